#include "dynamics/contact/contact_solver.h"

#include "dynamics/contact/contact_active_set.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr int kRounds = 4, kRoundsAtRest = 12;    ///< so often at most a choice is looked for ...
constexpr double kWork = 6e5, kWorkAtRest = 3e7;  ///< ... and with so many multiplications ...
constexpr double kUsual = 48;                     ///< ... for so many points; for more, as many more
constexpr double kSwept = 2000;                   ///< points that are relaxed where none is found
constexpr double kArea = 20;                      ///< an area takes as long as so many points
constexpr double kHolds = 1e-13;                  ///< a sweep that changes less is the last [m/s]
constexpr int kNewton = 3;                        ///< steps towards the slip of an area
constexpr double kExactly = 1e-17;                ///< the same where an exact solution is at hand [m/s]

/// One pass over a contact; returns the change of velocity it made.
double relax(std::vector<SolverBody>& m, SolverContact& c, const ContactRow& row) {
  const double normal = row.axis[0].velocity(m[row.a], m[row.b]) + row.shortfall * c.impulse[0];
  const double pressed = std::max(0.0, c.impulse[0] + (c.floor - normal) * row.normalMass);
  const double dn = pressed - c.impulse[0];
  if (dn != 0) row.axis[0].give(m[row.a], m[row.b], dn);
  c.impulse[0] = pressed;
  double change = std::fabs(dn) / std::max(row.normalMass, 1e-300);
  if (c.patch < 0 && c.friction > 0 && (pressed > 0 || !c.impulse.isZero(0))) {
    Vec2 u{row.axis[1].velocity(m[row.a], m[row.b]), row.axis[2].velocity(m[row.a], m[row.b])};
    if (c.slides) u = 0.5 * (u + c.slip);
    Vec2 f = c.impulse.tail<2>() - row.tangentMass * u;
    const double most = c.friction * pressed, size = f.norm();
    if (size > most) f *= size > 0 ? most / size : 0;
    const Vec2 df = f - c.impulse.tail<2>();
    c.impulse.tail<2>() = f;
    if (!df.isZero(0)) row.give(m, {0, df[0], df[1]});
    change = std::max(change, df.norm() / std::max(row.tangentMass, 1e-300));
  }
  return change;
}

/// The same for an area. It sticks if it can; else a few of Newton's steps look for the slip that goes with
/// the friction against it.
double relaxArea(std::vector<SolverBody>& m, std::vector<SolverContact>& contacts, std::size_t k,
                 const ContactRow& row) {
  SolverContact& c = contacts[k];
  const LoadedArea area(contacts, row, *c.area);
  const double most = c.friction * area.load;
  Vec3 now = Vec3::Zero();
  c.limited = false;
  if (most > 0) {
    const Vec3 u = row.velocity(m);
    now = c.impulse - row.stop * u;
    const ContactArea::Need need = area.needFor(-now / most);
    if (need.share > 1) {
      const Vec3 left = row.stop.ldlt().solve(now) * (1 / need.share - 1);
      Vec3 x = u.dot(need.slip) > 0.5 * u.norm() ? u : Vec3(need.slip * left.norm());
      const double half = c.slides ? 0.5 : 1;
      const Vec3 before = c.slides ? Vec3(0.5 * Vec3(c.spin, c.slip.x(), c.slip.y())) : Vec3(Vec3::Zero());
      Vec3 slip = half * x + before, force = Vec3::Zero();
      for (int i = 0; i < kNewton && !slip.isZero(0); ++i) {
        const ContactArea::Resistance r = area.against(slip);
        force = -most * r.force;
        const Vec3 off = c.impulse + row.stop * (x - u) - force;
        const Mat3 slope = row.stop + half * most * r.slope;
        Vec3 step = -slope.partialPivLu().solve(off);
        if (!step.allFinite()) break;
        while (slip.dot(slip + half * step) < 0.1 * slip.squaredNorm()) step *= 0.5;
        x += step;
        slip = half * x + before;
      }
      now = force;
      c.limited = true;
    }
  }
  const Vec3 change = now - c.impulse;
  c.impulse = now;
  if (!change.isZero(0)) row.give(m, change);
  return change.norm() * row.response;
}

struct Sweeps {
  std::vector<SolverBody>& solverBodies;
  std::vector<SolverContact>& contacts;
  const std::vector<ContactRow>& rows;
  std::vector<Vec3> direction, previous;
  double lastSquare = 0;

  double sweep() {
    double change = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      change = std::max(change, contacts[k].area ? relaxArea(solverBodies, contacts, k, rows[k])
                                                 : relax(solverBodies, contacts[k], rows[k]));
    return change;
  }

  /// What a pass did is a gradient: go on along it, conjugate to where it went before.
  bool conjugate(int most, double holds = kHolds) {
    const std::size_t n = contacts.size();
    direction.assign(n, Vec3::Zero());
    previous.resize(n);
    lastSquare = 0;
    for (int i = 0; i < most; ++i) {
      for (std::size_t k = 0; k < n; ++k) previous[k] = contacts[k].impulse;
      if (!(sweep() > holds)) return true;
      double square = 0;
      for (std::size_t k = 0; k < n; ++k)
        square += rows[k].response * (contacts[k].impulse - previous[k]).squaredNorm();
      const double beta = lastSquare > 0 ? square / lastSquare : 2;
      lastSquare = square;
      if (i + 1 == most) break;
      if (beta > 1) {
        for (Vec3& d : direction) d.setZero();
        continue;
      }
      for (std::size_t k = 0; k < n; ++k) {
        const Vec3 step = beta * direction[k], gradient = contacts[k].impulse - previous[k];
        contacts[k].impulse += step;
        rows[k].give(solverBodies, step);
        direction[k] = step + gradient;
      }
    }
    return false;
  }
};

}  // namespace

void SolverContact::placeAt(const Vec3& point, const Vec3& n, const Vec3& pa, const Vec3& pb) {
  rows = push = basisAround(n);
  armA = pushA = point - pa;
  armB = pushB = point - pb;
}

Mat3 basisAround(const Vec3& n) {
  Mat3 B;
  B.col(0) = n;
  B.col(1) = (std::fabs(n.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()).cross(n).normalized();
  B.col(2) = n.cross(B.col(1));
  return B;
}

bool solveContacts(std::vector<SolverBody>& solverBodies, std::vector<SolverContact>& contacts,
                   Effort effort) {
  const std::vector<ContactRow> rows = rowsOf(solverBodies, contacts);
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].give(solverBodies, contacts[k].impulse);
  Sweeps sweeps{solverBodies, contacts, rows, {}, {}, 0};
  ContactActiveSet choice(solverBodies, contacts, rows);
  const bool atRest = effort == Effort::AtRest;
  double work = atRest ? kWorkAtRest : kWork * std::max(1.0, static_cast<double>(contacts.size()) / kUsual);
  for (int round = 0; round < (atRest ? kRoundsAtRest : kRounds) && work > 0; ++round) {
    if (sweeps.conjugate(round == 0 ? 3 : 16, kExactly)) return true;
    if (choice.solve(work)) return true;
  }
  double each = 0;  // sweep, in points
  for (const SolverContact& c : contacts) each += c.area ? kArea : 1;
  return sweeps.conjugate(static_cast<int>(std::clamp(kSwept / std::max(each, 1.0), 20.0, 200.0)));
}

}  // namespace stadion
