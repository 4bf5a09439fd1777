#include "show/view/view_session.h"

#include "engine/base/installed_files.h"
#include "engine/hall_formats/hall_import.h"
#include "pipeline/target/rasteriser_settings.h"
#include "show/recording/last_frames.h"

#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <utility>

namespace stadion {
namespace {

constexpr std::size_t kMostGiven = 4;  ///< lines of what nodes give up
constexpr std::chrono::milliseconds kHudEvery{250}, kFilesEvery{250};
constexpr std::chrono::milliseconds kIdle{2};  ///< while there is nothing new to show
constexpr double kTurnPerPixel = 0.006;        ///< of the overview [rad]
constexpr double kZoomPerNotch = 0.88;
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

}  // namespace

std::unique_ptr<ViewSession> ViewSession::open(ViewSettings settings, Reporter& reporter,
                                               Diagnostics& findings) {
  std::unique_ptr<ViewSession> session(new ViewSession(std::move(settings), reporter));
  ViewSession& s = *session;
  const SessionSettings& played = s.settings_.session;
  if (!lastFramesCanBeKept(played.record.blackBox, findings)) return nullptr;
  auto walls = loadHall(played.show.walls, shareFolder() + "/walls", findings);
  if (!walls) return nullptr;
  s.walls_ = std::move(*walls);
  if (!s.openDrawing(findings)) return nullptr;
  s.windows_ = ViewWindows::open(s.settings_, s.walls_, s.renderer_->drawsWithGl(), findings);
  if (!s.windows_) return nullptr;
  s.hud_.budgetShown = s.settings_.hud;
  s.console_ = OperatorConsole::open({played.show, played.play, played.console}, s.hudReporter_, findings);
  if (!s.console_) return nullptr;
  s.web_ = OperatorWeb::create(played.web, s.hudReporter_, findings);
  if (findings.hasErrors()) return nullptr;
  s.hudReporter_.showIn(s.web_.get());
  s.show_ = PlayingShow::open(s.surroundings(std::make_shared<ReusableResources>()), findings);
  if (!s.show_ || !s.console_->begin(s.show_->player(), findings)) return nullptr;
  if (!s.web_) return session;
  if (!s.web_->listen(s.console_->queue(), findings)) return nullptr;
  s.console_->commanded = [web = s.web_.get()](const OperatorState& state) { web->commanded(state); };
  return session;
}

bool ViewSession::openDrawing(Diagnostics& findings) {
  auto renderer = ShowRenderer::open(settings_.session.draw.renderer);
  if (!renderer) {
    findings.add(renderer.error());
    return false;
  }
  renderer_ = std::move(renderer.value());
  if (!renderer_->drawsWithGl()) return true;
  DrawingNeeds needs = settings_.session.drawingNeeds(walls_.walls.size());
  needs.wishes.processes = false;
  setRasteriserThreads(DrawingPlan(needs, knownMachine(findings)).rasteriserThreadsHere());
  return true;
}

ShowSurroundings ViewSession::surroundings(std::shared_ptr<ReusableResources> kept) {
  const bool live = settings_.session.show.input == "none";
  ShowSurroundings around{settings_.session,
                          *renderer_,
                          mailbox_,
                          *console_,
                          std::move(kept),
                          live ? &visitor_ : nullptr,
                          windows_->pictureSizes(),
                          {0, 0, settings_.width, settings_.height},
                          hudReporter_,
                          [this] { ended_ = true; }};
  around.web = web_.get();
  return around;
}

void ViewSession::HudReporter::report(const Diagnostics& findings) {
  to_.report(findings);
  if (OperatorWeb* web = web_) web->say(findings);
  for (const Diagnostic& d : findings.all())
    if (d.severity == Severity::Error) hud_.say(d.where.file + ": " + d.message);
}

SessionEnd ViewSession::run(const std::atomic<bool>& stop) {
  begin({});
  hud_.say("H: help   Esc: quit");
  while (!quit_ && !stop) {
    takeEvents();
    if (const auto lost = windows_->lost()) {
      reporter_.fault(*lost);
      end_ = SessionEnd::Failed;
      endShow();
      return end_;
    }
    pollPad();
    watchFiles();
    takePictures();
    updateHud();
    if (std::exchange(stale_, false)) {
      windows_->show(overview_.shown);
      if (!begins_) console_->pictureSeen();
      tellOfStep();
    } else {
      std::this_thread::sleep_for(kIdle);
    }
    if (ended_.exchange(false)) afterTheEnd();
  }
  endShow();
  return stop ? SessionEnd::Stopped : end_;
}

// What keys do
// -------------------------------------------------------------------------------------------------

void ViewSession::takeEvents() {
  for (const auto& [window, event] : windows_->takeEvents()) take(window, event);
}

void ViewSession::take(std::size_t window, const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  if (event.kind == Kind::Close) quit_ = true;
  if (event.kind == Kind::Key && event.down && command(event)) return;
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

bool ViewSession::command(const WindowEvent& event) {
  if (!viewersCommand(event.key) && !operatorsCommand(event.key, event.shift)) return false;
  hudDrawn_ = {};
  stale_ = true;
  return true;
}

bool ViewSession::viewersCommand(Key key) {
  switch (key) {
  case Key::Escape: quit_ = true; return true;
  case Key::F1: hud_.helpShown = !hud_.helpShown; return true;
  case Key::F2: hud_.budgetShown = !hud_.budgetShown; return true;
  case Key::F5: beginReload("F5"); return true;
  case Key::F12: takeScreenshot(); return true;
  default: break;
  }
  switch (static_cast<char>(key)) {
  case 'H': hud_.helpShown = !hud_.helpShown; return true;
  case '.': step(); return true;
  case 'O':
    overview_.shown = !overview_.shown;
    moveOverview();
    return true;
  default: return false;
  }
}

// As in the terminal, but that the brackets without shift and the digits are the viewer's.
bool ViewSession::operatorsCommand(Key key, bool shift) {
  const bool bracket = key == static_cast<Key>('[') || key == static_cast<Key>(']');
  if (bracket && !shift) {
    changeSpeed(key == static_cast<Key>(']') ? 2 : 0.5);
    return true;
  }
  if (key >= static_cast<Key>('1') && key <= static_cast<Key>('9')) return false;
  const auto order = operatorCommandOf(key);
  if (order) console_->queue().post(*order);
  return order.has_value();
}

void ViewSession::step() {
  if (!steppedFrom_) steppedFrom_ = show_->framesPlayed();
  if (!console_->playback().paused()) console_->queue().post({OperatorAction::Pause, 1, false});
  console_->queue().post({OperatorAction::Step});
}

void ViewSession::changeSpeed(double factor) {
  Playback& playback = console_->playback();
  playback.setSpeed(playback.speed() * factor);
  say(fmt::format("speed 1/{:.0f}", 1 / playback.speed()));
}

void ViewSession::moveOverview() {
  show_->overview().move(overview_);
  stale_ = true;
}

void ViewSession::pollPad() {
  const auto now = Clock::now();
  const double seconds = std::min(std::chrono::duration<double>(now - padAsked_).count(), 0.1);
  padAsked_ = now;
  controls_.take(windows_->gamepad(), seconds);
}

// One show after the other
// ------------------------------------------------------------------------------------------

// Until there is a first picture the show stands at its first frame.
void ViewSession::begin(const std::optional<ShowPlace>& place) {
  ended_ = over_ = false;
  begins_ = true;
  unseen_ = 0;
  steppedFrom_.reset();
  visitor_.restart();
  console_->playback().hold(true);
  show_->start(place);
}

void ViewSession::takePictures() {
  const std::uint64_t before = shown_.frame;
  if (!mailbox_.fetch(pictures_, shown_)) return;
  windows_->take(pictures_);
  stale_ = true;
  if (!begins_ && shown_.frame > before) unseen_ += shown_.frame - before - 1;
  if (!std::exchange(begins_, false)) return;
  say("playing " + settings_.file());
  console_->playback().hold(false);
}

void ViewSession::afterTheEnd() {
  show_->stop();
  if (show_->nextGroup())
    nextGroup();
  else
    quit_ = true;
}

/// Discards pictures of the old show that wait in the mailbox. The windows keep the pictures that they show.
void ViewSession::putInPlace(std::unique_ptr<PlayingShow> show) {
  show_ = std::move(show);
  show_->overview().move(overview_);
  std::vector<EyePictures> left;
  mailbox_.fetch(left, shown_);
}

// Creates a new show; only the contents of files are reused.
void ViewSession::nextGroup() {
  finishRecord();
  if (web_) web_->endShow(false);
  console_->endGroup(show_->watch());
  Diagnostics findings;
  auto next = PlayingShow::open(surroundings(show_->kept()), findings);
  reporter_.report(findings);
  hud_.setTrouble(linesOf(findings));
  if (!next) {
    over_ = true;
    return say("the script has errors; the next group's show begins once it is saved without them");
  }
  putInPlace(std::move(next));
  show_->kept()->models.store().collect(~std::uint64_t{0});  // no frame shows the old one any more
  begin({});
}

void ViewSession::watchFiles() {
  if (reload_ && reload_->done()) finishReload();
  const auto now = Clock::now();
  if (reload_ || now - filesLookedAt_ < kFilesEvery) return;
  filesLookedAt_ = now;
  if (const auto why = files_.changed()) beginReload(*why);
}

// The old show is recorded until it ends. The new one is recorded only if a group waits for it to start.
void ViewSession::beginReload(const std::string& why) {
  if (reload_) return;
  say(fmt::format("reading {} again: {}", settings_.file(), why));
  files_.reset();
  ShowSurroundings around = surroundings(std::make_shared<ReusableResources>());
  around.recorded = over_;
  reload_ = std::make_unique<ShowReload>(std::move(around));
}

void ViewSession::finishReload() {
  Diagnostics findings;
  std::unique_ptr<PlayingShow> show = std::exchange(reload_, nullptr)->take(findings);
  reporter_.report(findings);
  hud_.setTrouble(linesOf(findings));
  if (!show) return say("the script has errors; the show goes on as it was");
  show_->stop();
  finishRecord();
  console_->silence();
  std::optional<ShowPlace> place;
  if (!over_) {
    place = show_->place();
    settings_.session.record.input.clear();  // another script, another log
  }
  putInPlace(std::move(show));
  begin(place);
  say(fmt::format("reloaded {}; the rig stands at {}", settings_.file(),
                  pointText(place ? place->X_WR.p : Vec3(Vec3::Zero()))));
}

/// Completes the input log of a show that has stopped.
void ViewSession::finishRecord() {
  const auto wrong = show_->watch().finish();
  if (!wrong) return;
  say("stadion: " + format(*wrong));
  if (end_ == SessionEnd::Played) end_ = SessionEnd::Refused;
}

void ViewSession::endShow() {
  show_->stop();
  if (const Failure& f = show_->failure()) {
    reporter_.fault(f->message);
    end_ = endOf(*f);
  }
  finishRecord();
  show_->watch().addTo(report_.summary, show_->framesPlayed());
  report_.rig = show_->place().X_WR.p;
  report_.frames = show_->framesPlayed();
  report_.dropped = show_->droppedTicks();
  report_.lateFrames = show_->lateFrames();
}

// What is shown
// ------------------------------------------------------------------------------------------------

// Told when the newest of them is seen.
void ViewSession::tellOfStep() {
  const Playback& playback = console_->playback();
  const bool newest = steppedFrom_ && shown_.frame >= *steppedFrom_ && playback.stepsWaiting() == 0 &&
                      shown_.frame + 1 == show_->framesPlayed();
  if (!newest) return;
  say(fmt::format("one frame, to {:.3f} s", toSeconds(shown_.time)));
  steppedFrom_ = shown_.frame + 1;
  if (!playback.paused()) steppedFrom_.reset();
}

BudgetNumbers ViewSession::budgetNumbers() const {
  BudgetNumbers f;
  f.show = std::filesystem::path(settings_.file()).filename().string();
  f.seconds = toSeconds(shown_.time);
  f.rate = settings_.session.show.rate;
  f.speed = console_->playback().speed();
  f.paused = console_->playback().paused();
  f.budget = show_->budget();
  f.dropped = show_->droppedTicks() + unseen_;
  if (const double stress = show_->stress(); stress > 1)
    f.given.push_back(fmt::format("everything counts as {:.3g} times farther away", stress));
  for (const BudgetReport& b : show_->budgets())
    if (b.now > 0 && f.given.size() < kMostGiven)
      f.given.push_back(fmt::format("{} gives up {} of {}: {:.2f} ms", b.name, b.now, b.levels, b.mean));
  return f;
}

void ViewSession::updateHud() {
  const auto now = Clock::now();
  if (now - hudDrawn_ < kHudEvery) return;
  hudDrawn_ = now;
  stale_ = true;
  const std::vector<PanelLine> none;
  windows_->setPanel(0, hud_.budgetShown ? budgetLines(budgetNumbers()) : none, false);
  windows_->setPanel(1, hud_.helpShown ? hud_.helpLines() : none, false);
  windows_->setPanel(2, hud_.messageLines(), true);
}

void ViewSession::takeScreenshot() {
  hudDrawn_ = {};
  updateHud();
  say(windows_->screenshot(settings_.shots, pictures_, overview_.shown));
}

}  // namespace stadion
