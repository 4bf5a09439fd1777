#pragma once
/// No two outputs may be one file, and none a file that is read, whether it was named on the command line or
/// not.

#include "engine/diagnostic.h"

#include <span>
#include <string>

namespace stadion {

struct NamedFile {
  std::string option;  ///< "--html", "the log beside the show"
  std::string file;    ///< empty: not asked for
  bool written = true;
};

/// Says which of them name the same file, if one is written: whatever came last would be all that is left.
/// However they are spelt, also through links; of each file the first clash, so outputs go last. Pipes and
/// devices may be named twice.
void refuseSameFiles(std::span<const NamedFile> files, Diagnostics& findings);

}  // namespace stadion
