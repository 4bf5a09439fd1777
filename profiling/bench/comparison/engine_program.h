#pragma once
/// The programs that play the cases, one for each engine, beside the program that runs.
///
/// Errors   a program that cannot be started, or says nothing, counts as crashed.

#include "profiling/bench/comparison/measurement.h"

namespace stadion::bench {

struct EngineProgram {
  std::string path;
  std::vector<std::string> variants;  ///< names of the engine's settings
  bool ours = false;                  ///< plays on Stadion
};

struct ListedCase {
  std::string name;
  std::vector<int> steps;  ///< steps a frame that are of interest
};

/// Those that are built in `folder`, Stadion's first.
std::vector<EngineProgram> enginePrograms(const std::string& folder);
std::vector<ListedCase> casesOf(const EngineProgram& program);

/// Plays one case; gives it up after `limit` seconds of processor time.
Measurement measure(const EngineProgram& program, const std::string& variant, const std::string& caseName,
                    int n, int limit);

}  // namespace stadion::bench
