#include "dynamics/contact_rows.h"

#include <cmath>

namespace stadion {
namespace {

ContactRow rowOf(const SolverContact& c, const std::vector<Mobile>& m) {
  ContactRow row;
  row.a = c.a, row.b = c.b;
  const Mobile &a = m[c.a], &b = m[c.b];
  for (int i = 0; i < 3; ++i) {
    ContactAxis& x = row.axis[static_cast<std::size_t>(i)];
    x.n = c.rows.col(i), x.p = c.push.col(i);
    x.spinA = c.armA.cross(x.n), x.spinB = c.armB.cross(x.n);
    x.turnA = a.inverseInertia * c.pushA.cross(x.p), x.turnB = b.inverseInertia * c.pushB.cross(x.p);
  }
  const auto response = [&](std::size_t i, std::size_t j) {
    const ContactAxis &x = row.axis[i], &y = row.axis[j];
    return (a.inverseMass + b.inverseMass) * x.n.dot(y.p) + x.spinA.dot(y.turnA) + x.spinB.dot(y.turnB);
  };
  const double kn = response(0, 0), t1 = response(1, 1), t2 = response(2, 2),
               d = 0.5 * (response(1, 2) + response(2, 1));
  const double kt = 0.5 * (t1 + t2) + std::sqrt(0.25 * (t1 - t2) * (t1 - t2) + d * d);
  row.response = kn, row.shortfall = c.give * kn;
  row.normalMass = kn > 0 ? 1 / (kn + row.shortfall) : 0, row.tangentMass = kt > 0 ? 1 / kt : 0;
  return row;
}

}  // namespace

std::vector<ContactRow> rowsOf(const std::vector<Mobile>& mobiles,
                               const std::vector<SolverContact>& contacts) {
  std::vector<ContactRow> rows;
  rows.reserve(contacts.size());
  for (const SolverContact& c : contacts) rows.push_back(rowOf(c, mobiles));
  return rows;
}

}  // namespace stadion
