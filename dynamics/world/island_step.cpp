#include "dynamics/world/island_step.h"

#include "dynamics/collision/manifold.h"
#include "dynamics/contact/island_energy.h"
#include "dynamics/world/ball_support.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kApproach = 1e-4;         ///< approaches up to this end with the step's own forces [m/s]
constexpr double kRestitutionSpeed = 0.1;  ///< slower approaches inside lasting contact do not bounce [m/s]
constexpr double kQuietSpeed = 2e-3;       ///< speed of surface points below which a body is quiet [m/s]
constexpr double kSleepsAfter = 0.2;       ///< quiet time after which a set of bodies sleeps [s]
constexpr double kQuietInGlide = 1e-9;     ///< quiet time of a body that glides slowly [s]
constexpr double kCreep = 1e-4;            ///< mean speed below which a body does not move on [m/s]
constexpr double kBalance = 1e-5;          ///< mean accelerations below this are balance, per pull [m/s2]
constexpr double kRolls = 0.01;            ///< slip of a rolling body, relative to its rotation
constexpr double kMostSpinLeft = 0.05;     ///< part of its spin that a body may keep when it stops rolling
constexpr double kNearlyStill = 5e-3;      ///< speed above which rolling resistance holds no body [m/s]
constexpr double kUnmoved = 1e-9;          ///< speed below which a point does not move at all [m/s]
constexpr double kMostTurn = 0.05;         ///< angle by which a solid turns in a step [rad]
constexpr double kMostSubsteps = 32;  ///< substeps of a step in which the lowest point of a rim moves far
constexpr double kGive = 1;           ///< share of what presses that a hand or a lift yields
constexpr double kShort = 1e-3;       ///< a floor missed by less is reached, nearly [m/s]
constexpr double kLanding = 1e-5;     ///< shortest step towards a touch [s]
constexpr double kOneWay = 0.98;      ///< cosine below which two surfaces are a valley or an edge
constexpr double kUnknown = 5e-5;     ///< overlap by which a corner is down that was not near [m]

bool staysWedged(const ContactIsland& s) {
  return s.wedged && std::ranges::any_of(s.found, [&](const FoundContact& f) {
           return f.contact.give > 0 && f.contact.velocity(s.end)[0] < f.contact.floor - kShort;
         });
}

/// The step's forces bring no energy but what takes back overlap, and what they took before.
void boundStep(ContactIsland& s, double h) {
  if (s.carried) return;
  const std::size_t n = s.set.size();
  double speed = 0;
  for (const FoundContact& f : s.found) speed = std::max(speed, f.contact.floor);
  const double pushed = pushOutWork(n, s.start, s.pull, h, speed), turning = turningWork(n, s.start, s.free);
  double credit = 0;
  for (const RigidBody* b : s.set) credit += b->contact.energyCredit;
  for (Vec3& a : s.pull) a *= 0.5 * h;
  const double work = boundWork(n, s.free, s.end, s.pull, pushed + turning + credit) - turning;
  credit -= work < 0 ? work : std::max(0.0, work - pushed);
  credit = std::clamp(credit, 0.0, kCredit * kineticEnergy(n, s.end));
  for (RigidBody* b : s.set) b->contact.energyCredit = credit / static_cast<double>(n);
}

/// Rolling resistance takes spin, up to c r N, from balls, and from rods and discs that roll.
void resistRolling(ContactIsland& s) {
  const auto resist = [&](std::size_t i, const FoundContact& f, Carrier side) {
    if (i >= s.set.size()) return;
    const bool ball = s.set[i]->isBall(), round = f.carrier == side;
    const double radius = ball ? s.set[i]->radius() : round ? f.rounding.radius : 0;
    SolverBody& m = s.end[i];
    Vec3 about = ball ? m.omega : Vec3(m.omega - f.gap.normal * f.gap.normal.dot(m.omega));
    if (!f.rounding.axis.isZero(0) && round) {  // a rim rolls along itself; it tips over freely
      const Vec3 along = f.rounding.axis - f.gap.normal * f.gap.normal.dot(f.rounding.axis);
      about = along * (along.dot(about) / std::max(along.squaredNorm(), 1e-300));
    }
    const double w = about.norm();
    if (!(radius > 0) || !(w > 0)) return;
    const Vec3 axis = about / w, turn = m.inverseInertia * axis;  // per unit of angular impulse
    const double inertia = 1 / turn.dot(axis);
    const double most = f.surface.rolling * radius * f.contact.impulse[0];
    // What rolls turns about the point that it rolls on, and is taken its way with its spin.
    const Vec3 arm = m.p - f.gap.point;
    const Vec3 u = m.velocityAt(f.gap.point), slip = u - f.gap.normal * f.gap.normal.dot(u);
    const bool rolls = slip.norm() < kRolls * w * radius;
    // As in the closed forms (ball_motion.h). A ball that is pushed out of something turns as little as it can.
    if (ball && !rolls && f.gap.distance > -kTouching) return;
    const double carried = rolls ? (arm - axis * axis.dot(arm)).squaredNorm() / m.inverseMass : 0;
    const Vec3 change = std::min(most / (inertia + carried), w) * inertia * turn;
    m.omega -= change;
    if (rolls) m.v -= change.cross(arm);
  };
  for (const FoundContact& f : s.found) {
    if (f.contact.impulse[0] <= 0 || f.surface.rolling <= 0) continue;
    resist(f.contact.a, f, Carrier::A);
    resist(f.contact.b, f, Carrier::B);
  }
}

/// Returns true if another face of the mesh is in the way of a ball that would go on along this one.
bool inFold(const RigidBody& b, const Collider& c, const Support& face, double tau) {
  constexpr double kTouches = 1e-8;     // [m]
  constexpr double kClosingIn = 1e-10;  // [m/s]
  const auto* mesh = std::get_if<MeshShape>(&*c.shape);
  if (!mesh) return false;
  const Vec3 v = b.velocity(tau), along = v - face.normal * face.normal.dot(v);
  const Pose X = c.motion.end;
  const Vec3 centre = X.inverse() * b.position(tau), local = X.q.conjugate() * along;
  const double reach = b.radius() + kTouches;
  Aabb box;
  box.lo = centre.array() - reach;
  box.hi = centre.array() + reach;
  std::vector<std::uint32_t> near;
  mesh->tree.overlapping(box, near);
  return std::ranges::any_of(near, [&](std::uint32_t i) {
    if (static_cast<std::int32_t>(i) == face.triangle) return false;
    const Vec3 from = centre - closestPoint(mesh->tree.triangles()[i], centre).point;
    const double distance = from.norm();
    return distance < reach && from.dot(local) < -kClosingIn * distance;
  });
}

/// Returns true if surfaces of two directions are near the body.
bool isInValley(const ContactIsland& s, std::size_t body) {
  const FoundContact* first = nullptr;
  for (const FoundContact& f : s.found) {
    if (f.contact.a != body) continue;
    if (first && first->gap.normal.dot(f.gap.normal) < kOneWay) return true;
    if (!first) first = &f;
  }
  return false;
}

/// Returns when a corner of the body that is not known yet reaches the still collider of contact `first`, the first of
/// its pair; h if none does before. X: pose of the body at the start.
double untilDown(const ContactIsland& s, std::size_t first, const Collider& c, const Pose& X, double h) {
  constexpr int kMostLooks = 4;
  const FoundContact& f = s.found[first];
  const SolverBody& m = s.start[f.contact.a];
  double known = 0;
  for (std::size_t k = first; k < s.found.size() && s.found[k].a == f.a && s.found[k].b == f.b; ++k)
    known = std::min(known, s.found[k].gap.distance);
  Collider body;
  body.shape = s.set[f.contact.a]->shape;
  body.bound = s.set[f.contact.a]->bound;
  std::vector<ManifoldPoint> points;
  for (int look = 0; look < kMostLooks; ++look) {
    const Quat turn = det::expRotation(h * m.omega);
    const Vec3 p = m.p + h * m.v;
    body.motion.end = {p + turn * (X.p - m.p), turn * X.q};
    manifold(Side::of(body), Side::of(c), 0, 0, points);
    double late = 0;
    for (const ManifoldPoint& at : points) {
      const double closing = -at.gap.normal.dot(m.v + m.omega.cross(at.gap.point - p));
      if (at.gap.distance < known - kUnknown && closing > kRestitutionSpeed)
        late = std::max(late, -at.gap.distance / closing);
    }
    if (!(late > 0)) return h;
    if (!(h - late > kLanding)) return kLanding;
    h -= late;
  }
  return h;
}

}  // namespace

/// Velocities at the start, and the sides of each contact.
void IslandStep::begin(ContactIsland& s, double tau) const {
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    RigidBody& b = *s.set[i];
    b.contact.slot = static_cast<std::uint32_t>(i);
    s.start.push_back(solverBodyOf(b, tau));
    s.wedged = s.wedged || b.contact.wedged;
  }
  for (FoundContact& f : s.found) {
    SolverContact& c = f.contact;
    c.a = objects_.body(f.a.id)->contact.slot;
    if (f.b.isBody && objects_.body(f.b.id)->mode == BodyMode::Contact &&
        !objects_.body(f.b.id)->contact.inPile) {
      c.b = objects_.body(f.b.id)->contact.slot;
      continue;
    }
    const auto known = std::find(s.fixed.begin(), s.fixed.end(), f.b);
    c.b = static_cast<std::uint32_t>(s.set.size() + static_cast<std::size_t>(known - s.fixed.begin()));
    if (known != s.fixed.end()) continue;
    s.fixed.push_back(f.b);
    SolverBody m = f.b.isBody ? solverBodyOf(*objects_.body(f.b.id), tau)
                              : solverBodyOf(*objects_.collider(f.b.id), tau);
    m.inverseMass = 0;
    m.inverseInertia.setZero();
    s.carried = s.carried || !m.v.isZero(0) || !m.omega.isZero(0);
    s.start.push_back(m);
  }
  findFlats(s, tau);
}

/// Returns true if it moves from outside, or may.
bool IslandStep::isDriven(ContactSide p) const {
  if (p.isBody) return !objects_.body(p.id)->movable();
  return objects_.collider(p.id)->motion.moving;
}

/// Between a hand, or a lift, and what does not move no velocities may be left: then the hand's contacts give
/// way, here and in the next steps, until all floors can be reached again.
bool IslandStep::solveIsland(ContactIsland& s, std::vector<SolverBody>& solverBodies,
                             std::vector<SolverContact>& contacts, Effort effort) const {
  std::vector<SolverContact> yielding = contacts;
  bool driven = false;
  for (SolverContact& c : yielding) {
    if (c.b < s.set.size() || !isDriven(s.fixed[c.b - s.set.size()])) continue;
    c.give = kGive;
    driven = true;
  }
  if (!driven) return solveContacts(solverBodies, contacts, effort);
  if (!s.wedged) {
    const std::vector<SolverBody> before = solverBodies;
    if (solveContacts(solverBodies, contacts, effort)) return true;
    solverBodies = before;
    s.wedged = true;
  }
  contacts = yielding;
  return solveContacts(solverBodies, contacts, effort);
}

/// What is an impact: approaches that end now, with restitution if they are fast.
void IslandStep::stopApproaches(ContactIsland& s, double tau) {
  bool any = false;
  std::vector<double> approach(s.found.size(), 0);  // [m/s]
  std::vector<SolverContact> hits;
  std::vector<std::int32_t> hitOf(s.found.size(), -1);
  for (const FoundContact& f : s.found) {
    if (f.gap.distance > kIslandSlop) continue;
    hitOf[static_cast<std::size_t>(&f - s.found.data())] = static_cast<std::int32_t>(hits.size());
    SolverContact c = f.contact;
    const SolverBody &a = s.start[c.a], &b = s.start[c.b];
    c.placeAt(f.gap.point, f.gap.normal, a.p, b.p);
    c.impulse.setZero();
    c.slides = false;
    const double closing = -c.velocity(s.start)[0];
    c.floor = closing > kRestitutionSpeed ? f.surface.restitution * closing : 0;
    any = any || closing > kApproach;
    approach[static_cast<std::size_t>(&f - s.found.data())] = closing;
    hits.push_back(c);
  }
  if (!any) return;
  for (SolverContact& c : hits) c.patch = -1;
  for (const FlatPatch& f : s.flats) {
    SolverContact c = f.contact;
    const SolverBody &a = s.start[c.a], &b = s.start[c.b];
    f.place(a, b, Mat3::Identity(), Mat3::Identity(), a.p, b.p, c.rows, c.armA, c.armB);
    c.push = c.rows;
    c.pushA = c.armA;
    c.pushB = c.armB;
    c.impulse.setZero();
    c.slides = false;
    for (const std::size_t k : f.points)
      if (hitOf[k] >= 0)
        hits[static_cast<std::size_t>(hitOf[k])].patch = static_cast<std::int32_t>(hits.size());
    hits.push_back(c);
  }
  const std::vector<SolverBody> before = s.start;
  solveIsland(s, s.start, hits, Effort::Moving);
  if (!s.carried) boundWork(s.set.size(), before, s.start, {}, 0);
  recordImpacts(s, hits, hitOf, approach, tau);
}

/// Pairs that meet in this step have an impact, at their fastest point.
void IslandStep::recordImpacts(const ContactIsland& s, const std::vector<SolverContact>& hits,
                               const std::vector<std::int32_t>& hitOf, const std::vector<double>& closing,
                               double tau) {
  for (std::size_t first = 0, end = 0; first < s.found.size(); first = end) {
    std::size_t fastest = first;
    double impulse = 0;
    for (end = first;
         end < s.found.size() && s.found[end].a == s.found[first].a && s.found[end].b == s.found[first].b;
         ++end) {
      if (closing[end] > closing[fastest]) fastest = end;
      if (hitOf[end] >= 0) impulse += hits[static_cast<std::size_t>(hitOf[end])].impulse[0];
    }
    const FoundContact& f = s.found[fastest];
    const ContactMemory::Key key = ContactMemory::keyOf(f.a, f.b);
    if (!(closing[fastest] > kRestitutionSpeed) || !(impulse > 0) || memory_.touching(key)) continue;
    const bool awaited = std::isfinite(objects_.body(key.second)->releaseDistance);
    if (awaited) releases_.releaseBefore(key, tau);
    const Vec3 outwards = key.second == f.a.id ? f.gap.normal : Vec3(-f.gap.normal);
    ContactMemory::Waiting* waiting = memory_.impact(key, time_.timeAt(tau), f.gap.point, outwards,
                                                     closing[fastest], impulse, time_.frame(), awaited);
    memory_.setTouching(key, true);
    if (waiting) releases_.foreseeRelease(*waiting, tau, f.gap.triangle);
  }
}

/// Rolling resistance may stop a body from rocking on its rims. Then the step is solved once more without
/// that rotation, because the contact forces of the first solution belong to it.
void IslandStep::holdRims(ContactIsland& s, const std::vector<SolverBody>& solved) const {
  std::vector<SolverBody> solverBodies = s.free;
  bool any = false;
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    const SolverBody& m = s.end[i];
    if (m.v.norm() + m.omega.norm() * s.set[i]->reach > kNearlyStill) continue;
    Mat3 free = Mat3::Identity();  // the axes that it may still turn about
    bool stopped = true;
    for (const FoundContact& f : s.found) {
      const SolverContact& c = f.contact;
      if (f.carrier != (c.a == i ? Carrier::A : Carrier::B) || (c.a != i && c.b != i) || c.impulse[0] <= 0 ||
          f.surface.rolling <= 0 || f.rounding.axis.isZero(0))
        continue;
      const Vec3 r = (f.rounding.axis - f.gap.normal * f.gap.normal.dot(f.rounding.axis)).normalized();
      stopped = stopped &&
                std::fabs(r.dot(m.omega)) <= kMostSpinLeft * std::fabs(r.dot(solved[i].omega)) + kUnmoved;
      if (const Vec3 more = free * r; more.norm() > kMostSpinLeft)
        free -= more.normalized() * more.normalized().transpose();
    }
    if (!stopped || free.isIdentity()) continue;
    any = true;
    solverBodies[i].inverseInertia = free * solverBodies[i].inverseInertia * free;
    solverBodies[i].omega = free * solverBodies[i].omega;
  }
  if (!any) return;
  std::vector<SolverContact> contacts;
  const std::size_t points = s.found.size();
  for (const FoundContact& f : s.found) contacts.push_back(f.contact);
  for (const FlatPatch& f : s.flats) contacts.push_back(f.contact);
  solveIsland(s, solverBodies, contacts, Effort::Moving);
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    s.end[i].v = solverBodies[i].v;
    s.end[i].omega = solverBodies[i].omega;
  }
  for (std::size_t i = 0; i < points; ++i) s.found[i].contact = contacts[i];
  for (std::size_t i = points; i < contacts.size(); ++i) s.flats[i - points].contact = contacts[i];
}

/// Nothing is near any more: it flies.
void IslandStep::concludeFreely(RigidBody& b, const SolverBody& start, double tau) {
  const Quat q = b.orientation(tau);
  waking_.wakeOnto({true, b.id}, tau);
  arcs_.startFlight(b, tau, start.p, start.v, q, q * b.inertia.cwiseProduct(q.conjugate() * start.omega));
}

/// A ball on one still face has a closed form.
bool IslandStep::settleOnFace(RigidBody& b, const FoundContact& only, double tau) {
  const Collider* c = only.b.isBody ? nullptr : objects_.collider(only.b.id);
  Support face;
  if (!c || std::fabs(only.gap.distance) > 2 * kIslandSlop ||
      std::fabs(b.velocity(tau).dot(only.gap.normal)) > 1e-3 || !supportFor(b, *c, only.gap, face) ||
      face.ends(b.position(tau), b.velocity(tau)) || inFold(b, *c, face, tau))
    return false;
  b.support = face;
  BallStart s{b.position(tau), b.velocity(tau), b.angularVelocity(tau), b.orientation(tau)};
  s.v -= face.normal * face.normal.dot(s.v);
  arcs_.startOnFace(b, tau, s, false, false);
  return true;
}

/// How long it has hardly moved, and whether it has been getting nowhere meanwhile and not gaining or losing
/// speed. Each look takes twice as long as the last one, so that what only trembles is found out to be in
/// balance.
void IslandStep::noteQuiet(RigidBody& b, const SolverBody& start, const SolverBody& end, double tau,
                           double h) const {
  const double before = b.contact.quietTime;
  const double fastest =
      std::max(end.v.norm() + end.omega.norm() * b.reach, start.v.norm() + start.omega.norm() * b.reach);
  b.contact.quietTime = fastest < kQuietSpeed ? before + h : 0;
  const auto look = [&](const SolverBody& from, double since, double span, bool balanced) {
    b.contact.sleepCandidate = {from.v, from.omega, since, span, balanced};
    b.contact.drift.setZero();
    b.contact.twist.setZero();
  };
  if (!(before > kQuietInGlide)) look(start, 0, kSleepsAfter, false);
  b.contact.drift += 0.5 * h * (start.v + end.v);
  b.contact.twist += 0.5 * h * (start.omega + end.omega);
  const double seconds = b.contact.quietTime - b.contact.sleepCandidate.since;
  if (seconds < b.contact.sleepCandidate.span) return;
  const double change = (end.v - b.contact.sleepCandidate.v).norm() +
                        (end.omega - b.contact.sleepCandidate.omega).norm() * b.reach;
  const double pull = fields_.accelerationAt(b, start.p, start.v, tau).norm();
  const double way = b.contact.drift.norm() + b.contact.twist.norm() * b.reach;
  look(end, b.contact.quietTime, 2 * b.contact.sleepCandidate.span,
       change <= kBalance * (1 + pull) * seconds && way <= kCreep * seconds);
}

/// The bodies' arcs of h seconds, and the forces as a guess for the next step.
void IslandStep::conclude(ContactIsland& s, double tau, double h) {
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    RigidBody& b = *s.set[i];
    b.contact.touching.clear();
    b.contact.warmStarts.clear();
    std::vector<ContactSide> near;
    const FoundContact* only = nullptr;
    int points = 0;
    const auto note = [](std::vector<ContactSide>& list, ContactSide p) {
      if (std::find(list.begin(), list.end(), p) == list.end()) list.push_back(p);
    };
    for (const FoundContact& f : s.found) {
      if (f.contact.a != i && f.contact.b != i) continue;
      ++points;
      only = &f;
      const ContactSide other = f.contact.a == i ? f.b : f.a;
      note(b.contact.touching, other);
      if (f.gap.distance < kTouching) note(near, other);
      if (f.contact.a == i && !f.contact.impulse.isZero(0))
        b.contact.warmStarts.push_back({f.key, basisAround(f.gap.normal) * (f.contact.impulse / h), h});
    }
    for (const ContactFinder::Beside& o : finder_.besideOf(b.id)) {
      note(b.contact.touching, o.piece);
      if (o.touches) note(near, o.piece);
    }
    for (const ContactSide p : s.way) note(b.contact.touching, p);
    for (const FlatPatch& f : s.flats)
      if (f.contact.a == i && !f.contact.impulse.isZero(0))
        b.contact.warmStarts.push_back({f.key, basisAround(f.flat.plane.n) * (f.contact.impulse / h), h});
    rememberTouching(memory_, b, near);
    if (points == 0) {
      concludeFreely(b, s.start[i], tau);
      continue;
    }
    const Quat q = b.orientation(tau);
    const SolverBody &start = s.start[i], &end = s.end[i];
    const Vec3 L0 = start.inverseInertia.inverse() * start.omega,
               L1 = end.inverseInertia.inverse() * end.omega;
    noteQuiet(b, start, end, tau, h);
    if (s.glides) b.contact.quietTime = b.contact.quietTime > 0 ? kQuietInGlide : 0;
    arcs_.setArc(b, tau, Path::parabola(start.p, start.v, (end.v - start.v) / h),
                 Spin::free(q, 0.5 * (L0 + L1), b.inertia), h, BodyMode::Contact);
    b.contact.endL = L1;
    b.contact.dueAge = h;
    if (points == 1 && b.isBall() && b.mode == BodyMode::Contact) settleOnFace(b, *only, tau);
  }
}

/// Even parts of h in which no body turns far: contact points of fast tops would leave their arcs. Nor does a
/// step go on, but for a moment, when it is not known any more how strong a field is that pulls; nor when a
/// corner that comes fast is down: that is an impact.
double IslandStep::stepOf(const ContactIsland& s, double tau, double h) const {
  for (const RigidBody* b : s.set) h = std::min(h, std::max(fields_.knownFor(*b, tau), kShortestStep));
  const double shortest = s.set.size() > 1 ? h / 8 : kLanding;
  for (const FoundContact& f : s.found) {
    if (f.gap.distance <= kIslandSlop) continue;
    const SolverBody &a = s.start[f.contact.a], &b = s.start[f.contact.b];
    const double closing =
        f.gap.normal.dot(b.v + b.omega.cross(f.gap.point - b.p) - a.v - a.omega.cross(f.gap.point - a.p));
    if (closing > kRestitutionSpeed && closing * h > f.gap.distance)
      h = std::min(h, std::max(f.gap.distance / closing, shortest));
  }
  double fastest = 0;
  for (std::size_t i = 0; i < s.set.size(); ++i)
    if (!s.set[i]->centred) fastest = std::max(fastest, s.start[i].omega.norm());
  double parts = std::ceil(fastest * h / kMostTurn);
  for (const FoundContact& f :
       s.found) {  // the flatter a disc, the faster its lowest point runs round its rim
    if (f.rounding.axis.isZero(0)) continue;
    const std::size_t i = f.carrier == Carrier::A ? f.contact.a : f.contact.b;
    const double lean = f.rounding.axis.cross(f.gap.normal).norm();
    if (lean < 0.5)
      parts =
          std::max(parts, std::min(kMostSubsteps, std::ceil(s.start[i].omega.norm() / lean * h / kMostTurn)));
  }
  return h / std::max(1.0, parts);
}

/// A pair in contact has no predicted touches. But where two surfaces meet in a valley, one more corner of the body
/// may come over the edge of a collider that another corner touches. The step ends when that corner is down.
double IslandStep::untilNextCorner(const ContactIsland& s, double tau, double h) const {
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    const RigidBody& b = *s.set[i];
    const SolverBody& m = s.start[i];
    const bool fast = m.v.norm() + m.omega.norm() * b.reach > kRestitutionSpeed;
    if (!fast || b.isBall() || !b.grip.recoveries.empty() || !isInValley(s, i)) continue;
    for (std::size_t k = 0; k < s.found.size(); ++k) {
      const FoundContact& f = s.found[k];
      if (f.contact.a != i || f.b.isBody || (k > 0 && s.found[k - 1].a == f.a && s.found[k - 1].b == f.b))
        continue;
      const Collider& c = *objects_.collider(f.b.id);
      if (!c.motion.moving) h = untilDown(s, k, c, b.at(tau).pose, h);
    }
  }
  return h;
}

void IslandStep::advance(ContactIsland& s, double tau, double h) {
  begin(s, tau);
  stopApproaches(s, tau);
  const double last = glide(s, tau, h);
  if (last == kForGood) {
    for (std::size_t i = 0; i < s.set.size(); ++i) {
      s.start[i].v.setZero();
      s.start[i].omega.setZero();
    }
    s.end = s.start;
    conclude(s, tau, h);
    for (RigidBody* b : s.set)
      if (b->mode == BodyMode::Contact) arcs_.freeze(*b, tau);
    return;
  }
  s.glides = last > 0;
  if (!s.glides) {
    h = untilNextCorner(s, tau, stepOf(s, tau, h));
    const bool holds = solveStep(s, tau, h, Effort::Moving);
    for (RigidBody* b : s.set) b->contact.unsolved = !holds;
    boundStep(s, h);
    const std::vector<SolverBody> solved = s.end;
    resistRolling(s);
    if (!s.carried) holdRims(s, solved);
  }
  const bool wedged = staysWedged(s);
  for (RigidBody* b : s.set) b->contact.wedged = wedged;
  conclude(s, tau, s.glides ? last : h);
  // Sets that have been quiet together fall asleep together.
  const bool quiet = !s.carried && std::ranges::all_of(s.set, [&](const RigidBody* b) {
    return b->mode == BodyMode::Contact && b->contact.quietTime >= kSleepsAfter &&
           b->contact.sleepCandidate.balanced && !fields_.feelsChange(*b);
  });
  if (quiet)
    for (RigidBody* b : s.set) arcs_.freeze(*b, tau);
}

}  // namespace stadion
