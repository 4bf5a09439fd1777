#pragma once
/// Runs a case of `stadion bench walls` in a process of its own.
///
/// Errors   A case that cannot be started, ends without a row, or takes too long is reported by its name.

#include "bench/walls/walls_case.h"
#include "engine/base/diagnostic.h"

#include <nlohmann/json.hpp>

namespace stadion::bench {

struct WallsPrograms {
  std::string stadion;     ///< the program itself
  std::string osg, floor;  ///< empty: not built
};
/// Returns the programs that are built beside this one.
WallsPrograms wallsPrograms(const std::string& stadion);

/// Returns the command line. The environment is the caller's, except for the rasteriser's threads.
std::vector<std::string> wordsFor(const WallsCase& c, const WallsPrograms& programs);

/// Returns the row: the fields of osg_walls, and those needed for comparisons.
nlohmann::json completed(const WallsCase& c, nlohmann::json printed);

Result<nlohmann::json> measure(const WallsCase& c, const WallsPrograms& programs);

struct PicturesCase {
  std::string scene, kind;  ///< as in WallsCase
  std::string drawnBy;      ///< threads or processes that draw Stadion's walls, as in the measurement
};
/// Returns Stadion's case for a frame of all six walls; its pictures are requested separately.
WallsCase ourPictures(const PicturesCase& c);
/// Draws that frame with both programs and compares them. `folder` may contain files.
Result<nlohmann::json> comparePictures(const PicturesCase& c, const WallsPrograms& programs,
                                       const std::string& folder);

}  // namespace stadion::bench
