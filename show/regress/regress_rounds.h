#pragma once
/// What a case costs: by the clock, in rounds, and in instructions, by the processor's counter or
/// under callgrind.
///
/// Errors   a sentence in `fault`; then the rest is void.

#include "profiling/regression/statistics/time_comparison.h"
#include "show/regress/regress_settings.h"

namespace stadion {

/// A program to be measured, and what is planted in it (for experiments; empty: nothing).
struct MeasuredProgram {
  std::string path;
  std::string planted{};
};

struct MeasuredRounds {
  std::vector<regression::Round> rounds;  ///< all that were asked for; `before` is empty of one program
  std::vector<double> calibrationMs;      ///< calibration times of each round
  std::string fault{};
};

/// How measurements are made.
struct MeasuringOptions {
  std::size_t rounds = 12;
  std::chrono::seconds limit{600};
  const std::atomic<bool>& stop;
};

/// Two programs, in rounds. In sequential mode they take turns frame by frame; else one run follows the
/// other. Which one begins changes from round to round.
MeasuredRounds measureRounds(const regression::SuiteCase& c, const std::string& mode,
                             const MeasuredProgram& before, const MeasuredProgram& now,
                             const MeasuringOptions& options);
/// Measures one program, with the calibration kernel before and after each run.
MeasuredRounds measureRounds(const regression::SuiteCase& c, const std::string& mode,
                             const MeasuredProgram& now, const MeasuringOptions& options);

struct CountedInstructions {
  std::vector<regression::SpanRow> rows;  ///< `instructions` a frame
  std::string fault{};
  bool refused = false;  ///< the fault is the user's: valgrind is missing
};

/// The counter of instructions. Hardware: the processor counts all of the playing thread, at hardly any cost.
/// Callgrind counts those of our own program, slowly. Their counts cannot be compared with each other.
enum class CountedBy { Hardware, Callgrind };
std::string_view nameOf(CountedBy by);

/// Counts the instructions of at most kCountedFrames frames of the case, drawn or not.
CountedInstructions countInstructions(const regression::SuiteCase& c, const MeasuredProgram& program,
                                      bool drawn, const MeasuringOptions& options,
                                      CountedBy by = CountedBy::Callgrind);
constexpr std::uint64_t kCountedFrames = 12;

}  // namespace stadion
