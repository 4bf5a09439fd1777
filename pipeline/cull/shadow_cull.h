#pragma once
/// Which things cast shadows, for each ring of a wall's shadow maps.
///
/// The rings are the same for all walls and both eyes (pipeline/state/shadow_places.h says where they are),
/// and lie on a grid of their texels that is fixed in the world, so that shadows look the same everywhere.
/// What has ever moved is kept apart from what has not, which need not be drawn again while nothing changes.
///
/// Threads  pure but for the list; any thread that holds a lease on the view's slot.

#include "pipeline/draw/draw_list.h"
#include "pipeline/state/scene_state.h"

namespace stadion {

class ShadowCull {
public:
  /// Sets up the rings for the first light of the list that casts shadows, if there is one. Expects the
  /// list's origin and lights to be set.
  ShadowCull(const SlotView& state, DrawList& out);

  bool any() const { return shadows_.light >= 0; }
  void consider(const InstanceRecord& r) {
    if (any()) cast(r);
  }

private:
  void placeRing(std::size_t ring, const Vec3& centre);
  bool coveredBy(std::size_t ring, const Vec3& p_L, double radius) const;
  void cast(const InstanceRecord& r);

  DrawShadows& shadows_;
  Vec3 origin_;
  Mat3 axes_ = Mat3::Identity();                        ///< rows: right, up, towards the light, in World
  std::array<Vec3, kShadowRings> centre_W_, centre_L_;  ///< of the rings; in World, and along the axes
};

}  // namespace stadion
