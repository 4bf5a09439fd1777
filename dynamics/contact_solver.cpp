#include "dynamics/contact_solver.h"

#include "dynamics/contact_choice.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::size_t kExact = 48;  ///< islands with so many points are solved exactly
constexpr double kHolds = 1e-13;    ///< a sweep that changes less is the last [m/s]
constexpr double kExactly = 1e-17;  ///< the same where an exact solution is at hand [m/s]

struct Row {
  double normalMass, tangentMass;  ///< 1 / response along n; 1 / greatest response across it
  double weight;                   ///< response: makes impulses of light and heavy pairs comparable
};

Row rowOf(const SolverContact& c, const std::vector<Mobile>& m) {
  const auto share = [](const Mobile& body, const Vec3& at, const Vec3& from) {
    if (body.inverseMass == 0) return Mat3(Mat3::Zero());
    return Mat3(body.inverseMass * Mat3::Identity() - skew(at) * body.inverseInertia * skew(from));
  };
  const Mat3 K =
      c.rows.transpose() * (share(m[c.a], c.armA, c.pushA) + share(m[c.b], c.armB, c.pushB)) * c.push;
  const double kn = K(0, 0), a = K(1, 1), b = K(2, 2), d = 0.5 * (K(1, 2) + K(2, 1));
  const double kt = 0.5 * (a + b) + std::sqrt(0.25 * (a - b) * (a - b) + d * d);
  return {kn > 0 ? 1 / kn : 0, kt > 0 ? 1 / kt : 0, kn};
}

/// One pass over a contact; returns the change of velocity it made.
double relax(std::vector<Mobile>& m, SolverContact& c, const Row& row) {
  Vec3 before = c.impulse;
  const double wanted = (c.floor - c.velocity(m)[0]) * row.normalMass;
  c.impulse[0] = std::max(0.0, c.impulse[0] + wanted);
  const double dn = c.impulse[0] - before[0];
  if (dn != 0) giveImpulse(m, c, c.impulse - before);
  double change = std::fabs(dn) / std::max(row.normalMass, 1e-300);
  if (c.friction > 0) {
    Vec2 u = c.velocity(m).tail<2>();
    if (c.slides) u = 0.5 * (u + c.slip);
    before = c.impulse;
    Vec2 f = c.impulse.tail<2>() - row.tangentMass * u;
    const double most = c.friction * c.impulse[0], size = f.norm();
    if (size > most) f *= size > 0 ? most / size : 0;
    c.impulse.tail<2>() = f;
    const Vec3 df = c.impulse - before;
    if (!df.isZero(0)) giveImpulse(m, c, df);
    change = std::max(change, df.norm() / std::max(row.tangentMass, 1e-300));
  }
  return change;
}

struct Sweeps {
  std::vector<Mobile>& mobiles;
  std::vector<SolverContact>& contacts;
  const std::vector<Row>& rows;
  std::vector<Vec3> direction, previous;
  double lastSquare = 0;

  double sweep() {
    double change = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      change = std::max(change, relax(mobiles, contacts[k], rows[k]));
    return change;
  }

  /// What a pass did is a gradient: go on along it, conjugate to where it went before.
  bool conjugate(int most) {
    const std::size_t n = contacts.size();
    direction.assign(n, Vec3::Zero()), previous.resize(n);
    lastSquare = 0;
    for (int i = 0; i < most; ++i) {
      for (std::size_t k = 0; k < n; ++k) previous[k] = contacts[k].impulse;
      if (!(sweep() > kHolds)) return true;
      double square = 0;
      for (std::size_t k = 0; k < n; ++k)
        square += rows[k].weight * (contacts[k].impulse - previous[k]).squaredNorm();
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
        if (!step.isZero(0)) giveImpulse(mobiles, contacts[k], step);
        direction[k] = step + gradient;
      }
    }
    return false;
  }
};

}  // namespace

Mat3 basisAround(const Vec3& n) {
  Mat3 B;
  B.col(0) = n;
  B.col(1) = (std::fabs(n.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()).cross(n).normalized();
  B.col(2) = n.cross(B.col(1));
  return B;
}

bool solveContacts(std::vector<Mobile>& mobiles, std::vector<SolverContact>& contacts) {
  std::vector<Row> rows;
  rows.reserve(contacts.size());
  for (SolverContact& c : contacts) {
    rows.push_back(rowOf(c, mobiles));
    giveImpulse(mobiles, c, c.impulse);
  }
  Sweeps sweeps{mobiles, contacts, rows, {}, {}, 0};
  if (contacts.size() > kExact) return sweeps.conjugate(60);
  ContactChoice choice(mobiles, contacts);
  for (int round = 0; round < 8; ++round) {
    for (int i = 0; i < 3; ++i)
      if (!(sweeps.sweep() > kExactly)) return true;
    if (choice.settle()) return true;
  }
  return sweeps.conjugate(contacts.size() > 24 ? 150 : 400);
}

}  // namespace stadion
