#include "profiling/report/page_parts.h"

namespace stadion::report {

const char* const kStyle = R"css(
:root{color-scheme:light dark;--ink:#1b2430;--quiet:#5b6878;--line:#dfe5ec;--paper:#fff;--ground:#f5f7fa;
--frame:#7456c8;--app:#2f6fd0;--cull:#12957f;--draw:#d9741a;--wait:#aab4c0;--bad:#c22f2b;--good:#22824a;--mark:#1b2430;--sampled:#8e99a6}
@media screen and (prefers-color-scheme:dark){:root{--ink:#e4eaf1;--quiet:#97a5b5;--line:#2b3541;--paper:#161c24;--ground:#0f141a;
--frame:#a68ff0;--app:#6ba3f5;--cull:#3cc4aa;--draw:#f39a4a;--wait:#4d5966;--bad:#f2726c;--good:#5fc78a;--mark:#e4eaf1;--sampled:#77828f}}
*{box-sizing:border-box}
body{margin:0;background:var(--ground);color:var(--ink);font:15px/1.5 system-ui,"Segoe UI","DejaVu Sans",sans-serif}
main{max-width:1500px;margin:0 auto;padding:1.2rem 1.2rem 4rem}
header h1{font-size:1.7rem;line-height:1.2;margin:.3rem 0 0;overflow-wrap:anywhere}
header p{margin:.15rem 0 1rem;color:var(--quiet)}
section,.tile{background:var(--paper);border:1px solid var(--line);border-radius:10px}
section{padding:1rem 1.1rem 1.1rem;margin:1rem 0}
h2{font-size:1.12rem;margin:0 0 .15rem}
h3{font-size:.95rem;margin:1rem 0 .3rem}
.say{color:var(--quiet);margin:0 0 .7rem;max-width:85ch;font-size:.9rem}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:.7rem}
.tile{padding:.6rem .9rem}
.tile b{display:block;font-size:1.45rem;line-height:1.25;font-variant-numeric:tabular-nums;white-space:nowrap;overflow:hidden;text-overflow:ellipsis}
.tile span{color:var(--quiet);font-size:.85rem}
.tile.bad b{color:var(--bad)}.tile.good b{color:var(--good)}
dl{display:flex;flex-wrap:wrap;gap:.15rem 1.6rem;margin:.9rem .2rem 0;font-size:.88rem}
dl div{display:flex;gap:.5rem}dt{color:var(--quiet);white-space:nowrap}dd{margin:0;overflow-wrap:anywhere}
nav{display:flex;flex-wrap:wrap;gap:.35rem;margin:0 0 .6rem;align-items:center}
button{font:inherit;font-size:.86rem;color:var(--ink);background:var(--ground);border:1px solid var(--line);border-radius:6px;padding:.15rem .65rem;cursor:pointer}
button:hover{border-color:var(--quiet)}
button[aria-pressed=true]{background:var(--ink);color:var(--paper);border-color:var(--ink)}
button:focus-visible,a:focus-visible,input:focus-visible,[tabindex]:focus-visible{outline:2px solid var(--app);outline-offset:1px}
input{font:inherit;font-size:.86rem;color:var(--ink);background:var(--ground);border:1px solid var(--line);border-radius:6px;padding:.15rem .6rem;width:16rem}
.gap{width:.8rem}
.readout{min-height:1.5em;font-size:.86rem;color:var(--quiet);margin:.35rem 0 0;overflow-wrap:anywhere}
.readout b{color:var(--ink)}
.key{display:flex;flex-wrap:wrap;gap:.2rem 1.1rem;font-size:.82rem;color:var(--quiet);margin:.4rem 0 0}
.key i{display:inline-block;width:.85em;height:.85em;border-radius:3px;margin-right:.4em;vertical-align:-.08em}
svg{display:block;width:100%;height:auto;overflow:visible}
svg text{font:11px system-ui,"Segoe UI","DejaVu Sans",sans-serif;fill:var(--ink);font-variant-numeric:tabular-nums}
svg text.quiet{fill:var(--quiet)}svg text.bad{fill:var(--bad);font-weight:600}svg text.halo{paint-order:stroke;stroke:var(--paper);stroke-width:4px;stroke-linejoin:round}svg text.on{fill:#fff;pointer-events:none}
@media screen and (prefers-color-scheme:dark){svg text.on{fill:#0c1117}}
svg .grid{stroke:var(--line)}svg .budget{stroke:var(--bad);stroke-dasharray:5 4;stroke-width:1.3}
.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(310px,1fr));gap:1rem 1.6rem}
figure{margin:0}figcaption{font-size:.88rem;font-weight:600;margin-bottom:.1rem}
figure p{margin:.1rem 0 0;font-size:.8rem;color:var(--quiet);font-variant-numeric:tabular-nums}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.87rem;width:100%}
caption{text-align:left;color:var(--quiet);font-size:.82rem;padding:0 0 .3rem}
th,td{padding:.24rem .6rem;border-bottom:1px solid var(--line);text-align:left;vertical-align:top}
th{color:var(--quiet);font-weight:600;white-space:nowrap}
tbody th{color:var(--ink);font-weight:500;white-space:normal;overflow-wrap:anywhere;min-width:9rem}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
td.row{white-space:nowrap}
td.words{min-width:21rem}
td.place{color:var(--quiet);white-space:nowrap}
th button{border:0;background:none;padding:0;color:inherit;font-weight:600}
th[aria-sort] button{color:var(--ink)}
th[aria-sort=descending] button::after{content:" \25BE"}th[aria-sort=ascending] button::after{content:" \25B4"}
table.heat{width:auto}table.heat td{min-width:5.4rem}
.bar{position:relative}.bar i{position:absolute;left:0;bottom:0;height:2px;background:var(--draw);border-radius:1px}
.bad{color:var(--bad)}.good{color:var(--good)}.quiet{color:var(--quiet)}
a{color:inherit}
.click{cursor:pointer}
@media print{body{background:#fff;font-size:11px}main{max-width:none;padding:0}nav,.readout,input{display:none}
section{border:0;padding:0;margin:0 0 1.2rem}section,figure,tr{break-inside:avoid}section.long{break-inside:auto}
.wide{overflow:visible}table{font-size:9.5px}th,td{padding:.15rem .3rem}tbody th{min-width:0}td.words{min-width:0}*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)css";

const char* const kBody = R"html(<main>
<header><h1 id="show"></h1><p>where its frames go</p><div class="tiles" id="tiles"></div><dl id="facts"></dl></header>
<noscript><p class="bad">The pictures and tables of this page are drawn by its own script, which this browser does not run.</p></noscript>
<section id="run"><h2>The run</h2><p class="say" id="run-say"></p><div id="strip"></div><div class="readout" id="strip-readout"></div></section>
<section id="timeline"><h2>Frame by frame</h2><p class="say">What each thread did. A stage holds its parts, these hold nodes; waits are grey.
A line stands where a frame was shown. Click on a frame to see it alone; arrow keys go on to its neighbours.</p>
<nav id="timeline-nav" aria-label="frames"></nav><div id="timeline-plot"></div><div class="readout" id="timeline-readout"></div><div class="key" id="timeline-key"></div></section>
<section id="flame"><h2>Along the scene</h2><p class="say" id="flame-say"></p><nav id="flame-nav" aria-label="stage"></nav>
<div id="flame-plot"></div><div class="readout" id="flame-readout"></div></section>
<section id="nodes" class="long"><h2>Most expensive nodes</h2><p class="say">Milliseconds a frame, the mean over all frames, all walls and eyes together.
p95 visit is of the frames in which App visited the node, p95 drawing of the times it was drawn alone, on one wall for one eye. A dash means that there is nothing to compare with: the script states no budget, or App did not visit it.</p>
<p class="say" id="nodes-unmeasured"></p>
<nav id="nodes-nav"></nav><div class="wide" id="nodes-table"></div></section>
<section id="distributions"><h2>How long stages take</h2><p class="say">Each count is a frame that sampling did not disturb. The dashed line is the budget of a frame; what lies beyond the last bin is counted in it.</p>
<div class="plots" id="histograms"></div></section>
<section id="walls"><h2>Walls and eyes</h2><p class="say" id="walls-say"></p><div class="wide" id="heat"></div><div class="wide" id="node-heat"></div></section>
<section id="late" class="long"><h2>Late frames</h2><p class="say" id="late-say"></p><div id="causes"></div><div class="wide" id="late-table"></div></section>
<section id="dynamics" class="long"><h2>Dynamics: cost and error</h2><p class="say" id="dynamics-say"></p><div class="wide" id="dynamics-table"></div></section>
<section id="stages" class="long"><h2>Stages, and how much of them is explained</h2><p class="say">What the stages take beside nodes, in milliseconds a frame. Waits are no work.
Explained is what was found with nodes or with parts of the stage itself; what is drawn is scaled to what whole eyes take.</p>
<div class="wide" id="explained-table"></div><div class="wide" id="stages-table"></div><div class="wide" id="counts-table"></div></section>
</main>
)html";

}  // namespace stadion::report
