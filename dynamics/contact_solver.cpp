#include "dynamics/contact_solver.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

struct Row {
  double normalMass, tangentMass;  ///< 1 / response along n; 1 / greatest response across it
  double weight;                   ///< response: makes impulses of light and heavy pairs comparable
};

Row rowOf(const SolverContact& c, const std::vector<Mobile>& m) {
  const Mat3 K = response(m[c.a], c.x) + response(m[c.b], c.x);
  const double kn = c.n.dot(K * c.n);
  const Vec3 t1 = (std::fabs(c.n.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()).cross(c.n).normalized(),
             t2 = c.n.cross(t1);
  const double a = t1.dot(K * t1), b = t2.dot(K * t2), d = t1.dot(K * t2);
  const double kt = 0.5 * (a + b) + std::sqrt(0.25 * (a - b) * (a - b) + d * d);
  return {kn > 0 ? 1 / kn : 0, kt > 0 ? 1 / kt : 0, kn};
}

void give(std::vector<Mobile>& m, const SolverContact& c, const Vec3& impulse) {
  m[c.a].apply(impulse, c.x);
  m[c.b].apply(-impulse, c.x);
}

Vec3 total(const SolverContact& c) {
  return c.normalImpulse * c.n + c.frictionImpulse;
}

/// One pass over a contact; returns the change of velocity it made.
double relax(std::vector<Mobile>& m, SolverContact& c, const Row& row) {
  const auto slipping = [&] { return Vec3(m[c.a].velocityAt(c.x) - m[c.b].velocityAt(c.x)); };
  const double wanted = (c.floor - slipping().dot(c.n)) * row.normalMass;
  const double normal = std::max(0.0, c.normalImpulse + wanted), dn = normal - c.normalImpulse;
  c.normalImpulse = normal;
  if (dn != 0) give(m, c, dn * c.n);
  double change = std::fabs(dn) / std::max(row.normalMass, 1e-300);
  if (c.friction > 0) {
    const Vec3 u = slipping();
    Vec3 f = c.frictionImpulse - row.tangentMass * (u - c.n * c.n.dot(u));
    f -= c.n * c.n.dot(f);
    const double most = c.friction * c.normalImpulse, size = f.norm();
    if (size > most) f *= size > 0 ? most / size : 0;
    const Vec3 df = f - c.frictionImpulse;
    c.frictionImpulse = f;
    if (!df.isZero(0)) give(m, c, df);
    change = std::max(change, df.norm() / std::max(row.tangentMass, 1e-300));
  }
  return change;
}

}  // namespace

int solveContacts(std::vector<Mobile>& mobiles, std::vector<SolverContact>& contacts) {
  std::vector<Row> rows;
  rows.reserve(contacts.size());
  for (SolverContact& c : contacts) {
    rows.push_back(rowOf(c, mobiles));
    give(mobiles, c, c.normalImpulse * c.n + c.frictionImpulse);
  }
  const std::size_t n = contacts.size();
  const int most = n <= 64 ? 600 : 60;
  std::vector<Vec3> direction(n, Vec3::Zero()), previous(n);
  double lastSquare = 0;
  for (int i = 0; i < most; ++i) {
    double change = 0, square = 0;
    for (std::size_t k = 0; k < n; ++k) previous[k] = total(contacts[k]);
    for (std::size_t k = 0; k < n; ++k) change = std::max(change, relax(mobiles, contacts[k], rows[k]));
    if (!(change > 1e-13)) return i + 1;
    // What a pass did is a gradient: go on along it, conjugate to where it went before.
    for (std::size_t k = 0; k < n; ++k)
      square += rows[k].weight * (total(contacts[k]) - previous[k]).squaredNorm();
    const double beta = lastSquare > 0 ? square / lastSquare : 2;
    lastSquare = square;
    if (i + 1 == most) break;
    if (beta > 1) {
      for (Vec3& d : direction) d.setZero();
      continue;
    }
    for (std::size_t k = 0; k < n; ++k) {
      SolverContact& c = contacts[k];
      const Vec3 step = beta * direction[k], gradient = total(c) - previous[k];
      const double up = c.n.dot(step);
      c.normalImpulse += up, c.frictionImpulse += step - up * c.n;
      if (!step.isZero(0)) give(mobiles, c, step);
      direction[k] = step + gradient;
    }
  }
  return most;
}

}  // namespace stadion
