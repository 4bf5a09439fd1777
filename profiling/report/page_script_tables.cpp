#include "profiling/report/page_parts.h"

namespace stadion::report {

const char* const kTableScript = R"js(
/// A table from columns {name, n (a number), cell(row), title(row), key(row)} and rows; the first column is
/// the row's head.
function table(caption, columns, rows, heads) {
  const cellOf = (c, r, i) => {
    const inside = c.cell(r), title = c.title ? c.title(r) : null;
    const e = i === 0 ? el("th", {scope: "row", title}) : el("td", {class: [c.n ? "n" : "", c.kind || ""].join(" ").trim() || null, title, style: c.style ? c.style(r) : null});
    e.append(...(Array.isArray(inside) ? inside : [inside]));
    return e;
  };
  return el("table", {class: heads && heads.kind || null}, caption ? el("caption", {}, caption) : null,
    el("thead", {}, el("tr", {}, ...columns.map((c, i) => heads && heads.head ? heads.head(c, i) : el("th", {scope: "col", class: c.n ? "n" : null, title: c.help || null}, c.name)))),
    el("tbody", {}, ...rows.map(r => el("tr", {}, ...columns.map((c, i) => cellOf(c, r, i))))));
}
const heat = (v, most, stage) => v > 0 ? `background:color-mix(in srgb, ${colour[stage]} ${Math.round(62 * Math.sqrt(v / most))}%, transparent)` : "";

/// Null is no 0: in so few frames it had no turn.
const priced = (v, inPart) => v === null ? [el("span", {class: "quiet", title: "not measured: it had no turn in these frames"}, "not measured")] : inPart ? [el("span", {title: "on some walls only: on the others it had no turn"}, "> " + ms(v))] : [ms(v)];
const nodeColumns = [
  {key: "path", name: "node", cell: n => [el("a", {href: "#flame", onclick: e => { e.preventDefault(); chosen.set({node: data.nodes.indexOf(n)}); byId("flame").scrollIntoView(); }}, n.path)], title: n => nodeText(n), by: n => n.path},
  {key: "place", name: "script", kind: "place", cell: n => shortPlace(n.place) + (n.unloaded ? " (unloaded)" : ""), title: n => n.place, by: n => n.place || ""},
  {key: "kind", name: "kind", cell: n => n.kind || "", by: n => n.kind || ""},
  {key: "budget", name: "budget", n: true, cell: n => ms(n.budget), by: n => n.budget || 0, help: "what its script allows it [ms]"},
  {key: "app", name: "App", n: true, cell: n => ms(n.app), by: n => n.app, help: "all phases, mean of all frames [ms]"},
  {key: "p95", name: "p95 visit", n: true, cell: n => n.visits > 0 ? ms(n.p95) : "\u2013", by: n => n.visits > 0 ? n.p95 : 0, help: "App without publishing, of the frames in which it was visited [ms]"},
  {key: "cull", name: "Cull", n: true, cell: n => priced(n.cull), by: n => n.cull || 0, help: "its share, all walls [ms]"},
  {key: "draw", name: "Draw", n: true, cell: n => priced(n.draw, n.inPart), by: n => n.draw || 0, help: "drawn alone, all walls and eyes [ms]"},
  {key: "drawing", name: "p95 drawing", n: true, cell: n => n.drawings > 0 ? ms(n.drawingP95) : "\u2013", by: n => n.drawingP95, title: n => n.drawings > 0 ? `${n.drawings} times, at most ${msText(n.drawingMax)}` : null, help: "each time it was drawn alone, on one wall for one eye [ms]"},
  {key: "total", name: "total", n: true, cell: n => ms(n.total), by: n => n.total, help: "App, Cull and Draw [ms]"},
  {key: "share", name: "share", n: true, kind: "bar", cell: n => [percent(n.share), el("i", {style: `width:${Math.min(100, 100 * n.share)}%`})], by: n => n.share, help: "of all stages of all walls"},
];

function drawNodes() {
  const by = nodeColumns.find(c => c.key === chosen.get("sort")) || nodeColumns.find(c => c.key === "total");
  const down = chosen.get("order", by.n ? "down" : "up") === "down", words = (chosen.get("find", "") || "").toLowerCase();
  const all = data.nodes.filter(n => n.total !== undefined && (words === "" || nodeText(n).toLowerCase().includes(words)));
  const rest = n => n.kind ? 0 : 1;  // what was too many comes after all others
  all.sort((a, b) => { if (rest(a) !== rest(b)) return rest(a) - rest(b); const x = by.by(a), y = by.by(b); return (x < y ? -1 : x > y ? 1 : 0) * (down ? -1 : 1); });
  const rows = Math.max(1, Number(chosen.get("rows", 30)) || 30), shown = all.slice(0, rows);
  const steps = [30, 300, 3000].filter(n => n < all.length).concat(all.length > 30 ? [all.length] : []);
  const head = c => el("th", {scope: "col", class: c.n ? "n" : null, title: c.help || null, "aria-sort": c === by ? (down ? "descending" : "ascending") : null},
    el("button", {type: "button", onclick: () => chosen.set({sort: c.key, order: c === by ? (down ? "up" : "down") : null})}, c.name));
  put("nodes-table", table(null, nodeColumns, shown, {head}));
  const field = byId("find") || el("input", {id: "find", type: "search", placeholder: "path, file or kind", "aria-label": "find nodes",
    value: chosen.get("find", ""), oninput: e => chosen.set({find: e.target.value || null})});
  put("nodes-nav", field, ...steps.map(n => choice(n === all.length ? `all ${n}` : n === 30 ? "the first 30" : String(n), n === Math.min(rows, all.length), {rows: n === 30 ? null : n})));
  const missed = data.nodes.filter(n => n.costs && (n.cull === null || n.draw === null || n.inPart)).length, needed = data.head.framesNeeded;
  const parted = data.head.whole < data.head.profiled ? `App by node is of ${data.head.whole} of the ${data.head.profiled} frames: in the others it had no processor for a while, or it visits too many nodes to record them each time. ` : "";
  byId("nodes-unmeasured").textContent = parted + (missed === 0 ? "" : needed === 0 ? "Draw was not measured: nothing was drawn." :
    `${missed} nodes had no turn in ${data.head.frames} frames, at least not on every wall; some ${needed} frames would do (--frames ${needed}).`);
  if (document.activeElement === document.body && words) field.focus();
}

function drawHeat() {
  const say = data.eyes.length > 0 ? `What drawing an eye takes when nothing else is drawn, in milliseconds: ${data.head.drawMethod}. Stages of different walls overlap, as far as there are processors; these figures do not.`
    : "Nothing was drawn.";
  byId("walls-say").textContent = say;
  if (data.eyes.length === 0) return;
  const eyes = [...new Set(data.eyes.map(e => e.eye))], most = Math.max(...data.eyes.map(e => e.ms), 1e-9);
  const at = (eye, wall) => data.eyes.find(e => e.eye === eye && e.wall === wall);
  const names = eyes.length === 1 ? ["the only eye"] : ["left eye", "right eye"];
  const total = eye => data.eyes.filter(e => e.eye === eye).reduce((s, e) => s + e.ms, 0);
  put("heat", table("Draw by wall and eye: mean, below it p95", [{name: "", cell: eye => names[eye]},
    ...data.walls.map((name, wall) => ({name, n: true, cell: eye => { const e = at(eye, wall); return e ? [ms(e.ms), el("br"), el("span", {class: "quiet"}, ms(e.p95))] : "\u2013"; },
      style: eye => at(eye, wall) ? heat(at(eye, wall).ms, most, "draw") : null, title: eye => at(eye, wall) ? `${at(eye, wall).count} times` : "not drawn"})),
    {name: "all walls", n: true, cell: eye => ms(total(eye))}], eyes, {kind: "heat"}));
  const seen = data.nodes.filter(n => n.walls && n.draw > 0).sort((a, b) => b.draw - a.draw).slice(0, 15);
  if (seen.length === 0) return;
  const onWall = (n, w) => n.walls[w] ? n.walls[w][1] + n.walls[w][2] : 0, known = (n, w) => n.walls[w] && (n.walls[w][1] !== null || n.walls[w][2] !== null), top = Math.max(...seen.flatMap(n => n.walls.map((_, w) => onWall(n, w))));
  put("node-heat", el("h3", {}, "The most expensive to draw, by wall"), table("Both eyes together, milliseconds a frame", [{name: "node", cell: n => n.path, title: nodeText},
    ...data.walls.map((name, w) => ({name, n: true, cell: n => known(n, w) ? ms(onWall(n, w)) : priced(null), style: n => heat(onWall(n, w), top, "draw"),
      title: n => n.walls[w] ? `left ${msText(n.walls[w][1])}, right ${msText(n.walls[w][2])}, Cull ${msText(n.walls[w][0])}` : null})),
    {name: "all walls", n: true, cell: n => ms(n.draw)}], seen, {kind: "heat"}));
}

function drawLate() {
  const judged = data.causes.reduce((s, c) => s + c[1], 0), late = data.causes.filter(c => c[0] !== "in time");
  const count = late.reduce((s, c) => s + c[1], 0);
  byId("late-say").textContent = judged === 0 ? "No frame was judged." : count === 0 ? `None of the ${judged} frames that sampling did not disturb came more than half a frame too late for ${plain(data.head.rate)} Hz.`
    : `${count} of ${judged} frames that sampling did not disturb came more than half a frame too late for ${plain(data.head.rate)} Hz.` + (data.late.length < count ? ` Below are the ${data.late.length} that came latest.` : "") +
      " Each has one cause: the stage that took longest, and why.";
  if (count === 0) return;
  const W = 700, most = Math.max(...late.map(c => c[1])), row = 24, s = svg("svg", {viewBox: `0 0 ${W} ${row * late.length + 4}`, role: "img", "aria-label": "late frames by cause", style: "max-width:700px"});
  late.sort((a, b) => b[1] - a[1]).forEach(([cause, n], i) => s.append(svg("text", {x: 0, y: i * row + 16}, cause), svg("rect", {x: 130, y: i * row + 4, width: Math.max(2, n / most * (W - 190)), height: row - 8, rx: 3, fill: "var(--bad)", opacity: 0.8}),
    svg("text", {class: "quiet", x: 136 + Math.max(2, n / most * (W - 190)), y: i * row + 16}, String(n))));
  put("causes", s);
  const rows = [...data.late].sort((a, b) => b.period - a.period), shown = chosen.get("lates") ? rows : rows.slice(0, 12);
  put("late-table", table(null, [
    {name: "frame", cell: f => [el("a", {href: "#timeline", onclick: e => { e.preventDefault(); showFrame(f.frame); byId("timeline").scrollIntoView(); }}, String(f.frame))]},
    {name: "after", n: true, cell: f => msText(f.period)}, {name: "cause", kind: "row", cell: f => f.cause}, {name: "stage", kind: "row", cell: f => NAMES[f.stage] ? NAMES[f.stage] + (f.wall ? " of wall " + f.wall : "") : f.stage},
    {name: "most expensive node of App that was over", cell: f => f.node >= 0 ? `${data.nodes[f.node].path}, ${msText(f.nodeMs)}` : "\u2013", title: f => f.node >= 0 ? data.nodes[f.node].place : null}, {name: "in words", kind: "words", cell: f => f.text}], shown),
    rows.length > 12 ? el("nav", {}, choice(chosen.get("lates") ? "fewer" : `all ${rows.length}`, false, {lates: chosen.get("lates") ? null : 1})) : "");
}

function drawDynamics() {
  const d = data.dynamics;
  if (!d || d.bodies.length === 0) return byId("dynamics").remove();
  byId("dynamics-say").textContent = "Bodies that dynamics nodes move. Share is the body's part of its dynamics node's time, by the arcs it begins. Cost is what the node takes with the body more than without it; error is how far the body ever is from where its finest model puts it. " +
    `Cheaper models that stay within ${metres(d.tolerance)} are named. ` + d.note;
  const worst = Math.max(...d.bodies.map(b => b.error || 0), d.tolerance), greatest = Math.max(...d.bodies.map(b => b.share), 1e-12);
  put("dynamics-table", table(null, [
    {name: "body", cell: b => b.name || "a body", title: b => b.place}, {name: "script", kind: "place", cell: b => shortPlace(b.place)}, {name: "collides as", cell: b => b.shape},
    {name: "share a frame", n: true, cell: b => msText(b.share), style: b => heat(b.share, greatest, "app")},
    {name: "cost a frame", n: true, cell: b => b.error === null ? "\u2013" : b.cost === null ? "below noise" : msText(b.cost)},
    {name: "error", n: true, cell: b => metres(b.error), style: b => b.error ? heat(b.error, worst, "draw") : null, title: b => b.beyond !== null ? `beyond ${metres(d.tolerance)} from ${plain(b.beyond)} s on` : null},
    {name: "at the end", n: true, cell: b => metres(b.endError)},
    {name: "what would do", cell: b => b.advice ? [b.advice, b.adviceCost !== null ? ` (${msText(b.adviceCost)}, ${metres(b.adviceError)})` : ` (${metres(b.adviceError)})`] : b.error === null ? "\u2013" : "as it is"},
    {name: "", cell: b => b.caution ? [el("span", {class: "quiet"}, "caution: " + b.caution)] : ""}], d.bodies));
}

function drawStages() {
  const e = data.stages.explained.filter(x => x.measured > 0);
  put("explained-table", table("Explained", [{name: "stage", cell: x => NAMES[x.stage]}, {name: "measured", n: true, cell: x => ms(x.measured)}, {name: "nodes", n: true, cell: x => ms(x.nodes)}, {name: "its own parts", n: true, cell: x => ms(x.named)},
    {name: "explained", n: true, cell: x => percent((x.nodes + x.named) / x.measured)}], e, {kind: "heat"}));
  put("stages-table", el("h3", {}, "By part"), table(null, [{name: "stage", cell: r => r.name}, {name: "part", cell: r => r.part ? r.part : [el("b", {}, "all of it")]}, {name: "mean a frame", n: true, cell: r => ms(r.ms)},
    {name: "p95", n: true, cell: r => ms(r.p95), help: "each time"}, {name: "max", n: true, cell: r => ms(r.max), help: "each time"}, {name: "", cell: r => r.wait ? [el("span", {class: "quiet"}, "waiting")] : ""}], data.stages.rows));
  const counts = data.stages.counts, kinds = [...new Set(counts.map(c => c.what))], whose = [...new Set(counts.map(c => c.of))];
  const count = (of, what) => counts.find(c => c.of === of && c.what === what), whole = v => v.toLocaleString("en", {maximumFractionDigits: v < 100 ? 1 : 0});
  put("counts-table", el("h3", {}, "Counted a frame"), table(null, [{name: "", cell: of => of}, ...kinds.filter(k => counts.some(c => c.what === k && c.max > 0)).map(what => ({name: what, n: true,
    cell: of => count(of, what) ? whole(count(of, what).mean) : "", title: of => count(of, what) ? `at most ${whole(count(of, what).max)}` : null}))], whose));
}
)js";

}  // namespace stadion::report
