#include "bench/comparison/verdict.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fmt/format.h>
#include <limits>

namespace stadion::bench {
namespace {

using Kind = Finding::Kind;
using At = CostLimit::At;

bool within(double value, double most) {
  return std::fabs(value) <= most;  // false for NaN
}

const Measurement* cheaper(const Measurement* a, const Measurement& b) {
  return !a || b.ns < a->ns ? &b : a;
}

/// Returns true if this peer counts in the limit's comparison.
bool counts(const CaseLimits& limits, const Measurement& m, double ours) {
  if (isOurs(m) || !m.played() || !m.engine.starts_with(limits.cost.peers)) return false;
  if (!keeps(m, limits.finished)) return false;
  if (limits.cost.at != At::EqualError) return true;
  const double most = limits.errors.empty() ? ours : std::max(ours, limits.errors.front().most);
  return within(m.metric("err"), most);
}

Finding compare(const std::string& what, double mine, double theirs, double limit, const Measurement& peer) {
  const double ratio = mine / theirs;
  return {ratio <= limit ? Kind::Met : Kind::Missed,
          fmt::format("{} {:.3g} of {} n={}, at most {:.3g}", what, ratio, peer.engine, peer.n, limit)};
}

void judgeErrors(const CaseLimits& limits, const Measurement& m, Verdict& verdict) {
  for (const MetricLimit& limit : limits.errors) {
    const double value = m.metric(limit.metric);
    verdict.findings.push_back(
        {within(value, limit.most) ? Kind::Met : Kind::Missed,
         std::isnan(value) ? fmt::format("{} was not measured", limit.metric)
                           : fmt::format("{} {:.3g}, at most {:.3g}", limit.metric, value, limit.most)});
  }
}

void judgeFinest(const CaseLimits& limits, const std::vector<Measurement>& of, Verdict& verdict) {
  for (const MetricLimit& limit : limits.finest) {
    double best = std::numeric_limits<double>::infinity();
    for (const Measurement& m : of)
      if (isJudged(m) && m.played()) best = std::fmin(best, std::fabs(m.metric(limit.metric)));
    verdict.findings.push_back(
        {within(best, limit.most) ? Kind::Met : Kind::Missed,
         fmt::format("{} {:.3g} at the finest setting, at most {:.3g}", limit.metric, best, limit.most)});
  }
}

void judgeCost(const CaseLimits& limits, const Measurement& mine, const std::vector<Measurement>& of,
               Verdict& verdict) {
  if (limits.cost.at == At::Never) return;
  if (std::none_of(of.begin(), of.end(), [](const Measurement& m) { return !isOurs(m); })) {
    verdict.findings.push_back({Kind::Void, "cost: no other engine in this run"});
    return;
  }
  verdict.peer = peerFor(limits, of, mine.metric("err"));
  if (!verdict.peer) {
    verdict.findings.push_back({Kind::Void, limits.cost.at == At::EqualError
                                                ? "cost: no other engine comes as near at any setting"
                                                : "cost: no other engine plays this to the end"});
    return;
  }
  const Measurement& peer = *verdict.peer;
  verdict.findings.push_back(compare("cost", mine.ns, peer.ns, limits.cost.ratio, peer));
  if (limits.cost.worstFrame > 0)
    verdict.findings.push_back(compare("worst frame", mine.metric("worst_frame_ms"),
                                       peer.metric("worst_frame_ms"), limits.cost.worstFrame, peer));
}

}  // namespace

std::size_t Verdict::count(Finding::Kind kind) const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [kind](const Finding& f) { return f.kind == kind; }));
}

bool isOurs(const Measurement& m) {
  return m.engine.starts_with("stadion");
}

bool isJudged(const Measurement& m) {
  return isOurs(m) && !m.engine.starts_with("stadion-paper");
}

bool keeps(const Measurement& m, const std::vector<MetricLimit>& limits) {
  return std::all_of(limits.begin(), limits.end(),
                     [&m](const MetricLimit& l) { return within(m.metric(l.metric), l.most); });
}

const Measurement* peerAtSetting(const CaseLimits& limits, const std::vector<Measurement>& of, double ours) {
  const Measurement* best = nullptr;
  for (const Measurement& m : of)
    if (counts(limits, m, ours) && (limits.cost.at == At::EqualError || m.n == limits.cost.steps))
      best = cheaper(best, m);
  return best;
}

const Measurement* peerFor(const CaseLimits& limits, const std::vector<Measurement>& of, double ours) {
  if (const Measurement* best = peerAtSetting(limits, of, ours)) return best;
  const Measurement* best = nullptr;
  for (const Measurement& m : of)
    if (counts(limits, m, ours)) best = cheaper(best, m);
  return best;
}

Verdict judge(const std::string& caseName, const std::vector<Measurement>& of) {
  Verdict verdict;
  verdict.caseName = caseName;
  const CaseLimits* limits = limitsFor(caseName);
  if (!limits) return verdict;
  for (const Measurement& m : of) {
    if (!isJudged(m)) continue;
    if (m.played()) {
      judgeErrors(*limits, m, verdict);
      judgeCost(*limits, m, of, verdict);
    } else {
      verdict.findings.push_back({Kind::Missed, m.unsupported || m.refused() ? m.engine + " cannot play this"
                                                : m.crash == SIGALRM         ? m.engine + " ran out of time"
                                                                             : m.engine + " crashed"});
    }
  }
  judgeFinest(*limits, of, verdict);
  return verdict;
}

}  // namespace stadion::bench
