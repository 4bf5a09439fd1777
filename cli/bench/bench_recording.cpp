#include "cli/bench/bench_recording.h"

#include "bench/grid_show.h"
#include "cli/bench/bench_recording_instructions.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/renderer_options.h"
#include "cli/terminal.h"
#include "engine/base/atomic_file.h"
#include "engine/base/installed_files.h"
#include "engine/maths/median.h"
#include "show/base/stop_signal.h"
#include "show/base/temporary_folder.h"
#include "show/player/player.h"
#include "show/recording/last_frames.h"
#include "show/recording/show_recording.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <ctime>
#include <memory>
#include <mutex>
#include <thread>

namespace stadion {
namespace {

constexpr std::uint64_t kFramesBefore = 8;

struct BenchRecordingOptions {
  std::uint64_t frames = 160;
  std::size_t rounds = 4;
  std::string size = "400x300";
  double most = 1;  ///< [%]
  bool json = false, noInstructions = false;
  RendererOptions renderer;
};

double processMs() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Two shows in one process take turns, frame by frame, and each frame's processor time is noted: of all
/// threads, so that what collects records counts, too.
class ProcessorTurns {
public:
  void begin(std::size_t turn) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return next_ == turn || alone_; });
    began_ = processMs();
  }
  void end(std::size_t turn) {
    const std::lock_guard lock(mutex_);
    took_[turn].push_back(processMs() - began_);
    next_ = 1 - turn;
    changed_.notify_all();
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    alone_ = true;
    changed_.notify_all();
  }
  const std::vector<double>& took(std::size_t turn) const { return took_[turn]; }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0;
  bool alone_ = false;
  double began_ = 0;
  std::array<std::vector<double>, 2> took_;
};

/// A show whose frames wait for their turns.
class TurningShow {
public:
  static std::unique_ptr<TurningShow> create(const ShowOptions& options, ShowRenderer& renderer,
                                             bool recorded, ProcessorTurns& turns, std::size_t turn,
                                             Diagnostics& findings) {
    std::unique_ptr<TurningShow> made(new TurningShow(turns, turn));
    made->player_ = Player::create(options, findings, printFindings);
    if (!made->player_) return nullptr;
    RecordingOptions everything;
    everything.keep = unaskedLastFrames(made->player_->walls().names());
    if (recorded) made->recording_ = ShowRecording::create(std::move(everything), findings);
    ShowParts parts = made->player_->parts(StereoLayout::Pair);
    renderer.drawFor(parts);
    parts.probe = made->probe();
    parts.observer = [show = made.get()](const TimeSignature&, const InputSample&, const Scene& scene) {
      if (show->recording_) show->recording_->see(scene);
    };
    parts.shown = [show = made.get()] {
      show->turns_.end(show->turn_);
      if (++show->frames_ < show->player_->frames()) show->turns_.begin(show->turn_);
    };
    made->stages_ = std::make_unique<ShowStages>(std::move(parts));
    return made;
  }

  void play() {
    FrameLoopOptions options = player_->loopOptions();
    options.mode = Mode::Sequential;
    turns_.begin(turn_);
    FrameLoop loop(*stages_, options, never_, probe());
    failure_ = loop.run().failure;
    if (failure_) turns_.leave();
  }
  const Failure& failure() const { return failure_; }
  std::uint64_t lost() const { return recording_ ? recording_->lost() : 0; }

private:
  TurningShow(ProcessorTurns& turns, std::size_t turn) : turns_(turns), turn_(turn) {}
  FrameProbe* probe() { return recording_ ? &recording_->probe() : nullptr; }

  ProcessorTurns& turns_;
  std::size_t turn_;
  std::uint64_t frames_ = 0;
  std::atomic<bool> never_ = false;
  std::unique_ptr<Player> player_;
  std::unique_ptr<ShowRecording> recording_;
  std::unique_ptr<ShowStages> stages_;
  Failure failure_;
};

/// The middle frames alone would leave out those that are sampled: of every kBlock frames the sum is taken,
/// and of these the middle ratio.
double ratioOf(const std::vector<double>& with, const std::vector<double>& without) {
  constexpr std::size_t kBlock = 16;
  std::vector<double> ratios;
  for (std::size_t at = kFramesBefore; at + kBlock <= std::min(with.size(), without.size()); at += kBlock) {
    double a = 0, b = 0;
    for (std::size_t i = at; i < at + kBlock; ++i) {
      a += with[i];
      b += without[i];
    }
    ratios.push_back(a / b);
  }
  return median(std::move(ratios));
}

struct RoundCost {
  double ratio = 1, ms = 0;
};

std::optional<RoundCost> measureRound(const ShowOptions& options, ShowRenderer& renderer,
                                      std::size_t recorded, Diagnostics& findings) {
  ProcessorTurns turns;
  std::array<std::unique_ptr<TurningShow>, 2> shows;
  for (std::size_t turn = 0; turn < 2; ++turn) {
    shows[turn] = TurningShow::create(options, renderer, turn == recorded, turns, turn, findings);
    if (!shows[turn]) return {};
  }
  std::thread second([&] { shows[1]->play(); });
  shows[0]->play();
  second.join();
  for (const auto& show : shows)
    if (show->failure()) {
      findings.error({}, show->failure()->message);
      return std::nullopt;
    }
  if (shows[recorded]->lost() > 0) findings.warning({}, "spans were lost");
  return RoundCost{ratioOf(turns.took(recorded), turns.took(1 - recorded)), median(turns.took(1 - recorded))};
}

/// How much more a frame executes when it is recorded; nothing, with the findings, if that cannot be counted.
std::optional<double> moreInstructions(const ShowOptions& show, const RendererOptions& renderer,
                                       const TemporaryFolder& folder, Diagnostics& findings) {
  const std::atomic<bool>& stop = catchStopSignals();
  std::vector<std::string> words{"run",     show.script, "--walls",      show.walls,
                                 "--size",  show.size,   "--mode",       "sequential",
                                 "--input", "none",      "--asset-root", show.assetRoots.front(),
                                 "--json"};
  for (const std::string& word : renderer.words()) words.push_back(word);
  words.push_back("--unrecorded");
  const FrameInstructions without = instructionsAFrame(words, folder.path(""), stop);
  words.back() = "--profile";
  const FrameInstructions with =
      without.fault.empty() ? instructionsAFrame(words, folder.path(""), stop) : without;
  if (!with.fault.empty()) {
    findings.error({}, with.fault);
    return std::nullopt;
  }
  return with.each / without.each - 1;
}

int benchRecording(const BenchRecordingOptions& o) {
  const TemporaryFolder folder;
  Diagnostics findings;
  if (const auto wrong = writeFile(folder.path("grid.evs"), gridScript())) findings.add(*wrong);
  ShowOptions show;
  show.script = folder.path("grid.evs");
  show.walls = "desktop";
  show.size = o.size;
  show.input = "none";
  show.frames = o.frames + kFramesBefore;
  show.assetRoots = {shareFolder() + "/scripts"};
  const auto renderer = ShowRenderer::open(o.renderer.settings(findings));
  if (!renderer) findings.add(renderer.error());
  if (findings.hasErrors() || !show.complete(findings)) return exitWith(findings, kBadInput);
  std::vector<double> ratios;
  double ms = 0;
  for (std::size_t round = 0; round < o.rounds; ++round) {
    const auto measured = measureRound(show, *renderer.value(), round % 2, findings);
    printFindings(findings);
    if (!measured) return kBadInput;
    ratios.push_back(measured->ratio);
    ms = measured->ms;
    std::fprintf(stderr, "round %zu of %zu: %+.2f %%\n", round + 1, o.rounds, 100 * (measured->ratio - 1));
  }
  const double more = median(ratios) - 1;
  std::optional<double> executed;
  if (!o.noInstructions && !(executed = moreInstructions(show, o.renderer, folder, findings)))
    return exitWith(findings, kBadInput);
  const bool ok = more <= o.most / 100 && executed.value_or(0) <= o.most / 100;
  if (o.json)
    std::printf("%s\n", nlohmann::json{{"bench", "recording"},
                                       {"frame_ms", ms},
                                       {"more", more},
                                       {"more_instructions", executed.value_or(0)},
                                       {"ok", ok}}
                            .dump()
                            .c_str());
  else
    std::printf("a grid of 10 000 nodes, 5 000 of them visited in every frame, %s, two eyes: %.1f ms of "
                "processor time a "
                "frame\nrecorded, it takes %+.2f %%  (at most %g %%)  %s\n",
                o.size.c_str(), ms, 100 * more, o.most, more <= o.most / 100 ? "ok" : "MISSED");
  if (!o.json && executed)
    std::printf("and executes %+.2f %% instructions  (at most %g %%)  %s\n", 100 * *executed, o.most,
                *executed <= o.most / 100 ? "ok" : "MISSED");
  return ok ? kOk : kCheckFailed;
}

}  // namespace

void addBenchRecording(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchRecordingOptions>();
  CLI::App* command = bench.add_subcommand(
      "recording", "What does recording nodes' costs cost? A show with it and without, in turns");
  CommandOptions options(*command);
  options.add("--frames", o->frames, {.least = 32, .most = 1e5});
  options.add("--rounds", o->rounds, {.most = 99});
  options.add("--size", o->size);
  options.add("--within", o->most, {.least = 0.001});
  options.add("--no-instructions", o->noInstructions);
  o->renderer.addTo(*command);
  options.add("--json", o->json);
  command->footer("--within is the share of a frame that recording may cost.");
  command->callback([o, &code] { code = benchRecording(*o); });
}

}  // namespace stadion
