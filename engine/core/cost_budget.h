#pragma once
/// What a node may cost, and what it gives up when it costs more.
///
/// The author writes a budget and an order of concessions: `budget=0.8, onoverrun="lod, half, rest"`. They
/// make a ladder: at level 0 nothing is given up, each level gives up a little more, in the author's order.
/// The decider of levels looks at clocks, so it stands outside of the show. A decision takes effect at the
/// start of a named frame. It travels in that frame's time signature, and is written into the input log, which
/// replays apply.
///
/// Threads  plain values.

#include "engine/base/time_signature.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace stadion {

/// What can be given up.
enum class Concession : std::uint8_t {
  Lod,   ///< detail: distances count more for it and what is below it
  Half,  ///< its cycle runs in every second frame, then in every fourth, and makes up for the others
  Rest,  ///< its cycle does not run; what it moves stands still. Messages still reach it
  Hide,  ///< it and what is below it is not drawn
};
inline constexpr std::array<std::string_view, 4> kConcessionNames{"lod", "half", "rest", "hide"};

/// Levels that each of them makes.
constexpr std::uint32_t levelsOf(Concession c) {
  return c == Concession::Lod ? 3 : c == Concession::Half ? 2 : 1;
}
inline std::uint32_t levelsOf(std::span<const Concession> ladder) {
  std::uint32_t count = 0;
  for (const Concession c : ladder) count += levelsOf(c);
  return count;
}

/// What a node has to do without.
struct Relief {
  double lod = 1;         ///< so many times farther away it counts
  std::uint8_t pace = 0;  ///< its cycle runs in one of 2^pace frames
  bool rests = false;     ///< its cycle does not run at all
  bool hidden = false;

  bool operator==(const Relief&) const = default;
  template <class Self, class Fields>
  static void fields(Self& r, Fields& f) {
    f("lod", r.lod), f("pace", r.pace), f("rests", r.rests), f("hidden", r.hidden);
  }
  /// Below something that has to do without `above` already.
  Relief below(const Relief& above) const {
    return {lod * above.lod, pace > above.pace ? pace : above.pace, rests || above.rests,
            hidden || above.hidden};
  }
};

constexpr double kLodLevel = 1.5;  ///< of Relief::lod from level to level

/// What is given up at that level of the ladder.
inline Relief reliefAt(std::span<const Concession> ladder, std::uint32_t level) {
  Relief r;
  for (const Concession c : ladder) {
    const std::uint32_t taken = level < levelsOf(c) ? level : levelsOf(c);
    level -= taken;
    if (taken == 0) break;
    if (c == Concession::Half) r.pace = static_cast<std::uint8_t>(taken);
    r.rests |= c == Concession::Rest, r.hidden |= c == Concession::Hide;
    for (std::uint32_t i = 0; c == Concession::Lod && i < taken; ++i) r.lod *= kLodLevel;
  }
  return r;
}

/// What a script says of a node's cost.
struct NodeTerms {
  double budget = 0;              ///< [ms] a frame, of App, Cull and Draw of it and all below it; 0 = none
  std::vector<Concession> gives;  ///< in this order
  double priority = 1;            ///< when the whole frame takes too long, the lowest gives up first
};

/// How far away things count when the show is under stress: so many times.
inline double stressOf(std::uint32_t level) {
  double stress = 1;
  for (; level >= kStressLevelsAnOctave; level -= kStressLevelsAnOctave) stress *= 2;
  constexpr double kSteps[] = {1, 1.189207115002721, 1.4142135623730951, 1.681792830507429};
  static_assert(std::size(kSteps) == kStressLevelsAnOctave);
  return stress * kSteps[level];
}

/// Decides, in a live run, which nodes give up what.
///
/// Threads  called by App.
class LoadDecider {
public:
  virtual ~LoadDecider() = default;
  /// What takes effect with this frame.
  virtual FrameLoad decide(std::uint64_t frame) = 0;
};

}  // namespace stadion
