#pragma once
/// One step of all members of piles, while it is put together. Internal to piles.cpp and pile_contacts.cpp.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/body/rigid_body.h"
#include "dynamics/collision/manifold.h"
#include "dynamics/collision/touch_seams.h"
#include "dynamics/contact/pile_solver.h"

namespace stadion {

struct PileStep {
  struct Member {
    RigidBody* body = nullptr;
    Vec3 p = Vec3::Zero();       ///< centre of mass
    Vec3 middle = Vec3::Zero();  ///< centre of the body's bounding ball
    double bound = 0;            ///< radius of that
    double way = 0;              ///< distance that the body may go within the step [m]
    bool round = false;          ///< a ball about its centre of mass
  };
  struct Fixed {
    ContactSide key;
    RigidBody* body = nullptr;
    Vec3 p = Vec3::Zero();
  };
  /// Data of a contact that the solver does not need.
  struct Note {
    std::uint64_t key = 0, reverse = 0;  ///< from the first side's view, from the second's
    ContactSide other;
    std::uint32_t fixed = kNone;  ///< index in `fixed` of the contact's second side, if that is no member
  };
  static constexpr std::uint32_t kNone = 0xffffffff;

  double tau = 0;
  std::vector<Member> members;
  std::vector<Fixed> fixed;
  std::vector<Note> notes;   ///< by contact
  std::vector<Vec3> points;  ///< by contact: its point
  std::vector<ManifoldPoint> found;
  std::vector<RigidBody*> near;
  std::vector<Bearing> bearings;        ///< bearings of a member on colliders
  std::vector<std::uint32_t> features;  ///< by bearing: its feature
  Pile pile;

  bool has(const RigidBody& b) const {
    return b.contact.slot < members.size() && members[b.contact.slot].body == &b;
  }
};

}  // namespace stadion
