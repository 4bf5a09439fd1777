#pragma once
/// Imports a model file, or every one of a folder, and reports the results, for `stadion check --assets`.

#include "engine/asset/import.h"

#include <filesystem>
#include <functional>

namespace stadion {

enum class AssetVerdict {
  Loaded,
  Refused,  ///< a 3D format that shows do not read
  Failed,   ///< a readable format, but this file is broken or beyond the limits
};

struct AssetFinding {
  AssetVerdict verdict = AssetVerdict::Failed;
  std::string file;            ///< below the folder, or its name alone
  std::string message;         ///< the error; empty when loaded
  ModelInventory inventory;    ///< when loaded: what becomes of the content
  Diagnostics losses;          ///< what is approximated or left out, as warnings
  const Mesh* mesh = nullptr;  ///< when loaded; valid during the call
};

struct AssetCounts {
  std::size_t loaded = 0, refused = 0, failed = 0;
  std::size_t faults = 0;  ///< failed files for which the importer program crashed, hung or ran out of memory
};

/// Imports the files of a folder in the order of names, without following symbolic links. Skips files that are no
/// models. `place` may be a single file as well. Returns an error only if `place` cannot be opened.
Result<AssetCounts> checkAssets(const std::filesystem::path& importerProgram,
                                const std::filesystem::path& place,
                                const std::function<void(const AssetFinding&)>& tell,
                                const ImportLimits& limits = {});

}  // namespace stadion
