#include "show/measure/soak_run.h"

#include "engine/base/installed_files.h"
#include "engine/base/run_stopped.h"
#include "pipeline/platform/process_figures.h"
#include "show/measure/soak_visitor.h"
#include "show/player/player.h"
#include "show/player/reusable_resources.h"
#include "show/recording/run_watch.h"
#include "show/recording/show_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kSampleEvery = 1000, kSampleAt = 50;  ///< frames: while nothing is being loaded
constexpr std::uint64_t kCheckEvery = 500, kKillEvery = 700;  ///< frames

/// How a visit is played. The same happens in all of them.
enum class Way { Pipelined, Sequential, Killed };

class Soak {
public:
  Soak(const SoakPlan& plan, SoakRecord& record, ShowRenderer& renderer, Reporter& reporter,
       const std::atomic<bool>& stop)
      : plan_(plan), record_(record), renderer_(renderer), reporter_(reporter), stop_(stop) {}

  /// False, and told, if a show could not be played.
  bool play();

private:
  bool visit(const std::string& show, Way way, std::uint64_t frames);
  void see(const TimeSignature& now, const Scene& scene, const RunWatch& watch);
  void countSeconds();
  void keepCounts();
  void tellProgress();

  const SoakPlan& plan_;
  SoakRecord& record_;
  ShowRenderer& renderer_;
  Reporter& reporter_;
  const std::atomic<bool>& stop_;
  std::map<std::string, ReusableResources> kept_;  ///< by show, as from group to group
  // Of the present visit.
  std::string show_;
  Way way_ = Way::Pipelined;
  Nanoseconds before_ = 0;
  std::uint64_t loadsVersion_ = 0;
  Clock::time_point told_{}, measured_ = Clock::now();
};

/// The processes that draw walls of this one.
std::vector<pid_t> wallProcesses() {
  std::vector<pid_t> found;
  std::error_code none;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", none)) {
    std::ifstream children(task.path() / "children");
    for (pid_t child = 0; children >> child;) {
      std::string name;
      std::ifstream("/proc/" + std::to_string(child) + "/comm") >> name;
      if (name == "stadion-wall") found.push_back(child);
    }
  }
  return found;
}

bool Soak::play() {
  // Long ones, in which a show may grow, and between them short ones in all the other ways.
  constexpr std::uint64_t kShort = 1000;
  const SoakCounts& counts = record_.counts;
  while (counts.frames < plan_.frames && !stop_) {
    const std::string& show = plan_.shows[counts.visits / 3 % plan_.shows.size()];
    const Way way = static_cast<Way>(counts.visits % 3);
    const std::uint64_t wanted = way == Way::Pipelined ? plan_.visit : std::min(plan_.visit, kShort);
    if (!visit(show, way, std::min(wanted, plan_.frames - counts.frames))) return false;
  }
  return true;
}

bool Soak::visit(const std::string& show, Way way, std::uint64_t frames) try {
  show_ = show;
  way_ = way;
  before_ = 0;
  loadsVersion_ = 0;
  ShowOptions o;
  o.script = show;
  o.walls = "desktop";
  o.size = "32x24";
  o.look = plan_.look;
  o.input = "none";
  o.frames = frames;
  o.mode = way == Way::Sequential ? Mode::Sequential : Mode::Pipelined;
  o.assetRoots = {shareFolder() + "/assets"};
  o.types = plan_.types;
  Diagnostics findings;
  ReusableResources& kept = kept_[show];
  kept.models.store().collect(~std::uint64_t{0});  // no frame shows it any more
  const auto player = o.complete(findings)
                          ? Player::create(o, findings, reporter_.reportFunction(), &stop_, &kept.models)
                          : nullptr;
  const auto watch =
      player ? RunWatch::create({}, PlaySettings{.everyFrame = true}, *player, findings) : nullptr;
  reporter_.report(findings);
  if (!watch) return false;
  RecordingOptions recording;
  recording.profile = false;
  recording.log.shares = true;
  const auto recorded = ShowRecording::create(std::move(recording), findings);
  SoakVisitor visitor;
  ShowParts parts = player->parts(StereoLayout::Off, &visitor);
  if (way == Way::Killed)
    parts.wallProcesses.emplace().renderer = renderer_.kind();
  else
    parts.contexts = &kept.contexts;
  renderer_.drawFor(parts);
  parts.probe = &recorded->probe();
  parts.observer = [&](const TimeSignature& now, const InputSample& input, const Scene& scene) {
    watch->see(now, input, scene);
    recorded->see(scene);
    see(now, scene, *watch);
  };
  FrameLoopOutcome outcome;
  {
    ShowStages stages(std::move(parts));
    FrameLoop loop(stages, player->loopOptions(), stop_, &recorded->probe());
    outcome = loop.run();
  }
  record_.counts.throws += visitor.throws();
  record_.counts.refused += visitor.refused();
  ++record_.counts.visits;
  keepCounts();
  if (outcome.failure) reporter_.fault(outcome.failure->message);
  return !outcome.failure;
} catch (const RunStopped&) {
  return true;
}

void Soak::see(const TimeSignature& now, const Scene& scene, const RunWatch& watch) {
  SoakCounts& c = record_.counts;
  const std::uint64_t wrong = c.wrongSteps;
  ++c.frames;
  if (now.step != signatureAt(now.frame, 60).step || now.time != before_ + now.step) ++c.wrongSteps;
  before_ = now.time;
  c.changes += scene.tree().version() - loadsVersion_;
  loadsVersion_ = scene.tree().version();
  const bool another = now.frame % kCheckEvery == 0 && !record_.agrees(show_, now.frame, watch.history());
  if (another) ++c.wrongHashes;
  // Saves the counts before it reports them: the reader of the report may end the run.
  if (another || (wrong == 0 && c.wrongSteps > 0)) keepCounts();
  if (another)
    reporter_.say(fmt::format("{}: frame {} has another history of states than before", show_, now.frame));
  if (way_ == Way::Killed && now.frame % kKillEvery == kKillEvery / 2)
    for (const pid_t wall : wallProcesses())
      if (kill(wall, SIGKILL) == 0) ++c.killed;
  if (way_ != Way::Pipelined || now.frame % kSampleEvery != kSampleAt) return;
  countSeconds();
  const ProcessFigures p = processFigures();
  record_.add({0, c.visits, c.frames, p.residentBytes, p.heapBytes, p.handles, p.threads});
  if (measured_ - told_ > std::chrono::seconds(10)) {
    told_ = measured_;
    tellProgress();
  }
}

void Soak::countSeconds() {
  const auto clock = Clock::now();
  record_.counts.seconds += std::chrono::duration<double>(clock - measured_).count();
  measured_ = clock;
}

void Soak::keepCounts() {
  countSeconds();
  record_.addCounts();
}

void Soak::tellProgress() {
  const SoakCounts& c = record_.counts;
  reporter_.say(fmt::format("soak: {} of {} frames, {:.0f} a second, {:.1f} MiB", c.frames, plan_.frames,
                            static_cast<double>(c.frames) / std::max(c.seconds, 1e-3),
                            static_cast<double>(record_.samples().back().residentBytes) / (1 << 20)));
}

}  // namespace

bool playSoak(const SoakPlan& plan, SoakRecord& record, ShowRenderer& renderer, Reporter& reporter,
              const std::atomic<bool>& stop) {
  return Soak(plan, record, renderer, reporter, stop).play();
}

}  // namespace stadion
