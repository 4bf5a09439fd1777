/// `stadion soak [SHOW...]`: plays shows for very many frames, and looks whether anything grows or changes.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/findings_json.h"
#include "cli/options/command_options.h"
#include "cli/options/command_programs.h"
#include "cli/options/plugin_option.h"
#include "cli/options/renderer_options.h"
#include "cli/terminal.h"
#include "engine/base/installed_files.h"
#include "engine/base/run_stopped.h"
#include "pipeline/platform/process_figures.h"
#include "show/base/stop_signal.h"
#include "show/measure/soak_record.h"
#include "show/measure/soak_visitor.h"
#include "show/player/reusable_resources.h"
#include "show/recording/run_watch.h"
#include "show/recording/show_recording.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <map>
#include <memory>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kSampleEvery = 1000, kSampleAt = 50;  ///< frames: while nothing is being loaded
constexpr std::uint64_t kCheckEvery = 500, kKillEvery = 700;  ///< frames
constexpr double kMostSlope = 1024;                           ///< [byte] in 10 000 frames
constexpr std::uint64_t kSlopeFrames = 10'000;
constexpr double kMostOfVisit = 4096;  ///< [byte] from visit to visit

struct SoakOptions {
  std::vector<std::string> plugins;
  SharedTypes types = standardNodes();
  std::vector<std::string> shows;
  std::uint64_t frames = 1'000'000, visit = 400'000;
  std::string record;
  Look look = Look::Plain;
  RendererOptions renderer;
  bool noMemory = false;  ///< what grows is not judged
  bool json = false;
};

/// How a visit is played. The same happens in all of them.
enum class Way { Pipelined, Sequential, Killed };

class Soak {
public:
  Soak(const SoakOptions& o, SoakRecord& record, ShowRenderer& renderer, const std::atomic<bool>& stop)
      : options_(o), record_(record), renderer_(renderer), stop_(stop) {}

  /// False, and told, if a show could not be played.
  bool play();

private:
  bool visit(const std::string& show, Way way, std::uint64_t frames);
  void see(const TimeSignature& now, const Scene& scene, const RunWatch& watch);
  void countSeconds();
  void keepCounts();
  void tellProgress();

  const SoakOptions& options_;
  SoakRecord& record_;
  ShowRenderer& renderer_;
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
  while (counts.frames < options_.frames && !stop_) {
    const std::string& show = options_.shows[counts.visits / 3 % options_.shows.size()];
    const Way way = static_cast<Way>(counts.visits % 3);
    const std::uint64_t wanted = way == Way::Pipelined ? options_.visit : std::min(options_.visit, kShort);
    if (!visit(show, way, std::min(wanted, options_.frames - counts.frames))) return false;
  }
  return true;
}

bool Soak::visit(const std::string& show, Way way, std::uint64_t frames) try {
  show_ = show, way_ = way, before_ = 0, loadsVersion_ = 0;
  ShowOptions o;
  o.script = show, o.walls = "desktop", o.size = "32x24", o.look = options_.look;
  o.input = "none", o.frames = frames;
  o.mode = way == Way::Sequential ? Mode::Sequential : Mode::Pipelined;
  o.assetRoots = {shareFolder() + "/assets"}, o.types = options_.types;
  Diagnostics findings;
  ReusableResources& kept = kept_[show];
  kept.models.store().collect(~std::uint64_t{0});  // no frame shows it any more
  const auto player =
      o.complete(findings) ? Player::create(o, findings, printFindings, &stop_, &kept.models) : nullptr;
  const auto watch =
      player ? RunWatch::create({}, PlaySettings{.everyFrame = true}, *player, findings) : nullptr;
  printFindings(findings);
  if (!watch) return false;
  RecordingOptions recording;
  recording.profile = false, recording.log.shares = true;
  const auto recorded = ShowRecording::create(std::move(recording), findings);
  SoakVisitor visitor;
  ShowParts parts = player->parts(StereoLayout::Off, &visitor);
  if (way == Way::Killed)
    parts.wallProcesses.emplace().renderer = renderer_.kind();
  else
    parts.contexts = &kept.contexts;
  renderer_.drawFor(parts);
  parts.probe = &recorded->probe();
  const ShowStages* running = nullptr;
  parts.observer = [&](const TimeSignature& now, const InputSample& input, const Scene& scene) {
    watch->see(now, input, scene);
    recorded->see(scene);
    player->collect(running->shownFrame());
    see(now, scene, *watch);
  };
  FrameLoopOutcome outcome;
  {
    ShowStages stages(std::move(parts));
    running = &stages;
    FrameLoop loop(stages, player->loopOptions(), stop_, &recorded->probe());
    outcome = loop.run();
  }
  record_.counts.throws += visitor.throws(), record_.counts.refused += visitor.refused();
  ++record_.counts.visits;
  keepCounts();
  if (outcome.failure) std::fprintf(stderr, "stadion: %s\n", outcome.failure->message.c_str());
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
    std::fprintf(stderr, "%s: frame %ju has another history of states than before\n", show_.c_str(),
                 static_cast<std::uintmax_t>(now.frame));
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
  std::fprintf(stderr, "soak: %ju of %ju frames, %.0f a second, %.1f MiB\n",
               static_cast<std::uintmax_t>(c.frames), static_cast<std::uintmax_t>(options_.frames),
               static_cast<double>(c.frames) / std::max(c.seconds, 1e-3),
               static_cast<double>(record_.samples().back().residentBytes) / (1 << 20));
}

/// Prints each verdict at once, or keeps it for JSON.
class Verdicts {
public:
  explicit Verdicts(bool json) : json_(json) {}

  void add(bool well, const std::string& what) {
    if (json_)
      kept_.push_back({{"what", what}, {"ok", well}});
    else
      std::printf("  %-6s %s\n", well ? "ok" : "FAILED", what.c_str());
    well_ = well_ && well;
  }
  /// Likewise, of what more samples might hide.
  void addLasting(bool well, const std::string& what) {
    add(well, what);
    if (!well) failed_.push_back(what);
  }
  /// What could not be judged.
  void addOpen(const std::string& what) {
    if (json_)
      kept_.push_back({{"what", what}, {"ok", nullptr}});
    else
      std::printf("  -      %s\n", what.c_str());
  }
  bool well() const { return well_; }
  const std::vector<std::string>& failed() const { return failed_; }
  const nlohmann::ordered_json& kept() const { return kept_; }

private:
  bool json_, well_ = true;
  nlohmann::ordered_json kept_ = nlohmann::ordered_json::array();
  std::vector<std::string> failed_;
};

/// Memory, in a visit or from visit to visit, handles and threads. What could not be judged is no pass, but
/// where the soak was stopped no failure either.
void judgeGrowth(Verdicts& v, const SoakRecord& record, std::uint64_t warmUp, bool stopped) {
  constexpr std::size_t kFewest = 10;
  const std::vector<SoakSample> samples = afterWarmUp(record.samples(), warmUp);
  const auto slope = [&](std::uint64_t SoakSample::*figure) {
    return slopeOf(samples, figure).value_or(0) * static_cast<double>(kSlopeFrames);
  };
  const bool inVisit = samples.size() >= kFewest;
  if (inVisit) {
    const double resident = slope(&SoakSample::residentBytes);
    v.addLasting(
        resident < kMostSlope,
        fmt::format("memory in a visit: {:+.1f} bytes in 10 000 frames (RSS; less than {} is asked for), "
                    "{:+.1f} of them asked for by the program; {} samples",
                    resident, kMostSlope, slope(&SoakSample::heapBytes), samples.size()));
  } else {
    v.addOpen(fmt::format("memory in a visit: {} samples after its first {} frames are too few",
                          samples.size(), warmUp));
  }
  const auto more = slopeOfVisits(record.samples(), &SoakSample::heapBytes);
  if (more)
    v.addLasting(
        *more < kMostOfVisit,
        fmt::format("memory from visit to visit: {:+.1f} bytes more asked for by the program (less than {}); "
                    "{:+.1f} bytes of RSS",
                    *more, kMostOfVisit, *slopeOfVisits(record.samples(), &SoakSample::residentBytes)));
  else
    v.addOpen("memory from visit to visit: too few visits (--visit)");
  if (!inVisit && !more && stopped)
    v.addOpen("memory was not judged: the soak was stopped");
  else if (!inVisit && !more)
    v.add(false,
          "memory was not judged: more --frames are needed, or --no-memory says that it is not asked for");
  if (record.samples().size() < kFewest) return;
  const auto handles = growthOf(record.samples(), &SoakSample::handles),
             threads = growthOf(record.samples(), &SoakSample::threads);
  v.addLasting(handles <= 0, fmt::format("handles: {:+} of {}", handles, record.samples().back().handles));
  v.addLasting(threads <= 0, fmt::format("threads: {:+} of {}", threads, record.samples().back().threads));
}

double framesPerSecond(const SoakCounts& c) {
  return static_cast<double>(c.frames) / std::max(c.seconds, 1e-3);
}

void printCounts(const SoakOptions& o, const SoakRecord& record) {
  const SoakCounts& c = record.counts;
  std::printf("soak of %s: %ju frames in %ju visits by %u processes, %.0f frames a second\n",
              fmt::format("{}", fmt::join(o.shows, ", ")).c_str(), static_cast<std::uintmax_t>(c.frames),
              static_cast<std::uintmax_t>(c.visits), record.processes(), framesPerSecond(c));
  std::printf(
      "  %ju files loaded or unloaded, %ju throws, %ju measurements refused, %ju walls' processes killed\n",
      static_cast<std::uintmax_t>(c.changes), static_cast<std::uintmax_t>(c.throws),
      static_cast<std::uintmax_t>(c.refused), static_cast<std::uintmax_t>(c.killed));
}

void printAsJson(const SoakOptions& o, const SoakRecord& record, const Verdicts& v) {
  const SoakCounts& c = record.counts;
  printJson({{"ok", v.well()},
             {"shows", o.shows},
             {"frames", c.frames},
             {"visits", c.visits},
             {"processes", record.processes()},
             {"frames_per_second", framesPerSecond(c)},
             {"files_changed", c.changes},
             {"throws", c.throws},
             {"measurements_refused", c.refused},
             {"walls_killed", c.killed},
             {"verdicts", v.kept()}});
}

/// Prints what came of it.
Verdicts tellVerdicts(const SoakOptions& o, const SoakRecord& record) {
  const SoakCounts& c = record.counts;
  if (!o.json) printCounts(o, record);
  Verdicts v(o.json);
  v.add(c.wrongSteps == 0, fmt::format("time steps: {} of {} frames are not one tick after the one before",
                                       c.wrongSteps, c.frames));
  v.add(c.wrongHashes == 0,
        fmt::format("states: {} of {} histories compared differ", c.wrongHashes, c.compared));
  if (!o.noMemory)
    judgeGrowth(v, record, std::min<std::uint64_t>(100'000, std::max(o.frames, c.frames) / 5),
                c.frames < o.frames);
  for (const std::string& what : record.failed())
    if (std::ranges::find(v.failed(), what) == v.failed().end()) v.add(false, "before: " + what);
  if (o.json) printAsJson(o, record, v);
  return v;
}

int soak(SoakOptions o) {
  Diagnostics findings;
  const std::atomic<bool>& stop = catchStopSignals();
  if (o.shows.empty()) o.shows = {shareFolder() + "/scripts/soak/soak.evs"};
  const std::string what =
      fmt::format("{}, look {}, visits of {} frames", fmt::join(o.shows, ", "), nameOf(o.look), o.visit);
  TerminalReporter terminal;
  const RendererSettings settings = o.renderer.settings(findings);
  const auto record = SoakRecord::open(o.record, what, terminal.faultFunction(), findings);
  printFindings(findings);
  if (!record || findings.hasErrors()) return kBadInput;
  if (record->counts.frames >= o.frames) {
    std::fprintf(stderr, "soak: it is finished, by the record: nothing is played\n");
    return tellVerdicts(o, *record).well() ? kOk : kCheckFailed;
  }
  const auto renderer = ShowRenderer::open(settings);
  if (!renderer) {
    std::fprintf(stderr, "stadion: %s\n", renderer.error().message.c_str());
    return kInternalFault;
  }
  record->begin();
  Soak run(o, *record, *renderer.value(), stop);
  if (!run.play()) return kBadInput;
  const Verdicts verdicts = tellVerdicts(o, *record);
  record->end(verdicts.failed());
  if (!verdicts.well()) return kCheckFailed;
  if (record->incomplete()) return kBadInput;
  return record->counts.frames < o.frames ? kStopped + stopSignal() : kOk;
}

}  // namespace

void addSoakCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<SoakOptions>();
  CLI::App* command = addListedCommand(app, "soak");
  CommandOptions options(*command);
  options.add("SHOW", o->shows);
  options.add("--frames", o->frames, {.least = 1000});
  options.add("--visit", o->visit);
  options.add("--record", o->record);
  options.add("--look", o->look);
  o->renderer.addTo(*command);
  addPluginOption(*command, o->plugins, o->types);
  options.add("--no-memory", o->noMemory);
  options.add("--json", o->json);
  command->footer(
      "Without SHOW a show is played that loads, unloads and throws. Shows are played in turns.\n"
      "Fails (exit code 1) if memory grows by 1 KiB or more in 10 000 frames of a visit, or by 4 KiB from\n"
      "visit to visit, or could not be judged; if handles or threads become more, if a frame is not one "
      "tick\n"
      "after the one before, or if the same frame of a show has another state than before: also when it is\n"
      "stopped. docs/all-day.md");
  command->callback([o, &code] { code = soak(*o); });
}

}  // namespace stadion
