#!/usr/bin/env python3
"""report.py DIR: the tables of bench/gpu/run.sh, and for each figure the limit that holds it."""
import json
import pathlib
import sys

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "gpu-results")


def objects(name):
    """All JSON objects in the file, one a line or one for the whole file; none if it is missing or damaged."""
    path = folder / (name + ".json")
    text = path.read_text() if path.exists() else ""
    try:
        return [json.loads(text)]
    except ValueError:
        pass
    found = []
    for line in text.splitlines():
        try:
            found.append(json.loads(line))
        except ValueError:
            continue
    return found


def first(name):
    found = objects(name)
    return found[0] if found else None


def rate(run):
    """Frames a second, without the time before the first frame, in which shaders are compiled."""
    return run["frames"] / (run["elapsed_seconds"] - run["warm_up_ms"] / 1000)


def stages(run):
    """Median milliseconds of each stage on each wall."""
    return {(s["stage"], s["wall"]): s["ms"]["p50"] for s in run["stages"] if s["ms"]["count"] > 0}


def limit(run):
    """The stage that takes the largest part of a frame."""
    frame = 1000 / rate(run)
    (stage, wall), most = max(stages(run).items(), key=lambda item: item[1])
    where = f"{stage} {wall}" if wall else stage
    kind = "holds it" if most > 0.8 * frame else "is the longest; no stage fills the frame"
    return f"{where}: {most:.2f} ms of {frame:.2f} ms {kind}"


print((folder / "machine.txt").read_text().strip() if (folder / "machine.txt").exists() else "")

run = first("gpu-olympia")
if run:
    how = run["how_drawn"]
    print(f"\nOlympia by OpenGL, {run['width']}x{run['height']} x {run['walls']} x {run['stereo']}: {rate(run):.1f} frames a second")
    print(f"  renderer {how['renderer']}: {how.get('renderer_why', '')}; {'; '.join(run['remarks'])}")
    print(f"  limit: {limit(run)}")
run = first("gpu-olympia-120hz")
if run:
    print(f"\nThe same at {run['rate_hz']:g} Hz: {run['frames_drawn']} frames drawn, {run['late_frames']} ticks without a new one")
    for wall, ms in run["motion_to_image_ms"].items():
        print(f"  motion to image, {wall}: p50 {ms['p50']:.2f} ms, p99 {ms['p99']:.2f} ms, {ms['p99'] * run['rate_hz'] / 1000:.2f} frames")
profile = first("gpu-olympia-passes")
if profile:
    print("\nPasses of Draw, milliseconds a frame")
    print(f"  {profile['draw_method']}")
    for stage in profile["stages"]:
        if stage["stage"].startswith("draw"):
            print(f"  {stage['stage']:12} {stage['part'] or 'whole':24} {stage['ms']:9.3f}, 95 % {stage['p95_ms']:9.3f}")
rows = [(scene, first(f"gpu-walls-{scene}")) for scene in "abc"]
if any(row for _, row in rows):
    print("\nScenes of bench walls, class OPEN")
    for scene, row in rows:
        if row:
            print(
                f"  {scene}: {row['fps']:.1f} frames a second; latency p50 {row['latency_ms_median']:.2f} ms,"
                f" p99 {row['latency_ms_p99']:.2f} ms; {row['renderer']}"
            )
ways = {way: [r for r in (first(f"gpu-olympia-{way}-{n}") for n in (1, 2)) if r] for way in ("direct", "mapped", "indirect", "both")}
if any(ways.values()):
    print("\nHow OpenGL gets its work (--gl-submission), Olympia as above; the faster of two runs")
    for way, runs in ways.items():
        if not runs:
            continue
        best = max(runs, key=rate)
        calls = sum(view["calls"] / view["frames"] for view in best["drawn"])
        draw = [ms for (stage, wall), ms in stages(best).items() if stage == "draw"]
        print(f"  {way:8} {rate(best):8.1f} frames a second; draw {max(draw, default=0):.2f} ms; {calls:.0f} draw calls a frame")
    for way in ("direct", "both"):
        row = first(f"gpu-walls-b-{way}")
        if row:
            print(f"  {way:8} {row['fps']:8.1f} frames a second in scene b of bench walls")
run = first("gpu-olympia-cards")
if run:
    print(f"\nOlympia with its walls on several cards: {rate(run):.1f} frames a second; limit: {limit(run)}")
looks = [row for row in objects("gpu-looks") if "rung" in row]
if looks:
    print("\nErrors against 64 samples a pixel, of 255")
    for row in looks:
        print(f"  {row['scene']:10} {row['wall']:6} {row['rung']:8} mean {row['mean']:.3f}, 99 % {row['p99']:.1f}, most {row['most']:.0f}")
alone = None
print("\nOlympia by the CPU renderer, 800x600 x 4 x 2")
for threads in (1, 2, 4, 8, 16):
    run = first(f"cpu-olympia-{threads}")
    if not run:
        continue
    alone = alone or rate(run)
    text = f"  {threads:2} threads: {rate(run):6.1f} frames a second, {rate(run) / alone:5.2f} times one thread"
    plan = first(f"plan-olympia-{threads}")
    if plan:
        predicted = plan["forecast"]["frames_per_second"]
        text += f"; plan says {predicted:.1f}, {100 * (predicted / rate(run) - 1):+.0f} %, held by {plan['forecast']['bottleneck']}"
    print(text)
    print(f"      limit: {limit(run)}")
