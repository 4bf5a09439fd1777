#include "profiling/regression/reports.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion::regression {
namespace {

const char* word(Outcome outcome) {
  return outcome == Outcome::Passed ? "ok" : outcome == Outcome::Failed ? "FAILED" : "-";
}

std::string row(const std::string& name, const Check& c, std::size_t nameWidth, std::size_t metricWidth) {
  std::string text = fmt::format("{:<{}}  {:<{}}  {:<6}  {}\n", name, nameWidth, c.metric, metricWidth,
                                 word(c.outcome), c.said);
  if (!c.culprit.empty())
    text += fmt::format("{:<{}}  {}\n", "", nameWidth + metricWidth + 10, "moved: " + c.culprit);
  return text;
}

}  // namespace

std::string tableOf(const SuiteResult& result) {
  std::size_t nameWidth = 4, metricWidth = 6;
  double seconds = 0;
  for (const CaseResult& c : result.cases) {
    nameWidth = std::max(nameWidth, c.name.size());
    seconds += c.seconds;
    for (const Check& k : c.checks) metricWidth = std::max(metricWidth, k.metric.size());
  }
  std::string text;
  for (const CaseResult& c : result.cases) {
    if (!c.fault.empty()) text += row(c.name, {"play", Outcome::Failed, c.fault}, nameWidth, metricWidth);
    for (const Check& k : c.checks) text += row(c.name, k, nameWidth, metricWidth);
  }
  for (const CaseResult& c : result.cases)
    for (const std::string& warning : c.warnings) text += warning + "\n";
  text +=
      fmt::format("{} cases in {:.1f} s: {} comparisons passed, {} failed, {} had nothing to compare with",
                  result.cases.size(), seconds, result.count(Outcome::Passed), result.count(Outcome::Failed),
                  result.count(Outcome::Skipped));
  if (result.faults() > 0) text += fmt::format("; {} cases could not be played", result.faults());
  if (result.warnings() > 0) text += fmt::format("; {} warnings of shows", result.warnings());
  return text + "\n";
}

}  // namespace stadion::regression
