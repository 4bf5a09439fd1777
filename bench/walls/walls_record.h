#pragma once
/// The file of `stadion bench walls --record`: a head that describes the run, then a row a line.
///
/// Ratios hold within one run on one machine, in one hour. So a run continues the rows of another only if
/// both have the same build, machine and setting, and were begun within half a day.
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
  std::string build;       ///< identifies the build of all measured programs
  std::string machine;     ///< in words; identifies the machine
  std::string drawnBy;     ///< thread or process: draws Stadion's walls
  std::int64_t begun = 0;  ///< seconds since 1970, UTC
};

/// The first line, without its end.
std::string lineOf(const RecordHead& head);

struct WallsRecord {
  RecordHead head;
  std::vector<nlohmann::json> rows;
};
/// Reads the file of an earlier run that this one, `now`, continues: its head, and its rows up to an
/// incomplete line. A missing file gives this run's head and no rows.
Result<WallsRecord> readRecord(const std::string& file, const RecordHead& now);

}  // namespace stadion::bench
