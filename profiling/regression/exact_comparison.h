#pragma once
/// Exact comparison of hashes and counts.

#include "profiling/regression/spans/facts.h"
#include "profiling/regression/spans/result.h"
#include "profiling/regression/suite.h"

namespace stadion::regression {

/// The facts to compare with, and their name in sentences: "the baseline", "the other build".
struct Reference {
  const RunFacts* facts = nullptr;  ///< null: there is none
  std::string name;
};

/// Returns a check for each requested metric. Images are compared only if the same renderer drew them.
std::vector<Check> compareFacts(const RunFacts& found, const Reference& with, const Metrics& metrics);

/// Returns all facts in one map, for reports.
NamedFacts allOf(const RunFacts& facts);

}  // namespace stadion::regression
