#include "dynamics/state/swept_boxes.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kMargin = 2e-6;  ///< so that a fresh arc of the same motion stays inside [m]

/// Makes room in the box for wherever the body's further arcs through a medium may go in `d` seconds after
/// tau, at which the box holds it.
void reachOn(const RigidBody& b, double tau, double d, Aabb& box) {
  const Vec3 v = b.velocity(tau), p = b.position(tau) + d * v;
  const Vec3 room = Vec3::Constant(b.reach + kMargin) + 0.5 * d * d * b.even.accelerationBound(v, d);
  box.include(p - room);
  box.include(p + room);
}

/// The box around a body from tau to `to`, however it turns.
Aabb sweptBody(const RigidBody& b, double tau, double to) {
  const Vec3 p0 = b.position(tau), p1 = b.position(to);
  Aabb box{p0.cwiseMin(p1), p0.cwiseMax(p1)};
  Vec3 sag = Vec3::Zero();
  if (b.path.isParabola()) {
    const auto& c = b.path.c;
    const Vec3 v0 = c[1] + b.age(tau) * (2 * c[2]), v1 = c[1] + b.age(to) * (2 * c[2]);
    for (int i = 0; i < 3;
         ++i)  // it turns back on the way: a parabola's vertex is this far beyond its ends at most
      if (v0[i] * v1[i] < 0) sag[i] = std::fabs(c[2][i]) * (to - tau) * (to - tau) / 4;
  } else {
    const Vec3 most = b.path.isSeries() ? b.even.accelerationBound(b.velocity(tau), to - tau)
                                        : Vec3::Constant(b.path.accelerationBound());
    sag = (to - tau) * (to - tau) / 8 * most;
  }
  const double margin = b.reach + kMargin + 1e-12 * p0.cwiseAbs().maxCoeff();
  sag.array() += margin;
  box.lo -= sag;
  box.hi += sag;
  return box;
}

}  // namespace

void SweptBoxes::sweep(RigidBody& b, double tau) {
  if (!b.enabled) return bodies_.remove(b);
  if (b.mode == BodyMode::Held) {
    b.swept = sweptBox(Side::of(b), std::max(tau, time_.partStart()),
                       std::max({tau, time_.partStart(), time_.partEnd()}));
  } else {
    const double end = b.pathAge - b.age0;
    Aabb box = sweptBody(b, tau, std::max(tau, std::min(time_.windowEnd(), end)));
    if (b.contact.inPile) {  // steps are short and many: a roomy box serves several
      if (b.place != kUnfiled && holds(b.swept, box)) return;
      const double room = 0.004 + 0.05 * b.velocity(tau).norm();
      b.swept.lo = box.lo.array() - room;
      b.swept.hi = box.hi.array() + room;
    } else {
      if (b.path.isSeries() && tau < end && end < time_.windowEnd())
        reachOn(b, end, time_.windowEnd() - end, box);
      b.swept = box;
    }
  }
  bodies_.put(b, b.swept);
}

void SweptBoxes::sweep(Collider& c) {
  if (!c.enabled) return colliders_.remove(c);
  if (c.motion.moving) {
    c.swept = sweptBox(Side::of(c), time_.partStart(), std::max(time_.partStart(), time_.partEnd()));
  } else {
    constexpr double margin = 2e-5;  // so that a body that touches it at load is seen
    c.swept = boundingBox(*c.shape, c.motion.end);
    c.swept.lo.array() -= margin;
    c.swept.hi.array() += margin;
  }
  colliders_.put(c, c.swept);
}

void SweptBoxes::sweep(ChangedMotions& changed) {
  changed.sortBodies();
  for (RigidBody* b : changed.bodies()) sweep(*b, time_.partStart());
  sortBodiesIfCrowded();
  sortCollidersIfCrowded();
}

void SweptBoxes::sweep(const ActiveBodies& active, double tau) {
  // A resting body sweeps what it did before. If many move, sorting all of them is cheaper.
  const bool many = active.size() * active.size() > 16 * objects_.bodies().size();
  for (RigidBody* b : active) {
    if (!many) bodies_.remove(*b);
    if (b->enabled) sweep(*b, tau);
  }
  if (many || bodies_.crowded()) sortBodies();
}

void SweptBoxes::sortBodies() {
  std::vector<BroadPhase<RigidBody>::Entry> entries;
  entries.reserve(objects_.bodies().size());
  for (RigidBody& b : objects_.bodies())
    if (b.enabled) entries.push_back({b.swept, &b});
  bodies_.file(std::move(entries));
}

void SweptBoxes::sortBodiesIfCrowded() {
  if (bodies_.crowded()) sortBodies();
}

void SweptBoxes::sortCollidersIfCrowded() {
  if (!colliders_.crowded()) return;
  std::vector<BroadPhase<Collider>::Entry> entries;
  for (Collider& c : objects_.colliders())
    if (c.enabled) entries.push_back({c.swept, &c});
  colliders_.file(std::move(entries));
}

bool SweptBoxes::anyNear(const ActiveBodies& active) const {
  bool near = false;
  for (const RigidBody* b : active) {
    if (near) break;
    if (!b->enabled) continue;
    eachCollider(b->swept, [&](const Collider&) { near = true; });
    eachBody(b->swept, [&](const RigidBody& o) { near = near || &o != b; });
  }
  return near;
}

}  // namespace stadion
