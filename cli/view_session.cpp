#include "cli/view_session.h"

#include "cli/exit_code.h"
#include "cli/show_check.h"
#include "cli/stop_signal.h"
#include "pipeline/output/run_summary.h"

#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kHudEvery{250}, kFilesEvery{250};
constexpr std::chrono::milliseconds kNap{2};  ///< while there is nothing new to show
constexpr double kTurnPerPixel = 0.006;       ///< of the overview [rad]
constexpr double kZoomPerNotch = 0.88;
constexpr double kInset = 0.3;  ///< the walls beside the overview, of the window's sides
constexpr std::size_t kMostTrouble = 12;

std::vector<std::string> linesOf(const Diagnostics& findings) {
  std::vector<std::string> lines;
  for (const Diagnostic& d : findings.all()) {
    if (d.severity != Severity::Error) continue;
    std::istringstream text(format(d));
    for (std::string line; std::getline(text, line) && lines.size() < kMostTrouble;) lines.push_back(line);
  }
  return lines;
}

std::string pointText(const Vec3& p) {
  return fmt::format("{:.3f} {:.3f} {:.3f}", p.x(), p.y(), p.z());
}

SheetPlace moved(SheetPlace place, std::int32_t x, std::int32_t y) {
  place.x += x, place.y += y;
  return place;
}

}  // namespace

std::unique_ptr<ViewSession> ViewSession::open(ViewOptions options, Diagnostics& findings) {
  std::unique_ptr<ViewSession> session(new ViewSession(std::move(options)));
  ViewSession& s = *session;
  auto walls = loadWalls(s.options_.run.show.walls, std::string(STADION_ROOT) + "/walls", findings);
  if (!walls) return nullptr;
  s.walls_ = std::move(*walls);
  if (!s.openWindows(findings) || !s.openDrawing(findings)) return nullptr;
  s.hud_.budgetShown = s.options_.hud;
  s.show_ = PlayingShow::open(s.surroundings(), findings);
  return s.show_ ? std::move(session) : nullptr;
}

ViewSession::~ViewSession() {
  if (reload_ && reload_->thread.joinable()) reload_->thread.join();
}

bool ViewSession::openWindows(Diagnostics& findings) {
  auto system = WindowSystem::open();
  if (!system) return findings.add(system.error()), false;
  system_ = std::move(system.value());
  sizes_ = unfold(walls_.walls, options_.width, options_.height);
  const std::string name = std::filesystem::path(options_.run.show.script).filename().string();
  const auto add = [&](const WindowPlan& plan) {
    auto window = ShowWindow::open(*system_, plan, options_.windowStereo, walls_.walls.size() + 1);
    if (!window) return findings.add(window.error()), false;
    windows_.push_back(std::move(window.value()));
    return true;
  };
  WindowPlan plan;
  if (options_.windows == "one") {
    plan.title = "Stadion: " + name;
    plan.width = options_.width, plan.height = options_.height;
    return add(plan);
  }
  for (std::size_t i = 0; i < walls_.walls.size(); ++i) {
    plan.title = "Stadion: " + name + ", " + walls_.walls[i].wall.name;
    plan.width = sizes_[i].width, plan.height = sizes_[i].height;
    plan.placed = true, plan.x = sizes_[i].x, plan.y = sizes_[i].y;
    if (!add(plan)) return false;
  }
  return true;
}

// A display that the graphics card drives is a sign that the card can draw the walls too.
bool ViewSession::openDrawing(Diagnostics& findings) {
  bool card = options_.provider == "egl";
  if (options_.provider == "auto" && !windows_[0]->window().makeCurrent())
    card = !isSoftware(windows_[0]->window().gl());
  auto provider = openGlProvider(card ? GlProviderKind::Egl : GlProviderKind::OsMesa);
  if (!provider && card && options_.provider == "auto") provider = openGlProvider(GlProviderKind::OsMesa);
  if (!provider) return findings.add(provider.error()), false;
  provider_ = std::move(provider.value());
  return true;
}

ShowSurroundings ViewSession::surroundings() {
  const bool live = options_.run.show.input.empty() || options_.run.show.input == "none";
  RunOptions& run = options_.run;
  if (live) run.show.input = "none";
  return {run,
          *provider_,
          mailbox_,
          playback_,
          live ? &visitor_ : nullptr,
          sizes_,
          {0, 0, options_.width, options_.height},
          [this](const Diagnostics& found) {
            tell(found);
            for (const Diagnostic& d : found.all())
              if (d.severity == Severity::Error) hud_.say(d.where.file + ": " + d.message);
          },
          [this] { ended_ = true; }};
}

void ViewSession::say(const std::string& line) {
  std::fprintf(stderr, "%s\n", line.c_str());
  hud_.say(line);
}

int ViewSession::run(const std::atomic<bool>& stop) {
  begin({});
  hud_.say("H: help   Esc: quit");
  while (!quit_ && !ended_ && !stop) {
    system_->poll();
    takeEvents();
    pollPad();
    watchFiles();
    const bool fresh = mailbox_.fetch(pictures_, shown_);
    if (fresh && std::exchange(begins_, false)) {
      say("playing " + options_.run.show.script);
      playback_.setPaused(pausedByUser_);
    }
    updateHud();
    if (fresh || stale_)
      show(fresh);
    else
      std::this_thread::sleep_for(kNap);
  }
  endShow();
  return stop ? kStopped + stopSignal() : code_;
}

// What keys do
// -------------------------------------------------------------------------------------------------

void ViewSession::takeEvents() {
  for (std::size_t w = 0; w < windows_.size(); ++w)
    for (const WindowEvent& event : windows_[w]->window().takeEvents()) take(w, event);
}

void ViewSession::take(std::size_t window, const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  if (event.kind == Kind::Close) quit_ = true;
  if (event.kind == Kind::Key && event.down && command(event.key)) return;
  const bool overOverview = overview_.shown && window == 0;
  const bool turns = overOverview && event.kind == Kind::Button && event.button == 1;
  if (overOverview && event.kind == Kind::Wheel) {
    overview_.zoom(event.y > 0 ? kZoomPerNotch : 1 / kZoomPerNotch, walls_);
    return moveOverview();
  }
  if (turns) return controls_.turnCamera(event.down);
  controls_.take(event);
  if (overOverview && controls_.turnsCamera() && event.kind == Kind::Move) {
    overview_.turn(-kTurnPerPixel * controls_.lastMove()[0], kTurnPerPixel * controls_.lastMove()[1]);
    moveOverview();
  }
}

bool ViewSession::command(Key key) {
  switch (key) {
  case Key::Escape: quit_ = true; return true;
  case Key::F1: hud_.helpShown = !hud_.helpShown; break;
  case Key::F2: hud_.budgetShown = !hud_.budgetShown; break;
  case Key::F5: beginReload("F5"); return true;
  case Key::F12: takeScreenshot(); return true;
  case Key::Space: setPaused(!playback_.paused()); break;
  default:
    switch (static_cast<char>(key)) {
    case 'H': hud_.helpShown = !hud_.helpShown; break;
    case '.':
      steppedFrom_ = show_->framesPlayed();
      playback_.step();
      break;
    case '[': changeSpeed(0.5); break;
    case ']': changeSpeed(2); break;
    case 'O':
      overview_.shown = !overview_.shown;
      moveOverview();
      break;
    default: return false;
    }
  }
  hudDrawn_ = {};
  stale_ = true;
  return true;
}

// Until there is a first picture the show stands at its first frame.
void ViewSession::begin(const std::optional<ShowPlace>& place) {
  ended_ = false, begins_ = true;
  pausedByUser_ = playback_.paused();
  playback_.setPaused(true);
  show_->start(place);
}

void ViewSession::setPaused(bool paused) {
  playback_.setPaused(paused);
  say(fmt::format("{} at {:.3f} s", paused ? "paused" : "going on", toSeconds(show_->time())));
}

void ViewSession::changeSpeed(double factor) {
  playback_.setSpeed(playback_.speed() * factor);
  say(fmt::format("speed 1/{:.0f}", 1 / playback_.speed()));
}

void ViewSession::moveOverview() {
  show_->overview().move(overview_);
  stale_ = true;
}

void ViewSession::pollPad() {
  const auto now = Clock::now();
  const double seconds = std::min(std::chrono::duration<double>(now - padAsked_).count(), 0.1);
  padAsked_ = now;
  controls_.take(system_->gamepad(), seconds);
}

// The script, read again
// ---------------------------------------------------------------------------------------

void ViewSession::watchFiles() {
  if (reload_ && reload_->done) finishReload();
  const auto now = Clock::now();
  if (reload_ || now - filesLookedAt_ < kFilesEvery) return;
  filesLookedAt_ = now;
  if (files_.changed()) beginReload("it was saved");
}

void ViewSession::beginReload(const char* why) {
  if (reload_) return;
  say(fmt::format("reading {} again: {}", options_.run.show.script, why));
  files_.settle();
  if (const auto wrong = show_->watch().finish()) say(format(*wrong));
  options_.run.recordInput.clear();  // another script, another log
  reload_ = std::make_unique<Reload>();
  reload_->thread = std::thread([this, &r = *reload_, around = surroundings()] {
    Diagnostics found = checkShow(options_.run.show.script, options_.run.show.assetRoots);
    for (const Diagnostic& d : found.all())
      if (d.severity == Severity::Error) r.findings.add(d);
    if (!r.findings.hasErrors()) r.show = PlayingShow::open(around, r.findings);
    r.done = true;
  });
}

void ViewSession::finishReload() {
  reload_->thread.join();
  const std::unique_ptr<Reload> r = std::move(reload_);
  tell(r->findings);
  hud_.setTrouble(linesOf(r->findings));
  if (!r->show) return say("the script has errors; the show goes on as it was");
  show_->stop();
  const ShowPlace place = show_->place();
  show_ = std::move(r->show);
  show_->overview().move(overview_);
  mailbox_.fetch(pictures_, shown_);  // what the old one left is not the new one's
  begin(place);
  say(fmt::format("reloaded {}; the rig stands at {}", options_.run.show.script, pointText(place.X_WR.p)));
}

void ViewSession::endShow() {
  show_->stop();
  if (const Failure& f = show_->failure()) {
    std::fprintf(stderr, "stadion: %s\n", f->message.c_str());
    code_ = exitCodeOf(*f);
  }
  if (const auto wrong = show_->watch().finish()) {
    std::fprintf(stderr, "stadion: %s\n", format(*wrong).c_str());
    if (code_ == kOk) code_ = kBadInput;
  }
  RunSummary summary;
  show_->watch().addTo(summary, show_->framesPlayed());
  std::printf("the rig stands at %s\n", pointText(show_->place().X_WR.p).c_str());
  std::printf("played %.3f s in %" PRIu64 " frames, %" PRIu64 " ticks dropped; state hash %016" PRIx64 "\n%s",
              summary.seconds, show_->framesPlayed(), show_->droppedTicks(), summary.stateHash.value_or(0),
              happeningsText(summary).c_str());
}

// What is shown
// ------------------------------------------------------------------------------------------------

std::vector<std::size_t> ViewSession::wallsOf(std::size_t window) const {
  std::vector<std::size_t> walls;
  for (std::size_t i = 0; i < walls_.walls.size(); ++i)
    if (windows_.size() == 1 || i == window) walls.push_back(i);
  if (window == 0) walls.push_back(overviewIndex());
  return walls;
}

std::vector<WindowPane> ViewSession::panesOf(std::size_t window) const {
  const auto [width, height] = windows_[window]->window().size();
  std::vector<WallEntry> entries;
  std::vector<std::size_t> walls = wallsOf(window);
  if (window == 0) walls.pop_back();
  for (const std::size_t i : walls) entries.push_back(walls_.walls[i]);
  std::vector<WindowPane> panes;
  if (!(overview_.shown && window == 0)) {
    const std::vector<SheetPlace> places = unfold(entries, width, height);
    for (std::size_t i = 0; i < walls.size(); ++i) panes.push_back({walls[i], places[i]});
    return panes;
  }
  panes.push_back({overviewIndex(), {0, 0, width, height}});
  const auto w = static_cast<std::uint32_t>(kInset * width), h = static_cast<std::uint32_t>(kInset * height);
  const std::vector<SheetPlace> places = unfold(entries, w, h);
  for (std::size_t i = 0; i < walls.size(); ++i)
    panes.push_back({walls[i], moved(places[i], static_cast<std::int32_t>(width - w),
                                     static_cast<std::int32_t>(height - h))});
  return panes;
}

void ViewSession::show(bool fresh) {
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    if (fresh) windows_[w]->take(pictures_, wallsOf(w));
    windows_[w]->draw(panesOf(w));
  }
  for (const auto& window : windows_) window->swap();
  stale_ = false;
  // Told when the last of them is seen.
  const bool reached = steppedFrom_ && shown_.frame >= *steppedFrom_ && playback_.stepsWaiting() == 0 &&
                       shown_.frame + 1 == show_->framesPlayed();
  if (!fresh || !reached) return;
  steppedFrom_.reset();
  say(fmt::format("one frame, to {:.3f} s", toSeconds(shown_.time)));
}

HudFigures ViewSession::figures() const {
  HudFigures f;
  f.show = std::filesystem::path(options_.run.show.script).filename().string();
  f.seconds = toSeconds(shown_.time), f.rate = options_.run.show.rate;
  f.speed = playback_.speed(), f.paused = playback_.paused();
  f.budget = show_->budget(), f.dropped = show_->droppedTicks();
  return f;
}

void ViewSession::updateHud() {
  const auto now = Clock::now();
  if (now - hudDrawn_ < kHudEvery) return;
  hudDrawn_ = now;
  stale_ = true;
  ShowWindow& first = *windows_[0];
  const auto [width, height] = first.window().size();
  const std::uint32_t room = width > 32 ? width - 16 : 16;
  const std::uint32_t scale = width >= 700 ? 2 : 1;
  const auto panel = [&](std::size_t number, bool shown, const std::vector<PanelLine>& lines, bool bottom) {
    first.setOverlay(number, shown && !lines.empty() ? textPanel(lines, room, scale) : Picture{}, bottom);
  };
  panel(0, hud_.budgetShown, hud_.budgetLines(figures()), false);
  panel(1, hud_.helpShown, hud_.helpLines(), false);
  panel(2, true, hud_.messageLines(), true);
}

void ViewSession::takeScreenshot() {
  std::error_code none;
  std::filesystem::create_directories(options_.shots, none);
  const auto path = [&](const std::string& what) {
    return fmt::format("{}/{:03}-{}.png", options_.shots, shots_, what);
  };
  const auto windowName = [&](std::size_t w) {
    return windows_.size() == 1 ? "window" : "window-" + walls_.walls[w].wall.name;
  };
  do ++shots_;
  while (std::filesystem::exists(path(windowName(0)), none));
  std::optional<Diagnostic> wrong;
  std::size_t count = 0;
  const auto write = [&](const std::string& what, const Picture& picture) {
    if (!wrong && !picture.empty()) wrong = writePng(path(what), picture), ++count;
  };
  hudDrawn_ = {};
  updateHud();
  for (std::size_t w = 0; w < windows_.size(); ++w)
    write(windowName(w), *windows_[w]->draw(panesOf(w), true));
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const std::vector<Picture>& eyes = pictures_[i].eyes;
    const std::string name = i < walls_.walls.size() ? walls_.walls[i].wall.name : "overview";
    for (std::size_t e = 0; e < eyes.size(); ++e)
      write(eyes.size() == 1 ? name : name + "-" + eyeName(kEyes[e]), eyes[e]);
  }
  say(wrong ? "no screenshot: " + format(*wrong)
            : fmt::format("screenshot: {} and {} more", path(windowName(0)), count - 1));
}

}  // namespace stadion
