#pragma once
/// A suite of one small case, and `stadion regress` that plays it.

#include "tests/programs/program.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

using Json = nlohmann::json;

/// A suite of one small case, in the look that costs less.
inline std::string smallSuite(const TestFolder& folder, const std::string& more = {},
                              const std::string& look = "plain") {
  return folder.write("small.suite", "stadion-suite 1\nsize 32x24\nwalls desktop\nlook " + look +
                                         "\ncase bodies\n  show " + testShow("bodies.evs") +
                                         "\n  asset-root " + assetFolder() + "\n  frames 12\n" + more);
}

const std::string kSmallCase = "bodies/sequential/plain";

inline ProgramResult regress(std::vector<std::string> words) {
  words.insert(words.begin(), {stadionPath(), "regress"});
  ProgramRun run{std::move(words)};
  run.limit = std::chrono::seconds(600);  // callgrind on a busy machine
  return runProgram(run);
}

}  // namespace stadion
