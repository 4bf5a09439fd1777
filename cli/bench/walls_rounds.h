#pragma once
/// The rounds of `stadion bench walls`: every case in a process of its own, one after the other, again and
/// again.
///
/// Threads  one thread; the machine should have nothing else to do.

#include "bench/walls/walls_case.h"
#include "bench/walls/walls_program.h"
#include "bench/walls/walls_record.h"
#include "bench/walls/walls_results.h"

#include <functional>
#include <string>
#include <vector>

namespace stadion {

struct WallsRounds {
  std::size_t rounds = 5;
  double minutes = 14;  ///< no further round is begun that would not end by then; the first one always is
  std::string record;   ///< rows are kept in this file, and those that it has are not measured again
  bench::RecordHead head{};  ///< what this run is of; it says how compared walls are drawn, too
  bool pictures = true;
  std::vector<std::string> scenes{};
  std::function<void(const nlohmann::json&)> row{};  ///< each one, as it comes
};

struct WallsOutcome {
  bench::WallsResults results;
  std::size_t rounds = 0;             ///< that were played, or were in the record
  std::vector<std::string> failures;  ///< what could not be measured, and why
};

/// The error is the record's.
Result<WallsOutcome> playRounds(const std::vector<bench::WallsCase>& cases,
                                const bench::WallsPrograms& programs, const WallsRounds& how);

}  // namespace stadion
