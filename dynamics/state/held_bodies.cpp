#include "dynamics/state/held_bodies.h"

#include <algorithm>

namespace stadion {

bool bothCarried(const Side& a, const Side& b) {
  return !(a.body && a.body->movable()) && !(b.body && b.body->movable());
}

void HeldBodies::add(RigidBody& b) {
  b.mode = BodyMode::Held;
  b.grip.freePlace = b.pose * b.bound.centre;
  if (std::ranges::find(list_, &b) == list_.end()) list_.push_back(&b);
  b.grip.held.arcs.clear();
  b.grip.nextArcs.clear();
  b.grip.held.set(b.pose, b.pose, time_.partEnd(), 0);
  b.grip.carried.clear();
  b.grip.accumulated.setZero();
}

void HeldBodies::dropReleased() {
  std::erase_if(list_, [](const RigidBody* b) { return b->mode != BodyMode::Held; });
}

void HeldBodies::carryFields(RigidBody& b, std::vector<FieldId> fields) const {
  if (b.grip.carried.empty()) b.grip.accumulatedTo = time_.instantAt(time_.partEnd());
  b.grip.carried = std::move(fields);
}

void HeldBodies::accumulate(double tau) {
  for (RigidBody* b : list_) {
    if (b->mode != BodyMode::Held || b->grip.carried.empty()) continue;
    // A push acts evenly and keeps its direction in the hand: its mean is that of the middle.
    const double span = time_.instantAt(tau).since(b->grip.accumulatedTo), middle = tau - 0.5 * span;
    if (!(span > 0)) continue;
    b->grip.accumulatedTo = time_.instantAt(tau);
    const Quat q_NW = b->grip.held.at(middle).pose.q.conjugate();
    for (const FieldId id : b->grip.carried) {
      const FieldEntry* f = fields_.find(id);
      if (!f || !f->on || !isHooked(*b, id) || !std::holds_alternative<LinearField>(f->field.law)) continue;
      b->grip.accumulated +=
          span * (q_NW * accelerationOf(f->field, {b->mass, b->dragArea}, time_.shareAt(middle)));
    }
  }
}

void HeldBodies::endTouches() {
  std::vector<ContactMemory::Key> apart;
  const auto look = [&](const ContactMemory::Key& key) {
    if (!memory_.touching(key)) return;
    const auto a = objects_.side(key.first), b = objects_.side({true, key.second});
    if (a && b && bothCarried(*a, *b) && gapBetween(*b, *a, time_.partEnd(), {1e-3}).distance > kCarriedApart)
      apart.push_back(key);
  };
  for (const RigidBody* b : list_)
    if (b->mode == BodyMode::Held) memory_.eachWith({true, b->id}, look);
  for (const auto& key : apart) memory_.setTouching(key, false);
}

}  // namespace stadion
