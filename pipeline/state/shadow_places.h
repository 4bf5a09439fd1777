#pragma once
/// Around which places shadows are kept ready, in rings: the nearer to the visitor, the finer.
///
/// A ring stays where it is until the head has gone a quarter of its reach away from its middle. So what does
/// not move need not be drawn into the shadow maps again while somebody looks around, and no shadow's edge
/// crawls when a head moves. Decided once a frame, where the frame is published: all walls have the same
/// rings, in every mode.
///
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
  const ShadowRecord& follow(const Vec3& p_WH);

private:
  ShadowRecord record_;
  bool any_ = false;
};

}  // namespace stadion
