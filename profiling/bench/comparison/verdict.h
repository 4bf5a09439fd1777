#pragma once
/// What was measured on one case against its limits.

#include "profiling/bench/comparison/limits.h"
#include "profiling/bench/comparison/measurement.h"

namespace stadion::bench {

struct Finding {
  enum class Kind { Met, Missed, Void };  ///< Void: nothing to compare with
  Kind kind = Kind::Met;
  std::string what;  ///< "err 3.4e-16, at most 1e-9"
};

struct Verdict {
  std::string caseName;
  std::vector<Finding> findings;
  const Measurement* peer = nullptr;  ///< what Stadion's cost is compared with

  std::size_t count(Finding::Kind kind) const;
};

bool isOurs(const Measurement& m);
bool keeps(const Measurement& m, const std::vector<MetricLimit>& limits);

/// The cheapest other engine at the setting of the limit; where none plays the case to its end there, the
/// cheapest that does so at any setting; null if none does. `ours` is how far off Stadion is.
const Measurement* peerFor(const CaseLimits& limits, const std::vector<Measurement>& of, double ours);
/// The same at the setting itself only.
const Measurement* peerAtSetting(const CaseLimits& limits, const std::vector<Measurement>& of, double ours);

/// `of`: all measurements of one case; the result points into it.
Verdict judge(const std::string& caseName, const std::vector<Measurement>& of);

}  // namespace stadion::bench
