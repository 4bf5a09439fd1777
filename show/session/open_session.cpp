/// Opens the shows of a session.

#include "show/session/open_session.h"

#include "engine/base/installed_files.h"
#include "engine/hall_formats/hall_import.h"
#include "pipeline/target/rasteriser_settings.h"
#include "show/player/script_watch.h"
#include "show/recording/governor_options.h"

#include <mutex>
#include <thread>
#include <utility>

namespace stadion {
namespace {

/// Findings that are reported only if what is tried succeeds. Those that come later are then reported too.
/// Any thread.
class HeldReport {
public:
  explicit HeldReport(Reporter::Report report) : held_(std::make_shared<Held>()) {
    held_->report = std::move(report);
  }
  Reporter::Report function() const {
    return [held = held_](const Diagnostics& findings) {
      const std::lock_guard lock(held->mutex);
      held->released ? held->report(findings) : held->findings.append(findings);
    };
  }
  void release() {
    const std::lock_guard lock(held_->mutex);
    held_->released = true;
    held_->report(held_->findings);
  }

private:
  struct Held {
    std::mutex mutex;
    Reporter::Report report;
    Diagnostics findings;
    bool released = false;
  };
  std::shared_ptr<Held> held_;
};

}  // namespace

OpenSession::OpenSession(SessionSettings settings, Reporter& terminal, const std::atomic<bool>& stop)
    : terminal_(terminal), reporter_(terminal), state_{std::move(settings), reporter_, stop} {}

OpenSession::~OpenSession() {
  if (web_) web_->close();
  while (!parts_.empty()) parts_.pop_back();
}

bool OpenSession::open(Diagnostics& findings) {
  SessionSettings& s = state_.settings;
  journal_ = RunJournal::open(s.supervision, terminal_, findings);
  if (findings.hasErrors()) return false;
  if (journal_) {
    reporter_.keepIn(*journal_);
    state_.journal = journal_.get();
  }
  web_ = OperatorWeb::create(s.web, reporter_, findings);
  s.console.hasPage = web_ != nullptr;
  state_.web = web_.get();
  parts_ = makeSessionParts(state_, findings);
  if (findings.hasErrors() || !openDrawing(findings)) return false;
  console_ = OperatorConsole::open({s.show, s.play, s.console}, reporter_, findings);
  if (!console_) return false;
  state_.console = console_.get();
  player_ = openShow(findings);
  if (!player_) return false;
  state_.player = player_.get();
  if (!renderer_->drawsNothing() && !canDraw(findings)) return false;
  reconsiderDrawing();
  return openGroup(findings);
}

/// Before the first context: the rasteriser asks once how many threads it has.
bool OpenSession::openDrawing(Diagnostics& findings) {
  const SessionSettings& s = state_.settings;
  RendererSettings settings = s.draw.renderer;
  // Spans are processor time of the thread that draws.
  if (!s.record.spans.file.empty() && settings.threads == 0) settings.threads = 1;
  auto renderer = ShowRenderer::open(settings);
  if (!renderer) {
    findings.add(renderer.error());
    return false;
  }
  renderer_ = std::move(renderer.value());
  state_.renderer = renderer_.get();
  if (renderer_->drawsNothing()) return true;
  Diagnostics reportedLater;
  const auto walls = loadHall(s.show.walls, shareFolder() + "/walls", reportedLater);
  if (!walls) return true;
  DrawingNeeds needs = s.drawingNeeds(walls->walls.size());
  needs.cpuThreads = renderer_->threads();
  drawing_.emplace(needs, renderer_->drawsWithGl() ? knownMachine(findings) : KnownMachine{});
  state_.drawing = &*drawing_;
  if (renderer_->drawsWithGl()) setRasteriserThreads(drawing_->rasteriserThreadsHere());
  return true;
}

/// Found out here rather than when the first picture is to be drawn.
bool OpenSession::canDraw(Diagnostics& findings) {
  std::optional<Diagnostic> why;
  const WallViews* before = nullptr;
  const ShowParts parts = player_->parts(state_.settings.draw.layout);
  for (const WallViews& wall : parts.walls) {
    if (!why && !(before && before->width == wall.width && before->height == wall.height))
      why = renderer_->checkSize(wall.width, wall.height);
    before = &wall;
  }
  if (why) findings.error(why->where, "--size: " + why->message);
  return !why && haveCards(findings);
}

/// Whether the graphics cards are there that the wall file names.
bool OpenSession::haveCards(Diagnostics& findings) {
  const WallFile& walls = player_->walls();
  for (const WallEntry& entry : walls.walls)
    if (const auto why = entry.card ? renderer_->checkCard(*entry.card) : std::nullopt)
      findings.error({walls.file, entry.line, entry.column}, why->message, entry.excerpt);
  return !findings.hasErrors();
}

/// What is only known once the show is open.
void OpenSession::reconsiderDrawing() {
  const SessionSettings& s = state_.settings;
  if (!drawing_ || !drawing_->setting().processes || s.draw.processes) return;
  if (renderer_->drawsOnCard()) drawing_->drawHere("a graphics card draws");
  if (!s.play.everyFrameCounts(*player_) && hasDrawnBudgets(player_->scene()))
    drawing_->drawHere("budgets of what is drawn are measured where it is drawn");
}

ImportedMeshes* OpenSession::models() {
  return console_->kept() ? &console_->kept()->models : nullptr;
}

std::unique_ptr<Player> OpenSession::createPlayer(const ShowOptions& show, Diagnostics& findings) {
  return Player::create(show, findings, reporter_.reportFunction(), &state_.stop, models());
}

/// In a cluster as the leader has it; after a crash as the process before had it. Null: an error, or the run
/// is to end.
std::unique_ptr<Player> OpenSession::openShow(Diagnostics& findings) {
  ShowOptions show = state_.settings.show;
  ClusterSession* const cluster = state_.cluster;
  if (cluster && !cluster->join(show, findings)) return nullptr;
  if (state_.supervised && state_.supervised->state()) show.state = state_.supervised->state();
  if (!show.state) return createPlayer(show, findings);

  HeldReport report(reporter_.reportFunction());
  Diagnostics found;
  auto player = Player::prepare(show, findings, report.function(), &state_.stop, models());
  if (!player) return nullptr;
  if (player->openScene(found) && (!cluster || cluster->hasFiles(player->scene()))) {
    report.release();
    return player;
  }
  if (cluster && !cluster->leads()) {
    report.release();
    findings.append(found);
    cluster->refuseFiles(findings);
    return nullptr;
  }
  show.state.reset();
  player.reset();
  player = createPlayer(show, findings);
  if (!player) return nullptr;
  if (!cluster)
    state_.supervised->restartShow(found);
  else if (!cluster->restartShow(found, findings))
    return nullptr;
  return player;
}

bool OpenSession::openGroup(Diagnostics& findings) {
  // In a cluster all machines have a file in the same frame, for which they wait.
  if (!state_.settings.play.repeats(*player_) && !state_.cluster) player_->playLive();
  for (const auto& part : parts_)
    if (!part->opened(findings)) return false;
  return true;
}

void OpenSession::closeShow(NextShow next, Diagnostics& findings) {
  for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) (*part)->following(next, findings);
  state_.player = nullptr;
  player_.reset();
}

/// Waits until the script is saved again, or the operator asks once more for the next group. False: the run
/// is to end.
bool OpenSession::waitForScript() {
  constexpr std::chrono::milliseconds kLookAgain{250};
  reporter_.say("the script has errors; the next group's show begins once it is saved without them");
  ScriptWatch files(state_.settings.show.script, state_.settings.show.assetRoots, state_.settings.show.types);
  for (;;) {
    if (state_.stop || !state_.takeKeys()) return false;
    for (const OperatorCommand& c : console_->queue().take()) {
      if (c.action == OperatorAction::End) return false;
      if (c.action == OperatorAction::NextGroup) return true;
    }
    if (files.changed()) return true;
    if (state_.supervised) state_.supervised->shown();  // a player that waits does not hang
    if (state_.service) state_.service->alive();
    std::this_thread::sleep_for(kLookAgain);
  }
}

bool OpenSession::nextGroup() {
  Diagnostics findings;
  closeShow(NextShow::OfGroup, findings);
  console_->kept()->models.store().collect(~std::uint64_t{0});  // no frame shows it any more
  for (;;) {
    player_ = createPlayer(state_.settings.show, findings);
    reporter_.report(std::exchange(findings, {}));
    if (player_) break;
    if (!waitForScript()) return false;
  }
  state_.player = player_.get();
  // A cluster's other machines learn of the next group by a new session.
  const bool isOpen = openGroup(findings);
  reporter_.report(findings);
  return isOpen;
}

bool OpenSession::rejoin() {
  Diagnostics findings;
  closeShow(NextShow::Rejoined, findings);
  player_ = openShow(findings);
  state_.player = player_.get();
  const bool isOpen = player_ && openGroup(findings);
  reporter_.report(findings);
  return isOpen;
}

SessionEnd OpenSession::close(SessionEnd end) {
  for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) end = (*part)->closed(end);
  return end;
}

}  // namespace stadion
