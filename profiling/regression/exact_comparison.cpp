#include "profiling/regression/exact_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stadion::regression {
namespace {

constexpr std::size_t kMostTold = 6;

/// "triangles front left: 120, was 118", for each fact that differs.
std::vector<std::string> differences(const NamedFacts& found, const NamedFacts& expected,
                                     std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const auto& [name, value] : expected) {
    const auto now = found.find(name);
    if (now == found.end() || now->second != value) names.push_back(name);
    if (now == found.end())
      all.push_back(fmt::format("{}: missing, was {}", name, value));
    else if (now->second != value)
      all.push_back(fmt::format("{}: {}, was {}", name, now->second, value));
  }
  for (const auto& [name, value] : found)
    if (!expected.contains(name)) {
      names.push_back(name);
      all.push_back(fmt::format("{}: {}, was not there", name, value));
    }
  return all;
}

Check compared(const std::string& metric, const NamedFacts& found, const NamedFacts& expected,
               const std::string& with) {
  if (found.empty() && expected.empty())
    return {metric, Outcome::Skipped, fmt::format("neither this run nor {} tells of any", with)};
  std::vector<std::string> names, wrong = differences(found, expected, names);
  if (wrong.empty()) return {metric, Outcome::Passed, fmt::format("{} equal to {}", found.size(), with)};
  const std::size_t more = wrong.size() > kMostTold ? wrong.size() - kMostTold : 0;
  wrong.resize(wrong.size() - more);
  return {metric,
          Outcome::Failed,
          fmt::format("not as in {}: {}{}", with, fmt::join(wrong, "; "),
                      more > 0 ? fmt::format("; and {} more", more) : ""),
          {},
          std::move(names)};
}

}  // namespace

std::vector<Check> compareFacts(const RunFacts& found, const Reference& with, const Metrics& metrics) {
  std::vector<Check> checks;
  const auto add = [&](bool asked, const std::string& metric, const NamedFacts& now,
                       const NamedFacts RunFacts::*facts) {
    if (!asked) return;
    if (!with.facts)
      checks.push_back({metric, Outcome::Skipped, fmt::format("{} has nothing to compare with", with.name)});
    else
      checks.push_back(compared(metric, now, with.facts->*facts, with.name));
  };
  add(metrics.state, "state", found.state, &RunFacts::state);
  const bool sameRenderer = !with.facts || with.facts->renderer == found.renderer;
  if (metrics.images && !sameRenderer)
    checks.push_back(
        {"images", Outcome::Skipped,
         fmt::format("drawn by {}, and those of {} by {}", found.renderer, with.name, with.facts->renderer)});
  else
    add(metrics.images, "images", found.images, &RunFacts::images);
  add(metrics.counts, "counts", found.counts, &RunFacts::counts);
  return checks;
}

NamedFacts allOf(const RunFacts& facts) {
  NamedFacts all = facts.state;
  all.insert(facts.images.begin(), facts.images.end());
  all.insert(facts.counts.begin(), facts.counts.end());
  return all;
}

}  // namespace stadion::regression
