#pragma once
/// The files of a model: regular files below the asset root, read whole into memory.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stadion::importer {

/// Reads a file below the open folder `root`. Names may use either slash. Nothing when there is no such file,
/// when it lies outside or is longer than `mostBytes`; `why` then says which.
std::optional<std::vector<std::uint8_t>> readBeneath(int root, std::string path, std::uint64_t mostBytes,
                                                     std::string* why = nullptr);

/// The path without what exporters add: Windows slashes, "./" and "file://" in front.
std::string plainPath(std::string path);

}  // namespace stadion::importer
