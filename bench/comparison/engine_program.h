#pragma once
/// The programs that play the cases, one for each engine, separate from this program.
///
/// Errors   a program that cannot be started, or prints nothing, counts as crashed.

#include "bench/comparison/measurement.h"

namespace stadion::bench {

struct EngineProgram {
  std::string path;
  std::vector<std::string> variants;  ///< names of the engine's settings
  bool ours = false;                  ///< plays on Stadion
};

struct ListedCase {
  std::string name;
  std::vector<int> steps;  ///< numbers of steps a frame to be measured
};

/// Returns the programs that are built in `folder`, Stadion's first.
std::vector<EngineProgram> enginePrograms(const std::string& folder);
std::vector<ListedCase> casesOf(const EngineProgram& program);

/// Plays one case; stops it after `limit` seconds of processor time.
Measurement measure(const EngineProgram& program, const std::string& variant, const std::string& caseName,
                    int n, int limit);

}  // namespace stadion::bench
