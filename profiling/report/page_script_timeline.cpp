#include "profiling/report/page_parts.h"

namespace stadion::report {

const char* const kTimelineScript = R"js(
const kAround = 4;  // frames beside the chosen one
const spanName = what => data.spans[what];
const isWait = name => name.startsWith("for ");

/// A span's place in the page: which stage it belongs to, what it is called.
function meaning(span, stageOf) {
  const name = spanName(span[1]);
  if (isWait(name)) return {stage: "wait", label: name};
  if (STAGES.includes(name)) return {stage: name, label: NAMES[name]};
  if (name === "swap") return {stage: "frame", label: "swap"};
  return {stage: stageOf, label: span[4] >= 0 ? data.nodes[span[4]].path : name, node: span[4], phase: name};
}
const stageOfThread = name => name.startsWith("Cull") ? "cull" : name.startsWith("Draw") ? "draw" : "app";

/// The stretch and the frame that are chosen, and which frames are seen.
function timelineView() {
  const stretch = data.stretches.find(s => s.key === chosen.get("stretch", "worst")) || data.stretches[0];
  if (!stretch || stretch.frames.length === 0) return null;
  const number = Number(chosen.get("frame", stretch.about));
  let at = stretch.frames.findIndex(f => f.frame === number);
  if (at < 0) at = Math.max(0, stretch.frames.findIndex(f => f.frame === stretch.about));
  const view = chosen.get("view", "some");
  const first = view === "all" ? 0 : view === "one" ? at : Math.max(0, at - kAround);
  const last = view === "all" ? stretch.frames.length - 1 : view === "one" ? at : Math.min(stretch.frames.length - 1, at + kAround);
  return {stretch, at, view, frames: stretch.frames.slice(first, last + 1)};
}

function moveFrame(by) {
  const v = timelineView(), next = v && v.stretch.frames[v.at + by];
  if (next) chosen.set({stretch: v.stretch.key, frame: next.frame});
}

/// Rows of each thread: one for each depth that is seen between two times.
function lanesOf(stretch, from, to) {
  const depth = data.threads.map(() => -1);
  for (const f of stretch.frames)
    for (const s of f.spans) if (s[5] < to && s[5] + s[6] > from) depth[s[0]] = Math.max(depth[s[0]], Math.min(s[3], 3));
  return depth;
}
const swapOf = f => f.spans.find(s => spanName(s[1]) === "swap");
const endOf = s => s[5] + s[6];

/// From when to when: one frame from its App on, several from picture to picture [us].
function timesOf(v) {
  let from = Infinity, to = 0;
  for (const f of v.frames)
    for (const s of f.spans) if (!isWait(spanName(s[1]))) from = Math.min(from, s[5]), to = Math.max(to, endOf(s));
  const first = swapOf(v.frames[0]), last = swapOf(v.frames[v.frames.length - 1]);
  if (last) to = endOf(last);
  if (v.view !== "one" && first) from = endOf(first) - 1000 * v.frames[0].period;
  const room = (to - from) * 0.012 || 1;
  return [from - room, to + room];
}

function drawTimeline() {
  const v = timelineView();
  if (!v) return put("timeline-plot", el("p", {class: "quiet"}, "The run was too short for frames to be kept."));
  const W = widthOf("timeline-plot"), left = 92, top = 34, bar = [15, 12, 11, 10], gap = 9;
  const [from, to] = timesOf(v), depths = lanesOf(v.stretch, from, to), tops = [];
  let H = top;
  data.threads.forEach((_, i) => { tops.push(H); if (depths[i] >= 0) for (let d = 0; d <= depths[i]; ++d) H += bar[d] + 1; H += depths[i] >= 0 ? gap : 0; });
  H += 14;
  const x = t => left + (t - from) / (to - from) * (W - left);
  const s = svg("svg", {viewBox: `0 0 ${W} ${H}`, role: "img", "aria-label": `what the threads did in frames ${v.frames[0].frame} to ${v.frames[v.frames.length - 1].frame}`});
  s.append(svg("defs", {}, svg("pattern", {id: "waits", width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)"},
    svg("rect", {width: 6, height: 6, fill: "var(--wait)", opacity: 0.22}), svg("line", {x1: 0, y1: 0, x2: 0, y2: 6, stroke: "var(--wait)", "stroke-width": 2.2, opacity: 0.5})),
    svg("clipPath", {id: "plot"}, svg("rect", {x: left, y: 0, width: W - left, height: H}))));
  const step = niceStep((to - from) / 1000, W / 110) * 1000;
  for (let t = Math.ceil(from / step) * step; t < to; t += step)
    s.append(svg("line", {class: "grid", x1: x(t), x2: x(t), y1: top - 4, y2: H - 14}),
             svg("text", {class: "quiet", x: x(t), y: H - 2, "text-anchor": "middle"}, plain(t / 1000) + " ms"));
  data.threads.forEach((name, i) => { if (depths[i] >= 0) s.append(svg("text", {x: 0, y: tops[i] + 12}, fitted(name, left - 6))); });
  const g = svg("g", {"clip-path": "url(#plot)"});
  const yOf = span => { let y = tops[span[0]]; for (let d = 0; d < Math.min(span[3], 3); ++d) y += bar[d] + 1; return y; };
  let lastLabel = -100;
  for (const f of v.stretch.frames) {
    const parity = f.frame % 2, beside = v.view === "one" && f !== v.stretch.frames[v.at];
    for (const span of [...f.spans].sort((a, b) => a[3] - b[3] || a[5] - b[5])) {
      if (span[3] > 3) continue;
      const m = meaning(span, stageOfThread(data.threads[span[0]])), d = span[3], h = bar[Math.min(d, 3)], y = yOf(span);
      const isStage = d === 0 && m.stage !== "wait";
      // However short, a stage is seen.
      const at = Math.max(x(span[5]), left), end = Math.min(Math.max(x(endOf(span)), isStage ? at + 2 : 0), W), w = end - at;
      if (w < 0.25 || x(endOf(span)) < left) continue;
      const rect = svg("rect", {class: "click", x: at, y, width: Math.max(w - (w > 3 ? 0.6 : 0), 0.4), height: h, rx: w > 4 ? 2 : 0,
        fill: m.stage === "wait" ? "url(#waits)" : colour[m.stage], opacity: beside ? 0.16 : m.stage === "wait" ? 1 : isStage ? (parity ? 1 : 0.78) : m.node >= 0 ? 0.62 : 0.42,
        stroke: isStage && f.late && !beside && w > 6 ? "var(--bad)" : null, "stroke-width": isStage && f.late ? 1.6 : null, onclick: () => chosen.set({stretch: v.stretch.key, frame: f.frame, view: v.view === "one" && !beside ? "some" : "one"})});
      const node = m.node >= 0 ? data.nodes[m.node] : null;
      rect.append(svg("title", {}, `${m.label}${node ? ", " + m.phase : ""}: ${msText(span[7])}, frame ${f.frame}${node && node.place ? "\n" + node.place : ""}${f.verdict ? "\n" + f.verdict : ""}`));
      g.append(reads(rect, "timeline-readout", [m.label + (node ? ", " + m.phase : ""), msText(span[7]), `frame ${f.frame}`, data.threads[span[0]], node && node.place ? shortPlace(node.place) : "",
        f.sampled ? "sampled: drawing took longer for it" : "", f.verdict].filter(t => t)));
      const label = isStage ? `${m.label} ${f.frame}` : m.label;
      if (w > 30 && !beside && fitted(label, w - 8)) g.append(svg("text", {class: m.stage === "wait" ? "quiet" : isStage ? "on" : "", x: at + 4, y: y + h - (h > 13 ? 4 : 2.5), style: `font-size:${h > 13 ? 11 : 9.5}px;pointer-events:none`}, fitted(label, w - 8)));
    }
    const swap = swapOf(f);
    if (!swap) continue;
    const at = x(endOf(swap));
    if (at < left || at > W) continue;
    s.append(svg("line", {x1: at, x2: at, y1: top - 8, y2: H - 14, stroke: f.late ? "var(--bad)" : "var(--frame)", "stroke-width": f.late ? 1.5 : 1, opacity: f.late ? 0.9 : 0.5}));
    if (at - lastLabel > 46 || f.frame === v.stretch.about) {
      lastLabel = at;
      s.append(reads(svg("text", {class: f.late ? "bad" : "quiet", x: Math.min(at, W - 22), y: 11, "text-anchor": "middle"}, String(f.frame)), "timeline-readout",
        [`frame ${f.frame}`, `shown ${msText(f.period)} after the one before`, f.verdict].filter(t => t)),
        svg("text", {class: f.late ? "bad" : "quiet", x: Math.min(at, W - 22), y: 22, "text-anchor": "middle"}, f.sampled ? "sampled" : f.period > 0 ? ms(f.period) : ""));
    }
  }
  s.append(g);
  put("timeline-plot", s);
  put("timeline-nav", ...data.stretches.map(st => choice(`${st.label} (${st.about})`, st === v.stretch, {stretch: st.key, frame: st.about, view: null})), el("span", {class: "gap"}),
    choice("one frame", v.view === "one", {view: "one"}), choice("nine", v.view === "some", {view: null}), choice("all of them", v.view === "all", {view: "all"}), el("span", {class: "gap"}),
    el("button", {type: "button", title: "the frame before", onclick: () => moveFrame(-1)}, "\u2190"), el("button", {type: "button", title: "the next frame", onclick: () => moveFrame(1)}, "\u2192"));
  const verdict = v.stretch.frames[v.at].verdict;
  put("timeline-readout", verdict ? el("span", {class: "bad"}, verdict) : `frame ${v.stretch.frames[v.at].frame}, shown ${msText(v.stretch.frames[v.at].period)} after the one before`);
  put("timeline-key", ...[["app", "App"], ["cull", "Cull"], ["draw", "Draw"], ["wait", "waiting"], ["frame", "shown"]].map(([k, t]) => el("span", {}, el("i", {style: `background:${colour[k]}`}), t)),
    el("span", {}, el("i", {style: "border:2px solid var(--bad)"}), "late"));
}
document.addEventListener("keydown", e => {
  if (e.target.tagName === "INPUT" || e.altKey || e.ctrlKey || e.metaKey) return;
  if (e.key === "ArrowLeft") moveFrame(-1), e.preventDefault();
  if (e.key === "ArrowRight") moveFrame(1), e.preventDefault();
});
)js";

}  // namespace stadion::report
