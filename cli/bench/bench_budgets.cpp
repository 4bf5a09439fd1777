#include "cli/bench/bench_budgets.h"

#include "cli/bench/planted_stall.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "engine/base/installed_files.h"
#include "engine/input/input_log.h"
#include "show/base/stop_signal.h"
#include "show/base/temporary_folder.h"
#include "show/recording/run_watch.h"
#include "show/recording/show_recording.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <memory>

namespace stadion {
namespace {

/// A ball that bounces for ever, and may cost 0.8 ms.
constexpr const char* kShow = R"(
forcelinear( name=gravity, direction="0, 0, -1" )
object( name=ground, file=plane.3ds )
dynobject( name=ball, file=football.3ds, position="0, 3, 2", restitution=1, damping=0, hook=gravity )
dynamics( name=game, collider=ground, collidee=ball, budget=0.8, onoverrun="half, rest" )
)";
constexpr double kRate = 60;

struct BenchBudgetsOptions {
  double before = 2, stall = 3, recovery = 9, quiet = 10;  ///< [s]
  int length = 50;                                         ///< [ms]
  bool json = false;
  double seconds() const { return before + stall + recovery + quiet; }
  static std::uint64_t frame(double seconds) { return static_cast<std::uint64_t>(seconds * kRate); }
  std::uint64_t from() const { return frame(before); }
  std::uint64_t to() const { return frame(before + stall); }
};

using Clock = std::chrono::steady_clock;

/// What was seen while the show played.
struct BudgetRun {
  std::vector<double> periods;         ///< by frame, since the one before [ms]
  std::optional<std::uint64_t> named;  ///< App's frame when the node was told of first
  std::string toldAs;
  std::vector<FrameFacts> kept;    ///< in the black box
  DegradationDecisions decisions;  ///< in its log
  std::uint64_t history = 0;
};

class Experiment {
public:
  explicit Experiment(const BenchBudgetsOptions& options) : o_(options) {
    std::ofstream(folder_.path("show.evs")) << kShow;
  }

  std::optional<BudgetRun> play(Diagnostics& findings) {
    ShowOptions show = showOptions();
    show.input = "none";
    const PlaySettings live;
    RecordSettings record;
    record.input = folder_.path("live.input");
    const auto player = Player::create(show, findings, printFindings);
    if (!player) return {};
    player->playLive();
    auto watch = RunWatch::create(record, live, *player, findings);
    auto recording = recordingOf(*player, findings);
    if (!watch || !recording) return {};
    const NodeRef game = player->scene().tree().resolve("game", {1, 0});
    PlantedStall stall(recording->probe(), {game, o_.from(), o_.to(), std::chrono::milliseconds(o_.length)});
    stall_ = &stall;
    ShowParts parts = player->parts(StereoLayout::Off);
    parts.probe = &stall;
    FrameLoop* running = nullptr;
    Clock::time_point last;
    parts.observer = [&](const TimeSignature& now, const InputSample& input, const Scene& scene) {
      watch->see(now, input, scene);
      recording->see(scene);
      const auto at = Clock::now();
      played_.periods.push_back(std::chrono::duration<double, std::milli>(at - last).count());
      last = at;
      if (now.frame == o_.to() + BenchBudgetsOptions::frame(1)) look();  // before the box has moved on
      if (now.frame >= BenchBudgetsOptions::frame(o_.seconds())) running->endAfterThisFrame();
    };
    ShowStages stages(std::move(parts));
    FrameLoopOptions options = live.loopOptions(*player);
    options.decider = recording->governor();
    FrameLoop loop(stages, options, catchStopSignals(), &stall);
    running = &loop;
    loop.run();
    recording->finish();
    return finish(*watch, findings);
  }

  /// Of a replay of what was recorded: over the state hashes of all frames. Nothing if it cannot be played.
  std::optional<std::uint64_t> replay(Mode mode, Diagnostics& findings) {
    ShowOptions show = showOptions();
    show.input = folder_.path("live.input");
    show.mode = mode;
    const auto player = Player::create(show, findings, printFindings);
    auto watch = player ? RunWatch::create({}, PlaySettings{.everyFrame = true}, *player, findings) : nullptr;
    if (!watch) return {};
    ShowParts parts = player->parts(StereoLayout::Off);
    parts.observer = [&](const TimeSignature& now, const InputSample& input, const Scene& scene) {
      watch->see(now, input, scene);
    };
    ShowStages stages(std::move(parts));
    FrameLoop(stages, player->loopOptions(), catchStopSignals()).run();
    return historyOf(*watch);
  }

private:
  ShowOptions showOptions() const {
    ShowOptions show;
    show.script = folder_.path("show.evs");
    show.walls = "desktop";
    show.rate = kRate;
    show.assetRoots = {shareFolder() + "/assets"};
    show.width = 32;
    show.height = 24;
    return show;
  }

  std::unique_ptr<ShowRecording> recordingOf(const Player& player, Diagnostics& findings) {
    RecordingOptions options;
    options.profile = false;
    options.log.samples = false;
    options.keep = BlackBoxOptions{folder_.path("frames"), kRate, player.walls().names(), {}, {}};
    GovernorOptions governor;
    governor.rate = kRate;
    governor.walls = player.walls().names();
    governor.tell = [this](const std::string& line) { record(line); };
    options.govern = std::move(governor);
    return ShowRecording::create(std::move(options), findings);
  }

  void look() {
    if (const auto box = BlackBox::read(folder_.path("frames"))) played_.kept = box.value().frames;
  }

  void record(const std::string& line) {
    std::fprintf(stderr, "%s\n", line.c_str());
    const std::uint64_t frame = stall_->frame();
    const bool named = line.starts_with("over budget") && line.find("\"game\"") != line.npos;
    if (!named || frame < o_.from() || played_.named) return;
    played_.named = frame;
    played_.toldAs = line;
  }

  static std::uint64_t historyOf(const RunWatch& watch) {
    RunSummary s;
    watch.addTo(s, 1);
    return s.historyHash.value_or(0);
  }

  std::optional<BudgetRun> finish(RunWatch& watch, Diagnostics& findings) {
    if (const auto wrong = watch.finish()) findings.add(*wrong);
    played_.history = historyOf(watch);
    if (const auto log = loadInputLog(folder_.path("live.input"), findings))
      played_.decisions = log->decisions.degradation;
    return findings.hasErrors() ? std::nullopt : std::optional(std::move(played_));
  }

  BenchBudgetsOptions o_;
  TemporaryFolder folder_;
  PlantedStall* stall_ = nullptr;
  BudgetRun played_;
};

/// Prints each limit at once, as text or as an object.
class Report {
public:
  explicit Report(bool json) : json_(json) {}

  void limit(bool met, const std::string& what) {
    if (json_)
      print({{"bench", "budgets"}, {"limit", what}, {"ok", met}});
    else
      std::printf("%-6s %s\n", met ? "ok" : "FAILED", what.c_str());
    met_ = met_ && met;
  }
  void lateFrames(std::uint64_t late, std::uint64_t stalled, std::uint64_t tries) const {
    if (json_)
      print({{"bench", "budgets"}, {"late_frames", late}, {"stalled_frames", stalled}, {"tries", tries}});
    else
      std::printf("       %llu of the stall's %llu frames were late, tries to recover included (%llu)\n",
                  static_cast<unsigned long long>(late), static_cast<unsigned long long>(stalled),
                  static_cast<unsigned long long>(tries));
  }
  bool met() const { return met_; }

private:
  static void print(const nlohmann::json& line) { std::printf("%s\n", line.dump().c_str()); }

  bool json_;
  bool met_ = true;
};

bool isOnTime(const BudgetRun& p, std::uint64_t frame) {
  return frame < p.periods.size() && p.periods[frame] < 1.5 * 1e3 / kRate;
}

/// The first frame of five on time, one after the other.
std::uint64_t backInRate(const BudgetRun& p, std::uint64_t from) {
  constexpr std::uint64_t kRow = 5;
  for (std::uint64_t frame = from; frame + kRow < p.periods.size(); ++frame) {
    std::uint64_t row = 0;
    while (row < kRow && isOnTime(p, frame + row)) ++row;
    if (row == kRow) return frame;
  }
  return p.periods.size();
}

void judge(const BenchBudgetsOptions& o, const BudgetRun& p, Report& report) {
  const std::uint64_t from = o.from(), to = o.to();
  report.limit(p.named && *p.named <= from + 2,
               p.named ? fmt::format("named {} frames after the stall began (at most 2)", *p.named - from)
                       : "never named");
  const auto kept = std::ranges::find_if(
      p.kept, [&](const FrameFacts& f) { return f.frame >= from && f.frame < to && f.over[0] != 0; });
  const bool holds = kept != p.kept.end();
  report.limit(holds,
               holds ? fmt::format("in the black box: {}", toText(*kept, {})) : "not in the black box");
  const std::uint64_t back = backInRate(p, from);
  report.limit(back <= from + 10,
               fmt::format("back in its rate {} frames after the stall began (at most 10)", back - from));
  std::uint64_t late = 0, level = 0, last = 0, tries = 0;
  for (std::uint64_t f = from; f < to; ++f) late += !isOnTime(p, f);
  for (const auto& [frame, d] : p.decisions) {
    tries += frame > from && frame < to && d.level < level;
    level = d.level;
    last = frame;
  }
  report.lateFrames(late, to - from, tries);
  const std::uint64_t quiet = BenchBudgetsOptions::frame(o.seconds() - o.quiet);
  report.limit(level == 0 && !p.decisions.empty(),
               fmt::format("has everything back from frame {} on, {:.1f} s "
                           "after the stall ended",
                           last, (double(last) - double(to)) / kRate));
  std::size_t later = 0;
  for (const auto& [frame, d] : p.decisions) later += frame >= quiet;
  report.limit(later == 0, fmt::format("{} decisions in the last {:g} s (none), {} in all", later, o.quiet,
                                       p.decisions.size()));
}

int benchBudgets(const BenchBudgetsOptions& o) {
  Diagnostics findings;
  Experiment experiment(o);
  std::fprintf(stderr, "%.0f s: a node stalls for %d ms in each frame from %g s to %g s\n", o.seconds(),
               o.length, o.before, o.before + o.stall);
  const auto played = experiment.play(findings);
  std::vector<std::optional<std::uint64_t>> replays;
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
    if (played) replays.push_back(experiment.replay(mode, findings));
  printFindings(findings);
  if (!played) return kInternalFault;
  Report report(o.json);
  judge(o, *played, report);
  for (const auto& history : replays)
    report.limit(history == played->history,
                 fmt::format("replay of its log: state history {:016x}, live {:016x}", history.value_or(0),
                             played->history));
  return report.met() ? kOk : kCheckFailed;
}

}  // namespace

void addBenchBudgets(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchBudgetsOptions>();
  CLI::App* command = bench.add_subcommand(
      "budgets", "A node stalls: is it named, does the show keep its rate, does it recover and stay quiet?");
  CommandOptions options(*command);
  options.add("--stall", o->length);
  options.add("--stall-time", o->stall);
  options.add("--recovery", o->recovery);
  options.add("--quiet", o->quiet);
  options.add("--json", o->json);
  command->callback([o, &code] { code = benchBudgets(*o); });
}

}  // namespace stadion
