#include "dynamics/state/world_objects.h"

#include <algorithm>

namespace stadion {
namespace {

std::pair<ContactSide, ContactSide> ordered(ContactSide a, ContactSide b) {
  return a < b ? std::pair(a, b) : std::pair(b, a);
}

}  // namespace

ShapeId WorldObjects::addShape(std::shared_ptr<const Shape> shape) {
  const Sphere bound = boundingSphere(*shape);
  if (!bound.centre.allFinite() || !(bound.radius > 0)) return 0;
  const ShapeId id = nextShape_++;
  ShapeEntry& entry = shapes_.add(id);
  entry.shape = std::move(shape);
  entry.bound = bound;
  return id;
}

bool WorldObjects::removeShape(ShapeId id) {
  const ShapeEntry* s = shapes_.find(id);
  if (!s || s->uses > 0) return false;
  shapes_.erase(id);
  return true;
}

const Shape* WorldObjects::shape(ShapeId id) const {
  const ShapeEntry* s = shapes_.find(id);
  return s ? s->shape.get() : nullptr;
}

RigidBody& WorldObjects::addBody(ShapeId shape) {
  ShapeEntry& s = *shapes_.find(shape);
  ++s.uses;
  const BodyId id = nextBody_++;
  RigidBody& b = bodies_.add(id);
  b.id = id;
  b.shapeId = shape;
  b.shape = s.shape.get();
  b.bound = s.bound;
  return b;
}

Collider& WorldObjects::addCollider(ShapeId shape) {
  ShapeEntry& s = *shapes_.find(shape);
  ++s.uses;
  const ColliderId id = nextCollider_++;
  Collider& c = colliders_.add(id);
  c.id = id;
  c.shapeId = shape;
  c.shape = s.shape.get();
  c.bound = s.bound;
  return c;
}

void WorldObjects::forgetPairsOf(ContactSide p) {
  std::erase_if(ignored_, [&](const auto& pair) { return pair.first == p || pair.second == p; });
}

void WorldObjects::remove(const RigidBody& b) {
  --shapes_.find(b.shapeId)->uses;
  forgetPairsOf({true, b.id});
  bodies_.erase(b.id);
}

void WorldObjects::remove(const Collider& c) {
  --shapes_.find(c.shapeId)->uses;
  forgetPairsOf({false, c.id});
  colliders_.erase(c.id);
}

const std::uint32_t* WorldObjects::versionPointer(ContactSide p) const {
  if (const RigidBody* b = p.isBody ? body(p.id) : nullptr) return &b->version;
  if (const Collider* c = p.isBody ? nullptr : collider(p.id)) return &c->version;
  return nullptr;
}

std::uint32_t WorldObjects::versionOf(ContactSide p) const {
  const std::uint32_t* version = versionPointer(p);
  return version ? *version : 0;
}

void WorldObjects::ignore(ContactSide a, ContactSide b, bool on) {
  if (on)
    ignored_.insert(ordered(a, b));
  else
    ignored_.erase(ordered(a, b));
}

bool WorldObjects::mayTouch(const Side& a, const Side& b) const {
  if (a.body && b.body && !bodiesCollide_) return false;
  return ignored_.empty() || !ignored_.count(ordered(a.key, b.key));
}

bool WorldObjects::restoreShape(ShapeId id, std::shared_ptr<const Shape> shape) {
  ShapeEntry* entry = shapes_.find(id);
  if (!entry || entry->shape || !shape) return false;
  entry->shape = std::move(shape);
  for (RigidBody& b : bodies_)
    if (b.shapeId == id) b.shape = entry->shape.get();
  for (Collider& c : colliders_)
    if (c.shapeId == id) c.shape = entry->shape.get();
  return true;
}

bool WorldObjects::restoreFlight(BodyId id, std::shared_ptr<const BodyFlight> flight) {
  RigidBody* b = body(id);
  if (!b || !flight || std::erase(flightless_, id) == 0) return false;
  b->flight = std::move(flight);
  return true;
}

bool WorldObjects::complete() const {
  bool whole = flightless_.empty();
  for (const RigidBody& b : bodies_) whole = whole && b.shape;
  for (const Collider& c : colliders_) whole = whole && c.shape;
  return whole;
}

}  // namespace stadion
