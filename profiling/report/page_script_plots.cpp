#include "profiling/report/page_parts.h"

namespace stadion::report {

const char* const kPlotScript = R"js(
/// All frames of the run, from left to right: how long after the one before each was shown.
function drawStrip() {
  const {columns, framesEach} = data.strip;
  if (columns.length === 0) return put("strip", el("p", {class: "quiet"}, "No frame was shown."));
  const W = widthOf("strip"), H = 150, left = 40, bottom = 20, top = 8;
  const sorted = columns.map(c => c[1]).sort((a, b) => a - b);
  const most = Math.max(budget * 1.3, Math.min(sorted[sorted.length - 1], sorted[Math.floor(0.98 * (sorted.length - 1))] * 2.2)) || 1;
  const x = i => left + i / columns.length * (W - left), y = v => H - bottom - Math.min(v, most) / most * (H - bottom - top);
  const s = svg("svg", {viewBox: `0 0 ${W} ${H}`, role: "img", "aria-label": "frame to frame, all frames"});
  const step = niceStep(most, 4);
  for (let v = 0; v <= most; v += step)
    s.append(svg("line", {class: "grid", x1: left, x2: W, y1: y(v), y2: y(v)}),
             svg("text", {class: "quiet", x: left - 6, y: y(v) + 4, "text-anchor": "end"}, plain(v)));
  const w = Math.max(0.6, (W - left) / columns.length - (W / columns.length > 3 ? 0.7 : 0));
  columns.forEach(([frame, period, sampled, late, app, cull, draw], i) => {
    const fillWith = sampled ? "var(--sampled)" : late ? "var(--bad)" : "var(--frame)";
    const bar = svg("rect", {class: "click", x: x(i), width: w, y: y(period), height: H - bottom - y(period), fill: fillWith, opacity: sampled ? 0.35 : 0.9,
                             onclick: () => showFrame(frame)});
    s.append(reads(bar, "strip-readout", [`frame ${frame}`, msText(period) + " after the one before", `App ${msText(app)}`, `Cull up to ${msText(cull)}`,
                   `Draw up to ${msText(draw)}`, sampled ? "sampled" : late ? "late" : "in time"]));
    if (period > most) s.append(svg("path", {d: `M${x(i) + w / 2 - 3} ${top}l3 -5l3 5z`, fill: fillWith}));
  });
  const each = niceStep(columns[columns.length - 1][0] - columns[0][0] || 1, W / 130);
  columns.forEach(([frame], i) => {
    const before = i > 0 ? columns[i - 1][0] : -1;
    if (each >= 1 && Math.floor(frame / each) !== Math.floor(before / each) && i > 0)
      s.append(svg("text", {class: "quiet", x: x(i), y: H - 5, "text-anchor": "middle"}, String(Math.floor(frame / each) * each)));
  });
  if (budget > 0 && budget < most)
    s.append(svg("line", {class: "budget", x1: left, x2: W, y1: y(budget), y2: y(budget)}),
             svg("text", {class: "bad halo", x: W - 4, y: y(budget) - 5, "text-anchor": "end"}, `budget ${ms(budget)} ms`));
  put("strip", s);
  const longest = columns.filter(c => !c[2]).sort((a, b) => b[1] - a[1])[0];
  if (longest) put("strip-readout", `the longest that was not sampled: frame ${longest[0]}, ${msText(longest[1])}`);
  byId("run-say").textContent = "Milliseconds from one frame to the next, frame by frame" + (framesEach > 1 ? `, the longest of ${framesEach} in each column` : "") +
    ". Red came more than half a frame too late at the show's rate; grey were sampled, or follow one that was, which takes time. Click for the frame below.";
}

/// The stretch that holds a frame, or the nearest one.
function showFrame(frame) {
  let best = null, far = Infinity;
  for (const s of data.stretches)
    for (const f of s.frames)
      if (Math.abs(f.frame - frame) < far) far = Math.abs(f.frame - frame), best = [s.key, f.frame];
  if (best) chosen.set({stretch: best[0], frame: best[1], view: far === 0 ? "one" : "some"});
}

function histogram(d) {
  const W = 330, H = 128, left = 4, bottom = 18, top = 26, end = d.from + d.step * d.bins.length;
  const most = Math.max(...d.bins), x = v => left + (v - d.from) / (end - d.from) * (W - 2 * left), y = n => H - bottom - n / most * (H - bottom - top);
  const s = svg("svg", {viewBox: `0 0 ${W} ${H}`, role: "img", "aria-label": `histogram of ${d.name}`});
  d.bins.forEach((n, i) => {
    if (n === 0) return;
    const from = d.from + i * d.step, last = i === d.bins.length - 1;
    s.append(svg("rect", {x: x(from) + 0.4, width: (W - 2 * left) / d.bins.length - 0.8, y: y(n), height: H - bottom - y(n), fill: colour[d.stage]},
      svg("title", {}, `${n} frames: ${ms(from)} ` + (last ? "ms or more" : `to ${ms(from + d.step)} ms`))));
  });
  s.append(svg("line", {class: "grid", x1: left, x2: W - left, y1: H - bottom, y2: H - bottom}));
  const step = niceStep(end - d.from, 5);
  for (let v = Math.ceil(d.from / step) * step; v <= end; v += step)
    s.append(svg("text", {class: "quiet", x: x(v), y: H - 4, "text-anchor": "middle"}, plain(v)));
  // Labels of close marks stand on two heights.
  let lastX = [-100, -100];
  for (const [name, v] of [["median", d.median], ["mean", d.mean], ["p95", d.p95], ["p99", d.p99]].sort((a, b) => a[1] - b[1])) {
    const at = x(v), row = at - lastX[0] > 44 ? 0 : 1;
    lastX[row] = at;
    s.append(svg("line", {x1: at, x2: at, y1: row === 0 ? 12 : 24, y2: H - bottom, stroke: "var(--mark)", "stroke-width": 1, opacity: 0.65}),
             svg("text", {class: "quiet", x: Math.min(Math.max(at, 18), W - 20), y: row === 0 ? 9 : 21, "text-anchor": "middle"}, name));
  }
  if (budget >= d.from && budget <= end) s.append(svg("line", {class: "budget", x1: x(budget), x2: x(budget), y1: 12, y2: H - bottom}));
  const where = budget <= 0 || (budget >= d.from && budget <= end) ? "" : budget > end ? ", budget far to the right" : ", budget to the left";
  return el("figure", {}, el("figcaption", {}, d.name), s,
    el("p", {}, `mean ${ms(d.mean)}, median ${ms(d.median)}, p95 ${ms(d.p95)}, p99 ${ms(d.p99)}, max ${ms(d.max)} ms${where}`));
}
function drawHistograms() {
  put("histograms", ...data.distributions.map(histogram));
}
)js";

}  // namespace stadion::report
