#include "dynamics/world/island_step.h"

#include "dynamics/contact/island_energy.h"
#include "dynamics/world/ball_support.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kSlop = 1e-5;             ///< overlap that is left alone [m]
constexpr double kPushOut = 0.2;           ///< speed limit of the correction of deeper overlap [m/s]
constexpr double kApproach = 1e-4;         ///< approaches up to this end with the step's own forces [m/s]
constexpr double kRestitutionSpeed = 0.1;  ///< slower approaches inside lasting contact do not bounce [m/s]
constexpr double kQuietSpeed = 2e-3;       ///< of surface points [m/s]
constexpr double kSleepsAfter = 0.2;       ///< before a set of bodies sleeps [s]
constexpr double kGliding = 1e-9;          ///< quiet time of one whose slow motion is known [s]
constexpr double kCreep = 1e-4;            ///< mean speeds below this are none [m/s]
constexpr double kCalm = 1e-5;             ///< mean accelerations below this are balance, per pull [m/s2]
constexpr double kRolls = 0.01;            ///< slip of what rolls, relative to how it turns
constexpr double kHeld = 0.05;             ///< of its spin, what rolls no more may have left
constexpr double kNearlyStill = 5e-3;      ///< faster than this nothing is held by rolling resistance [m/s]
constexpr double kUnmoved = 1e-9;          ///< slower than this is not at all [m/s]
constexpr double kBalanced = 1e-7;         ///< accelerations below this are rounding [m/s2]
constexpr double kProbe = 1e-4;            ///< step in which accelerations are measured [s]
constexpr double kMostTurn = 0.05;         ///< angle by which a solid turns in a step [rad]
constexpr double kMostParts = 32;          ///< of a step in which the lowest point of a rim runs far
constexpr double kFarthest = 1;            ///< how long a glide is foreseen at most [s]
constexpr double kShortestGlide = 1e-7;    ///< and at least [s]
constexpr double kGive = 1;                ///< share of what presses that a hand or a lift yields
constexpr double kOneFace = 0.9999;        ///< cosine of normals that are one face's
constexpr double kShort = 1e-3;            ///< a floor missed by less is reached, nearly [m/s]
constexpr double kLanding = 1e-5;          ///< shortest step towards a touch [s]

/// How a body lies during a step, from its velocities at both ends.
struct Turned {
  Vec3 p;
  Mat3 R;  ///< turn since the start
};

Turned turned(const Mobile& start, const Mobile& end, double share, double h) {
  const double s = share * h;
  const Vec3 w = s * (start.omega + 0.5 * share * (end.omega - start.omega));
  return {start.p + s * (start.v + 0.5 * share * (end.v - start.v)),
          w.isZero(0) ? Mat3(Mat3::Identity()) : det::expRotation(w).toRotationMatrix()};
}

/// Where the point of the carrier is that touches when the carrier has turned by R; `down` leads from it to
/// the other side, at the start and now.
Vec3 carried(const Vec3& arm, const Rounding& r, const Mat3& R, const Vec3& down, const Vec3& downNow) {
  if (r.radius == 0) return R * arm;
  return R * (arm - r.offset(down, r.axis)) + r.offset(downNow, R * r.axis);
}

/// Arms and basis of a contact when its sides lie like this.
void place(const Mobile& a0, const Mobile& b0, const Gap& gap, Carrier carrier, const Rounding& rounding,
           const Turned& a, const Turned& b, Mat3& basis, Vec3& armA, Vec3& armB) {
  basis = basisAround(gap.normal);
  armA = gap.point - a0.p, armB = gap.point - b0.p;
  if (carrier == Carrier::B) {
    basis = a.R * basis;
    armB = carried(armB, rounding, b.R, gap.normal, basis.col(0));
    armA = b.p + armB - a.p;
  } else {
    if (carrier == Carrier::A) {
      basis = b.R * basis;
      armA = carried(armA, rounding, a.R, -gap.normal, -basis.col(0));
    }
    armB = a.p + armA - b.p;
  }
}

/// The same for a flat contact, at the end and in the middle of the step, and its slip before it.
template <class Flat>
void placeFlat(const Flat& f, const std::vector<Mobile>& start, const std::vector<Mobile>& guess, double h,
               SolverContact& c) {
  const Mobile &a = start[c.a], &b = start[c.b];
  SolverContact before = c;
  f.place(a, b, Mat3::Identity(), Mat3::Identity(), a.p, b.p, before.rows, before.armA, before.armB);
  const Vec3 u0 = before.velocity(start);
  c.spin = u0[0], c.slip = u0.tail<2>();
  const Turned am = turned(a, guess[c.a], 0.5, h), bm = turned(b, guess[c.b], 0.5, h),
               ae = turned(a, guess[c.a], 1, h), be = turned(b, guess[c.b], 1, h);
  f.place(a, b, am.R, bm.R, am.p, bm.p, c.push, c.pushA, c.pushB);
  f.place(a, b, ae.R, be.R, ae.p, be.p, c.rows, c.armA, c.armB);
}

double pushOut(double gap) {
  return std::min(kPushOut, std::max(0.0, -gap - kSlop) * 20);
}

/// The speed at which overlap is taken back [m/s]. Points of one face go at one speed, the mean of theirs: if
/// each had its own, three of them would contradict the fourth.
double pushOutOf(const std::vector<FoundContact>& found, std::size_t i) {
  const FoundContact& f = found[i];
  double sum = 0, many = 0;
  if (!(pushOut(f.gap.distance) > 0)) return 0;
  for (const FoundContact& o : found)
    if (o.a == f.a && o.b == f.b && o.gap.normal.dot(f.gap.normal) > kOneFace)
      if (const double speed = pushOut(o.gap.distance); speed > 0) sum += speed, many += 1;
  return sum / many;
}

bool staysWedged(const ContactIsland& s) {
  return s.wedged && std::ranges::any_of(s.found, [&](const FoundContact& f) {
           return f.contact.give > 0 && f.contact.velocity(s.end)[0] < f.contact.floor - kShort;
         });
}

/// The step's forces bring no energy but what takes back overlap.
void boundStep(ContactIsland& s, double h) {
  if (s.carried) return;
  const std::size_t n = s.set.size();
  double speed = 0;
  for (const FoundContact& f : s.found) speed = std::max(speed, f.contact.floor);
  const double allowed = pushOutWork(n, s.start, s.pull, h, speed);
  for (Vec3& a : s.pull) a *= 0.5 * h;
  boundWork(n, s.free, s.end, s.pull, allowed);
}

/// Rolling resistance takes spin, up to c r N, from balls, and from rods and discs that roll.
void resistRolling(ContactIsland& s) {
  const auto resist = [&](std::size_t i, const FoundContact& f, Carrier side) {
    if (i >= s.set.size()) return;
    const bool ball = s.set[i]->isBall(), round = f.carrier == side;
    const double radius = ball ? s.set[i]->radius() : round ? f.rounding.radius : 0;
    Mobile& m = s.end[i];
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
    const double carried = rolls ? (arm - axis * axis.dot(arm)).squaredNorm() / m.inverseMass : 0;
    const Vec3 change = std::min(most / (inertia + carried), w) * inertia * turn;
    m.omega -= change;
    if (rolls) m.v -= change.cross(arm);
  };
  for (const FoundContact& f : s.found) {
    if (f.contact.impulse[0] <= 0 || f.surface.rolling <= 0) continue;
    resist(f.contact.a, f, Carrier::A), resist(f.contact.b, f, Carrier::B);
  }
}

/// Whether another face of the mesh is in the way of a ball that would go on along this one.
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
  box.lo = centre.array() - reach, box.hi = centre.array() + reach;
  std::vector<std::uint32_t> near;
  mesh->tree.overlapping(box, near);
  return std::ranges::any_of(near, [&](std::uint32_t i) {
    if (static_cast<std::int32_t>(i) == face.triangle) return false;
    const Vec3 from = centre - closestPoint(mesh->tree.triangles()[i], centre).point;
    const double distance = from.norm();
    return distance < reach && from.dot(local) < -kClosingIn * distance;
  });
}

}  // namespace

/// Velocities at the start, and the sides of each contact.
void IslandStep::begin(ContactIsland& s, double tau) const {
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    RigidBody& b = *s.set[i];
    b.contact.slot = static_cast<std::uint32_t>(i);
    s.start.push_back(mobileOf(b, tau));
    s.wedged = s.wedged || b.contact.wedged;
  }
  for (FoundContact& f : s.found) {
    SolverContact& c = f.contact;
    c.a = objects_.body(f.a.id)->contact.slot;
    if (f.b.isBody && objects_.body(f.b.id)->mode == BodyMode::Contact &&
        !objects_.body(f.b.id)->contact.crowd) {
      c.b = objects_.body(f.b.id)->contact.slot;
      continue;
    }
    const auto known = std::find(s.fixed.begin(), s.fixed.end(), f.b);
    c.b = static_cast<std::uint32_t>(s.set.size() + static_cast<std::size_t>(known - s.fixed.begin()));
    if (known != s.fixed.end()) continue;
    s.fixed.push_back(f.b);
    Mobile m = f.b.isBody ? mobileOf(*objects_.body(f.b.id), tau) : mobileOf(*objects_.collider(f.b.id), tau);
    m.inverseMass = 0, m.inverseInertia.setZero();
    s.carried = s.carried || !m.v.isZero(0) || !m.omega.isZero(0);
    s.start.push_back(m);
  }
  findFlats(s, tau);
}

/// Whether it moves from outside, or may.
bool IslandStep::isDriven(Party p) const {
  if (p.isBody) return !objects_.body(p.id)->movable();
  return objects_.collider(p.id)->motion.moving;
}

/// Between a hand, or a lift, and what does not move no velocities may be left: then the hand's contacts give
/// way, here and in the next steps, until all floors can be reached again.
bool IslandStep::solveIsland(ContactIsland& s, std::vector<Mobile>& mobiles,
                             std::vector<SolverContact>& contacts, Effort effort) const {
  std::vector<SolverContact> yielding = contacts;
  bool driven = false;
  for (SolverContact& c : yielding) {
    if (c.b < s.set.size() || !isDriven(s.fixed[c.b - s.set.size()])) continue;
    c.give = kGive, driven = true;
  }
  if (!driven) return solveContacts(mobiles, contacts, effort);
  if (!s.wedged) {
    const std::vector<Mobile> before = mobiles;
    if (solveContacts(mobiles, contacts, effort)) return true;
    mobiles = before, s.wedged = true;
  }
  contacts = yielding;
  return solveContacts(mobiles, contacts, effort);
}

/// What is an impact: approaches that end now, with restitution if they are fast.
void IslandStep::stopApproaches(ContactIsland& s) const {
  bool any = false;
  std::vector<SolverContact> hits;
  std::vector<std::int32_t> hitOf(s.found.size(), -1);
  for (const FoundContact& f : s.found) {
    if (f.gap.distance > kSlop) continue;
    hitOf[static_cast<std::size_t>(&f - s.found.data())] = static_cast<std::int32_t>(hits.size());
    SolverContact c = f.contact;
    const Mobile &a = s.start[c.a], &b = s.start[c.b];
    c.placeAt(f.gap.point, f.gap.normal, a.p, b.p);
    c.impulse.setZero(), c.slides = false;
    const double closing = -c.velocity(s.start)[0];
    c.floor = closing > kRestitutionSpeed ? f.surface.restitution * closing : 0;
    any = any || closing > kApproach;
    hits.push_back(c);
  }
  if (!any) return;
  for (SolverContact& c : hits) c.patch = -1;
  for (const FlatPatch& f : s.flats) {
    SolverContact c = f.contact;
    const Mobile &a = s.start[c.a], &b = s.start[c.b];
    f.place(a, b, Mat3::Identity(), Mat3::Identity(), a.p, b.p, c.rows, c.armA, c.armB);
    c.push = c.rows, c.pushA = c.armA, c.pushB = c.armB;
    c.impulse.setZero(), c.slides = false;
    for (const std::size_t k : f.points)
      if (hitOf[k] >= 0)
        hits[static_cast<std::size_t>(hitOf[k])].patch = static_cast<std::int32_t>(hits.size());
    hits.push_back(c);
  }
  const std::vector<Mobile> before = s.start;
  solveIsland(s, s.start, hits, Effort::Moving);
  if (!s.carried) boundWork(s.set.size(), before, s.start, {}, 0);
}

/// Velocities after h seconds: forces act in the middle of the step, contact points obey at its end. A first
/// pass foresees how the bodies turn, a second one counts.
bool IslandStep::solveStep(ContactIsland& s, double tau, double h, Effort effort) const {
  std::vector<Mobile> guess = s.start;
  std::vector<Vec3>& pull = s.pull;
  pull.resize(s.set.size());
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    pull[i] = fields_.accelerationAt(*s.set[i], guess[i].p, guess[i].v, tau);
    guess[i].v += h * pull[i];
  }
  std::vector<SolverContact> step;
  const std::size_t points = s.found.size();
  step.reserve(points + s.flats.size());
  const auto begins = [&](SolverContact c, std::uint64_t key, const Vec3& n) {
    c.impulse.setZero();
    for (const Pressed& p : s.set[c.a]->contact.presses)
      if (p.key == key) c.impulse = std::min(h, p.step) * (basisAround(n).transpose() * p.force);
    if (c.patch >= 0) c.impulse.tail<2>().setZero();  // its area's now
    step.push_back(c);
  };
  for (const FoundContact& f : s.found) begins(f.contact, f.key, f.gap.normal);
  for (const FlatPatch& f : s.flats) begins(f.contact, f.key, f.flat.plane.n);
  bool holds = false;
  for (int pass = 0; pass < 2; ++pass) {
    s.end = s.start;
    for (std::size_t i = 0; i < s.set.size(); ++i) {
      const RigidBody& b = *s.set[i];
      Mobile& m = s.end[i];
      const Turned at = turned(s.start[i], guess[i], 1, h);
      if (pass > 0 && !fields_.uniformFor(b)) {
        const Turned mid = turned(s.start[i], guess[i], 0.5, h);
        pull[i] = fields_.accelerationAt(b, mid.p, 0.5 * (s.start[i].v + guess[i].v), tau + 0.5 * h);
      }
      m.v += h * pull[i];
      if (b.damping > 0) m.v *= det::exp(-b.damping * h);
      if (!m.omega.isZero(0) || pass > 0) {  // its angular momentum stays, its inertia turns with it
        const Mat3 turnedInverse = at.R * m.inverseInertia * at.R.transpose();
        if (!b.isBall() && !m.omega.isZero(0))
          m.omega = turnedInverse * s.start[i].inverseInertia.inverse() * m.omega;
        m.inverseInertia = turnedInverse;
      }
    }
    for (std::size_t i = points; i < step.size(); ++i) {
      SolverContact& c = step[i];
      placeFlat(s.flats[i - points], s.start, guess, h, c);
      if (pass > 0) {
        const Vec3 u0(c.spin, c.slip.x(), c.slip.y());
        c.slides = u0.norm() > 2 * (c.velocity(guess) - u0).norm();
      }
    }
    for (std::size_t i = 0; i < points; ++i) {
      const FoundContact& f = s.found[i];
      SolverContact& c = step[i];
      const Mobile &a = s.start[c.a], &b = s.start[c.b], &a1 = guess[c.a], &b1 = guess[c.b];
      place(a, b, f.gap, f.carrier, f.rounding, turned(a, a1, 0.5, h), turned(b, b1, 0.5, h), c.push, c.pushA,
            c.pushB);
      place(a, b, f.gap, f.carrier, f.rounding, turned(a, a1, 1, h), turned(b, b1, 1, h), c.rows, c.armA,
            c.armB);
      SolverContact before = c;
      before.placeAt(f.gap.point, f.gap.normal, a.p, b.p);
      const Vec3 u0 = before.velocity(s.start);
      if (f.gap.distance > kSlop) {
        // The mean velocity of the step closes the gap and no more. Among several bodies what comes faster
        // sinks in a little rather than being thrown back from all sides at once, which could bring energy.
        c.floor = std::min(-2 * f.gap.distance / h - u0[0], s.set.size() > 1 ? kPushOut : 1e300);
      } else {
        c.floor = pushOutOf(s.found, i);
      }
      c.slip = u0.tail<2>();
      if (pass > 0) {
        const Vec2 u1 = c.velocity(guess).tail<2>();
        c.slides = c.slip.norm() > 2 * (u1 - c.slip).norm();
      }
    }
    s.free = s.end;
    holds = solveIsland(s, s.end, step, effort);
    bool turns = false;
    for (std::size_t i = 0; i < s.set.size(); ++i)
      turns = turns || std::max(s.start[i].omega.norm(), s.end[i].omega.norm()) * s.set[i]->reach > 1e-8 ||
              !fields_.uniformFor(*s.set[i]);
    for (std::size_t i = 0; i < step.size() && !turns; ++i) {
      const Vec2 u0 = step[i].slip, u1 = step[i].velocity(s.end).tail<2>();
      turns = std::fabs(u0.x() * u1.y() - u0.y() * u1.x()) > 1e-9 * u0.squaredNorm() + 1e-16;
    }
    if (!turns) break;
    guess = s.end;
    for (std::size_t i = 0; i < guess.size(); ++i) guess[i].p = s.start[i].p;
  }
  for (std::size_t i = 0; i < points; ++i) s.found[i].contact = step[i];
  for (std::size_t i = points; i < step.size(); ++i) s.flats[i - points].contact = step[i];
  return holds;
}

/// Bodies that do not turn, on faces that they do not leave, keep their accelerations until a slip ends: how
/// long that lasts, 0 if not even for this step, infinite if all are at rest for good.
double IslandStep::glide(ContactIsland& s, double tau, double h) {
  if (s.carried) return 0;
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    const RigidBody& b = *s.set[i];
    if (s.start[i].omega.norm() * b.reach > kUnmoved || b.damping > 0) return 0;
  }
  for (const FoundContact& f : s.found)
    if (f.gap.distance < -kSlop) return 0;  // it is being pushed out
  const double probe = std::min(h, kProbe);
  if (!solveStep(s, tau, probe, Effort::AtRest)) return 0;
  double most = kFarthest, fastest = 0, strongest = 0;
  std::vector<Party> way;  // of faces that the points come to
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    const RigidBody& b = *s.set[i];
    const Vec3 a = (s.end[i].v - s.start[i].v) / probe;
    const double alpha = (s.end[i].omega - s.start[i].omega).norm() / probe * b.reach;
    if (alpha > kBalanced) return 0;
    fastest = std::max(fastest, s.start[i].v.norm()), strongest = std::max(strongest, a.norm());
    if (!fields_.uniformFor(b) && (s.start[i].v.norm() > kUnmoved || a.norm() > kBalanced)) return 0;
  }
  if (fastest <= kUnmoved && strongest <= kBalanced)  // what changes may stir them in this very frame
    return std::ranges::any_of(s.set, [&](const RigidBody* b) { return fields_.feelsChange(*b); }) ? 0
                                                                                                   : 1e300;
  for (const FoundContact& f : s.found) {
    const SolverContact& c = f.contact;
    const Vec3 n = f.gap.normal, u = s.start[c.a].v - s.start[c.b].v,
               a = (s.end[c.a].v - s.end[c.b].v - u) / probe;
    const double un = u.dot(n), an = a.dot(n);
    if (un < -kUnmoved || an < -kBalanced) return 0;  // what nears it may hit it
    if (un > kUnmoved || an > kBalanced || c.impulse[0] <= 0) continue;
    const Vec3 ut = u - un * n, at = a - an * n;
    const double speed = ut.norm(), change = at.norm();
    if (speed <= kUnmoved && change <= kBalanced) continue;
    if (ut.cross(at).norm() > 1e-9 * speed * (change + 1)) return 0;  // the slip turns
    if (ut.dot(at) < 0 && c.friction > 0) most = std::min(most, speed / change);
    // Faces must go on carrying the same points.
    if (f.b.isBody || f.carrier != Carrier::A) return 0;
    most = std::min(most,
                    surfaces_.timeCarried(*s.set[c.a], f.b.id, f.gap, f.contact.friction, ut, at, most, way));
    if (!(most > kShortestGlide)) return 0;
  }
  if (!(most > kShortestGlide)) return 0;
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    s.start[i].omega.setZero(), s.end[i].omega.setZero();
    s.end[i].v = s.start[i].v + (s.end[i].v - s.start[i].v) / probe * most;
  }
  for (FoundContact& f : s.found) f.contact.impulse *= most / probe;
  s.way = std::move(way);
  for (FlatPatch& f : s.flats) f.contact.impulse *= most / probe;
  return most;
}

/// What lies on its rims, and is kept from rocking on them by rolling resistance, is solved for once more
/// without that freedom: what the contacts asked for belonged to the spin that has been taken from it.
void IslandStep::holdRims(ContactIsland& s, const std::vector<Mobile>& solved) const {
  std::vector<Mobile> mobiles = s.free;
  bool any = false;
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    const Mobile& m = s.end[i];
    if (m.v.norm() + m.omega.norm() * s.set[i]->reach > kNearlyStill) continue;
    Mat3 free = Mat3::Identity();  // the axes that it may still turn about
    bool stopped = true;
    for (const FoundContact& f : s.found) {
      const SolverContact& c = f.contact;
      if (f.carrier != (c.a == i ? Carrier::A : Carrier::B) || (c.a != i && c.b != i) || c.impulse[0] <= 0 ||
          f.surface.rolling <= 0 || f.rounding.axis.isZero(0))
        continue;
      const Vec3 r = (f.rounding.axis - f.gap.normal * f.gap.normal.dot(f.rounding.axis)).normalized();
      stopped = stopped && std::fabs(r.dot(m.omega)) <= kHeld * std::fabs(r.dot(solved[i].omega)) + kUnmoved;
      if (const Vec3 more = free * r; more.norm() > kHeld)
        free -= more.normalized() * more.normalized().transpose();
    }
    if (!stopped || free.isIdentity()) continue;
    any = true;
    mobiles[i].inverseInertia = free * mobiles[i].inverseInertia * free;
    mobiles[i].omega = free * mobiles[i].omega;
  }
  if (!any) return;
  std::vector<SolverContact> contacts;
  const std::size_t points = s.found.size();
  for (const FoundContact& f : s.found) contacts.push_back(f.contact);
  for (const FlatPatch& f : s.flats) contacts.push_back(f.contact);
  solveIsland(s, mobiles, contacts, Effort::Moving);
  for (std::size_t i = 0; i < s.set.size(); ++i) s.end[i].v = mobiles[i].v, s.end[i].omega = mobiles[i].omega;
  for (std::size_t i = 0; i < points; ++i) s.found[i].contact = contacts[i];
  for (std::size_t i = points; i < contacts.size(); ++i) s.flats[i - points].contact = contacts[i];
}

/// Nothing is near any more: it flies.
void IslandStep::concludeFreely(RigidBody& b, const Mobile& start, double tau) {
  const Quat q = b.orientation(tau);
  waking_.wakeOnto({true, b.id}, tau);
  arcs_.startFlight(b, tau, start.p, start.v, q, q * b.inertia.cwiseProduct(q.conjugate() * start.omega));
}

/// A ball on one still face has a closed form.
bool IslandStep::settleOnFace(RigidBody& b, const FoundContact& only, double tau) {
  const Collider* c = only.b.isBody ? nullptr : objects_.collider(only.b.id);
  Support face;
  if (!c || std::fabs(only.gap.distance) > 2 * kSlop ||
      std::fabs(b.velocity(tau).dot(only.gap.normal)) > 1e-3 || !supportFor(b, *c, only.gap, face) ||
      face.ends(b.position(tau), b.velocity(tau)) || inFold(b, *c, face, tau))
    return false;
  b.support = face;
  BallStart s{b.position(tau), b.velocity(tau), b.spin.angularVelocity(b.spinAge(tau)), b.orientation(tau)};
  s.v -= face.normal * face.normal.dot(s.v);
  arcs_.startOnFace(b, tau, s, false, false);
  return true;
}

/// How long it has hardly moved, and whether it has been getting nowhere meanwhile and not gaining or losing
/// speed. Each look takes twice as long as the last one, so that what only trembles is found out to be in
/// balance.
void IslandStep::noteQuiet(RigidBody& b, const Mobile& start, const Mobile& end, double tau, double h) const {
  const double before = b.contact.quiet;
  const double fastest =
      std::max(end.v.norm() + end.omega.norm() * b.reach, start.v.norm() + start.omega.norm() * b.reach);
  b.contact.quiet = fastest < kQuietSpeed ? before + h : 0;
  const auto look = [&](const Mobile& from, double since, double span, bool balanced) {
    b.contact.calm = {from.v, from.omega, since, span, balanced};
    b.contact.drift.setZero(), b.contact.twist.setZero();
  };
  if (!(before > kGliding)) look(start, 0, kSleepsAfter, false);
  b.contact.drift += 0.5 * h * (start.v + end.v), b.contact.twist += 0.5 * h * (start.omega + end.omega);
  const double seconds = b.contact.quiet - b.contact.calm.since;
  if (seconds < b.contact.calm.span) return;
  const double change =
      (end.v - b.contact.calm.v).norm() + (end.omega - b.contact.calm.omega).norm() * b.reach;
  const double pull = fields_.accelerationAt(b, start.p, start.v, tau).norm();
  const double way = b.contact.drift.norm() + b.contact.twist.norm() * b.reach;
  look(end, b.contact.quiet, 2 * b.contact.calm.span,
       change <= kCalm * (1 + pull) * seconds && way <= kCreep * seconds);
}

/// The bodies' arcs of h seconds, and the forces as a guess for the next step.
void IslandStep::conclude(ContactIsland& s, double tau, double h) {
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    RigidBody& b = *s.set[i];
    b.contact.touching.clear(), b.contact.presses.clear();
    std::vector<Party> near;
    const FoundContact* only = nullptr;
    int points = 0;
    const auto note = [](std::vector<Party>& list, Party p) {
      if (std::find(list.begin(), list.end(), p) == list.end()) list.push_back(p);
    };
    for (const FoundContact& f : s.found) {
      if (f.contact.a != i && f.contact.b != i) continue;
      ++points, only = &f;
      const Party other = f.contact.a == i ? f.b : f.a;
      note(b.contact.touching, other);
      if (f.gap.distance < kTouching) note(near, other);
      if (f.contact.a == i && !f.contact.impulse.isZero(0))
        b.contact.presses.push_back({f.key, basisAround(f.gap.normal) * (f.contact.impulse / h), h});
    }
    for (const ContactFinder::Beside& o : finder_.besideOf(b.id)) {
      note(b.contact.touching, o.piece);
      if (o.touches) note(near, o.piece);
    }
    for (const Party p : s.way) note(b.contact.touching, p);
    for (const FlatPatch& f : s.flats)
      if (f.contact.a == i && !f.contact.impulse.isZero(0))
        b.contact.presses.push_back({f.key, basisAround(f.flat.plane.n) * (f.contact.impulse / h), h});
    rememberTouching(memory_, b, near);
    if (points == 0) {
      concludeFreely(b, s.start[i], tau);
      continue;
    }
    const Quat q = b.orientation(tau);
    const Mobile &start = s.start[i], &end = s.end[i];
    const Vec3 L0 = start.inverseInertia.inverse() * start.omega,
               L1 = end.inverseInertia.inverse() * end.omega;
    noteQuiet(b, start, end, tau, h);
    if (s.glides) b.contact.quiet = b.contact.quiet > 0 ? kGliding : 0;
    arcs_.setArc(b, tau, Path::parabola(start.p, start.v, (end.v - start.v) / h),
                 Spin::free(q, 0.5 * (L0 + L1), b.inertia), h, BodyMode::Contact);
    b.contact.endL = L1, b.contact.dueAge = h;
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
    if (f.gap.distance <= kSlop) continue;
    const Mobile &a = s.start[f.contact.a], &b = s.start[f.contact.b];
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
          std::max(parts, std::min(kMostParts, std::ceil(s.start[i].omega.norm() / lean * h / kMostTurn)));
  }
  return h / std::max(1.0, parts);
}

void IslandStep::advance(ContactIsland& s, double tau, double h) {
  begin(s, tau);
  stopApproaches(s);
  const double last = glide(s, tau, h);
  if (last > 1e299) {
    for (std::size_t i = 0; i < s.set.size(); ++i) s.start[i].v.setZero(), s.start[i].omega.setZero();
    s.end = s.start;
    conclude(s, tau, h);
    for (RigidBody* b : s.set)
      if (b->mode == BodyMode::Contact) arcs_.freeze(*b, tau);
    return;
  }
  s.glides = last > 0;
  if (!s.glides) {
    h = stepOf(s, tau, h);
    const bool holds = solveStep(s, tau, h, Effort::Moving);
    for (RigidBody* b : s.set) b->contact.restless = !holds;
    boundStep(s, h);
    const std::vector<Mobile> solved = s.end;
    resistRolling(s);
    if (!s.carried) holdRims(s, solved);
  }
  const bool wedged = staysWedged(s);
  for (RigidBody* b : s.set) b->contact.wedged = wedged;
  conclude(s, tau, s.glides ? last : h);
  // Sets that have been quiet together fall asleep together.
  const bool quiet = !s.carried && std::ranges::all_of(s.set, [&](const RigidBody* b) {
    return b->mode == BodyMode::Contact && b->contact.quiet >= kSleepsAfter && b->contact.calm.balanced &&
           !fields_.feelsChange(*b);
  });
  if (quiet)
    for (RigidBody* b : s.set) arcs_.freeze(*b, tau);
}

}  // namespace stadion
