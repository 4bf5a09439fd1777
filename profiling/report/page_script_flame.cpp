#include "profiling/report/page_parts.h"

namespace stadion::report {

const char* const kFlameScript = R"js(
/// Parts of the stages themselves that are not shared among nodes.
const kOwnParts = {app: ["loading", "mail", "sound", "watching"], cull: [], draw: ["sky", "resolve"]};

/// A stage's time as a tree: the scene's nodes, the stage's own parts, what is not explained.
function flameTree(stage) {
  // Below what holds it a node needs no path.
  const labelOf = n => n.parent !== undefined && n.path.startsWith(data.nodes[n.parent].path + "/") ? n.path.slice(data.nodes[n.parent].path.length + 1) : n.path;
  const boxes = data.nodes.map((n, i) => ({label: labelOf(n), node: n, index: i, own: n[stage] || 0, children: []}));
  const world = {label: "World", own: 0, children: [], say: "all nodes"};
  data.nodes.forEach((n, i) => (n.parent === undefined ? world : boxes[n.parent]).children.push(boxes[i]));
  const explained = data.stages.explained.find(e => e.stage === stage) || {measured: 0, nodes: 0, named: 0};
  const parts = {label: "the stage's own parts", own: 0, children: [], say: "what is spent on no node"};
  let left = explained.named;
  for (const part of kOwnParts[stage]) {
    let sum = 0;
    for (const r of data.stages.rows)
      if (r.part === part && (stage === "draw" ? r.name.endsWith(", alone") && r.name.startsWith("draw") : r.name.startsWith(stage))) sum += r.ms;
    sum = Math.min(sum, left), left -= sum;
    if (sum > 0) parts.children.push({label: part, own: sum, children: [], say: "a part of " + NAMES[stage]});
  }
  parts.own = Math.max(0, left);
  const root = {label: NAMES[stage], own: 0, children: [world, parts], say: stage === "draw" ? "all walls and eyes, each eye drawn alone" : stage === "cull" ? "all walls" : "one frame"};
  weigh(world), weigh(parts);
  const rest = explained.measured - world.total - parts.total;
  if (rest > 0) root.children.push({label: "not explained", own: rest, total: rest, children: [], say: "measured, and found with nobody"});
  weigh(root);
  return root;
}
function weigh(box) {
  box.total = box.own;
  for (const c of box.children) c.parent = box, weigh(c), box.total += c.total;
  box.children = box.children.filter(c => c.total > 0).sort((a, b) => b.total - a.total);
}
function findBox(box, index) {
  if (box.index === index) return box;
  for (const c of box.children) { const found = findBox(c, index); if (found) return found; }
  return null;
}
const heightOf = box => 1 + Math.max(0, ...box.children.map(heightOf));
/// The same name has the same shade everywhere.
function shade(label) {
  let h = 7;
  for (const c of label) h = (h * 31 + c.codePointAt(0)) % 997;
  return 0.55 + 0.45 * h / 997;
}

function drawFlame() {
  const measured = STAGES.filter(s => (data.stages.explained.find(e => e.stage === s) || {}).measured > 0);
  const stage = measured.includes(chosen.get("stage")) ? chosen.get("stage") : measured[measured.length - 1];
  if (!stage) return put("flame-plot", el("p", {class: "quiet"}, "Nothing was measured."));
  const tree = flameTree(stage), zoomed = chosen.get("node") === undefined ? null : findBox(tree, Number(chosen.get("node")));
  const root = zoomed || tree, above = [];
  for (let b = root.parent; b; b = b.parent) above.unshift(b);
  const W = widthOf("flame-plot"), row = 23, H = row * (above.length + heightOf(root)) + 2;
  const s = svg("svg", {viewBox: `0 0 ${W} ${H}`, role: "img", "aria-label": `${NAMES[stage]} along the scene tree`});
  const zoomTo = b => chosen.set({node: b.index === undefined ? null : b.index});
  const draw = (b, at, w, y, faded) => {
    if (w < 0.5) return;
    const isNode = b.index !== undefined;
    const rect = svg("rect", {class: "click", tabindex: w > 12 ? 0 : null, x: at, y, width: Math.max(0.4, w - 0.8), height: row - 2, rx: w > 5 ? 3 : 0, fill: isNode || b === tree ? colour[stage] : "var(--wait)",
      opacity: faded ? 0.3 : b.label === "not explained" ? 0.25 : isNode ? shade(b.label) : b === tree ? 1 : 0.5, onclick: () => zoomTo(b), onkeydown: e => { if (e.key === "Enter") zoomTo(b); }});
    const place = isNode && b.node.place ? b.node.place : "", kind = isNode && b.node.kind ? b.node.kind : "";
    const parts = [b.label, kind, msText(b.total) + " a frame", b.children.length > 0 && b.own > 0 ? `itself ${msText(b.own)}` : "", percent(b.total / (tree.total || 1)) + ` of ${NAMES[stage]}`, place || b.say || ""];
    if (isNode && stage === "app" && b.node.phases) {
      const names = ["receive", "simulate", "dispatch", "settle", "publish"];
      parts.push(b.node.phases.map((v, i) => v > 0 ? `${names[i]} ${msText(v)}` : "").filter(t => t).join(", "));
    }
    const told = parts.filter(t => t);
    rect.append(svg("title", {}, told.join("\n")));
    s.append(reads(rect, "flame-readout", told));
    const text = fitted(w > 190 ? `${b.label}  ${msText(b.total)}` : b.label, w - 10);
    if (text) s.append(svg("text", {class: !faded && (b === tree || isNode && shade(b.label) > 0.78) ? "on" : "", x: at + 5, y: y + 15, style: "pointer-events:none"}, text));
  };
  above.forEach((b, i) => draw(b, 0, W, i * row, true));
  const lay = (b, at, w, y) => {
    draw(b, at, w, y, false);
    let x = at;
    for (const c of b.children) { const cw = w * c.total / b.total; if (cw >= 0.5) lay(c, x, cw, y + row); x += cw; }
  };
  if (root.total > 0) lay(root, 0, W, above.length * row);
  put("flame-plot", s);
  put("flame-nav", ...measured.map(k => choice(NAMES[k], k === stage, {stage: k})), el("span", {class: "gap"}), zoomed ? choice("the whole scene", false, {node: null}) : null);
  const how = {app: "Every node's phases are timed in every frame: receive, simulate, dispatch, and what the scene does for it.",
               cull: "Timed for each wall as a whole; in the frames that are sampled a node has its share of the tests, fillings and sorts that it took part in.",
               draw: "In the frames that are sampled a few batches are drawn alone, each in its place, until all have been; measured as " + data.head.drawMethod + "."};
  byId("flame-say").textContent = "A node's width is what it and all below it in the scene take of the stage, per frame. Click to zoom in. " + how[stage];
  put("flame-readout", zoomed ? el("b", {}, zoomed.label) : "", zoomed ? `  ${msText(zoomed.total)} a frame` : "");
}
)js";

}  // namespace stadion::report
