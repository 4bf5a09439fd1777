#pragma once
/// What a run told that is the same on every run of the same program: to be compared exactly.
///
/// Threads  plain values, any thread.
/// Errors   a summary that is none gives nothing.

#include <map>
#include <optional>
#include <string>

namespace stadion::regression {

/// By name, as text: hashes in hexadecimal, counts in decimal.
using NamedFacts = std::map<std::string, std::string>;

struct RunFacts {
  NamedFacts state;      ///< "state hash" of the last frame, "history hash" of all
  NamedFacts images;     ///< "image WALL EYE": of the last frame's pictures
  NamedFacts counts;     ///< "frames", "nodes visited per frame", "triangles WALL EYE" ...
  std::string renderer;  ///< who drew: images are the same only from the same one
  double rate = 0;       ///< [1/s] that was asked for; 0: not told
};

/// From the object that `stadion run --json` prints.
std::optional<RunFacts> factsOf(const std::string& summaryJson);

}  // namespace stadion::regression
