#pragma once
/// What a suite found, run after run: one JSON object a line, appended to.
///
/// Threads  plain values, any thread.
/// Errors   lines that are none are passed over: a line may be half written.

#include "profiling/regression/spans/result.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace stadion::regression {

/// One run of the suite.
struct HistoryEntry {
  struct Case {
    bool failed = false;
    std::set<std::string> failedFigures{};  ///< those that were not as they should be
    std::map<std::string, double> figures;  ///< "app [ms]", "triangles front left" ...
  };
  std::string when, program;
  std::map<std::string, Case> cases;
};

HistoryEntry historyEntryOf(const SuiteResult& result);
std::string toJsonLine(const HistoryEntry& entry);
std::vector<HistoryEntry> readHistory(const std::string& text);

}  // namespace stadion::regression
