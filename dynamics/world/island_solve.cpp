#include "dynamics/world/island_step.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kPushOut = 0.2;     ///< speed limit of the correction of deeper overlap [m/s]
constexpr double kOneFace = 0.9999;  ///< cosine of normals that are one face's
constexpr double kTurns = 1e-8;      ///< slower surface points do not turn a body within a step [m/s]

/// How a body lies during a step, from its velocities at both ends.
struct TurnedPose {
  Vec3 p;
  Mat3 R;  ///< turn since the start
};

TurnedPose turned(const SolverBody& start, const SolverBody& end, double share, double h) {
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
void place(const SolverBody& a0, const SolverBody& b0, const Gap& gap, Carrier carrier,
           const Rounding& rounding, const TurnedPose& a, const TurnedPose& b, Mat3& basis, Vec3& armA,
           Vec3& armB) {
  basis = basisAround(gap.normal);
  armA = gap.point - a0.p;
  armB = gap.point - b0.p;
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

/// Places a flat contact at the end and in the middle of the step, and computes its slip before it.
void placeFlat(const FlatPatch& f, const std::vector<SolverBody>& start, const std::vector<SolverBody>& guess,
               double h, bool first, SolverContact& c) {
  const SolverBody &a = start[c.a], &b = start[c.b];
  SolverContact before = c;
  f.place(a, b, Mat3::Identity(), Mat3::Identity(), a.p, b.p, before.rows, before.armA, before.armB);
  const Vec3 u0 = before.velocity(start);
  c.spin = u0[0];
  c.slip = u0.tail<2>();
  const TurnedPose am = turned(a, guess[c.a], 0.5, h), bm = turned(b, guess[c.b], 0.5, h),
                   ae = turned(a, guess[c.a], 1, h), be = turned(b, guess[c.b], 1, h);
  f.place(a, b, am.R, bm.R, am.p, bm.p, c.push, c.pushA, c.pushB);
  f.place(a, b, ae.R, be.R, ae.p, be.p, c.rows, c.armA, c.armB);
  if (!first) c.slides = u0.norm() > 2 * (c.velocity(guess) - u0).norm();
}

double pushOut(double gap) {
  return std::min(kPushOut, std::max(0.0, -gap - kIslandSlop) * 20);
}

/// The speed at which overlap is taken back [m/s]. Points of one face go at one speed, the mean of theirs: if
/// each had its own, three of them would contradict the fourth.
double pushOutOf(const std::vector<FoundContact>& found, std::size_t i) {
  const FoundContact& f = found[i];
  double sum = 0, many = 0;
  if (!(pushOut(f.gap.distance) > 0)) return 0;
  for (const FoundContact& o : found)
    if (o.a == f.a && o.b == f.b && o.gap.normal.dot(f.gap.normal) > kOneFace)
      if (const double speed = pushOut(o.gap.distance); speed > 0) {
        sum += speed;
        many += 1;
      }
  return sum / many;
}

/// A point at the end and in the middle of the step, its slip before it and the speed that it asks for.
void placePoint(const ContactIsland& s, std::size_t i, const std::vector<SolverBody>& guess, double h,
                bool first, SolverContact& c) {
  const FoundContact& f = s.found[i];
  const SolverBody &a = s.start[c.a], &b = s.start[c.b], &a1 = guess[c.a], &b1 = guess[c.b];
  place(a, b, f.gap, f.carrier, f.rounding, turned(a, a1, 0.5, h), turned(b, b1, 0.5, h), c.push, c.pushA,
        c.pushB);
  place(a, b, f.gap, f.carrier, f.rounding, turned(a, a1, 1, h), turned(b, b1, 1, h), c.rows, c.armA, c.armB);
  SolverContact before = c;
  before.placeAt(f.gap.point, f.gap.normal, a.p, b.p);
  const Vec3 u0 = before.velocity(s.start);
  if (f.gap.distance > kIslandSlop) {
    // The mean velocity of the step closes the gap and no more. Among several bodies what comes faster
    // sinks in a little rather than being thrown back from all sides at once, which could bring energy.
    c.floor = std::min(-2 * f.gap.distance / h - u0[0], s.set.size() > 1 ? kPushOut : 1e300);
  } else {
    c.floor = pushOutOf(s.found, i);
  }
  c.slip = u0.tail<2>();
  if (!first) {
    const Vec2 u1 = c.velocity(guess).tail<2>();
    c.slides = c.slip.norm() > 2 * (u1 - c.slip).norm();
  }
}

/// Returns true if a body turns in the step.
bool anyTurns(const ContactIsland& s) {
  for (std::size_t i = 0; i < s.set.size(); ++i)
    if (std::max(s.start[i].omega.norm(), s.end[i].omega.norm()) * s.set[i]->reach > kTurns) return true;
  return false;
}

/// Returns true if the direction of a slip changes in the step.
bool anySlipTurns(const ContactIsland& s, const std::vector<SolverContact>& step) {
  return std::ranges::any_of(step, [&](const SolverContact& c) {
    const Vec2 u0 = c.slip, u1 = c.velocity(s.end).tail<2>();
    return std::fabs(u0.x() * u1.y() - u0.y() * u1.x()) > 1e-9 * u0.squaredNorm() + 1e-16;
  });
}

}  // namespace

/// What `end` would be without contacts, and the pull on the bodies.
void IslandStep::moveFreely(ContactIsland& s, const std::vector<SolverBody>& guess, double tau, double h,
                            bool first) const {
  s.end = s.start;
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    const RigidBody& b = *s.set[i];
    SolverBody& m = s.end[i];
    const TurnedPose at = turned(s.start[i], guess[i], 1, h);
    if (!first && !fields_.uniformFor(b)) {
      const TurnedPose mid = turned(s.start[i], guess[i], 0.5, h);
      s.pull[i] = fields_.accelerationAt(b, mid.p, 0.5 * (s.start[i].v + guess[i].v), tau + 0.5 * h);
    }
    m.v += h * s.pull[i];
    if (b.damping > 0) m.v *= det::exp(-b.damping * h);
    if (!m.omega.isZero(0) || !first) {  // its angular momentum stays, its inertia turns with it
      const Mat3 turnedInverse = at.R * m.inverseInertia * at.R.transpose();
      if (!b.isBall() && !m.omega.isZero(0))
        m.omega = turnedInverse * s.start[i].inverseInertia.inverse() * m.omega;
      m.inverseInertia = turnedInverse;
    }
  }
}

/// Velocities after h seconds: forces act in the middle of the step, contact points apply at its end. A first
/// pass foresees how the bodies turn, a second one counts.
bool IslandStep::solveStep(ContactIsland& s, double tau, double h, Effort effort) const {
  std::vector<SolverBody> guess = s.start;
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
    for (const WarmStart& p : s.set[c.a]->contact.warmStarts)
      if (p.key == key) c.impulse = std::min(h, p.step) * (basisAround(n).transpose() * p.force);
    // Its area rubs now, or nothing does. What has turned may have had its force along this face.
    if (c.patch >= 0 || (c.friction == 0 && !c.area)) c.impulse.tail<2>().setZero();
    step.push_back(c);
  };
  for (const FoundContact& f : s.found) begins(f.contact, f.key, f.gap.normal);
  for (const FlatPatch& f : s.flats) begins(f.contact, f.key, f.flat.plane.n);
  bool holds = false;
  for (int pass = 0; pass < 2; ++pass) {
    moveFreely(s, guess, tau, h, pass == 0);
    for (std::size_t i = points; i < step.size(); ++i)
      placeFlat(s.flats[i - points], s.start, guess, h, pass == 0, step[i]);
    for (std::size_t i = 0; i < points; ++i) placePoint(s, i, guess, h, pass == 0, step[i]);
    s.free = s.end;
    holds = solveIsland(s, s.end, step, effort);
    const auto varies = [&](const RigidBody* b) { return !fields_.uniformFor(*b); };
    if (!anyTurns(s) && std::ranges::none_of(s.set, varies) && !anySlipTurns(s, step)) break;
    guess = s.end;
    for (std::size_t i = 0; i < guess.size(); ++i) guess[i].p = s.start[i].p;
  }
  for (std::size_t i = 0; i < points; ++i) s.found[i].contact = step[i];
  for (std::size_t i = points; i < step.size(); ++i) s.flats[i - points].contact = step[i];
  return holds;
}

}  // namespace stadion
