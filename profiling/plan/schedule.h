#pragma once
/// How the frames of a show fall out in time, on a machine that need not be there.
///
/// What the frame loop does (pipeline/loop/frame_loop.h) is done here by processes that only compute as long as
/// the stages were measured to: one thread for App and, for each wall, one for Cull and one for Draw, or one
/// for all of it; three slots of scene state; two draw lists a wall; all walls swap together. The software
/// rasteriser is modelled as it works: walls take turns with their calls, what they call for is rasterised by
/// threads of its own, one picture after the other, and a wall keeps its turn until its picture is done.
///
/// Units    milliseconds of processor time and of time. Threads  plain values.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion::plan {

/// A picture's part of Draw.
struct PictureCost {
  double calls = 0;   ///< of the drawing thread
  double raster = 0;  ///< of the rasteriser's threads together, afterwards
  double atOnce = 1;  ///< how many of them work at a time; a picture of few tiles keeps few busy
};

struct WallCost {
  double cull = 0;
  std::vector<PictureCost> pictures;  ///< by eye
};

/// What a frame costs.
struct FrameCost {
  double app = 0;
  double appHelpers = 0;  ///< of threads that work for App meanwhile
  std::vector<WallCost> walls;
  double swap = 0;
};

struct Machine {
  double cores = 1;
  double rasterThreads = 1;  ///< for one where it was measured: as many times more work at a time
};

enum class Pacing { Free, Lock, Float };

/// Who runs what. Machines, and rasterisers on a machine, have their walls in turn: wall w is the
/// (w mod n)th's.
struct Plan {
  bool pipelined = true;
  std::size_t walls = 1;  ///< more than were measured: those again
  Machine machine;
  std::size_t machines = 1;     ///< alike, each with an App of its own; all walls swap together
  std::size_t rasterisers = 1;  ///< on each machine; more than one: walls are processes
  bool waitsInTurn = true;      ///< for each picture, as llvmpipe does; else for all of them, afterwards
  Pacing pacing = Pacing::Free;
  double rate = 60;     ///< [1/s], unless free
  bool newest = false;  ///< the walls show the newest frame, as in a live show; else every frame
  std::size_t frames = 60;
};

enum class Doing : std::uint8_t {
  App,
  Cull,
  Calls,   ///< Draw, in its turn
  Raster,  ///< of the rasteriser
  Swap,
  ForTurn,    ///< Draw waits for other walls' calls
  ForPixels,  ///< Draw waits for the rasteriser
  ForWalls,   ///< Draw waits for the walls that are not done
};
constexpr bool isWait(Doing d) {
  return d >= Doing::ForTurn;
}

/// A stretch of time of one thread, or of the rasteriser.
struct Bar {
  std::size_t row = 0;  ///< in Schedule::rows
  Doing what = Doing::App;
  std::uint64_t frame = 0;
  double begin = 0, end = 0;
};

struct ShownFrame {
  std::uint64_t frame = 0;
  double began = 0;  ///< App, which samples the poses
  double shown = 0;
};

struct Schedule {
  std::vector<std::string> rows;  ///< "App", "Cull 1", "Draw 1", "rasteriser"
  std::vector<Bar> bars;          ///< in order of their ends
  std::vector<ShownFrame> shown;
  std::vector<double> busy;  ///< processor time, by machine
  double end = 0;
};

/// Expects a cost at least, with a wall at least. Frame n costs what measured frame n did, the first again
/// after the last.
Schedule scheduleOf(const std::vector<FrameCost>& costs, const Plan& plan);

}  // namespace stadion::plan
