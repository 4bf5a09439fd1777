#include "bench/comparison/comparison_report.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stadion::bench {
namespace {

const char* wordFor(Finding::Kind kind) {
  switch (kind) {
  case Finding::Kind::Met: return "met";
  case Finding::Kind::Missed: return "MISSED";
  case Finding::Kind::Void: return "void";
  }
  return "";
}

/// The errors that have limits, and err.
std::vector<std::string> columnsOf(const CaseComparison& result) {
  std::vector<std::string> columns{"err"};
  if (const CaseLimits* limits = limitsFor(result.name))
    for (const MetricLimit& l : limits->errors)
      if (std::find(columns.begin(), columns.end(), l.metric) == columns.end()) columns.push_back(l.metric);
  return columns;
}

std::string cell(const Measurement& m, const std::string& metric) {
  const double value = m.metric(metric);
  return std::isnan(value) ? "-" : fmt::format("{:.2g}", value);
}

int widthOf(const std::string& column) {
  return std::max(9, static_cast<int>(column.size()));
}

std::string rowOf(const Measurement& m, const CaseComparison& result,
                  const std::vector<std::string>& columns) {
  std::string row = fmt::format("  {:<20}{:>3}", m.engine, m.n);
  if (m.unsupported) return row + "  has no such thing\n";
  if (m.crash) return row + (m.crash == SIGALRM ? "  out of time\n" : "  crashed\n");
  if (m.refused()) return row + "  refused the mesh\n";
  row += fmt::format("{:>12.1f}", m.ns);
  for (const std::string& c : columns) row += fmt::format("  {:>{}}", cell(m, c), widthOf(c));
  if (result.verdict.peer)
    row += fmt::format("  {:>8.3g}{}", m.ns / result.verdict.peer->ns, &m == result.verdict.peer ? " *" : "");
  return row + "\n";
}

}  // namespace

std::string tableOf(const CaseComparison& result) {
  const std::vector<std::string> columns = columnsOf(result);
  std::string text = fmt::format("{}\n  {:<20}{:>3}{:>12}", result.name, "engine", "n", "ns/frame");
  for (const std::string& c : columns) text += fmt::format("  {:>{}}", c, widthOf(c));
  if (result.verdict.peer) text += fmt::format("  {:>8}", "ratio");
  text += "\n";
  for (const Measurement& m : result.measurements) text += rowOf(m, result, columns);
  for (const Finding& f : result.verdict.findings)
    text += fmt::format("  {:<8}{}\n", wordFor(f.kind), f.what);
  return text;
}

std::string summaryOf(const std::vector<CaseComparison>& results) {
  std::size_t met = 0, missed = 0, voids = 0;
  std::string which;
  for (const CaseComparison& r : results) {
    met += r.verdict.count(Finding::Kind::Met);
    missed += r.verdict.count(Finding::Kind::Missed);
    voids += r.verdict.count(Finding::Kind::Void);
    for (const Finding& f : r.verdict.findings)
      if (f.kind == Finding::Kind::Missed) which += fmt::format("  {:<26}{}\n", r.name, f.what);
  }
  return fmt::format("{} limits met, {} missed, {} void\n{}", met, missed, voids, which);
}

std::string resultsJson(const std::vector<CaseComparison>& results) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const CaseComparison& r : results) {
    nlohmann::ordered_json measurements = nlohmann::ordered_json::array();
    for (const Measurement& m : r.measurements)
      measurements.push_back(nlohmann::ordered_json::parse(toJson(m)));
    nlohmann::ordered_json findings = nlohmann::ordered_json::array();
    for (const Finding& f : r.verdict.findings)
      findings.push_back({{"verdict", wordFor(f.kind)}, {"what", f.what}});
    cases.push_back({{"case", r.name}, {"measurements", measurements}, {"limits", findings}});
  }
  return cases.dump(1) + "\n";
}

bool allMet(const std::vector<CaseComparison>& results) {
  return std::all_of(results.begin(), results.end(),
                     [](const CaseComparison& r) { return r.verdict.count(Finding::Kind::Missed) == 0; });
}

}  // namespace stadion::bench
