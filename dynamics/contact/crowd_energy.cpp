#include "dynamics/contact/crowd_energy.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kPileRounding = 1e-13;    ///< relative excess that is none
constexpr double kMotionSpent = 0.05;  ///< share of a group's energy of motion that a shift may use

}  // namespace

CrowdEnergy::CrowdEnergy(const Crowd& crowd)
    : parent_(crowd.members), pushed_(crowd.members, 0), driven_(crowd.members, 0), groups_(crowd.members),
      taken_(crowd.members, 0.0) {
  for (std::uint32_t i = 0; i < crowd.members; ++i) parent_[i] = i;
}

std::uint32_t CrowdEnergy::of(std::uint32_t i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

/// Bodies that push each other at present belong together from now on.
void CrowdEnergy::join(const Crowd& crowd) {
  for (const CrowdContact& c : crowd.contacts) {
    if (!(c.pressed > 0)) continue;
    pushed_[c.a] = 1;
    if (c.b < crowd.members) {
      pushed_[c.b] = 1;
      const std::uint32_t a = of(c.a), b = of(c.b);
      parent_[std::max(a, b)] = std::min(a, b);
    } else if (const CrowdBody& fixed = crowd.bodies[c.b]; !fixed.v.isZero(0) || !fixed.omega.isZero(0)) {
      driven_[c.a] = 1;
    }
  }
  groups_.assign(crowd.members, {});
  for (std::uint32_t i = 0; i < crowd.members; ++i)
    if (pushed_[i]) {
      Group& g = groups_[of(i)];
      g.touched = true, g.driven = g.driven || driven_[i];
    }
}

/// a M b of a member.
double CrowdEnergy::product(const Crowd& crowd, std::size_t i, const CrowdBody& a, const CrowdBody& b) const {
  const double along = a.v.dot(b.v) / a.inverseMass;
  if (a.roundInertia > 0) return along + a.omega.dot(b.omega) / a.roundInertia;
  return along + a.omega.dot(crowd.inverseInertia[i].inverse() * b.omega);
}

void CrowdEnergy::boundJump(Crowd& crowd, const std::vector<CrowdBody>& before) {
  join(crowd);
  for (std::uint32_t i = 0; i < crowd.members; ++i) {
    if (!pushed_[i]) continue;
    Group& g = groups_[of(i)];
    const CrowdBody &old = before[i], &now = crowd.bodies[i];
    const double was = product(crowd, i, old, old), is = product(crowd, i, now, now);
    g.before += was, g.start += is;
    taken_[i] = 0.5 * (was - is);
  }
  for (std::uint32_t i = 0; i < crowd.members; ++i) {
    if (!pushed_[i]) continue;
    const Group& g = groups_[of(i)];
    if (g.driven || !(g.start > g.before)) continue;
    const CrowdBody& now = crowd.bodies[i];
    taken_[i] += 0.5 * (1 - g.before / g.start) * product(crowd, i, now, now);
    slow(crowd.bodies[i], std::sqrt(g.before / g.start));
  }
}

void CrowdEnergy::payShift(Crowd& crowd, double deep) {
  join(crowd);
  for (const CrowdContact& c : crowd.contacts)
    if (c.pressed > 0 && c.gap < -deep) groups_[of(c.a)].deep = true;
  for (std::uint32_t i = 0; i < crowd.members; ++i) {
    if (!pushed_[i]) continue;
    Group& g = groups_[of(i)];
    const CrowdBody& b = crowd.bodies[i];
    g.start += 0.5 * product(crowd, i, b, b), g.before += taken_[i];
    g.lifts -= crowd.pull[i].dot(crowd.shift[i]) / b.inverseMass;
  }
  for (std::uint32_t i = 0; i < crowd.members; ++i) {
    if (!pushed_[i]) continue;
    const Group& g = groups_[of(i)];
    const double paid = std::max(g.before, 0.0);
    if (g.driven || g.deep || !(g.lifts > paid)) continue;
    const double spent = std::min(g.lifts - paid, kMotionSpent * g.start);
    crowd.shift[i] *= (paid + spent) / g.lifts;
    if (g.start > 0) slow(crowd.bodies[i], std::sqrt(1 - spent / g.start));
  }
}

void CrowdEnergy::boundWork(Crowd& crowd) {
  join(crowd);
  for (std::uint32_t i = 0; i < crowd.members; ++i) {
    if (!pushed_[i]) continue;
    Group& g = groups_[of(i)];
    const CrowdBody &v0 = crowd.start[i], &v1 = crowd.bodies[i];
    g.start += product(crowd, i, v0, v0), g.end += product(crowd, i, v1, v1);
    g.across += product(crowd, i, v0, v1);
    const Vec3 falls = crowd.h / v0.inverseMass * crowd.pull[i];
    g.fallsAtStart += falls.dot(v0.v), g.fallsAtEnd += falls.dot(v1.v);
  }
  for (std::uint32_t i = 0; i < crowd.members; ++i) {
    if (!pushed_[i]) continue;
    const Group& g = groups_[of(i)];
    if (g.driven) continue;
    // With the end's velocities times s the work of the contacts goes like start (s end - start - fall) at
    // first and s end (s end - start - fall) at last.
    const double first = g.start + g.fallsAtStart, last = g.across + g.fallsAtEnd;
    double s = 1;
    if (g.across > first && g.across > 0) s = std::min(s, first / g.across);
    if (g.end > last) s = std::min(s, last / g.end);
    s = std::max(s, 0.0);
    if (s < 1 - kPileRounding) slow(crowd.bodies[i], s);
    if (s * g.across > first + kPileRounding * (g.start + std::fabs(g.fallsAtStart)))
      slow(crowd.start[i], 0), slow(crowd.bodies[i], 0);
  }
}

}  // namespace stadion
