#pragma once
/// What the frames of a run tell beside the typical one: mean, percentiles, the longest frame, late frames.
///
/// Units    microseconds; late frames are a number of frames.
/// Threads  free functions, any thread.

#include "profiling/regression/spans/span_record.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stadion::regression {

/// Processor time of the thread, or duration by the clock on the wall.
enum class TimeKind { Processor, Elapsed };
std::string_view nameOf(TimeKind kind);

constexpr std::size_t kFirstFrames = 5;  ///< left out of figures: they build what the others use

constexpr std::string_view kLateFrames = "late frames";

/// By name: "mean", "p95", "p99", "longest", and "late frames" if there is a budget.
using RunFigures = std::map<std::string, double>;
/// `us`: by frame number; what is not a number is left out. `budgetUs` 0: nothing is late.
RunFigures figuresOf(const std::vector<double>& us, double budgetUs);

/// The times of a stage in several runs.
struct StageSeries {
  std::string stage;  ///< its key
  std::string name;   ///< for people
  TimeKind kind = TimeKind::Processor;
  std::vector<std::vector<double>> runs;  ///< [run][frame]; NaN where a run did not tell
  std::vector<RunFigures> figures;        ///< of each run
  double leastDeviation = 0;              ///< at least so far are runs from the usual frame [us]
};

/// By frame number, up to the last one.
std::vector<double> byFrame(const std::map<std::uint64_t, double>& us);

/// The budget of a frame, for the whole frame alone: other stages have none.
double budgetOf(const SpanRow& row, double frameBudgetUs);

}  // namespace stadion::regression
