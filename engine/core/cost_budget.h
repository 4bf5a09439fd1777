#pragma once
/// What a node may cost, and what it gives up when it costs more.
///
/// The author writes a budget and an order of degradation steps: `budget=0.8, onoverrun="lod, half, rest"`.
/// They make a ladder: at level 0 nothing is given up, each level gives up a little more, in the author's
/// order. The decider of levels looks at clocks, so it stands outside of the show. A decision takes effect at
/// the start of a named frame. It travels in that frame's time signature, and is written into the input log,
/// which replays apply.
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

/// One step by which a node gets cheaper.
enum class DegradationStep : std::uint8_t {
  Lod,   ///< less detail: the node and its descendants count as farther away
  Half,  ///< the cycle runs in every second frame, then in every fourth, and makes up for the others
  Rest,  ///< the cycle does not run, and moved objects stand still; messages still arrive
  Hide,  ///< the node and its descendants are not drawn
};
inline constexpr std::array<std::string_view, 4> kDegradationNames{"lod", "half", "rest", "hide"};

/// Returns the number of levels of a step.
constexpr std::uint32_t levelsOf(DegradationStep c) {
  return c == DegradationStep::Lod ? 3 : c == DegradationStep::Half ? 2 : 1;
}
inline std::uint32_t levelsOf(std::span<const DegradationStep> ladder) {
  std::uint32_t count = 0;
  for (const DegradationStep c : ladder) count += levelsOf(c);
  return count;
}

/// How far a node is degraded.
struct NodeDegradation {
  double lod = 1;         ///< factor of the node's distance in the choice of detail
  std::uint8_t pace = 0;  ///< the node's cycle runs in one of 2^pace frames
  bool rests = false;     ///< the node's cycle does not run at all
  bool hidden = false;

  bool operator==(const NodeDegradation&) const = default;
  template <class Self, class Fields>
  static void fields(Self& r, Fields& f) {
    f("lod", r.lod), f("pace", r.pace), f("rests", r.rests), f("hidden", r.hidden);
  }
  /// Returns this degradation of a node below one that is degraded by `above`.
  NodeDegradation below(const NodeDegradation& above) const {
    return {lod * above.lod, pace > above.pace ? pace : above.pace, rests || above.rests,
            hidden || above.hidden};
  }
};

constexpr double kLodLevel = 1.5;  ///< factor of NodeDegradation::lod from level to level

/// Returns the degradation at that level of the ladder.
inline NodeDegradation degradationAt(std::span<const DegradationStep> ladder, std::uint32_t level) {
  NodeDegradation r;
  for (const DegradationStep c : ladder) {
    const std::uint32_t taken = level < levelsOf(c) ? level : levelsOf(c);
    level -= taken;
    if (taken == 0) break;
    if (c == DegradationStep::Half) r.pace = static_cast<std::uint8_t>(taken);
    r.rests |= c == DegradationStep::Rest;
    r.hidden |= c == DegradationStep::Hide;
    for (std::uint32_t i = 0; c == DegradationStep::Lod && i < taken; ++i) r.lod *= kLodLevel;
  }
  return r;
}

/// A script's statements about a node's cost.
struct NodeTerms {
  double budget = 0;  ///< [ms] a frame, of App, Cull and Draw of it and all below it; 0 = none
  std::vector<DegradationStep> gives;  ///< in this order
  double priority = 1;                 ///< when the whole frame takes too long, the lowest gives up first
};

/// Returns the factor on all distances, in the choice of detail, at that level of stress.
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
class DegradationDecider {
public:
  virtual ~DegradationDecider() = default;
  /// Returns the degradation that takes effect with this frame.
  virtual FrameDecisions decide(std::uint64_t frame) = 0;
};

}  // namespace stadion
