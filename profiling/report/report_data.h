#pragma once
/// All that a report of a show's profile tells, before it is a page.
///
/// Units  milliseconds unless said otherwise. Threads  plain values, once recording is over.

#include "profiling/record/thread_names.h"
#include "profiling/report/frame_series.h"
#include "profiling/report/kept_frames_table.h"
#include "profiling/report/show_figures.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

/// How the show was played, and where.
struct ReportHead {
  std::string show;
  double rate = 60;  ///< [1/s]
  std::uint64_t frames = 0;
  double recording = 0;  ///< a frame, of all threads: what recording took; it is in no figure
  std::vector<std::pair<std::string, std::string>> facts;  ///< what, and how: in this order
};

/// What drawing one eye takes from an idle rasteriser to an idle rasteriser.
struct EyeFigures {
  std::size_t wall = 0, eye = 0;
  double ms = 0, p95 = 0;
  std::uint64_t count = 0;
};

/// A body that a dynamics node moves: cost beside error.
struct BodyFigures {
  std::string name, file;
  std::uint32_t line = 0;
  std::string shape;
  double share = 0;                ///< of its dynamics node's time, a frame
  std::optional<double> cost;      ///< measured: with the body less without it; none below the noise
  std::optional<double> error;     ///< greatest, against the finest model [m]
  std::optional<double> endError;  ///< in the last frame [m]
  std::optional<double> beyond;    ///< when the error first exceeds the tolerance [s]
  std::string advice, caution;     ///< empty: none
  std::optional<double> adviceCost, adviceError;
};

struct DynamicsFigures {
  double tolerance = 1e-3;  ///< [m]
  std::vector<BodyFigures> bodies;
  std::string note;  ///< why errors are missing, if they are
};

struct ReportData {
  ReportHead head;
  const ShowFigures& figures;
  const NodeNames& names;
  const FrameSeries& series;
  const KeptFrames& kept;
  std::vector<ThreadNames::Thread> threads;
  std::vector<EyeFigures> eyes;
  std::optional<DynamicsFigures> dynamics{};  ///< none: no dynamics node moves anything
};

/// One JSON object: what the page's scripts draw from.
std::string reportJson(const ReportData& data);
/// The page: nothing beside it is needed, no network. What comes from scripts is told as text, whatever it
/// holds.
std::string reportPage(const ReportData& data);

}  // namespace stadion
