#pragma once
/// What nodes tell each other has happened.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace stadion {

enum class Event : std::uint8_t {
  Enter,
  Exit,
  Button1,
  Button2,
  Button3,
  Button4,
  TimesUp,
  Loaded,
  Unloaded,
  Finished,
  OnImpact,
  OnRelease,
  OnQuarantine,
  Measured,
  Foul,
  Won,
  Lost,
  Drawn,
  Button1Up,
  Button2Up,
  Button3Up,
  Button4Up,
};

inline constexpr std::array<std::string_view, 22> kEventNames = {
    "enter",    "exit",     "button1",   "button2",   "button3",      "button4",  "timesup", "loaded",
    "unloaded", "finished", "onimpact",  "onrelease", "onquarantine", "measured", "foul",    "won",
    "lost",     "drawn",    "button1up", "button2up", "button3up",    "button4up"};
inline constexpr std::size_t kEventCount = kEventNames.size();

constexpr std::string_view nameOf(Event event) {
  return kEventNames[static_cast<std::size_t>(event)];
}

constexpr std::optional<Event> eventNamed(std::string_view word) {
  for (std::size_t i = 0; i < kEventCount; ++i)
    if (kEventNames[i] == word) return static_cast<Event>(i);
  return std::nullopt;
}

}  // namespace stadion
