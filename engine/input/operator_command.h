#pragma once
/// The operator's commands to a running show.
///
/// Keys of a terminal or a window and messages of a network all become commands.
///
/// Threads  plain values.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace stadion {

enum class OperatorAction : std::uint8_t {
  Start,          ///< ends waiting: show time begins
  Pause,          ///< on: show time stands still; the visitor can still look around
  Step,           ///< plays one frame of show time during a pause
  Black,          ///< on: all walls are black; the show goes on unless it is paused too
  TestPattern,    ///< on: all walls show the test pattern; the show goes on
  Cue,            ///< calls the cue with this number, from 1 to 32
  NextGroup,      ///< the show restarts, as if the program had been restarted
  SwapEyes,       ///< on: left and right are exchanged on every wall
  EyeSeparation,  ///< between the eyes [m]
  FreezeHead,     ///< on: the head stays where it is, and its tracker is ignored
  Volume,         ///< volume of all sounds, from 0 to 1
  Latency,        ///< limit of frames in flight between pose and picture: 1 to 4
  End,            ///< the run ends after this frame
};

/// As addresses (/stadion/next-group) and in texts.
inline constexpr std::array<std::string_view, 13> kOperatorActionNames = {
    "start",     "pause",          "step",        "black",  "test-pattern", "cue", "next-group",
    "swap-eyes", "eye-separation", "freeze-head", "volume", "latency",      "end"};

constexpr std::string_view nameOf(OperatorAction action) {
  return kOperatorActionNames[static_cast<std::size_t>(action)];
}

constexpr std::optional<OperatorAction> operatorActionNamed(std::string_view word) {
  for (std::size_t i = 0; i < kOperatorActionNames.size(); ++i)
    if (kOperatorActionNames[i] == word) return static_cast<OperatorAction>(i);
  return std::nullopt;
}

/// Returns true if it changes pictures and sounds alone, not what happens in the show.
constexpr bool isOfPresentation(OperatorAction action) {
  return action == OperatorAction::Black || action == OperatorAction::TestPattern || action == OperatorAction::SwapEyes ||
         action == OperatorAction::EyeSeparation || action == OperatorAction::Volume;
}

struct OperatorCommand {
  OperatorAction action{};
  /// 1 on, 0 off, nothing: the other of what it is; of eye separation, volume, latency and cue the value itself.
  std::optional<double> value{};
  bool relative = false;  ///< the value is added to what is

  bool operator==(const OperatorCommand&) const = default;
};

}  // namespace stadion
