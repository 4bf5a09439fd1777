#pragma once
/// Simulates the timing of a show's frames on a machine that need not exist.
///
/// The frame loop (pipeline/loop/frame_loop.h) is modelled by processes that compute for the measured times
/// of the stages. There is one thread for App and, for each wall, one for Cull and one for Draw, or one
/// thread for all. There are three slots of scene state and two draw lists a wall; all walls swap together.
/// The software rasteriser is modelled, too: walls take turns with their calls, and threads of its own
/// rasterise one picture after the other. A wall keeps its turn until its picture is done. Walls of the CPU
/// renderer take no turns, and its threads draw one wall after the other.
///
/// Units    milliseconds of processor time and of time.
/// Threads  plain values.

#include "engine/core/pace.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion::plan {

/// A picture's part of Draw.
struct PictureCost {
  double calls = 0;   ///< processor time of the drawing thread
  double raster = 0;  ///< processor time of the rasteriser's threads together, afterwards
  double atOnce = 1;  ///< number of them that work at a time; few in a picture of few tiles
};

struct WallCost {
  double cull = 0;
  std::vector<PictureCost> pictures;  ///< by eye
  double cullBesideDraw = 0;          ///< the last part of `cull`: Draw may begin before it
};

/// The costs of a frame.
struct FrameCost {
  double app = 0;
  double appHelpers = 0;  ///< processor time of threads that work for App meanwhile
  std::vector<WallCost> walls;
  double swap = 0;
};

struct Machine {
  double cores = 1;
  double rasterThreads = 1;  ///< relative to the measuring machine: this factor more work at a time
};

/// Distribution of the work. Walls are assigned to machines, and to rasterisers on a machine, in turn: wall w
/// to number w mod n.
struct Plan {
  bool pipelined = true;
  std::size_t walls = 1;  ///< if more than were measured, those are repeated
  Machine machine;
  std::size_t machines = 1;     ///< equal machines, each with an App of its own; all walls swap together
  std::size_t rasterisers = 1;  ///< on each machine; more than one: walls are processes
  bool takesTurns = true;       ///< walls of a rasteriser, with their calls: those of OpenGL do
  bool waitsInTurn = true;      ///< for each picture, as llvmpipe does; else for all of them, afterwards
  Pace pace = Pace::Free;
  double rate = 60;     ///< [1/s], unless free
  bool newest = false;  ///< the walls show the newest frame, as in a live show; else every frame
  /// Limit of frames in flight, if pipelined; 0: as many as the stages hold. Counted from App, or if the
  /// newest frame is shown from Cull.
  std::size_t mostInFlight = 0;
  bool drawBeginsEarly = true;  ///< Draw begins with the first part of a list while Cull fills the rest
  std::size_t frames = 60;
};

enum class Activity : std::uint8_t {
  App,
  Cull,
  Calls,   ///< Draw, in its turn
  Raster,  ///< the rasteriser makes pixels
  Swap,
  ForTurn,    ///< Draw waits for other walls' calls
  ForPixels,  ///< Draw waits for the rasteriser
  ForWalls,   ///< Draw waits for other walls to finish
};
constexpr bool isWait(Activity d) {
  return d >= Activity::ForTurn;
}

/// An interval of one thread, or of the rasteriser.
struct Bar {
  std::size_t row = 0;  ///< in Schedule::rows
  Activity what = Activity::App;
  std::uint64_t frame = 0;
  double begin = 0, end = 0;
};

struct ShownFrame {
  std::uint64_t frame = 0;
  double began = 0;  ///< start of App, which samples the poses
  double shown = 0;
};

struct Schedule {
  std::vector<std::string> rows;  ///< "App", "Cull 1", "Draw 1", "rasteriser"
  std::vector<Bar> bars;          ///< in order of their ends
  std::vector<ShownFrame> shown;
  std::vector<double> busy;  ///< processor time, by machine
  double end = 0;
};

/// Expects at least one cost, with at least one wall. Frame n costs what measured frame n did; after the last
/// one the first follows again.
Schedule scheduleOf(const std::vector<FrameCost>& costs, const Plan& plan);

}  // namespace stadion::plan
