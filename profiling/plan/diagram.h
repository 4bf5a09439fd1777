#pragma once
/// Timing diagrams, as IRIS Performer drew them: a row a thread, time to the right, a few frames from the
/// middle of a schedule.
///
/// Threads  plain values.

#include "profiling/plan/schedule.h"

namespace stadion::plan {

/// For a terminal. Work is shown as the frame's last digit, waits as marks; the last line explains them.
std::string diagramText(const Schedule& schedule, std::size_t frames, std::size_t columns = 100);

/// Returns an SVG picture with one colour for each frame, pale waits, and swaps as lines. Each bar has a
/// tooltip.
std::string diagramSvg(const Schedule& schedule, std::size_t frames, const std::string& title);

}  // namespace stadion::plan
