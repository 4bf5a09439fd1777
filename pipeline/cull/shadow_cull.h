#pragma once
/// Which things cast shadows, for each ring of a wall's shadow maps.
///
/// The rings are the same for all walls and both eyes (engine/published/shadow_places.h says where they are),
/// and lie on a grid of their texels that is fixed in the world, so that shadows look the same everywhere.
/// Casters that have ever moved are kept apart from still ones. Still casters are neither searched for
/// (still_casters.h) nor drawn again while nothing changes.
///
/// Threads  pure but for the list; any thread that holds a lease on the view's slot.

#include "pipeline/cull/still_casters.h"

namespace stadion {

class ShadowCull {
public:
  /// Sets up the rings for the first light of the list that casts shadows, if there is one, with what stands
  /// still. Expects the list's origin and lights to be set.
  ShadowCull(const SlotView& state, StillCasters& still, DrawList& out);

  bool any() const { return shadows_.light >= 0; }
  /// Adds what has ever moved; of others nothing is to be done.
  void consider(const InstanceRecord& r) {
    if (any() && (r.flags & kMoves) != 0) cast(r);
  }

private:
  void placeRing(std::size_t ring, const Vec3& centre);
  bool coveredBy(std::size_t ring, const Vec3& p_L, double radius) const;
  void cast(const InstanceRecord& r);

  DrawShadows& shadows_;
  std::span<const FigureRecord> figures_;
  Vec3 origin_;
  Mat3 axes_ = Mat3::Identity();  ///< rows: right, up, towards the light, in World
  std::array<RingPlace, kShadowRings> places_;
};

}  // namespace stadion
