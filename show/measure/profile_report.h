#pragma once
/// What `stadion profile --out` tells beyond what was recorded: how the show was played, and how exact its
/// bodies' models are.

#include "profiling/report/report_data.h"
#include "show/measure/fidelity.h"
#include "show/measure/profile_run.h"

#include <optional>

namespace stadion {

/// `gl`: the driver that drew, in its own words; empty if nothing was drawn.
ReportHead reportHead(const ProfileRunOptions& options, const Player& player, const std::string& gl);

/// Cost and error of the bodies that dynamics nodes move; none if there are none. Bodies are played with
/// other models if that was asked for, or takes seconds only; else their errors are missing, and it says why.
/// Errors that were asked for go into fidelity.json too.
std::optional<DynamicsFigures> dynamicsFigures(const ProfileRunOptions& options, const ShowFigures& figures,
                                               OutputFiles& files);

}  // namespace stadion
