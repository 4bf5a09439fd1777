#include "cli/bench/bench_scale.h"

#include "bench/city_show.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "engine/base/prefetch.h"
#include "pipeline/record/run_summary.h"
#include "profiling/record/allocations.h"
#include "show/base/temporary_folder.h"
#include "show/player/player.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMostAppMs = 0.1, kMostCullMs = 2, kMostBytes = 200;
constexpr std::uint64_t kWarm = 20;

struct BenchScaleOptions {
  bench::CityShow city;
  std::uint64_t frames = 200;
  bool cold = false;  ///< what App and Cull need has left the processor's caches
  bool json = false;
};

struct Figures {
  double loadSeconds = 0;
  double bytesANode = 0;  ///< what the loaded show holds
  double peakBytesANode = 0;
  std::vector<double> app, cull;  ///< [ms], by frame; Cull of all walls
  Allocations allocations;        ///< of App, in all of these frames
  double seen = 0;                ///< by an eye or both, on all walls
};

double millisecondsSince(Clock::time_point t) {
  return std::chrono::duration<double, std::milli>(Clock::now() - t).count();
}

double bytesInUse() {
  const struct mallinfo2 m = mallinfo2();
  return static_cast<double>(m.uordblks + m.hblkhd);
}

/// The most that this process has had in memory at a time.
double peakBytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::stod(line.substr(6));
  return 0;
}

/// Goes through more memory than a core's caches hold, as drawing does.
class Elsewhere {
public:
  explicit Elsewhere(bool goes) : lines_(goes ? kBytes / kCacheLine : 0) {}
  void visit() {
    for (std::array<char, kCacheLine>& line : lines_) ++line[0];
  }

private:
  static constexpr std::size_t kBytes = std::size_t{32} << 20;
  std::vector<std::array<char, kCacheLine>> lines_;
};

/// App and Cull in turns, as in a sequential run; nothing is drawn.
void playFrames(Player& player, const BenchScaleOptions& o, Figures& f) {
  ShowParts parts = player.parts(StereoLayout::Pair);
  const std::size_t walls = parts.walls.size();
  ShowStages stages(std::move(parts));
  std::vector<DrawList> lists(walls);
  Elsewhere elsewhere(o.cold);
  f.app.reserve(o.frames);
  f.cull.reserve(o.frames);
  for (std::uint64_t frame = 0; frame < kWarm + o.frames; ++frame) {
    const TimeSignature now = signatureAt(frame, player.rate());
    elsewhere.visit();
    const Allocations before = allocationsSoFar();
    const Clock::time_point app = Clock::now();
    stages.app(now, frame % kSlots);
    const double appMs = millisecondsSince(app);
    const Allocations during = allocationsSoFar() - before;
    const Clock::time_point cull = Clock::now();
    for (std::size_t wall = 0; wall < walls; ++wall) stages.cull(wall, frame % kSlots, lists[wall]);
    if (frame < kWarm) continue;
    f.app.push_back(appMs);
    f.cull.push_back(millisecondsSince(cull));
    f.allocations += during;
  }
  for (const DrawList& list : lists) f.seen += static_cast<double>(list.opaque.size());
}

std::optional<Figures> measure(const BenchScaleOptions& o) {
  const TemporaryFolder folder;
  if (const std::string wrong = bench::writeCity(folder.path(""), o.city); !wrong.empty()) {
    std::fprintf(stderr, "stadion: %s\n", wrong.c_str());
    return std::nullopt;
  }
  ShowOptions show;
  show.script = folder.path("city.evs");
  show.walls = folder.path("city.walls");
  show.size = "800x600";
  show.input = "none";
  show.frames = kWarm + o.frames;
  Diagnostics findings;
  const auto nodes = static_cast<double>(o.city.still + o.city.moving);
  Figures f;
  const double before = bytesInUse(), peakBefore = peakBytes();
  const Clock::time_point began = Clock::now();
  const auto player = show.complete(findings) ? Player::create(show, findings, printFindings) : nullptr;
  if (!player) {
    printFindings(findings);
    return std::nullopt;
  }
  f.loadSeconds = 1e-3 * millisecondsSince(began);
  const auto chunk = static_cast<double>(player->parts(StereoLayout::Pair).state.arena().bytesInUse());
  f.bytesANode = (bytesInUse() - before + chunk) / nodes;
  f.peakBytesANode = (peakBytes() - peakBefore) / nodes;
  playFrames(*player, o, f);
  return f;
}

int benchScale(const BenchScaleOptions& o) {
  const std::optional<Figures> f = measure(o);
  if (!f) return kBadInput;
  const double app = percentile(f->app, 50), cull = percentile(f->cull, 50);
  const bool ok =
      app <= kMostAppMs && cull <= kMostCullMs && f->bytesANode <= kMostBytes && f->allocations.count == 0;
  if (o.json)
    std::printf("%s\n", nlohmann::json{{"bench", "scale"},
                                       {"still", o.city.still},
                                       {"moving", o.city.moving},
                                       {"cold", o.cold},
                                       {"app_ms", app},
                                       {"app_ms_p99", percentile(f->app, 99)},
                                       {"app_limit_ms", kMostAppMs},
                                       {"app_allocations", f->allocations.count},
                                       {"cull_ms", cull},
                                       {"cull_limit_ms", kMostCullMs},
                                       {"items", f->seen},
                                       {"bytes_a_node", f->bytesANode},
                                       {"bytes_limit", kMostBytes},
                                       {"peak_bytes_a_node", f->peakBytesANode},
                                       {"load_s", f->loadSeconds},
                                       {"ok", ok}}
                            .dump()
                            .c_str());
  else
    std::printf("%zu nodes that stand still, %zu that move, four walls\n"
                "  App and publishing  %8.3f ms a frame   (at most %.1f)   p99 %.3f, %.0f allocations\n"
                "  Cull, all walls     %8.3f ms a frame   (at most %.1f)   %.0f items\n"
                "  memory              %8.1f bytes a node (at most %.0f)   %.0f at the peak of loading\n"
                "  loading             %8.2f s\n%s\n",
                o.city.still, o.city.moving, app, kMostAppMs, percentile(f->app, 99),
                static_cast<double>(f->allocations.count), cull, kMostCullMs, f->seen, f->bytesANode,
                kMostBytes, f->peakBytesANode, f->loadSeconds, ok ? "ok" : "FAILED");
  return ok ? kOk : kCheckFailed;
}

}  // namespace

void addBenchScale(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchScaleOptions>();
  CLI::App* command = bench.add_subcommand("scale", "A million nodes that stand still, and a few that move");
  CommandOptions options(*command);
  options.add("--still", o->city.still);
  options.add("--moving", o->city.moving, {.most = 1e5});
  options.add("--frames", o->frames, {.most = 1e5});
  options.add("--cold", o->cold);
  options.add("--json", o->json);
  command->callback([o, &code] { code = benchScale(*o); });
}

}  // namespace stadion
