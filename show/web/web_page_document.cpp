#include "show/web/web_page.h"

namespace stadion {

std::string_view web_page::document() {
  return R"page(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Stadion operator</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="/page.css">
<script src="/page.js" defer></script>
</head>
<body>
<a class="skip" href="#commands">Skip to the commands</a>
<header>
  <h1 id="show">Stadion</h1>
  <p class="facts">
    <span id="phase" class="badge">no answer</span>
    <span id="time"></span> <span id="rate"></span> <span id="group"></span>
  </p>
</header>
<p id="said" role="status"></p>
<p id="trouble" role="alert"></p>
<main>
<section id="login" aria-labelledby="login-title" hidden>
  <h2 id="login-title">Token</h2>
  <form id="token-form">
    <label for="token">The token that the program printed, or that its token file has</label>
    <input id="token" type="password" autocomplete="off" spellcheck="false" required>
    <button>Open</button>
  </form>
</section>
<div id="page" hidden>
<section id="commands" aria-labelledby="commands-title" tabindex="-1">
  <h2 id="commands-title">Commands</h2>
  <div class="buttons">
    <button type="button" id="start" data-command="start">Start</button>
    <button type="button" data-command="pause" data-switch="paused">Pause</button>
    <button type="button" id="step" data-command="step">One frame</button>
    <button type="button" data-command="black" data-switch="black">Black walls</button>
    <button type="button" data-command="test-pattern" data-switch="testPattern">Test pattern</button>
    <button type="button" data-command="freeze-head" data-switch="freezeHead">Freeze head</button>
    <button type="button" data-command="swap-eyes" data-switch="swapEyes">Swap eyes</button>
    <button type="button" class="grave" data-command="next-group" data-asks="Next group: press again">Next group</button>
    <button type="button" class="grave" data-command="end" data-asks="End the show: press again">End the show</button>
  </div>
  <div class="values">
    <label>Volume <input type="range" min="0" max="1" step="0.05" data-value="volume"><output></output></label>
    <label>Eye separation, metres
      <input type="number" min="0" max="1" step="0.001" data-value="eye-separation" data-key="eyeSeparation"></label>
    <label>Frames in flight
      <select data-value="latency"><option>1</option><option>2</option><option>3</option><option>4</option></select>
    </label>
  </div>
</section>
<section id="cues-section" aria-labelledby="cues-title" hidden>
  <h2 id="cues-title">Cues</h2>
  <div id="cues" class="buttons"></div>
</section>
<section aria-labelledby="views-title">
  <h2 id="views-title">Views</h2>
  <div id="views"></div>
</section>
<section aria-labelledby="walls-title">
  <h2 id="walls-title">Walls</h2>
  <div class="wide" tabindex="0" role="region" aria-labelledby="walls-title">
  <table>
    <thead><tr><th scope="col">wall</th><th scope="col">health</th><th scope="col">Draw, ms</th>
      <th scope="col">most</th><th scope="col">Cull, ms</th><th scope="col">last drawn</th></tr></thead>
    <tbody id="walls"></tbody>
  </table>
  </div>
  <p id="frame-times" class="small"></p>
</section>
<section id="hosts-section" aria-labelledby="hosts-title" hidden>
  <h2 id="hosts-title">Hosts</h2>
  <div class="wide" tabindex="0" role="region" aria-labelledby="hosts-title">
  <table>
    <thead><tr><th scope="col">host</th><th scope="col">health</th></tr></thead>
    <tbody id="hosts"></tbody>
  </table>
  </div>
</section>
<section aria-labelledby="late-title">
  <h2 id="late-title">Late frames</h2>
  <p id="late-causes">none</p>
  <ol id="late" class="lines" tabindex="0" aria-labelledby="late-title"></ol>
</section>
<section class="whole" aria-labelledby="log-title">
  <h2 id="log-title">Log</h2>
  <ol id="log" class="lines" tabindex="0" aria-labelledby="log-title"></ol>
</section>
</div>
</main>
<footer id="program" class="small"></footer>
</body>
</html>
)page";
}

}  // namespace stadion
