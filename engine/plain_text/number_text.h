#pragma once
/// Numbers that a user has written.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace stadion {

/// "800x600": two whole numbers and nothing else; nothing if it is not that.
std::optional<std::pair<std::uint32_t, std::uint32_t>> parseSize(const std::string& text);

}  // namespace stadion
