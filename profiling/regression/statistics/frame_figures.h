#pragma once
/// Figures of a run's frames besides the typical one: mean, percentiles, the longest frame, late frames.
///
/// Units    microseconds; late frames are a number of frames.
/// Threads  free functions, any thread.

#include "profiling/regression/spans/span_record.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stadion::regression {

/// Processor time of the thread, or real time.
enum class TimeKind { Processor, Elapsed };
std::string_view nameOf(TimeKind kind);

constexpr std::size_t kFirstFrames = 5;  ///< left out of figures: they build data for the others

constexpr std::string_view kLateFrames = "late frames";

/// By name: "mean", "p95", "p99", "longest", and "late frames" if there is a budget.
using RunFigures = std::map<std::string, double>;
/// `us`: by frame number; NaN is left out. `budgetUs` 0: no frame is late.
RunFigures figuresOf(const std::vector<double>& us, double budgetUs);

/// The times of a stage in several runs.
struct StageSeries {
  std::string stage;  ///< key of the stage
  std::string name;   ///< for people
  TimeKind kind = TimeKind::Processor;
  std::vector<std::vector<double>> runs;  ///< [run][frame]; NaN if a run has no value
  std::vector<RunFigures> figures;        ///< figures of each run
  double leastDeviation = 0;              ///< least deviation of runs from the usual frame [us]
};

/// By frame number, up to the last one.
std::vector<double> byFrame(const std::map<std::uint64_t, double>& us);

/// Returns the budget of a frame for the stage "frame"; other stages have none.
double budgetOf(const SpanRow& row, double frameBudgetUs);

}  // namespace stadion::regression
