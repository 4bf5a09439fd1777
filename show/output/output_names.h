#pragma once
/// No two outputs may be one file, and none a file that is read, whether it was named on the command line or
/// not. None may lie where nothing can be written.

#include "engine/base/diagnostic.h"

#include <span>
#include <string>

namespace stadion {

struct NamedFile {
  std::string option;  ///< "--trace", "the log beside the show"
  std::string file;    ///< empty: not asked for
  bool written = true;
};

/// Says which of them name the same file, if one is written: whatever came last would be all that is left.
/// However they are spelt, also through links; of each file the first clash, so outputs go last. Pipes and
/// devices may be named twice.
void refuseSameFiles(std::span<const NamedFile> files, Diagnostics& findings);

/// Says which of those that are written cannot be: folders, files that are not ours to write to, and new ones
/// whose folder is not, or not there.
void refuseUnwritable(std::span<const NamedFile> files, Diagnostics& findings);

}  // namespace stadion
