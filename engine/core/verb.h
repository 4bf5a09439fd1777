#pragma once
/// What a node can be told to do.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace stadion {

enum class Verb : std::uint8_t {
  Enable,
  Disable,
  Toggle,
  Attach,
  Detach,
  Show,
  Hide,
  Reset,
  Hook,
  Unhook,
  Grab,
  Release,
  Load,
  Unload,
  Say,
  Start,
};

inline constexpr std::array<std::string_view, 16> kVerbNames = {
    "enable", "disable", "toggle", "attach",  "detach", "show",   "hide", "reset",
    "hook",   "unhook",  "grab",   "release", "load",   "unload", "say",  "start"};
inline constexpr std::size_t kVerbCount = kVerbNames.size();

constexpr std::string_view nameOf(Verb verb) {
  return kVerbNames[static_cast<std::size_t>(verb)];
}

constexpr std::optional<Verb> verbNamed(std::string_view word) {
  for (std::size_t i = 0; i < kVerbCount; ++i)
    if (kVerbNames[i] == word) return static_cast<Verb>(i);
  return std::nullopt;
}

/// What of a tracker's pose `attach` takes over.
enum class AttachPart : std::uint8_t { All, Position, Orientation };

inline constexpr std::array<std::string_view, 3> kAttachPartNames = {"all", "position", "orientation"};

}  // namespace stadion
