#include "profiling/report/page_parts.h"

namespace stadion::report {

const char* const kFlameScript = R"js(
/// Parts of the stages themselves that are not shared among nodes.
const kOwnParts = {app: ["loading", "mail", "sound", "watching"], cull: [], draw: ["sky", "resolve"]};

/// Of Draw, eyes drawn alone: nodes are drawn alone, too.
const explainedOf = stage => data.stages.explained.find(e => e.stage === (stage === "draw" ? "alone" : stage));
/// A stage's time as a tree: the scene's nodes, the stage's own parts, what is not explained.
function flameTree(stage) {
  // Below what holds it a node needs no path.
  const labelOf = n => n.parent !== undefined && n.path.startsWith(data.nodes[n.parent].path + "/") ? n.path.slice(data.nodes[n.parent].path.length + 1) : n.path;
  const boxes = data.nodes.map((n, i) => ({label: labelOf(n), node: n, index: i, own: n[stage] || 0, children: []}));
  const world = {label: "World", own: 0, children: [], say: "all nodes"};
  data.nodes.forEach((n, i) => (n.parent === undefined ? world : boxes[n.parent]).children.push(boxes[i]));
  const explained = explainedOf(stage) || {measured: 0, nodes: 0, named: 0};
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
  if (rest > 0) root.children.push({label: "not explained", own: rest, total: rest, children: [], say: "measured, but not explained by any node or part"});
  weigh(root);
  for (const b of [world, ...boxes]) gather(b);
  return root;
}
/// Very many below one node are too narrow to be seen: those that are alike, by kind and by name without its
/// number, become one box, in which the most expensive come first, a hundred together.
const kTogether = 100;
function gather(box) {
  if (box.children.length <= kTogether) return;
  const alike = new Map(), kept = [];
  for (const c of box.children) {
    if (c.total > 0.02 * box.total || !c.node) { kept.push(c); continue; }
    const name = c.label.replace(/[0-9]+$/, ""), id = (c.node.kind || "") + " " + name;
    if (!alike.has(id)) alike.set(id, {say: c.node.kind || "", stem: name + "\u2026", key: (box.index === undefined ? "w" : box.index) + ":" + id, boxes: []});
    alike.get(id).boxes.push(c);
  }
  for (const a of alike.values()) {
    const all = together(box, `${a.boxes.length} \u00d7 ${a.stem}`, a.say, a.key, a.boxes);
    if (a.boxes.length > kTogether) {
      const each = Math.max(kTogether, Math.ceil(a.boxes.length / kTogether)), parts = [];
      for (let i = 0; i < a.boxes.length; i += each)
        parts.push(together(all, `${i + 1} to ${Math.min(i + each, a.boxes.length)} of ${a.stem}`, "in the order of cost", `${a.key}:${i}`, a.boxes.slice(i, i + each)));
      all.children = parts;
    }
    kept.push(...(a.boxes.length > 2 ? [all] : a.boxes));
    if (a.boxes.length <= 2) for (const b of a.boxes) b.parent = box;
  }
  box.children = kept.sort((a, b) => b.total - a.total);
}
function together(parent, label, say, key, boxes) {
  const box = {label, say, key, parent, own: 0, children: boxes, total: boxes.reduce((s, b) => s + b.total, 0)};
  for (const b of boxes) b.parent = box;
  return box;
}
function weigh(box) {
  box.total = box.own;
  for (const c of box.children) c.parent = box, weigh(c), box.total += c.total;
  box.children = box.children.filter(c => c.total > 0).sort((a, b) => b.total - a.total);
}
const addressOf = box => box.key !== undefined ? box.key : box.index === undefined ? null : String(box.index);
function findBox(box, address) {
  if (addressOf(box) === address) return box;
  for (const c of box.children) { const found = findBox(c, address); if (found) return found; }
  return null;
}
/// In rows, of what is wide enough to be seen.
const kNarrow = 0.5;
const heightOf = (box, w) => 1 + box.children.reduce((most, c) => { const cw = w * c.total / (box.total || 1); return cw < kNarrow ? most : Math.max(most, heightOf(c, cw)); }, 0);
/// The same name has the same shade everywhere.
function shade(label) {
  let h = 7;
  for (const c of label) h = (h * 31 + c.codePointAt(0)) % 997;
  return 0.55 + 0.45 * h / 997;
}

function drawFlame() {
  const measured = STAGES.filter(s => (explainedOf(s) || {}).measured > 0);
  const stage = measured.includes(chosen.get("stage")) ? chosen.get("stage") : measured[measured.length - 1];
  if (!stage) return put("flame-plot", el("p", {class: "quiet"}, "Nothing was measured."));
  const tree = flameTree(stage), zoomed = chosen.get("node") === undefined ? null : findBox(tree, chosen.get("node"));
  const root = zoomed || tree, above = [];
  for (let b = root.parent; b; b = b.parent) above.unshift(b);
  const W = widthOf("flame-plot"), row = 23, H = row * (above.length + heightOf(root, W)) + 2;
  const s = svg("svg", {viewBox: `0 0 ${W} ${H}`, role: "img", "aria-label": `${NAMES[stage]} along the scene tree`});
  const zoomTo = b => chosen.set({node: addressOf(b)});
  const draw = (b, at, w, y, faded) => {
    if (w < kNarrow) return;
    const isNode = b.index !== undefined || b.key !== undefined;
    const rect = svg("rect", {class: "click", tabindex: w > 12 ? 0 : null, x: at, y, width: Math.max(0.4, w - 0.8), height: row - 2, rx: w > 5 ? 3 : 0, fill: isNode || b === tree ? colour[stage] : "var(--wait)",
      opacity: faded ? 0.3 : b.label === "not explained" ? 0.25 : isNode ? shade(b.label) : b === tree ? 1 : 0.5, onclick: () => zoomTo(b), onkeydown: e => { if (e.key === "Enter") zoomTo(b); }});
    const place = b.node && b.node.place ? b.node.place : "", kind = b.node && b.node.kind ? b.node.kind : "";
    const parts = [b.label, kind, msText(b.total) + " a frame", b.children.length > 0 && b.own > 0 ? `itself ${msText(b.own)}` : "", percent(b.total / (tree.total || 1)) + ` of ${NAMES[stage]}`, place || b.say || ""];
    if (b.node && stage === "app" && b.node.phases) {
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
    let narrow = 0;
    for (const c of b.children) { const cw = w * c.total / b.total; if (cw >= kNarrow) lay(c, x, cw, y + row), x += cw; else narrow += 1; }
    const room = at + w * (b.total - b.own) / b.total - x;
    if (narrow > 0 && room > 3) s.append(svg("rect", {x, y: y + row, width: room - 0.8, height: row - 2, fill: "var(--wait)", opacity: 0.35}, svg("title", {}, `${narrow} more, each too little to be seen; click above to zoom in`)));
  };
  if (root.total > 0) lay(root, 0, W, above.length * row);
  put("flame-plot", s);
  put("flame-nav", ...measured.map(k => choice(NAMES[k], k === stage, {stage: k})), el("span", {class: "gap"}), zoomed ? choice("the whole scene", false, {node: null}) : null);
  const how = {app: "A node's phases are timed when App visits it: receive, simulate, dispatch, and what the scene does for it. Where App visits hundreds of nodes, this is done in some frames only.",
               cull: "Timed for each wall as a whole; in the frames that are sampled a node has its share of the tests, fillings and sorts that it took part in.",
               draw: "In the frames that are sampled a few batches are drawn alone, each in its place, until all have been; measured as " + data.head.drawMethod + "."};
  byId("flame-say").textContent = "A node's width is what it and all below it in the scene take of the stage, per frame. Click to zoom in. Very many alike are one box. " + how[stage];
  put("flame-readout", zoomed ? el("b", {}, zoomed.label) : "", zoomed ? `  ${msText(zoomed.total)} a frame` : "");
}
)js";

}  // namespace stadion::report
