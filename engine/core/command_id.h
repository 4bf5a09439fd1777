#pragma once
/// What a node can be told to do.
///
/// The commands that several node types share have numbers of their own. They are part of the state hash
/// while a message waits, so they never change. A command that one node type adds is numbered by its name.

#include "engine/core/word.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace stadion {

enum class CommandId : std::uint32_t {
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

inline constexpr std::array<std::string_view, 16> kCommandNames = {
    "enable", "disable", "toggle", "attach",  "detach", "show",   "hide", "reset",
    "hook",   "unhook",  "grab",   "release", "load",   "unload", "say",  "start"};

/// Also in a `case`: `case commandNamed("tug"):`.
constexpr CommandId commandNamed(std::string_view word) {
  for (std::uint32_t i = 0; i < kCommandNames.size(); ++i)
    if (kCommandNames[i] == word) return static_cast<CommandId>(i);
  return static_cast<CommandId>(hashOfWord(word));
}
constexpr CommandId lastOf(CommandId) {
  return static_cast<CommandId>(0xFFFFFF);
}

/// The parts of a tracker's pose that `attach` takes over.
enum class AttachPart : std::uint8_t { All, Position, Orientation };

inline constexpr std::array<std::string_view, 3> kAttachPartNames = {"all", "position", "orientation"};

}  // namespace stadion
