#pragma once
/// How a live run keeps its budgets: what the options and the show say of it.

#include "profiling/budget/load_governor.h"
#include "show/settings/run_options.h"

namespace stadion {

/// Whether what is drawn has a budget: then samples of drawing are taken.
bool hasDrawnBudgets(const Scene& scene);

/// Of a live run overruns are told and acted upon; of another they are counted. `walls` are the names of all
/// that are drawn.
GovernorOptions governorOf(const RunOptions& options, const Player& player, std::vector<std::string> walls);

}  // namespace stadion
