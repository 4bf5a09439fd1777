#include "cli/bench/walls_measure.h"

#include "bench/walls/picture_difference.h"
#include "bench/walls/wall_room.h"
#include "cli/terminal.h"
#include "pipeline/loop/pacer.h"
#include "pipeline/record/run_summary.h"
#include "profiling/record/processor_time.h"
#include "show/player/player.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <malloc.h>
#include <span>
#include <unistd.h>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

/// What this process holds in memory now [MB].
double memoryMb() {
  std::ifstream in("/proc/self/statm");
  double all = 0, resident = 0;
  in >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// What the show holds [MB]: what this process has allocated, and the records of what stands still, which are
/// mapped by themselves. Not counted are the slots of what moves. Walls are closed by then.
double heldMb(Player& player) {
  const struct mallinfo2 heap = mallinfo2();
  const std::size_t chunks = player.parts(StereoLayout::Pair).state.arena().bytesInUse();
  return static_cast<double>(heap.uordblks + heap.hblkhd + chunks) / 1e6;
}

/// When frames were complete on all walls.
struct CompletedFrames {
  std::uint64_t frames = 0;
  Clock::time_point begin{}, end{};
  double processorBegin = 0, processorEnd = 0;

  void add(const WallsSetting& s) {
    if (++frames == s.warm) {
      begin = Clock::now();
      processorBegin = processorSeconds();
    }
    if (frames == s.warm + s.frames) {
      end = Clock::now();
      processorEnd = processorSeconds();
    }
  }
};

std::string pictureFile(const WallsSetting& s, const std::string& wall, std::size_t eye) {
  return s.pictures + "_" + wall + (eye == 0 ? "_L.ppm" : "_R.ppm");
}

/// Frames, of those that are measured or not, of which a view was not drawn: at least so many.
std::uint64_t incompleteFrames(const FrameLoopOutcome& outcome, const ShowStages& stages, std::size_t walls,
                               std::uint64_t frames) {
  std::uint64_t late = 0;  // several walls may be late in the same frame
  for (std::size_t wall = 0; wall < walls; ++wall) late = std::max(late, stages.late(wall).frames);
  return frames - std::min(frames, outcome.framesDrawn) + late;
}

/// Takes the pictures of the frame that follows the last one that is measured.
class LastPictures final : public PictureSink {
public:
  LastPictures(const WallsSetting& setting, std::vector<std::string> walls)
      : setting_(setting), walls_(std::move(walls)) {}

  bool wants(const TimeSignature& now) const override {
    return !setting_.pictures.empty() && now.frame == setting_.warm + setting_.frames;
  }
  Failure take(const TimeSignature&, const std::vector<EyePictures>& walls) override {
    for (std::size_t wall = 0; wall < walls.size(); ++wall)
      for (std::size_t eye = 0; eye < walls[wall].eyes.size(); ++eye)
        if (const std::string file = pictureFile(setting_, walls_[wall], eye);
            !write(file, walls[wall].eyes[eye]))
          return Reason("cannot write " + file);
    return {};
  }

private:
  static bool write(const std::string& file, const Picture& p) {
    bench::RgbPicture rgb{p.width, p.height, {}};
    for (std::size_t i = 0; i < p.rgba.size(); ++i)
      if (i % 4 != 3) rgb.rgb.push_back(p.rgba[i]);
    return bench::writePpm(file, rgb);
  }

  const WallsSetting& setting_;
  std::vector<std::string> walls_;
};

/// Without the frames before those that are measured.
std::vector<double> measured(const DurationSeries& series, const WallsSetting& s) {
  const std::vector<double>& all = series.values();
  const std::size_t first = std::min<std::size_t>(s.warm, all.size());
  const std::size_t last = std::min<std::size_t>(s.warm + s.frames, all.size());
  return {all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(last)};
}

/// What frames took on all walls together: one wall may do what is for all.
double medianOfSums(const std::vector<DurationSeries>& walls, const WallsSetting& s) {
  std::vector<double> sums(s.frames, 0);
  for (const DurationSeries& wall : walls) {
    const std::vector<double> of = measured(wall, s);
    for (std::size_t i = 0; i < std::min(of.size(), sums.size()); ++i) sums[i] += of[i];
  }
  return percentile(sums, 50);
}

}  // namespace

std::string unwritable(const WallsSetting& s) {
  namespace fs = std::filesystem;
  if (s.pictures.empty()) return {};
  for (std::size_t wall = 0; wall < s.walls; ++wall)
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const std::string file = pictureFile(s, bench::roomWalls()[wall].name, eye);
      std::error_code error;
      const bool there = fs::exists(file, error);
      const bool opens = static_cast<bool>(std::ofstream(file, std::ios::binary | std::ios::app));
      if (opens && !there) fs::remove(file, error);
      if (!opens) return "--out: " + file + " cannot be written";
    }
  return {};
}

namespace {

ShowOptions showOf(const WallsSetting& s, const std::string& folder) {
  ShowOptions show;
  show.script = folder + "/show.evs";
  show.walls = folder + "/room.walls";
  show.input = folder + "/show.input";
  show.mode = s.mode;
  show.look = Look::Plain;
  show.size = std::to_string(s.width) + "x" + std::to_string(s.height);
  show.frames = s.warm + s.frames + 1;
  return show;
}

ShowParts showPartsOf(const WallsSetting& s, Player& player, ShowRenderer& renderer) {
  ShowParts parts = player.parts(StereoLayout::Pair);
  if (s.kind == "STRICT") {
    parts.quality.mostAtOnce = 1;
    parts.quality.leavesOutUnseen = false;
  }
  if (s.without == "unseen") parts.quality.leavesOutUnseen = false;
  if (s.without == "small") parts.quality.drawsSmallObjects = false;
  if (s.drawnBy == "process") parts.wallProcesses = WallProcesses{renderer.kind()};
  renderer.drawFor(parts);
  return parts;
}

/// Returns the latency of each measured frame: that of its slowest wall [ms].
std::vector<double> worstLatency(const FrameTimes& times, const WallsSetting& s) {
  std::vector<double> latency;
  for (std::size_t i = 0; i < s.frames; ++i) {
    double worst = 0;
    for (const DurationSeries& wall : times.latency)
      if (s.warm + i < wall.values().size()) worst = std::max(worst, wall.values()[s.warm + i]);
    latency.push_back(worst);
  }
  return latency;
}

void addSetting(const WallsSetting& s, ShowRenderer& renderer, nlohmann::json& to) {
  const char* lp = std::getenv("LP_NUM_THREADS");
  to.update({{"engine", "stadion"},
             {"class", s.kind},
             {"without", s.without},
             {"backend", nameOf(renderer.kind())},
             {"scene", s.scene},
             {"flat", s.flat ? 1 : 0},
             {"walls", s.walls},
             {"eyes", 2},
             {"width", s.width},
             {"height", s.height},
             {"mode", nameOf(s.mode)},
             {"wall_workers", s.drawnBy},
             {"frames_under_way", s.mostInFlight},
             {"lp_threads", lp ? lp : "default"},
             {"draw_threads", renderer.threads()},
             {"pace", s.pace},
             {"frames", s.frames}});
}

void addTimes(const WallsSetting& s, const FrameTimes& times, nlohmann::json& to) {
  const double views = 2 * static_cast<double>(s.walls);
  const std::vector<double> period = measured(times.period, s), latency = worstLatency(times, s);
  const double cull = medianOfSums(times.cull, s), draw = medianOfSums(times.draw, s);
  to.update({{"frame_ms_median", percentile(period, 50)},
             {"frame_ms_p95", percentile(period, 95)},
             {"frame_ms_p99", percentile(period, 99)},
             {"frame_ms_max", percentile(period, 100)},
             {"latency_ms_median", percentile(latency, 50)},
             {"latency_ms_p95", percentile(latency, 95)},
             {"latency_ms_p99", percentile(latency, 99)},
             {"app_ms", percentile(measured(times.app, s), 50)},
             {"cull_ms_per_view", cull / views},
             {"draw_ms_per_view", draw / views},
             {"cull_ms_sum", cull},
             {"draw_ms_sum", draw}});
}

void addProcessorTime(const WallsSetting& s, const CompletedFrames& completed, nlohmann::json& to) {
  const double took = seconds(completed.end - completed.begin);
  const double processor = completed.processorEnd - completed.processorBegin;
  const auto frames = static_cast<double>(s.frames);
  to.update({{"fps", frames / took},
             {"cpu_cores", processor / took},
             {"cpu_ms_per_frame", 1e3 * processor / frames}});
}

void addCounts(const WallsSetting& s, const ShowStages& stages, nlohmann::json& to) {
  nlohmann::json counts = nlohmann::json::array();
  double draws = 0, triangles = 0;
  for (std::size_t wall = 0; wall < s.walls; ++wall)
    for (const DrawTotals& eye : std::span(stages.drawn(wall)).first(kEyes.size())) {
      const double n = std::max(1.0, static_cast<double>(eye.frames));
      counts.push_back(std::llround(static_cast<double>(eye.calls) / n));
      draws += static_cast<double>(eye.calls) / n;
      triangles += static_cast<double>(eye.triangles) / n;
    }
  to.update({{"renderer", stages.drawnBy()},
             {"draws_per_frame", draws},
             {"tris_per_frame", triangles},
             {"draws_per_view", counts}});
}

}  // namespace

Result<nlohmann::json> measureWalls(const WallsSetting& s, const std::string& folder) {
  ShowOptions show = showOf(s, folder);
  Diagnostics findings;
  const auto wrong = [&](const std::string& what) {
    printFindings(findings);
    return Diagnostic{Severity::Error, {folder, 0, 0}, what, {}};
  };
  if (!show.complete(findings)) return wrong("bad settings");
  const auto renderer = ShowRenderer::open(s.renderer);
  if (!renderer) return renderer.error();
  const auto player = Player::create(show, findings, printFindings);
  if (!player) return wrong("the show cannot be played");
  LastPictures pictures(s, player->walls().names());
  CompletedFrames completed;
  ShowParts parts = showPartsOf(s, *player, *renderer.value());
  parts.sink = &pictures;
  parts.shown = [&] { completed.add(s); };
  ShowStages stages(std::move(parts));
  const std::atomic<bool> never = false;
  FrameLoopOptions options = player->loopOptions();
  options.mostInFlight = s.mostInFlight;
  options.pace = s.pace == "lock" ? Pace::Lock : Pace::Free;
  FrameLoop loop(stages, options, never);
  const FrameLoopOutcome outcome = loop.run();
  if (outcome.failure) return wrong(outcome.failure->message);

  nlohmann::json result{{"memory_mb", memoryMb()}, {"held_mb", heldMb(*player)}};
  addSetting(s, *renderer.value(), result);
  addTimes(s, loop.times(), result);
  addProcessorTime(s, completed, result);
  addCounts(s, stages, result);
  result["incomplete"] = incompleteFrames(outcome, stages, s.walls, show.frames);
  return result;
}

nlohmann::json measureTicks(std::uint64_t frames) {
  Pacer pacer(Pace::Lock, bench::kWallSceneRate);
  pacer.wait();
  std::vector<double> periods;
  Clock::time_point before = Clock::now();
  for (std::uint64_t i = 0; i < frames; ++i) {
    pacer.wait();
    const Clock::time_point now = Clock::now();
    periods.push_back(1e3 * seconds(now - before));
    before = now;
  }
  return nlohmann::json{{"engine", "control"},
                        {"frames", frames},
                        {"frame_ms_median", percentile(periods, 50)},
                        {"frame_ms_p95", percentile(periods, 95)},
                        {"frame_ms_p99", percentile(periods, 99)},
                        {"frame_ms_max", percentile(periods, 100)}};
}

bench::WallScene sceneOf(const WallsSetting& s) {
  return {s.scene.front(), s.nodes, s.moving, s.far};
}

}  // namespace stadion
