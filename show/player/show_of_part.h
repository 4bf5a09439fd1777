#pragma once
/// The show that a script is a part of, so that a part can be asked about by itself: its names and its assets
/// are those of the show around it.

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace stadion {

class NodeRegistry;

/// Looks through the scripts in the folder of `file` and in those around it for one that loads it, directly
/// or through others; of several the nearest, and of those the first by name. Nothing if there is none.
/// `assetRoots`: further folders in which a show's scenes may lie.
std::optional<std::string> showAround(const std::string& file, const std::vector<std::string>& assetRoots,
                                      const NodeRegistry& types);

/// `script` and all that it loads, directly or through others, with the assets of `show`; without links or
/// `..`.
std::set<std::filesystem::path> filesOf(const std::filesystem::path& script,
                                        const std::filesystem::path& show,
                                        const std::vector<std::string>& assetRoots,
                                        const NodeRegistry& types);

}  // namespace stadion
