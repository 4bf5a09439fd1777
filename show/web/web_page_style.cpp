#include "show/web/web_page.h"

namespace stadion {

std::string_view web_page::style() {
  return R"page(:root {
  color-scheme: dark light;
  --back: #14171b; --field: #1e2329; --line: #3a424c; --text: #eceff3; --soft: #aeb7c2;
  --key: #2b323b; --on: #8fd0ff; --on-text: #06263c; --good: #8ddb9a; --bad: #ffb0a3; --warn: #ffd58a;
}
@media (prefers-color-scheme: light) {
  :root {
    --back: #f4f5f7; --field: #ffffff; --line: #c3c9d1; --text: #15181c; --soft: #4c5560;
    --key: #e6e9ee; --on: #0b5c94; --on-text: #ffffff; --good: #12692a; --bad: #a61b0b; --warn: #7a4d00;
  }
}
* { box-sizing: border-box; }
[hidden] { display: none !important; }
body { margin: 0 auto; max-width: 80rem; padding: 0 1rem 2rem; background: var(--back); color: var(--text);
  font: 1rem/1.45 system-ui, sans-serif; }
header { position: sticky; top: 0; z-index: 1; display: flex; flex-wrap: wrap; gap: 0 1rem; align-items: baseline;
  padding: .6rem 0 .4rem; background: var(--back); border-bottom: 1px solid var(--line); }
h1 { font-size: 1.25rem; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 1rem; margin: 0 0 .5rem; color: var(--soft); }
.facts { margin: 0; display: flex; flex-wrap: wrap; gap: .2rem .9rem; align-items: baseline;
  font-variant-numeric: tabular-nums; }
.badge { padding: .05rem .6rem; border-radius: 1rem; border: 1px solid currentColor; font-weight: 600; }
.badge.playing { color: var(--good); } .badge.paused, .badge.waiting, .badge.opening { color: var(--warn); }
.badge.over, .badge.lost { color: var(--bad); }
#said { min-height: 1.45em; margin: .3rem 0; color: var(--soft); }
#trouble { margin: 0; color: var(--bad); font-weight: 600; }
#trouble:empty { display: none; }
#page { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); gap: 1rem; align-items: start; }
.whole { grid-column: 1 / -1; }
section { background: var(--field); border: 1px solid var(--line); border-radius: .5rem; padding: .8rem; min-width: 0; }
.buttons { display: grid; grid-template-columns: repeat(auto-fill, minmax(7rem, 1fr)); gap: .5rem; }
button, input, select { font: inherit; color: inherit; min-height: 2.75rem; border-radius: .4rem;
  border: 1px solid var(--line); background: var(--key); padding: .3rem .7rem; }
button { cursor: pointer; font-weight: 600; }
button:disabled { opacity: .45; cursor: default; }
button[aria-pressed="true"] { background: var(--on); color: var(--on-text); border-color: var(--on); }
button.grave { border-color: var(--bad); }
button.asked { background: var(--bad); color: var(--back); }
:focus-visible { outline: 3px solid var(--on); outline-offset: 2px; }
.values { display: grid; grid-template-columns: repeat(auto-fit, minmax(11rem, 1fr)); gap: .6rem 1rem; margin-top: .8rem; }
.values label { display: flex; flex-direction: column; font-size: .9rem; }
.values input, .values select { width: 100%; }
input[type="range"] { padding: 0; }
output { font-variant-numeric: tabular-nums; color: var(--soft); }
#views { display: grid; grid-template-columns: repeat(auto-fill, minmax(9rem, 1fr)); gap: .5rem; }
figure { margin: 0; min-width: 0; }
figure img, figure .none { display: block; width: 100%; aspect-ratio: 4 / 3; object-fit: contain; background: #000;
  border-radius: .3rem; }
figcaption { font-size: .85rem; color: var(--soft); overflow-wrap: anywhere; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .25rem .6rem .25rem 0; border-bottom: 1px solid var(--line); white-space: nowrap; }
th[scope="col"] { font-size: .85rem; color: var(--soft); font-weight: 500; }
.good { color: var(--good); } .bad { color: var(--bad); } .warn { color: var(--warn); }
.lines { list-style: none; margin: 0; padding: 0; max-height: 16rem; overflow-y: auto; font-size: .85rem; }
.lines:empty::after { content: "nothing yet"; color: var(--soft); }
.lines li { padding: .1rem 0; overflow-wrap: anywhere; }
.lines time { color: var(--soft); margin-right: .6rem; font-variant-numeric: tabular-nums; }
.small { font-size: .85rem; color: var(--soft); }
#token-form { display: grid; gap: .5rem; max-width: 30rem; }
.skip { position: absolute; left: -100rem; }
.skip:focus { left: .5rem; top: .5rem; z-index: 2; background: var(--field); padding: .5rem; }
@media (max-width: 30rem) {
  body { padding: 0 .6rem 2rem; }
  section { padding: .6rem; }
  .buttons { grid-template-columns: 1fr 1fr; }
  #views { grid-template-columns: 1fr 1fr; }
}
)page";
}

}  // namespace stadion
