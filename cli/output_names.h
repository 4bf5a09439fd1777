#pragma once
/// Files that are named on the command line: no two outputs may be the same, and none a script that is read.

#include "engine/diagnostic.h"

#include <span>
#include <string>

namespace stadion {

struct NamedFile {
  std::string option;  ///< "--html"
  std::string file;    ///< empty: not asked for
  bool written = true;
};

/// Says which of them name the same file, if one is written: whatever came last would be all that is left.
/// Pipes and devices may be named twice.
void refuseSameFiles(std::span<const NamedFile> files, Diagnostics& findings);

}  // namespace stadion
