#pragma once
/// Arguments of a short run.

#include "tests/programs/program.h"

#include <string>
#include <vector>

namespace stadion {

/// Arguments for a short, small run of one of the test shows.
inline std::vector<std::string> shortRun(const std::string& show, std::vector<std::string> more = {},
                                         const char* frames = "5") {
  std::vector<std::string> words{"run",    show,    "--asset-root", assetFolder(), "--walls",  "desktop",
                                 "--size", "32x24", "--look",       "plain",       "--frames", frames};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace stadion
