#include "dynamics/crowd_solver.h"
#include "dynamics/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {

struct World::Core::CrowdStep {
  double h = 0;
  std::vector<RigidBody*> members;
  std::vector<CrowdBody> bodies, moved;  ///< the members, then the parties that nothing moves
  std::vector<CrowdContact> contacts;
  std::vector<Party> others;  ///< of each contact: its second side
  std::vector<Party> fixed;
  std::vector<Vec3> pull;  ///< on the members [m/s2]
};

namespace {

constexpr double kTouching = 1e-4;    ///< pairs closer than this are in contact [m]
constexpr double kLeast = 4;          ///< a smaller crowd is none any more
constexpr double kDue = 1e-9;         ///< times as near as this are the same [s]
constexpr double kQuietSpeed = 4e-3;  ///< of surface points [m/s]
constexpr double kQuietTime = 0.3;    ///< before a body sleeps among quiet ones [s]
constexpr double kWaking = 1e-9;      ///< quiet time of one who has been woken softly [s]

bool sleeps(const RigidBody& b) {
  return b.mode == BodyMode::Rest || b.mode == BodyMode::Quarantined;
}

}  // namespace

void World::Core::joinCrowd(RigidBody& b, double tau, CrowdStep& step) {
  if (!b.crowd) {
    const double quiet = b.mode == BodyMode::Rest ? kWaking : b.quiet;
    enterContact(b, tau);
    if (b.mode != BodyMode::Contact) return;
    b.crowd = true, b.quiet = quiet, b.dueAge = 0;
  }
  CrowdBody c;
  const double age = b.age(tau);
  const bool ended = b.dueAge > 0 && age >= b.dueAge - kDue;
  const Quat q = b.orientation(tau);
  c.p = b.position(tau);
  c.v = ended ? b.endV : b.velocity(tau);
  const Vec3 L = ended ? b.endL : b.spin.angularMomentum(age);
  c.omega = q * b.inertia.cwiseInverse().cwiseProduct(q.conjugate() * L);
  c.inverseMass = b.inverseMass;
  if (b.isBall() && b.inertia.x() == b.inertia.y() && b.inertia.y() == b.inertia.z()) {
    c.roundInertia = 1 / b.inertia.x();
  } else {
    const Mat3 R = q.toRotationMatrix();
    c.inverseInertia = R * b.inertia.cwiseInverse().asDiagonal() * R.transpose();
  }
  b.slot = static_cast<std::uint32_t>(step.members.size());
  step.members.push_back(&b);
  step.bodies.push_back(c);
}

void World::Core::findCrowdContacts(RigidBody& b, double tau, CrowdStep& step) {
  const double h = step.h;
  const CrowdBody me = step.bodies[b.slot];
  const Side self = Side::of(b);
  const Vec3 middle = b.isCentred() ? me.p : Vec3(b.poseAt(tau) * b.bound.centre);
  const double own = kTouching + h * (me.v.norm() + me.omega.norm() * (b.isBall() ? 0 : b.reach) + 9.81 * h);
  std::vector<ManifoldPoint> points;
  const auto add = [&](const Gap& gap, std::uint32_t feature, Party other, const Surface& surface) {
    CrowdContact c;
    const PairSurface pair = combine(b.surface, surface);
    c.a = b.slot, c.n = gap.normal, c.gap = gap.distance, c.friction = pair.friction;
    c.restitution = pair.restitution, c.rolling = pair.rolling;
    c.armA = gap.point - me.p, c.armB = gap.point;  // the other's centre is taken away when all are known
    c.key = pairKey(self.party, other, feature);
    for (const Pressed& p : b.presses)
      if (p.key == c.key) c.impulse = std::min(h, p.step) * p.force;
    step.contacts.push_back(c);
    step.others.push_back(other);
  };
  Aabb box;
  box.include(middle);
  box.lo.array() -= b.bound.radius + own, box.hi.array() += b.bound.radius + own;
  nearColliders.eachNear(box, [&](const Collider& c) {
    const Side other = Side::of(c);
    if (!mayTouch(self, other)) return;
    manifold(self, other, tau, own + (c.motion.moving ? h * c.motion.at(tau).velocityAt(middle).norm() : 0),
             points);
    for (const ManifoldPoint& p : points) add(p.gap, p.key, other.party, c.surface);
  });
  // Fliers' boxes hold their whole way, so that those who come fast are met as well.
  nearBodies.eachNear(box, [&](RigidBody& o) {
    if (&o == &b || !o.enabled || !mayTouch(self, Side::of(o))) return;
    const bool member = o.crowd && o.slot < step.members.size() && step.members[o.slot] == &o;
    if (member && o.id < b.id) return;  // the pair is found from there
    const Party party{true, o.id};
    const Vec3 theirV = member ? step.bodies[o.slot].v : o.velocity(tau);
    const double margin = own + h * theirV.norm();
    const Vec3 there = member && o.isCentred() ? step.bodies[o.slot].p : Vec3(o.poseAt(tau) * o.bound.centre);
    const double reach = b.bound.radius + o.bound.radius + margin;
    const Vec3 apart = middle - there;
    const double square = apart.squaredNorm();
    if (square > reach * reach) return;
    const bool balls = b.isBall() && o.isBall();
    if (balls) {
      const double d = std::sqrt(square);
      Gap gap;
      gap.distance = d - b.radius() - o.radius();
      gap.normal = d > 0 ? Vec3(apart / d) : Vec3::UnitZ();
      gap.point = there + o.radius() * gap.normal;
      points.assign(1, {gap, 1});
    } else {
      manifold(self, Side::of(o), tau, margin, points);
      if (points.empty()) return;
    }
    if (!member && o.movable() && o.mode != BodyMode::Quarantined) {
      // Who sleeps stays asleep unless it is pushed; who moves comes along.
      const bool touched =
          std::ranges::any_of(points, [](const auto& p) { return p.gap.distance < kTouching; });
      if (!sleeps(o) || (touched && (b.quiet == 0 || me.v.norm() > 5e-3))) {
        joinCrowd(o, tau, step);
        if (o.id < b.id && o.crowd) return;
      }
    }
    for (const ManifoldPoint& p : points) add(p.gap, p.key, party, o.surface);
  });
}

/// Arcs of the step, forces as a guess for the next one, and who may sleep.
void World::Core::concludeCrowd(CrowdStep& s, double tau) {
  const std::size_t n = s.members.size();
  std::vector<std::vector<Party>> near(n);
  std::vector<char> calm(n, 1), pressed(n, 0);
  std::vector<int> points(n, 0);
  const auto note = [](std::vector<Party>& list, Party p) {
    if (std::find(list.begin(), list.end(), p) == list.end()) list.push_back(p);
  };
  for (std::size_t i = 0; i < n; ++i) {
    RigidBody& b = *s.members[i];
    b.touching.clear(), b.presses.clear();
    const double speed = s.bodies[i].v.norm() + s.bodies[i].omega.norm() * b.reach,
                 carried = s.moved[i].v.norm() + s.moved[i].omega.norm() * b.reach;
    b.quiet = std::max(speed, carried) < kQuietSpeed ? b.quiet + s.h : 0;
    calm[i] = b.quiet >= kQuietTime;
  }
  std::vector<char> may = calm;
  for (std::size_t k = 0; k < s.contacts.size(); ++k) {
    const CrowdContact& c = s.contacts[k];
    RigidBody& a = *s.members[c.a];
    if (!c.impulse.isZero(0)) pressed[c.a] = 1, pressed[c.b < n ? c.b : c.a] = 1;
    if (c.pressed > 0) a.presses.push_back({c.key, c.impulse / s.h, s.h});
    note(a.touching, s.others[k]), ++points[c.a];
    if (c.gap < kTouching) note(near[c.a], s.others[k]);
    if (c.b < n) {
      RigidBody& b = *s.members[c.b];
      note(b.touching, {true, a.id}), ++points[c.b];
      if (c.gap < kTouching) note(near[c.b], {true, a.id});
      may[c.a] = may[c.a] && calm[c.b], may[c.b] = may[c.b] && calm[c.a];
    } else {
      const CrowdBody& fixed = s.bodies[c.b];
      may[c.a] = may[c.a] && fixed.v.isZero(0) && fixed.omega.isZero(0);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    RigidBody& b = *s.members[i];
    const CrowdBody &carried = s.moved[i], &after = s.bodies[i];
    const auto inertia = [&](const Vec3& omega) {
      const Quat q = b.orientation(tau);
      return Vec3(q * b.inertia.cwiseProduct(q.conjugate() * omega));
    };
    const Quat q = b.orientation(tau);
    const std::vector<Party> left = b.leaning;
    remember(b, near[i]);
    for (const Party p : left)  // who leaned on it may fall now
      if (p.isBody && std::find(near[i].begin(), near[i].end(), p) == near[i].end())
        if (RigidBody* o = body(p.id); o && o->mode == BodyMode::Rest) enterContact(*o, tau);
    if (points[i] == 0) {
      wakeOnto({true, b.id}, tau);
      startFlight(b, tau, carried.p, after.v, q, inertia(after.omega));
      predict(b, tau);
      continue;
    }
    const double quiet = b.quiet;
    // Who is not pressed falls; else the step's impulses come first and the way is straight.
    const bool falls = !pressed[i];
    setArc(b, tau,
           falls ? Path::parabola(carried.p, after.v - s.h * s.pull[i], s.pull[i])
                 : Path::parabola(carried.p, carried.v, Vec3::Zero()),
           Spin::free(q, inertia(carried.omega), b.inertia), s.h, BodyMode::Contact);
    if (b.mode != BodyMode::Contact) continue;
    b.endV = after.v, b.endL = inertia(after.omega), b.dueAge = s.h, b.quiet = quiet;
    if (may[i])
      freeze(b, tau), predict(b, tau);
    else
      sweep(b, tau);
  }
}

/// One step of all who lie in heaps, to the next time on the crowd's grid.
void World::Core::advanceCrowd(double tau) {
  CrowdStep s;
  Nanoseconds next = (timeAt(tau) / crowdGrid + 1) * crowdGrid;
  if (next - timeAt(tau) < crowdGrid / 8) next += crowdGrid;
  s.h = Instant{next, 0}.since(instantAt(tau));
  std::vector<RigidBody*> due;
  for (RigidBody* b : active) {
    b->slot = 0xffffffff;
    if (b->crowd && b->enabled && b->dueAge <= b->age(tau) + kDue) due.push_back(b);
  }
  if (due.empty()) return;
  if (static_cast<double>(due.size()) < kLeast) {
    for (RigidBody* b : due) {
      const Vec3 L = b->endL;
      if (b->dueAge > 0)
        setArc(*b, tau, Path::parabola(b->position(tau), b->endV, Vec3::Zero()),
               Spin::free(b->orientation(tau), L, b->inertia), tickTime, BodyMode::Contact);
      b->crowd = false, b->endL = L;
    }
    return;
  }
  std::ranges::sort(due, {}, &RigidBody::id);
  for (RigidBody* b : due) joinCrowd(*b, tau, s);
  for (std::size_t i = 0; i < s.members.size(); ++i) findCrowdContacts(*s.members[i], tau, s);
  const std::size_t n = s.members.size();
  for (std::size_t k = 0; k < s.contacts.size(); ++k) {
    CrowdContact& c = s.contacts[k];
    const Party p = s.others[k];
    RigidBody* o = p.isBody ? body(p.id) : nullptr;
    if (o && o->crowd && o->slot < n && s.members[o->slot] == o) {
      c.b = o->slot;
    } else {
      const auto known = std::find(s.fixed.begin(), s.fixed.end(), p);
      c.b = static_cast<std::uint32_t>(n + static_cast<std::size_t>(known - s.fixed.begin()));
      if (known == s.fixed.end()) {
        s.fixed.push_back(p);
        const Kinematics kin = o ? o->at(tau) : collider(p.id)->motion.at(tau);
        CrowdBody fixed;
        fixed.p = kin.p, fixed.v = kin.v, fixed.omega = kin.omega;
        s.bodies.push_back(fixed);
      }
    }
    c.armB -= s.bodies[c.b].p;
  }
  s.pull.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const RigidBody& b = *s.members[i];
    s.pull[i] = accelerationAt(b, s.bodies[i].p, s.bodies[i].v, tau);
    if (b.damping > 0) s.bodies[i].v *= det::exp(-b.damping * s.h);
  }
  solveCrowd(s.bodies, s.contacts, s.pull, s.h, s.moved);
  for (const CrowdContact& c : s.contacts) {
    const RigidBody& b = *s.members[c.a];
    if (!(c.rolling > 0) || !(c.pressed > 0) || !b.isBall()) continue;
    const double most = c.rolling * b.radius() * c.pressed / b.inertia.x();
    for (CrowdBody* m : {&s.bodies[c.a], &s.moved[c.a]})
      if (const double w = m->omega.norm(); w > 0) m->omega *= std::max(0.0, 1 - most / w);
  }
  concludeCrowd(s, tau);
}

}  // namespace stadion
