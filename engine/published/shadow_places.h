#pragma once
/// Rings around the visitor's head in which shadows are drawn: the nearer, the finer.
///
/// A ring stays where it is until the head is a quarter of the ring's reach away from its middle. So what
/// does not move need not be drawn into the shadow maps again while the visitor looks around, and no shadow's
/// edge crawls when a head moves. Where a ring is therefore depends on earlier frames. That is why the rings
/// belong to the scene's state: they are decided once a frame, and a snapshot contains them. All walls, modes
/// and machines have the same rings, whatever each has drawn before.
///
/// Frames   World. Units: metres.
/// Threads  App only.

#include "engine/maths/maths.h"

#include <array>
#include <cstddef>

namespace stadion {

constexpr std::size_t kShadowRings = 4;
/// How far from their middle the rings reach, across the light [m].
constexpr std::array<double, kShadowRings> kShadowReach{6, 24, 96, 384};

/// Plain, to be published.
struct ShadowRecord {
  double centre[kShadowRings][3] = {};  ///< World [m]
};

class ShadowPlaces {
public:
  /// Moves the rings that the head has left behind; returns where all of them are.
  const ShadowRecord& follow(const Vec3& p_WH);

  template <class Self, class Fields>
  static void fields(Self& s, Fields& f) {
    f("placed", s.placed_);
    for (auto& centre : s.record_.centre)
      for (auto& x : centre) f("centre", x);
  }

private:
  ShadowRecord record_;
  bool placed_ = false;
};

}  // namespace stadion
