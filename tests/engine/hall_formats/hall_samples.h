#pragma once
/// Small halls and files for the tests of foreign formats.

#include "engine/hall_formats/hall_import.h"
#include "engine/hall_formats/neighbour_files.h"

#include <map>
#include <string>

namespace stadion::hall_samples {

/// Returns a hall with every kind of screen and image, masks, and a flat wall.
WallFile fullHall();

/// Files by name, as readers ask for them.
struct FakeFiles {
  std::map<std::string, std::string> files;

  NeighbourFiles reader() const {
    return [all = files](const std::string& name, std::size_t) {
      const auto at = all.find(name);
      if (at == all.end()) return Result<std::string>::failure("there is no file " + name);
      return Result<std::string>(at->second);
    };
  }
};

/// Returns all findings, one a line: "LINE: severity: message".
std::string said(const Diagnostics& out);

/// Returns mpcdi.xml of one region of 40 x 30 pixels with the file warp.pfm, and alpha.png if it has one.
std::string mpcdiXml(const std::string& profile, const std::string& inRegion, bool alpha = false);

}  // namespace stadion::hall_samples
