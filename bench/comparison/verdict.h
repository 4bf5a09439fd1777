#pragma once
/// Compares the measurements of one case with its limits.

#include "bench/comparison/limits.h"
#include "bench/comparison/measurement.h"

namespace stadion::bench {

struct Finding {
  enum class Kind { Met, Missed, Void };  ///< Void: nothing to compare with
  Kind kind = Kind::Met;
  std::string what;  ///< "err 3.4e-16, at most 1e-9"
};

struct Verdict {
  std::string caseName;
  std::vector<Finding> findings;
  const Measurement* peer = nullptr;  ///< the measurement to which Stadion's cost is compared

  std::size_t count(Finding::Kind kind) const;
};

/// Returns true for each setting of Stadion. None is a peer.
bool isOurs(const Measurement& m);
/// Returns true if the limits hold for it: not for the rungs that are only shown beside.
bool isJudged(const Measurement& m);
bool keeps(const Measurement& m, const std::vector<MetricLimit>& limits);

/// Returns the cheapest other engine at the setting of the limit. If none finishes the case there, returns
/// the cheapest that finishes it at any setting; null if none does. `ours` is Stadion's error.
const Measurement* peerFor(const CaseLimits& limits, const std::vector<Measurement>& of, double ours);
/// Returns the cheapest other engine at the setting of the limit that finishes the case there; null if none
/// does.
const Measurement* peerAtSetting(const CaseLimits& limits, const std::vector<Measurement>& of, double ours);

/// `of`: all measurements of one case; the result points into it.
Verdict judge(const std::string& caseName, const std::vector<Measurement>& of);

}  // namespace stadion::bench
