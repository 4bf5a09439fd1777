#include "dynamics/world/pile_step.h"
#include "dynamics/world/piles.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kWakeSpeed = 5e-3;  ///< a body that touches a sleeping body faster wakes it [m/s]
constexpr double kStrongest = 9.81;  ///< acceleration that a step allows for [m/s2]

bool sleeps(const RigidBody& b) {
  return standsStill(b.mode);
}

/// The gap between a ball and a plane that does not move and has no rim.
Gap planeGap(const Vec3& centre, double radius, const PlaneShape& plane, const Pose& X) {
  Gap gap;
  gap.normal = X.q * plane.normal();
  const double height = gap.normal.dot(centre - X * plane.pose.p);
  gap.distance = height - radius;
  gap.point = centre - height * gap.normal;
  gap.face = true;
  return gap;
}

}  // namespace

/// A point of contact of a member with a member or one that nothing moves.
void Piles::addContact(const RigidBody& b, ContactSide other, const Surface& surface, const Gap& gap,
                       std::uint32_t feature, PileStep& step) {
  PileContact c;
  const PairSurface pair = combine(b.surface, surface);
  c.a = b.contact.slot;
  c.n = gap.normal;
  c.gap = gap.distance;
  c.friction = pair.friction;
  c.restitution = pair.restitution;
  if (b.isBall()) c.rolling = pair.rolling * b.radius();
  PileStep::Note note;
  note.other = other;
  note.key = pairKey({true, b.id}, other, feature);
  note.reverse = pairKey(other, {true, b.id}, feature);
  for (const WarmStart& p : b.contact.warmStarts)
    if (p.key == note.key) {
      const Vec3 impulse = std::min(step.pile.h, p.step) * p.force;
      c.pressed = std::max(0.0, impulse.dot(c.n));
      if (c.friction > 0) c.tangential = impulse - impulse.dot(c.n) * c.n;
    }
  RigidBody* o = other.isBody ? objects_.body(other.id) : nullptr;
  if (o && step.has(*o)) {
    c.b = o->contact.slot;
  } else if (o && o->contact.slot < step.fixed.size() && step.fixed[o->contact.slot].body == o) {
    note.fixed = o->contact.slot;
  } else {
    const auto known = o ? step.fixed.end() : std::ranges::find(step.fixed, other, &PileStep::Fixed::key);
    note.fixed = static_cast<std::uint32_t>(known - step.fixed.begin());
    if (known == step.fixed.end()) step.fixed.push_back({other, o, Vec3::Zero()});
    if (o) o->contact.slot = note.fixed;
  }
  step.pile.contacts.push_back(c);
  step.notes.push_back(note);
  step.points.push_back(gap.point);
}

void Piles::findColliders(const RigidBody& b, const Aabb& box, double margin, PileStep& step) {
  const PileStep::Member me = step.members[b.contact.slot];
  const Side self = Side::of(b);
  step.bearings.clear();
  step.features.clear();
  const auto note = [&](const Collider& c, const Gap& gap, std::uint32_t feature) {
    step.bearings.push_back({{false, c.id}, c.shape, c.motion.at(step.tau).pose, gap});
    step.features.push_back(feature);
  };
  boxes_.eachCollider(box, [&](const Collider& c) {
    const bool moves = c.motion.moving;
    if (!objects_.mayTouch(self, Side::of(c))) return;
    if (me.round && !moves && !std::holds_alternative<MeshShape>(*c.shape)) {
      const auto* plane = std::get_if<PlaneShape>(c.shape);
      const Gap gap = plane && !plane->bounded()
                          ? planeGap(me.middle, me.bound, *plane, c.motion.end)
                          : ballGap(me.middle, me.bound, *c.shape, c.motion.end, {.limit = margin});
      if (gap.distance < margin) note(c, gap, 1);
      return;
    }
    const double theirs = moves ? step.pile.h * c.motion.at(step.tau).velocityAt(me.middle).norm() : 0;
    manifold(self, Side::of(c), step.tau, margin + theirs, step.found);
    // A ball with its centre inside leaves by one way, the shortest.
    if (me.round && !step.found.empty() && step.found.front().gap.distance < -me.bound) step.found.resize(1);
    for (const ManifoldPoint& p : step.found) note(c, p.gap, p.key);
  });
  const std::vector<char> hidden = hiddenAmong(step.bearings);
  for (std::size_t i = 0; i < step.bearings.size(); ++i) {
    const Bearing& on = step.bearings[i];
    if (hidden.empty() || !hidden[i])
      addContact(b, on.of, objects_.collider(on.of.id)->surface, on.gap, step.features[i], step);
  }
}

/// A body near a member: the points at which they may meet, and whether it joins the step.
void Piles::meet(RigidBody& b, RigidBody& o, double margin, PileStep& step) {
  if (&o == &b || !o.enabled) return;
  const PileStep::Member me = step.members[b.contact.slot];
  bool member = step.has(o);
  if (member && o.id < b.id) return;  // the pair is found from there
  double reach = margin;
  Vec3 there;
  if (member) {
    reach += step.members[o.contact.slot].way;
    there = step.members[o.contact.slot].middle;
  } else {
    reach += step.pile.h * o.velocity(step.tau).norm();
    there = o.centred ? o.position(step.tau) : Vec3(o.poseAt(step.tau) * o.bound.centre);
  }
  const Vec3 apart = me.middle - there;
  const double square = apart.squaredNorm(), far = me.bound + o.bound.radius + reach;
  if (square > far * far || !objects_.mayTouch(Side::of(b), Side::of(o))) return;
  if (me.round && o.centred) {
    const double d = std::sqrt(square);
    Gap gap;
    gap.distance = d - me.bound - o.bound.radius;
    gap.normal = d > 0 ? Vec3(apart / d) : Vec3::UnitZ();
    gap.point = there + o.bound.radius * gap.normal;
    step.found.assign(1, {gap, 1});
  } else {
    manifold(Side::of(b), Side::of(o), step.tau, reach, step.found);
    if (step.found.empty()) return;
  }
  if (!member && o.movable()) {
    // A sleeping body stays asleep unless it is pushed; a moving body joins the step.
    const bool touched =
        std::ranges::any_of(step.found, [](const auto& p) { return p.gap.distance < kTouching; });
    const bool pushes = b.contact.quietTime == 0 || step.pile.bodies[b.contact.slot].v.norm() > kWakeSpeed;
    if (!sleeps(o) || (touched && pushes)) join(o, step);
    member = step.has(o);
    if (member && o.id < b.id) return;
  }
  for (const ManifoldPoint& p : step.found) addContact(b, {true, o.id}, o.surface, p.gap, p.key, step);
}

void Piles::findContacts(RigidBody& b, PileStep& step) {
  const PileStep::Member& me = step.members[b.contact.slot];
  const double margin = kTouching + me.way + step.pile.h * step.pile.h * kStrongest;
  Aabb box;
  box.include(me.middle);
  box.lo.array() -= me.bound + margin;
  box.hi.array() += me.bound + margin;
  findColliders(b, box, margin, step);
  // Fliers' boxes hold their whole way, so that fast bodies are met as well. In the order of ids:
  // sweeps depend on it, and the broad phase's own depends on frames.
  step.near.clear();
  foresight_.eachBodyNear(box, step.tau, [&](RigidBody& o) {
    if (step.has(o)) {  // most of them: the pair is found from the other, or too far apart
      const PileStep::Member& other = step.members[o.contact.slot];
      const double far = me.bound + other.bound + margin + other.way;
      if (o.id <= b.id || (me.middle - other.middle).squaredNorm() > far * far) return;
    }
    step.near.push_back(&o);
  });
  std::ranges::sort(step.near, {}, &RigidBody::id);
  for (RigidBody* o : step.near) meet(b, *o, margin, step);
}

/// All sides are known now: which of them move, and where the points are on both.
void Piles::linkContacts(PileStep& step) {
  Pile& pile = step.pile;
  const auto n = static_cast<std::uint32_t>(step.members.size());
  for (PileStep::Fixed& f : step.fixed) {
    const Kinematics k = f.body ? f.body->at(step.tau) : objects_.collider(f.key.id)->motion.at(step.tau);
    f.p = k.p;
    PileBody still;
    still.v = k.v;
    still.omega = k.omega;
    pile.bodies.push_back(still);
  }
  std::size_t kept = 0;
  const std::vector<Vec3> holds = placesOfFriction(step);
  for (std::size_t k = 0; k < pile.contacts.size(); ++k) {
    PileContact c = pile.contacts[k];
    const PileStep::Note& note = step.notes[k];
    const PileStep::Fixed* fixed = note.fixed == PileStep::kNone ? nullptr : &step.fixed[note.fixed];
    if (fixed && fixed->body && step.has(*fixed->body)) {  // it has come along after all
      c.b = fixed->body->contact.slot;
      if (fixed->body->id < step.members[c.a].body->id) continue;  // and has found the pair by itself
    } else if (fixed) {
      c.b = n + note.fixed;
    }
    const PileStep::Member& a = step.members[c.a];
    const Vec3 other = c.b < n ? step.members[c.b].p : fixed->p;
    const Vec3 armA = step.points[k] - a.p, armB = step.points[k] - other;
    const bool still = c.b >= n && pile.bodies[c.b].omega.isZero(0);
    if (a.round && (still || (c.b < n && step.members[c.b].round))) {
      c.leverA = -armA.dot(c.n);
      c.leverB = still ? 0 : armB.dot(c.n);
    } else {
      c.arms = static_cast<std::int32_t>(pile.arms.size());
      const Vec3& hold = holds.empty() ? step.points[k] : holds[k];
      pile.arms.push_back({armA, armB, hold - a.p, hold - other});
    }
    pile.contacts[kept] = c;
    step.notes[kept] = note;
    ++kept;
  }
  pile.contacts.resize(kept);
  step.notes.resize(kept);
}

/// In a pile the points of a flat contact keep friction of their own, but at the mean radius of its area: so
/// they resist spin as even pressure does, whichever of them carry it. Empty if all have it where they are.
std::vector<Vec3> Piles::placesOfFriction(const PileStep& step) const {
  std::vector<Vec3> places;
  std::vector<Gap> gaps;
  const std::vector<PileContact>& all = step.pile.contacts;
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    for (end = first + 1; end < all.size() && all[end].a == all[first].a; ++end)
      if (step.notes[end].other != step.notes[first].other) break;
    if (end - first < 3 || all[first].friction <= 0) continue;
    const std::optional<Side> b = objects_.side(step.notes[first].other);
    if (!b) continue;
    gaps.clear();
    for (std::size_t k = first; k < end; ++k) {
      Gap g;
      g.distance = all[k].gap;
      g.normal = all[k].n;
      g.point = step.points[k];
      gaps.push_back(g);
    }
    for (const FlatContact& flat :
         flatContacts(Side::of(*step.members[all[first].a].body), {&*b, 1}, step.tau, gaps)) {
      if (places.empty()) places = step.points;
      const Vec3& middle = flat.plane.origin;
      for (const std::uint32_t k : flat.points) {
        const Vec3 off = step.points[first + k] - middle;
        const double away = (off - flat.plane.n * flat.plane.n.dot(off)).norm();
        if (away > flat.area->radius()) places[first + k] = middle + flat.area->radius() / away * off;
      }
    }
  }
  return places;
}

}  // namespace stadion
