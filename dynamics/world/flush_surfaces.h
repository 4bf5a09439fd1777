#pragma once
/// Surfaces of several flush pieces: their seams are no obstacle to bodies that touch, strike or roll over
/// them.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/collision/touch_seams.h"
#include "dynamics/contact/patch_impact.h"
#include "dynamics/state/contact_events.h"
#include "dynamics/state/swept_boxes.h"
#include "dynamics/state/world_objects.h"
#include "dynamics/world/impact_search.h"

#include <optional>
#include <vector>

namespace stadion {

class FlushSurfaces {
public:
  FlushSurfaces(const WorldObjects& objects, const SweptBoxes& boxes, ContactMemory& memory,
                const ImpactSearch& search)
      : objects_(objects), boxes_(boxes), memory_(memory), search_(search) {}

  /// The first touch in [from, to] that is more than a seam.
  std::optional<Touch> firstRealTouch(const Side& a, const Side& b, double from, double to);
  /// Still colliders that the body may strike in the same moment as `but`.
  std::vector<PatchSide> struckBeside(const RigidBody& b, const Collider& but, double tau, bool ends) const;
  /// Looks for a collider that goes on where the ball's face ends. True if the ball rolls on there, `lift`
  /// higher.
  bool crossSeam(RigidBody& b, double tau, double& lift);
  /// How long flat faces of one plane and one friction carry a contact point that glides at u under the
  /// acceleration a along them, at most about `most` [s]; negative if nothing carries it now. Appends the
  /// colliders that it comes to.
  double timeCarried(const RigidBody& b, ColliderId start, const Gap& gap, double friction, const Vec3& u,
                     const Vec3& a, double most, std::vector<ContactSide>& way) const;

private:
  template <class F>
  void eachColliderAt(const RigidBody& b, double tau, F f) const;
  std::vector<Bearing> bearingsOf(const RigidBody& b, double tau, const Collider& but) const;
  bool isHiddenTouch(const Side& a, const Side& b, Touch& touch) const;
  bool carriesAlready(const RigidBody& b, ContactSide piece) const;

  const WorldObjects& objects_;
  const SweptBoxes& boxes_;
  ContactMemory& memory_;
  const ImpactSearch& search_;
};

}  // namespace stadion
