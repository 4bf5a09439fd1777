#pragma once
/// How the cases of a regression suite are played and compared.

#include "profiling/regression/baseline.h"
#include "profiling/regression/suite.h"

#include <chrono>
#include <optional>
#include <string>

namespace stadion {

struct RegressSettings {
  std::string program;              ///< the one to try
  std::chrono::seconds limit{600};  ///< for each of its processes
  bool instructions = false;        ///< callgrind counts where the processor cannot
  regression::Metrics asked{};      ///< metrics to compare, and to keep in a baseline
};

/// The reference of a comparison.
struct RegressReference {
  std::string program;                             ///< another one; empty: none
  std::optional<regression::Baseline> baseline{};  ///< nothing: none
  std::string baselineFile{};
};

}  // namespace stadion
