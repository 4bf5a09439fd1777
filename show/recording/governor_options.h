#pragma once
/// How a live run keeps its budgets, from the settings and the show.

#include "profiling/budget/degradation_governor.h"
#include "show/player/play_settings.h"

namespace stadion {

/// Returns true if what is drawn has a budget: then samples of drawing are taken.
bool hasDrawnBudgets(const Scene& scene);

/// In a live run overruns go to `say` and are acted upon; in another run they are counted. `walls` are the
/// names of all walls that are drawn.
GovernorOptions governorOf(const PlaySettings& play, const Player& player, std::vector<std::string> walls,
                           std::function<void(const std::string&)> say);

}  // namespace stadion
