#pragma once
/// What `check` finds in one script: its language, its names, its assets, and how its bodies start.

#include "engine/diagnostic.h"

#include <string>
#include <vector>

namespace stadion {

/// Findings in the order of the lines. Sub-scenes are checked with it. A missing asset is an error here.
Diagnostics checkShow(const std::string& file, const std::vector<std::string>& assetRoots);

}  // namespace stadion
