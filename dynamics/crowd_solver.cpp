#include "dynamics/crowd_solver.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr int kSweeps = 10, kCalming = 2;
constexpr double kSlop = 1e-4;        ///< overlap that is left alone [m]
constexpr double kShare = 0.2;        ///< of deeper overlap that a step removes
constexpr double kPushOut = 0.5;      ///< speed limit of that [m/s]
constexpr double kBounceSpeed = 0.5;  ///< slower approaches do not bounce [m/s]

double responseAlong(const CrowdBody& b, const Vec3& arm, const Vec3& n) {
  if (b.inverseMass == 0) return 0;
  const Vec3 c = arm.cross(n);
  return b.inverseMass +
         (b.roundInertia > 0 ? b.roundInertia * c.squaredNorm() : c.dot(b.inverseInertia * c));
}

Vec3 velocity(const CrowdBody& a, const CrowdBody& b, const CrowdContact& c) {
  return a.v + a.omega.cross(c.armA) - b.v - b.omega.cross(c.armB);
}

void prepare(CrowdContact& c, std::vector<CrowdBody>& bodies, double h) {
  CrowdBody &a = bodies[c.a], &b = bodies[c.b];
  const double kn = responseAlong(a, c.armA, c.n) + responseAlong(b, c.armB, c.n);
  const Vec3 t1 = (std::fabs(c.n.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()).cross(c.n).normalized(),
             t2 = c.n.cross(t1);
  const double k1 = responseAlong(a, c.armA, t1) + responseAlong(b, c.armB, t1),
               k2 = responseAlong(a, c.armA, t2) + responseAlong(b, c.armB, t2);
  const bool round = (a.roundInertia > 0 || a.inverseMass == 0) && (b.roundInertia > 0 || b.inverseMass == 0);
  const double kt = round ? k1 : k1 + k2;  // at least the greatest
  c.normalMass = kn > 0 ? 1 / kn : 0, c.tangentMass = kt > 0 ? 1 / kt : 0;
  const double closing = -velocity(a, b, c).dot(c.n);
  c.floor = c.gap > 0 ? -c.gap / h : std::min(kPushOut, std::max(0.0, -c.gap - kSlop) * kShare / h);
  c.calm = std::min(c.floor, 0.0);
  if (closing > kBounceSpeed && closing * h > c.gap) c.calm = c.restitution * closing;
  c.pressed = std::max(0.0, c.impulse.dot(c.n));
}

void relax(CrowdContact& c, std::vector<CrowdBody>& bodies, double floor) {
  CrowdBody &a = bodies[c.a], &b = bodies[c.b];
  const Vec3 u = velocity(a, b, c);
  const double un = u.dot(c.n);
  const double pressed = std::max(0.0, c.pressed + (floor - un) * c.normalMass);
  if (pressed == 0 && c.pressed == 0) return;
  const Vec3 held = c.impulse - c.n * c.impulse.dot(c.n);
  Vec3 f = held - c.tangentMass * (u - un * c.n);
  const double most = c.friction * pressed, size = f.squaredNorm();
  if (size > most * most) f *= most / std::sqrt(size);
  const Vec3 impulse = pressed * c.n + f, step = impulse - c.impulse;
  c.pressed = pressed, c.impulse = impulse;
  a.apply(step, c.armA), b.apply(-step, c.armB);
}

}  // namespace

void solveCrowd(std::vector<CrowdBody>& bodies, std::vector<CrowdContact>& contacts,
                const std::vector<Vec3>& pull, double h, std::vector<CrowdBody>& moved) {
  for (CrowdContact& c : contacts) prepare(c, bodies, h);
  for (std::size_t i = 0; i < pull.size(); ++i) bodies[i].v += h * pull[i];
  for (const CrowdContact& c : contacts)
    bodies[c.a].apply(c.impulse, c.armA), bodies[c.b].apply(-c.impulse, c.armB);
  for (int i = 0; i < kSweeps; ++i) {
    if (i % 2 == 0)
      for (CrowdContact& c : contacts) relax(c, bodies, c.floor);
    else
      for (std::size_t k = contacts.size(); k-- > 0;) relax(contacts[k], bodies, contacts[k].floor);
  }
  moved = bodies;
  for (int i = 0; i < kCalming; ++i)
    for (CrowdContact& c : contacts) relax(c, bodies, c.pressed > 0 ? c.calm : std::min(c.floor, 0.0));
}

}  // namespace stadion
