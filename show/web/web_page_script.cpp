#include "show/web/web_page.h"

namespace stadion {

std::string_view web_page::script() {
  return R"page("use strict";
// The operator's page. It asks for the state once a second, and for pictures and lines only if there are new ones.
const EVERY = 1000, HIDDEN_EVERY = 5000, ASKS = 4000, MOST_LINES = 200;
const KEY = "stadion-token";
const byId = (id) => document.getElementById(id);
const make = (name, text, kind) => {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (kind) made.className = kind;
  return made;
};

let token = "";
let state = null;
const lastLine = { log: 0, late: 0 };
const shown = new Map();  // pictures by their path: number, address of the object

// The token comes behind the #, which no request carries. It stays in this tab alone.
function takeToken() {
  const behind = decodeURIComponent(location.hash.slice(1));
  if (/^[\w.~+\/=-]{16,}$/.test(behind)) {
    sessionStorage.setItem(KEY, behind);
    history.replaceState(null, "", location.pathname);
  }
  token = sessionStorage.getItem(KEY) || "";
}

function askForToken(why) {
  byId("login").hidden = false;
  byId("page").hidden = true;
  byId("trouble").textContent = why;
  byId("token").focus();
}

function ask(path, options) {
  const headers = { Authorization: "Bearer " + token, ...(options && options.headers) };
  return fetch(path, { ...options, headers, cache: "no-store", signal: AbortSignal.timeout(8000) });
}

async function send(command, value, by) {
  const body = { command };
  if (value !== undefined) body.value = value;
  if (by) body.by = true;
  try {
    const answer = await ask("/command", {
      method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });
    say(answer.ok ? sentText(command, value) : (await answer.text()).trim());
  } catch {
    say("the command was not sent: no answer");
  }
  soon();
}

function sentText(command, value) {
  const words = command.replace("-", " ");
  const isSwitch = document.querySelector(`[data-command="${command}"][data-switch]`) !== null;
  return "sent: " + words + (isSwitch ? (value ? " on" : " off") : value === undefined ? "" : " " + value);
}

function say(text) { byId("said").textContent = text; }

// What the operator presses -----------------------------------------------------------------------------------

function press(button) {
  const { command } = button.dataset;
  if (button.dataset.switch) return send(command, state && state.operator[button.dataset.switch] ? 0 : 1);
  if (!button.dataset.asks) return send(command);
  // Two presses, so that no slip ends a show.
  if (button.classList.contains("asked")) {
    settle(button);
    return send(command);
  }
  button.dataset.label = button.textContent;
  button.textContent = button.dataset.asks;
  button.classList.add("asked");
  say(button.dataset.asks);
  setTimeout(() => settle(button), ASKS);
}

function settle(button) {
  if (!button.classList.contains("asked")) return;
  button.classList.remove("asked");
  button.textContent = button.dataset.label;
}

function begin() {
  takeToken();
  for (const button of document.querySelectorAll("[data-command]"))
    button.addEventListener("click", () => press(button));
  for (const field of document.querySelectorAll("[data-value]")) {
    field.addEventListener("change", () => {
      if (field.value !== "" && field.checkValidity()) send(field.dataset.value, Number(field.value));
      else say(field.validationMessage);
    });
    if (field.type === "range") field.addEventListener("input", () => showVolume(field));
  }
  byId("token-form").addEventListener("submit", (event) => {
    event.preventDefault();
    token = byId("token").value.trim();
    sessionStorage.setItem(KEY, token);
    byId("token").value = "";
    soon();
  });
  document.addEventListener("visibilitychange", () => { if (!document.hidden) soon(); });
  window.addEventListener("hashchange", () => { takeToken(); soon(); });
  poll();
}

// What the show says ------------------------------------------------------------------------------------------

let timer = 0, asking = false;
function soon() {
  clearTimeout(timer);
  timer = setTimeout(poll, 100);
}

async function poll() {
  clearTimeout(timer);
  if (asking) return;
  asking = true;
  try {
    if (!token) askForToken("");
    else await refresh();
  } catch {
    lost("no answer from the show");
  }
  asking = false;
  timer = setTimeout(poll, document.hidden ? HIDDEN_EVERY : EVERY);
}

function lost(why) {
  byId("trouble").textContent = why;
  byId("phase").textContent = "no answer";
  byId("phase").className = "badge lost";
}

async function refresh() {
  const answer = await ask("/state");
  if (answer.status === 401) return askForToken("this token is not the right one");
  if (!answer.ok) return lost((await answer.text()).trim());
  state = await answer.json();
  byId("trouble").textContent = "";
  byId("login").hidden = true;
  byId("page").hidden = false;
  showState();
  await Promise.all([takeLines("log", state.lastLine), takeLines("late", state.lastLate)]);
  await takePictures();
  document.body.dataset.drawn = "yes";
}

function clock(seconds) {
  const whole = Math.floor(seconds), two = (n) => String(n).padStart(2, "0");
  return Math.floor(whole / 3600) + ":" + two(Math.floor(whole / 60) % 60) + ":" + two(whole % 60);
}

function set(id, text) {
  const at = byId(id);
  if (at.textContent !== text) at.textContent = text;
}

function showState() {
  const s = state;
  document.title = s.show + " " + s.phase;
  set("show", s.show || "Stadion");
  set("phase", s.phase);
  byId("phase").className = "badge " + s.phase;
  set("time", clock(s.time));
  set("rate", s.framesPerSecond.toFixed(1) + " of " + s.rate + " frames/s");
  set("group", "group " + s.group);
  set("program", s.program + ", up " + clock(s.uptime));
  for (const button of document.querySelectorAll("[data-switch]"))
    button.setAttribute("aria-pressed", String(Boolean(s.operator[button.dataset.switch])));
  byId("start").disabled = !s.operator.waiting;
  byId("step").disabled = !s.operator.paused;
  for (const field of document.querySelectorAll("[data-value]")) {
    if (field === document.activeElement) continue;
    field.value = s.operator[field.dataset.key || field.dataset.value];
    if (field.type === "range") showVolume(field);
  }
  showCues();
  showWalls();
  showHosts();
  const p = s.period;
  set("frame-times", "Frame: median " + p.p50 + " ms, 99 % " + p.p99 + " ms, most " + p.most + " ms." +
    (s.app ? " App: median " + s.app.p50 + " ms, most " + s.app.most + " ms." : ""));
  const causes = Object.entries(s.late.causes).map(([cause, count]) => count + " " + cause);
  set("late-causes", s.late.total === 0 ? "none" : s.late.total + ": " + causes.join(", "));
}

function showVolume(field) {
  const text = Math.round(100 * field.value) + " %";
  field.setAttribute("aria-valuetext", text);
  field.parentElement.querySelector("output").textContent = text;
}

function rebuilt(id, key) {
  const at = byId(id);
  if (at.dataset.key === key) return null;
  at.dataset.key = key;
  at.replaceChildren();
  return at;
}

function showCues() {
  byId("cues-section").hidden = state.cues.length === 0;
  const at = rebuilt("cues", JSON.stringify(state.cues));
  if (!at) return;
  const seen = new Set();
  for (const cue of state.cues) {
    if (seen.has(cue.number)) continue;
    seen.add(cue.number);
    const button = make("button", cue.number + " " + (cue.label || cue.name));
    button.type = "button";
    button.addEventListener("click", () => send("cue", cue.number));
    at.append(button);
  }
}

const KINDS = { well: "good", late: "warn", silent: "bad" };
function showWalls() {
  const at = byId("walls");
  at.replaceChildren(...state.walls.map((wall) => {
    const row = make("tr");
    const name = make("th", wall.name);
    name.scope = "row";
    row.append(name, make("td", wall.health, KINDS[wall.health]));
    for (const text of [wall.draw && wall.draw.p50, wall.draw && wall.draw.most, wall.cull && wall.cull.p50])
      row.append(make("td", text === null ? "" : String(text)));
    row.append(make("td", wall.drawnAgo === null ? "" : wall.drawnAgo < 1 ? "now" : wall.drawnAgo + " s ago"));
    return row;
  }));
  const views = rebuilt("views", JSON.stringify(state.walls.map((w) => [w.name, w.views.map((v) => v.name)])));
  if (!views) return;
  for (const { address } of shown.values()) URL.revokeObjectURL(address);
  shown.clear();
  state.walls.forEach((wall, w) => wall.views.forEach((view, v) => {
    const name = wall.name + (view.name ? ", " + view.name + " eye" : ""), figure = make("figure");
    const picture = make("img");
    picture.id = "view-" + w + "-" + v;
    picture.alt = "View of " + name;
    picture.hidden = true;
    figure.append(make("div", undefined, "none"), picture, make("figcaption", name));
    views.append(figure);
  }));
}

function showHosts() {
  byId("hosts-section").hidden = state.hosts.length === 0;
  byId("hosts").replaceChildren(...state.hosts.map((host) => {
    const row = make("tr"), name = make("th", host.name);
    name.scope = "row";
    row.append(name, make("td", host.state, host.well ? "good" : "bad"));
    return row;
  }));
}

async function takeLines(id, newest) {
  if (newest < lastLine[id]) {  // another program
    lastLine[id] = 0;
    byId(id).replaceChildren();
  }
  if (newest === lastLine[id]) return;
  const answer = await ask("/" + id + "/" + lastLine[id]);
  if (!answer.ok) return;
  const list = byId(id);
  for (const line of await answer.json()) {
    const item = make("li");
    item.append(make("time", clock(line.uptime)), line.text);
    list.prepend(item);
    lastLine[id] = line.number;
  }
  while (list.childElementCount > MOST_LINES) list.lastElementChild.remove();
}

async function takePictures() {
  for (let w = 0; w < state.walls.length; ++w)
    for (let v = 0; v < state.walls[w].views.length; ++v) {
      const number = state.walls[w].views[v].picture, path = "/views/" + w + "/" + v;
      if (number === 0 || (shown.has(path) && shown.get(path).number === number)) continue;
      const answer = await ask(path);
      if (!answer.ok) continue;
      const address = URL.createObjectURL(await answer.blob()), picture = byId("view-" + w + "-" + v);
      const before = shown.get(path);
      shown.set(path, { number, address });
      picture.src = address;
      picture.hidden = false;
      picture.previousElementSibling.hidden = true;
      if (before) URL.revokeObjectURL(before.address);
    }
}

begin();
)page";
}

}  // namespace stadion
