#pragma once
/// Facts of a run that are equal in every run of the same program: they are compared exactly.
///
/// Threads  plain values, any thread.
/// Errors   an invalid summary gives nothing.

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
  std::string renderer;  ///< the renderer: images are equal only with the same one
  double rate = 0;       ///< [1/s] requested; 0: unknown
};

/// Reads the object that `stadion run --json` prints.
std::optional<RunFacts> factsOf(const std::string& summaryJson);

}  // namespace stadion::regression
