#pragma once
/// What `check` finds in one script: its language, its names, its assets, and how its bodies start.

#include "engine/base/diagnostic.h"
#include "engine/script/script_texts.h"
#include "show/base/standard_nodes.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace stadion {

/// Findings in the order of the lines. Sub-scenes are checked with it. A missing asset is an error here.
/// Once `giveUp` (if it is given) is true, it ends soon, and what it says is worth nothing.
/// `texts`: what is checked; null: the scripts as they are on disk.
Diagnostics checkShow(const std::string& file, const std::vector<std::string>& assetRoots, SharedTypes types,
                      const std::atomic<bool>* giveUp = nullptr,
                      std::shared_ptr<const ScriptTexts> texts = nullptr);

/// Checks language and names alone: no asset is read, so it is quick.
Diagnostics checkScripts(const std::string& file, const std::vector<std::string>& assetRoots,
                         SharedTypes types, std::shared_ptr<const ScriptTexts> texts = nullptr);

}  // namespace stadion
