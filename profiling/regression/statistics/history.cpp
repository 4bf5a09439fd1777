#include "profiling/regression/statistics/history.h"

#include "profiling/regression/statistics/rank_test.h"

#include <nlohmann/json.hpp>

#include <cstdlib>

namespace stadion::regression {
namespace {

using Json = nlohmann::ordered_json;

/// Adds only counts: hashes are no figures.
void addCounts(const CaseResult& c, HistoryEntry::Case& kept) {
  for (const auto& [name, value] : c.facts) {
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    const bool isHash = name.find("hash") != name.npos || name.starts_with("image ");
    if (!isHash && end != value.c_str() && !*end) kept.figures[name] = number;
  }
}

HistoryEntry entryOf(const Json& j) {
  HistoryEntry entry{j.at("when"), j.at("program"), {}};
  for (const auto& [name, c] : j.at("cases").items()) {
    HistoryEntry::Case& kept = entry.cases[name];
    kept.failed = c.at("failed").get<bool>();
    if (c.contains("failed_figures")) c.at("failed_figures").get_to(kept.failedFigures);
    for (const auto& [figure, value] : c.at("figures").items())
      if (value.is_number()) kept.figures[figure] = value.get<double>();
  }
  return entry;
}

}  // namespace

HistoryEntry historyEntryOf(const SuiteResult& result) {
  HistoryEntry entry{result.when, result.program, {}};
  for (const CaseResult& c : result.cases) {
    HistoryEntry::Case& kept = entry.cases[c.name];
    kept.failed = c.failed() || !c.fault.empty();
    for (const Check& k : c.checks) kept.failedFigures.insert(k.figures.begin(), k.figures.end());
    for (const auto& [stage, rounds] : c.milliseconds) kept.figures[stage + " [ms]"] = median(rounds);
    for (const auto& [stage, count] : c.instructions) kept.figures[stage + " [instructions]"] = count;
    addCounts(c, kept);
  }
  return entry;
}

std::string toJsonLine(const HistoryEntry& entry) {
  Json j{{"when", entry.when}, {"program", entry.program}, {"cases", Json::object()}};
  for (const auto& [name, c] : entry.cases)
    j["cases"][name] =
        Json{{"failed", c.failed}, {"failed_figures", c.failedFigures}, {"figures", c.figures}};
  return j.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<HistoryEntry> readHistory(const std::string& text) {
  std::vector<HistoryEntry> all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    try {
      all.push_back(entryOf(Json::parse(text.substr(at, end - at))));
    } catch (const Json::exception&) {
      // An incomplete line, from a run that was killed.
    }
    at = end + 1;
  }
  return all;
}

}  // namespace stadion::regression
