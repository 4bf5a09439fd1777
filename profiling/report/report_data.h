#pragma once
/// All data of a report on a show's profile, before it becomes a page.
///
/// Units    milliseconds unless stated otherwise.
/// Threads  plain values, once recording is over.

#include "profiling/record/thread_names.h"
#include "profiling/report/frame_series.h"
#include "profiling/report/kept_frames_table.h"
#include "profiling/report/show_figures.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

/// The settings and the machine of the run.
struct ReportHead {
  std::string show;
  double rate = 60;  ///< [1/s]
  std::uint64_t frames = 0;
  double recording = 0;  ///< cost of recording a frame, over all threads; in no other figure
  std::vector<std::pair<std::string, std::string>> facts;  ///< name and value, in this order
};

/// The cost of drawing one eye, with an idle rasteriser before and after.
struct EyeFigures {
  std::size_t wall = 0, eye = 0;
  double ms = 0, p95 = 0;
  std::uint64_t count = 0;
};

/// A body that a dynamics node moves: cost and error.
struct BodyFigures {
  std::string name, file;
  std::uint32_t line = 0;
  std::string shape;
  double share = 0;                ///< share of its dynamics node's time, a frame
  std::optional<double> cost;      ///< measured: time saved without it; empty if below the noise
  std::optional<double> error;     ///< greatest, against the most accurate model [m]
  std::optional<double> endError;  ///< in the last frame [m]
  std::optional<double> beyond;    ///< first time at which the error exceeds the tolerance [s]
  std::string advice, caution;     ///< empty: none
  std::optional<double> adviceCost, adviceError;
};

struct DynamicsFigures {
  double tolerance = 1e-3;  ///< [m]
  std::vector<BodyFigures> bodies;
  std::string note;  ///< the reason for missing errors
};

struct ReportData {
  ReportHead head;
  const ShowFigures& figures;
  const NodeNames& names;
  const FrameSeries& series;
  const KeptFrames& kept;
  std::vector<ThreadNames::Thread> threads;
  std::vector<EyeFigures> eyes;
  std::optional<DynamicsFigures> dynamics{};  ///< empty: no dynamics node moves a body
};

/// Returns one JSON object, which the page's scripts draw.
std::string reportJson(const ReportData& data);
/// Returns the page. It needs no other files and no network. Text from scripts is shown as text, with any
/// content.
std::string reportPage(const ReportData& data);

}  // namespace stadion
