#pragma once
/// One setting of one program in the table of `stadion bench walls`.
///
/// Class    STRICT  a draw for each visible node, nothing merged or left out
///          OPEN    anything, if 99.9 % of all pixels are within 2 of 255
///          SUBMIT  as OPEN at 32 x 24 pixels: the cost where rasterising is not the limit
/// Units    metres; pixels.
/// Threads  plain values and functions.

#include <cstdint>
#include <string>
#include <vector>

namespace stadion::bench {

struct WallsCase {
  std::string engine = "stadion";  ///< stadion, osg, floor; control: a loop that only waits for its ticks
  std::string kind = "STRICT";
  std::string scene = "a";
  bool flat = false;  ///< true: all nodes are in one group; false: they stand in cells with a group each
  std::string mode;   ///< stadion: pipelined, sequential; osg: DPC, CTPC, ST; floor: its drawing
                      ///< method
  std::string lp{};   ///< LP_NUM_THREADS; empty: the program chooses
  std::string pace = "free";  ///< stadion's
  std::string drawnBy{};      ///< stadion's --wall-workers; empty: it chooses
  std::size_t walls = 4;
  std::uint32_t width = 800, height = 600;
  std::uint64_t warm = 3, frames = 12;
  std::size_t nodes = 0, moving = 0;  ///< 0: the scene's own
  double far = 0;                     ///< [m]; 0: the scene's own
};

/// The cases that are compared with each other.
WallsCase ourCase(const std::string& scene, bool flat, const std::string& kind,
                  const std::string& mode = "pipelined");
WallsCase osgCase(const std::string& scene, bool flat, const std::string& kind, const std::string& mode);
WallsCase floorCase(const std::string& scene, const std::string& kind, const std::string& way = "uniform");
/// Returns the case at the size of SUBMIT.
WallsCase small(WallsCase of);
/// Returns the case with both eyes on the front wall, drawn by one thread: it measures the processor time of
/// drawing a view.
WallsCase oneWall(WallsCase of);
/// Frames begin on ticks.
WallsCase lockedCase();
WallsCase controlCase();

/// Rows of cases with the same name may be combined. "stadion c flat STRICT pipelined"
std::string nameOf(const WallsCase& c);

/// The cases of a table's round, in order; compared cases are adjacent.
struct WallsChoice {
  std::vector<std::string> scenes{"a", "b", "c"};
  bool osg = true, floor = true;  ///< whether they are installed
  std::string drawnBy{};          ///< for all of Stadion's
};
std::vector<WallsCase> tableCases(const WallsChoice& choice);
/// Numbers of nodes from a thousand to a million, numbers of walls from one to six.
std::vector<WallsCase> scalingCases(const WallsChoice& choice);
std::vector<std::size_t> scalingNodes();
WallsCase scalingCase(std::size_t nodes, const std::string& engine);

}  // namespace stadion::bench
