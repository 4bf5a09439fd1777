#!/usr/bin/env bash
# FOLDER/run.sh [--out DIR] [--gl auto|egl|osmesa] [--quick]: what Stadion does on this machine, in at most five minutes.
# FOLDER was made by bench/gpu/pack.sh. First OpenGL: Olympia and the walls of `bench walls` at 1920x1200, four stereo
# walls: frames a second, time of each pass, motion to image, late frames at 120 Hz. The same with mapped memory and indirect
# draws on and off, and with the walls on several cards, if there are some. Then errors of pictures, and the CPU
# renderer with 1, 2, 4, 8 and 16 threads beside the prediction of `stadion plan`. DIR (default: gpu-results) gets all
# outputs; report.py prints the tables and names for each figure the limit that holds it. --quick: few frames, small
# pictures, to try the script itself. Ends with 0 if every measurement ran, else with 1.
set -uo pipefail
here=$(dirname "$(readlink -f "$0")")
out=gpu-results gl=egl quick=
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=$2; shift 2 ;;
    --gl) gl=$2; shift 2 ;;
    --quick) quick=1; shift ;;
    --help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "run.sh: there is no $1; see --help" >&2; exit 2 ;;
  esac
done
mkdir -p "$out"
out=$(readlink -f "$out")
export LD_LIBRARY_PATH=$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} XDG_STATE_HOME=$out/state XDG_CACHE_HOME=$out/cache
stadion=$here/bin/stadion bench=$here/bin/stadion-bench measure=$here/bin/stadion-measure
olympia=$here/share/stadion/scripts/olympia.evs
size=1920x1200 frames=400 few=60 seconds=8 walls_frames=60 patience=1
[ -z "$quick" ] || { size=320x200; frames=8; few=8; seconds=1; walls_frames=4; patience=10; }
gpu="--renderer gl --gl $gl"
failed=0

measure() { # NAME LIMIT COMMAND...: its standard output becomes NAME.json
  local name=$1 limit=$(($2 * patience)) began=$SECONDS
  shift 2
  if timeout -k 5 "$limit" "$@" >"$out/$name.json" 2>"$out/$name.log"; then
    echo "$name: $((SECONDS - began)) s"
  else
    # A missed limit of a bench is a result, too.
    [ -s "$out/$name.json" ] && echo "$name: $((SECONDS - began)) s, see $name.log" || { echo "$name: FAILED, see $name.log" >&2; failed=1; }
  fi
}

{
  uname -srm
  grep -m1 "model name" /proc/cpuinfo
  nproc
  nvidia-smi --query-gpu=name,driver_version --format=csv,noheader 2>/dev/null || echo "no nvidia-smi"
} | tee "$out/machine.txt"
"$stadion" doctor >"$out/doctor.txt" 2>&1

# The graphics card.
measure gpu-olympia 40 "$stadion" run "$olympia" --walls cave4 --size $size $gpu --frames $frames --json
measure gpu-olympia-120hz 30 "$stadion" run "$olympia" --walls cave4 --size $size $gpu --pace lock --rate 120 --seconds $seconds --json
measure gpu-olympia-passes 40 "$measure" profile "$olympia" --walls cave4 --size $size $gpu --frames $((few + 40)) --json
for scene in a b c; do
  measure gpu-walls-$scene 25 "$bench" bench walls --one --scene $scene --class OPEN $gpu --width "${size%x*}" --height "${size#*x}" \
    --frames $walls_frames --json
done
# What mapped memory and indirect draws gain, each alone and both. Turns rather than blocks: a card changes its clock.
for round in 1 2; do
  for way in direct mapped indirect both; do
    measure gpu-olympia-$way-$round 15 "$stadion" run "$olympia" --walls cave4 --size $size $gpu --gl-submission $way \
      --frames $((frames / 4)) --json
  done
done
for way in direct both; do
  measure gpu-walls-b-$way 15 "$bench" bench walls --one --scene b --class OPEN $gpu --gl-submission $way --width "${size%x*}" \
    --height "${size#*x}" --frames $walls_frames --json
done
# Walls on several cards, in turn.
cards=$(nvidia-smi -L 2>/dev/null | grep -c ^GPU)
if [ "$cards" -gt 1 ]; then
  awk -v cards="$cards" '/^wall / {$0 = $0 "  card " wall++ % cards} {print}' "$here/share/stadion/walls/cave4.walls" >"$out/cards.walls"
  measure gpu-olympia-cards 40 "$stadion" run "$olympia" --walls "$out/cards.walls" --size $size $gpu --frames $frames --json
fi
measure gpu-looks 60 "$bench" bench looks --scenes kick,olympia-2,a --rungs 4,opengl --frames 1 --rounds 1 --no-perception --gl "$gl" --size 800x600 --json

# The processors.
for threads in 1 2 4 8 16; do
  [ "$threads" -le "$(nproc)" ] || continue
  measure cpu-olympia-$threads 60 "$stadion" run "$olympia" --walls cave4 --size 800x600 --renderer cpu --draw-threads $threads \
    --frames $((threads * few / 2 < frames ? threads * few / 2 : frames)) --json
  measure plan-olympia-$threads 30 "$measure" plan "$olympia" --walls cave4 --size 800x600 --renderer cpu --draw-threads $threads \
    --cores $threads --frames 8 --mode pipelined --json
done

if command -v python3 >/dev/null; then
  python3 "$here/report.py" "$out" | tee "$out/report.txt"
else
  echo "no python3 here: run report.py $out elsewhere"
fi
exit $failed
