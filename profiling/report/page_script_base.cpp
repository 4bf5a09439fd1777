#include "profiling/report/page_parts.h"

namespace stadion::report {

const char* const kBaseScript = R"js(
const data = JSON.parse(document.getElementById("data").textContent);
/// Nodes as the tables want them: what is left out in the data is put in again.
function readNodes() {
  for (const n of data.nodes) {
    if (n.place) n.place = data.files[n.place[0]] + ":" + n.place[1];
    if (n.kind !== undefined) n.kind = data.kinds[n.kind];
    if (!n.costs) continue;
    [n.app, n.cull, n.draw] = n.costs;
    [n.visits, n.p95, n.max] = n.visits || [0, 0, 0];
    [n.drawings, n.drawingP95, n.drawingMax] = n.drawings || [0, 0, 0];
    n.total = n.app + n.cull + n.draw, n.share = n.share || 0;
  }
}
readNodes();
const byId = id => document.getElementById(id);
const kSvg = "http://www.w3.org/2000/svg";
const STAGES = ["app", "cull", "draw"];
const NAMES = {app: "App", cull: "Cull", draw: "Draw", frame: "Frame", alone: "each eye drawn alone, before scaling"};
const budget = data.head.rate > 0 ? 1000 / data.head.rate : 0;
const colour = {frame: "var(--frame)", app: "var(--app)", cull: "var(--cull)", draw: "var(--draw)", wait: "var(--wait)"};

/// An element. Texts are set as texts: nothing that a script names itself becomes markup.
function el(tag, attributes, ...children) {
  const e = document.createElement(tag);
  return fill(e, attributes, children);
}
function svg(tag, attributes, ...children) {
  const e = document.createElementNS(kSvg, tag);
  return fill(e, attributes, children);
}
function fill(e, attributes, children) {
  for (const [k, v] of Object.entries(attributes || {})) {
    if (v === null || v === undefined || v === false) continue;
    if (k.startsWith("on")) e.addEventListener(k.slice(2), v);
    else e.setAttribute(k, v);
  }
  e.append(...children.filter(c => c !== null && c !== undefined));
  return e;
}
function put(id, ...children) { byId(id).replaceChildren(...children.filter(c => c !== null && c !== undefined)); }

/// Three digits, in milliseconds without the unit.
function ms(v) {
  if (v === null || v === undefined) return "\u2013";
  if (v === 0) return "0";
  const size = Math.abs(v);
  if (size < 0.00005) return "<0.0001";
  return size >= 100 ? v.toFixed(0) : size >= 10 ? v.toFixed(1) : size >= 1 ? v.toFixed(2) : size >= 0.1 ? v.toFixed(3) : v.toFixed(4);
}
const three = v => String(Number(v.toPrecision(3)));
const msText = v => v === null ? "not measured" : v === 0 ? "0 ms" : Math.abs(v) < 0.1 ? three(1000 * v) + " \u00b5s" : ms(v) + " ms";
const percent = v => v === null || v === undefined ? "\u2013" : v >= 0.0995 ? (100 * v).toFixed(0) + " %" : (100 * v).toFixed(1) + " %";
function metres(v) {
  if (v === null || v === undefined) return "\u2013";
  if (v === 0) return "0";
  const size = Math.abs(v);
  return size < 1e-9 ? "<1 nm" : size < 1e-6 ? three(1e9 * v) + " nm" : size < 1e-3 ? three(1e6 * v) + " \u00b5m"
    : size < 1 ? three(1e3 * v) + " mm" : three(v) + " m";
}
const shortPlace = place => place ? place.replace(/^.*\//, "") : "";
const nodeText = n => n.path + (n.place ? "  " + n.place : "") + (n.unloaded ? " (unloaded)" : "");

/// As much of a text as there is room for.
function fitted(text, room) {
  const letters = Math.floor(room / 6.3);
  return text.length <= letters ? text : letters < 4 ? "" : text.slice(0, letters - 1) + "\u2026";
}

/// What is chosen stands in the address, so that a view can be kept and passed on.
const chosen = {
  values: new Map(new URLSearchParams(location.hash.slice(1))),
  get(key, otherwise) { return this.values.has(key) ? this.values.get(key) : otherwise; },
  set(changes) {
    for (const [k, v] of Object.entries(changes)) v === null ? this.values.delete(k) : this.values.set(k, String(v));
    const text = new URLSearchParams([...this.values]).toString();
    history.replaceState(null, "", "#" + text);
    drawAll();
  },
};

/// The room a plot has, in pixels.
const widthOf = id => Math.max(280, Math.floor(byId(id).getBoundingClientRect().width));

/// Steps of 1, 2 or 5 of which about `count` are in the range.
function niceStep(range, count) {
  const raw = range / count, power = Math.pow(10, Math.floor(Math.log10(raw)));
  for (const f of [1, 2, 5, 10]) if (raw <= f * power) return f * power;
  return 10 * power;
}
const plain = v => String(Math.round(v * 1e6) / 1e6);

/// Tells what is under the mouse or has the focus, beneath the plot.
function reads(element, id, parts) {
  const tell = () => put(id, el("b", {}, parts[0]), "  " + parts.slice(1).join("  \u00b7  "));
  element.addEventListener("mouseenter", tell);
  element.addEventListener("focus", tell);
  return element;
}
function choice(label, pressed, change) {
  return el("button", {type: "button", "aria-pressed": pressed ? "true" : "false", onclick: () => chosen.set(change)}, label);
}
)js";

}  // namespace stadion::report
