#include "profiling/report/page_parts.h"

namespace stadion::report {

const char* const kMainScript = R"js(
function drawHead() {
  byId("show").textContent = data.head.show;
  const period = data.distributions.find(d => d.stage === "frame"), judged = data.causes.reduce((s, c) => s + c[1], 0);
  const late = data.causes.filter(c => c[0] !== "in time").reduce((s, c) => s + c[1], 0);
  const mostExpensive = data.nodes.filter(n => n.total !== undefined && n.kind).sort((a, b) => b.total - a.total)[0];
  const tile = (value, what, kind, title) => el("div", {class: "tile " + (kind || ""), title}, el("b", {}, value), el("span", {}, what));
  put("tiles", tile(`${plain(data.head.rate)} Hz`, budget > 0 ? `${ms(budget)} ms a frame` : "no budget"),
    period ? tile(msText(period.median), "median frame to frame", budget > 0 && period.median > 1.5 * budget ? "bad" : "good") : "",
    period ? tile(msText(period.p95), "95 % of frames within", budget > 0 && period.p95 > 1.5 * budget ? "bad" : "good") : "",
    judged > 0 ? tile(late === 0 ? "none" : `${late} of ${judged}`, "frames late", late > 0 ? "bad" : "good", "of those that sampling did not disturb") : "",
    mostExpensive ? tile(mostExpensive.path, `most expensive node, ${msText(mostExpensive.total)}`, "", nodeText(mostExpensive)) : "",
    tile(msText(data.head.recording), "a frame to record it, taken off"));
  put("facts", ...data.head.facts.map(([what, how]) => el("div", {}, el("dt", {}, what), el("dd", {}, how))));
}

/// What depends on what is chosen, or on how wide the page is.
function drawAll() {
  drawStrip(), drawTimeline(), drawFlame(), drawNodes(), drawLate();
}
drawHead(), drawHistograms(), drawHeat(), drawDynamics(), drawStages(), drawAll();
let drawnWidth = widthOf("strip");
addEventListener("resize", () => {
  if (widthOf("strip") !== drawnWidth) drawnWidth = widthOf("strip"), drawAll();
});
addEventListener("hashchange", () => {
  chosen.values = new Map(new URLSearchParams(location.hash.slice(1)));
  drawAll();
});
document.documentElement.dataset.drawn = "yes";
)js";

}  // namespace stadion::report
