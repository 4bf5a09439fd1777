#pragma once
/// The file of `stadion bench walls --record`: a head that says what its rows are of, then a row a line.
///
/// Ratios hold within one run on one machine, in one hour. So a run goes on with the rows of another only
/// where both are of the same build, machine and setting, and were begun within half a day.
///
/// Errors   name the file and the line, and what to do.
/// Threads  plain functions.

#include "engine/base/diagnostic.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace stadion::bench {

struct RecordHead {
  std::string build;       ///< of all programs that are measured; another one differs
  std::string machine;     ///< in words; another one differs
  std::string workers;     ///< thread or process: who draws Stadion's walls
  std::int64_t begun = 0;  ///< seconds since 1970, UTC
};

/// The first line, without its end.
std::string lineOf(const RecordHead& head);

struct WallsRecord {
  RecordHead head;
  std::vector<nlohmann::json> rows;
};
/// What an earlier run wrote that this one, `now`, goes on with: its head, and its rows up to a line that was
/// cut off. A file that is not there has this run's head and no rows.
Result<WallsRecord> readRecord(const std::string& file, const RecordHead& now);

}  // namespace stadion::bench
