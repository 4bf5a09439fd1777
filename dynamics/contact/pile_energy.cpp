#include "dynamics/contact/pile_energy.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kPileRounding = 1e-13;  ///< relative excess that is none
constexpr double kMotionSpent = 0.05;    ///< share of a group's energy of motion that a shift may use

}  // namespace

PileEnergy::PileEnergy(const Pile& pile)
    : parent_(pile.members), pushed_(pile.members, 0), driven_(pile.members, 0), groups_(pile.members),
      taken_(pile.members, 0.0) {
  for (std::uint32_t i = 0; i < pile.members; ++i) parent_[i] = i;
}

std::uint32_t PileEnergy::of(std::uint32_t i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

/// Bodies that push each other at present belong together from now on.
void PileEnergy::join(const Pile& pile) {
  for (const PileContact& c : pile.contacts) {
    if (!(c.pressed > 0)) continue;
    pushed_[c.a] = 1;
    if (c.b < pile.members) {
      pushed_[c.b] = 1;
      const std::uint32_t a = of(c.a), b = of(c.b);
      parent_[std::max(a, b)] = std::min(a, b);
    } else if (const PileBody& fixed = pile.bodies[c.b]; !fixed.v.isZero(0) || !fixed.omega.isZero(0)) {
      driven_[c.a] = 1;
    }
  }
  groups_.assign(pile.members, {});
  for (std::uint32_t i = 0; i < pile.members; ++i)
    if (pushed_[i] && driven_[i]) groups_[of(i)].driven = true;
}

/// a M b of a member.
double PileEnergy::product(const Pile& pile, std::size_t i, const PileBody& a, const PileBody& b) const {
  const double along = a.v.dot(b.v) / a.inverseMass;
  if (a.roundInertia > 0) return along + a.omega.dot(b.omega) / a.roundInertia;
  return along + a.omega.dot(pile.inverseInertia[i].inverse() * b.omega);
}

void PileEnergy::boundJump(Pile& pile, const std::vector<PileBody>& before) {
  join(pile);
  for (std::uint32_t i = 0; i < pile.members; ++i) {
    if (!pushed_[i]) continue;
    Group& g = groups_[of(i)];
    const PileBody &old = before[i], &now = pile.bodies[i];
    const double was = product(pile, i, old, old), is = product(pile, i, now, now);
    g.before += was;
    g.start += is;
    taken_[i] = 0.5 * (was - is);
  }
  for (std::uint32_t i = 0; i < pile.members; ++i) {
    if (!pushed_[i]) continue;
    const Group& g = groups_[of(i)];
    if (g.driven || !(g.start > g.before)) continue;
    const PileBody& now = pile.bodies[i];
    taken_[i] += 0.5 * (1 - g.before / g.start) * product(pile, i, now, now);
    slow(pile.bodies[i], std::sqrt(g.before / g.start));
  }
}

void PileEnergy::payShift(Pile& pile, double deep) {
  join(pile);
  for (const PileContact& c : pile.contacts)
    if (c.pressed > 0 && c.gap < -deep) groups_[of(c.a)].deep = true;
  for (std::uint32_t i = 0; i < pile.members; ++i) {
    if (!pushed_[i]) continue;
    Group& g = groups_[of(i)];
    const PileBody& b = pile.bodies[i];
    g.start += 0.5 * product(pile, i, b, b);
    g.before += taken_[i];
    g.lifts -= pile.pull[i].dot(pile.shift[i]) / b.inverseMass;
  }
  for (std::uint32_t i = 0; i < pile.members; ++i) {
    if (!pushed_[i]) continue;
    const Group& g = groups_[of(i)];
    const double paid = std::max(g.before, 0.0);
    if (g.driven || g.deep || !(g.lifts > paid)) continue;
    const double spent = std::min(g.lifts - paid, kMotionSpent * g.start);
    pile.shift[i] *= (paid + spent) / g.lifts;
    if (g.start > 0) slow(pile.bodies[i], std::sqrt(1 - spent / g.start));
  }
}

void PileEnergy::boundWork(Pile& pile) {
  join(pile);
  for (std::uint32_t i = 0; i < pile.members; ++i) {
    if (!pushed_[i]) continue;
    Group& g = groups_[of(i)];
    const PileBody &v0 = pile.start[i], &v1 = pile.bodies[i];
    g.start += product(pile, i, v0, v0);
    g.end += product(pile, i, v1, v1);
    g.across += product(pile, i, v0, v1);
    const Vec3 falls = pile.h / v0.inverseMass * pile.pull[i];
    g.fallsAtStart += falls.dot(v0.v);
    g.fallsAtEnd += falls.dot(v1.v);
  }
  for (std::uint32_t i = 0; i < pile.members; ++i) {
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
    if (s < 1 - kPileRounding) slow(pile.bodies[i], s);
    if (s * g.across > first + kPileRounding * (g.start + std::fabs(g.fallsAtStart))) {
      slow(pile.start[i], 0);
      slow(pile.bodies[i], 0);
    }
  }
}

}  // namespace stadion
