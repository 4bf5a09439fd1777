#pragma once
/// Hashes and counts: equal, or not.

#include "profiling/regression/spans/facts.h"
#include "profiling/regression/spans/result.h"
#include "profiling/regression/suite.h"

namespace stadion::regression {

/// What facts are compared with, and what it is called in sentences: "the baseline", "the other build".
struct Reference {
  const RunFacts* facts = nullptr;  ///< null: there is none
  std::string name;
};

/// A check for each of the metrics that are asked for. Images are compared only where the same renderer drew
/// them.
std::vector<Check> compareFacts(const RunFacts& found, const Reference& with, const Metrics& metrics);

/// All facts under one roof, for reports.
NamedFacts allOf(const RunFacts& facts);

}  // namespace stadion::regression
