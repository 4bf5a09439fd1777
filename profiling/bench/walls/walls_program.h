#pragma once
/// Runs a case of `stadion bench walls` in a process of its own.
///
/// Errors   what cannot be started, ends without a row, or takes too long, is told with the case's name.

#include "engine/base/diagnostic.h"
#include "profiling/bench/walls/walls_case.h"

#include <nlohmann/json.hpp>

namespace stadion::bench {

struct WallsPrograms {
  std::string stadion;     ///< the program itself
  std::string osg, floor;  ///< empty: not built
};
/// What is built beside the program.
WallsPrograms wallsPrograms(const std::string& stadion);

/// How it is called; its environment is that of the caller, except for the rasteriser's threads.
std::vector<std::string> wordsFor(const WallsCase& c, const WallsPrograms& programs);

/// The row: the fields that osg_walls prints, and what a row needs to be compared with others.
nlohmann::json completed(const WallsCase& c, nlohmann::json printed);

Result<nlohmann::json> measure(const WallsCase& c, const WallsPrograms& programs);

struct PicturesCase {
  std::string scene, kind;  ///< as in WallsCase
  std::string workers;      ///< who draws ours: as what is measured is drawn
};
/// Our words for a frame of all six walls; its pictures are still to be asked for.
WallsCase ourPictures(const PicturesCase& c);
/// Draws such a frame with both programs and compares them. `folder` may be filled.
Result<nlohmann::json> comparePictures(const PicturesCase& c, const WallsPrograms& programs,
                                       const std::string& folder);

}  // namespace stadion::bench
