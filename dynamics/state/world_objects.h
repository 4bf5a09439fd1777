#pragma once
/// The shapes, bodies and colliders of a world, by id, and the pairs that must not collide.
///
/// Ids        count up from 1 in the order of creation and are not used again.
/// Ownership  owns bodies and colliders; their addresses stay until they are removed. Shapes are shared.

#include "dynamics/body/id_table.h"
#include "dynamics/body/rigid_body.h"
#include "dynamics/collision/touch.h"

#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace stadion {

class WorldObjects {
public:
  /// 0 if the bounds of the shape are not finite.
  ShapeId addShape(std::shared_ptr<const Shape> shape);
  /// False if there is no such shape or something has it.
  bool removeShape(ShapeId id);
  const Shape* shape(ShapeId id) const;

  /// A new body or collider with its id, shape and bound. Expects that the shape exists.
  RigidBody& addBody(ShapeId shape);
  Collider& addCollider(ShapeId shape);
  void remove(const RigidBody& b);
  void remove(const Collider& c);

  RigidBody* body(BodyId id) const { return bodies_.find(id); }
  Collider* collider(ColliderId id) const { return colliders_.find(id); }
  IdTable<RigidBody>& bodies() { return bodies_; }
  IdTable<Collider>& colliders() { return colliders_; }
  const IdTable<RigidBody>& bodies() const { return bodies_; }
  const IdTable<Collider>& colliders() const { return colliders_; }

  /// Nothing of a body or collider that is off or does not exist.
  std::optional<Side> side(ContactSide p) const {
    if (p.isBody) {
      const RigidBody* b = body(p.id);
      return b && b->enabled ? std::optional(Side::of(*b)) : std::nullopt;
    }
    const Collider* c = collider(p.id);
    return c && c->enabled ? std::optional(Side::of(*c)) : std::nullopt;
  }
  const Surface& surfaceOf(ContactSide p) const {
    return p.isBody ? body(p.id)->surface : collider(p.id)->surface;
  }
  /// Version of the motion; 0 of what does not exist.
  std::uint32_t versionOf(ContactSide p) const;
  const std::uint32_t* versionPointer(ContactSide p) const;

  void ignore(ContactSide a, ContactSide b, bool on);
  void setBodiesCollide(bool on) { bodiesCollide_ = on; }
  bool bodiesCollide() const { return bodiesCollide_; }
  /// Returns true if the two sides collide with each other.
  bool mayTouch(const Side& a, const Side& b) const;

  /// A restored state lacks shapes and flights until they are given back.
  bool restoreShape(ShapeId id, std::shared_ptr<const Shape> shape);
  bool restoreFlight(BodyId id, std::shared_ptr<const BodyFlight> flight);
  bool complete() const;

  template <class Fields>
  void state(Fields& f) {
    shapes_.state("shapes", f, [&](ShapeId, ShapeEntry& s) { f("bound", s.bound), f("uses", s.uses); });
    bodies_.state("bodies", f, [&](BodyId id, RigidBody& b) {
      bool flies = b.flight != nullptr;
      f.about(id);
      f("body", b), f("flies", flies);
      b.id = id;
      if (f.restores() && flies) flightless_.push_back(id);
    });
    f.about(0);
    colliders_.state("colliders", f, [&](ColliderId id, Collider& c) { f("collider", c), c.id = id; });
  }
  template <class Fields>
  void stateOfPairs(Fields& f) {
    f("ignored", ignored_), f("bodies collide", bodiesCollide_);
  }
  template <class Fields>
  void stateOfIds(Fields& f) {
    f("next shape", nextShape_), f("next body", nextBody_), f("next collider", nextCollider_);
  }

private:
  struct ShapeEntry {
    std::shared_ptr<const Shape> shape;
    Sphere bound;
    std::uint32_t uses = 0;
  };
  void forgetPairsOf(ContactSide p);

  IdTable<ShapeEntry> shapes_;
  IdTable<RigidBody> bodies_;
  IdTable<Collider> colliders_;
  std::uint32_t nextShape_ = 1, nextBody_ = 1, nextCollider_ = 1;
  std::set<std::pair<ContactSide, ContactSide>> ignored_;
  bool bodiesCollide_ = true;
  std::vector<BodyId> flightless_;  ///< restored bodies that wait for their flights
};

}  // namespace stadion
