#pragma once
/// The results of a suite, run after run: one JSON object a line, appended.
///
/// Threads  plain values, any thread.
/// Errors   invalid lines are skipped: a line may be incomplete.

#include "profiling/regression/spans/result.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace stadion::regression {

/// A run of the suite.
struct HistoryEntry {
  struct Case {
    bool failed = false;
    std::set<std::string> failedFigures{};  ///< figures that failed
    std::map<std::string, double> figures;  ///< "app [ms]", "triangles front left" ...
  };
  std::string when, program;
  std::map<std::string, Case> cases;
};

HistoryEntry historyEntryOf(const SuiteResult& result);
std::string toJsonLine(const HistoryEntry& entry);
std::vector<HistoryEntry> readHistory(const std::string& text);

}  // namespace stadion::regression
