#include "dynamics/contact/contact_rows.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kTurns = 1e-12;     ///< of what resists turning, so that nothing is infinite
constexpr double kNarrowest = 1e-3;  ///< part of an area that a load at its rim presses on

ContactRow rowOf(const SolverContact& c, const std::vector<SolverBody>& m) {
  ContactRow row;
  row.a = c.a;
  row.b = c.b;
  const SolverBody &a = m[c.a], &b = m[c.b];
  for (int i = 0; i < 3; ++i) {
    ContactAxis& x = row.axis[static_cast<std::size_t>(i)];
    x.n = c.rows.col(i);
    x.p = c.push.col(i);
    x.spinA = c.armA.cross(x.n);
    x.spinB = c.armB.cross(x.n);
    x.turnA = a.inverseInertia * c.pushA.cross(x.p);
    x.turnB = b.inverseInertia * c.pushB.cross(x.p);
  }
  if (c.area) {
    ContactAxis& x = row.axis[0];
    const double r = c.area->radius();
    x.spinA = x.spinB = r * c.rows.col(0);
    x.turnA = a.inverseInertia * (r * c.push.col(0));
    x.turnB = b.inverseInertia * (r * c.push.col(0));
    x.n.setZero();
    x.p.setZero();
  }
  const auto response = [&](std::size_t i, std::size_t j) {
    const ContactAxis &x = row.axis[i], &y = row.axis[j];
    return (a.inverseMass + b.inverseMass) * x.n.dot(y.p) + x.spinA.dot(y.turnA) + x.spinB.dot(y.turnB);
  };
  const double kn = response(0, 0), t1 = response(1, 1), t2 = response(2, 2),
               d = 0.5 * (response(1, 2) + response(2, 1));
  const double kt = 0.5 * (t1 + t2) + std::sqrt(0.25 * (t1 - t2) * (t1 - t2) + d * d);
  row.response = kn;
  row.shortfall = c.give * kn;
  row.normalMass = kn > 0 ? 1 / (kn + row.shortfall) : 0;
  row.tangentMass = kt > 0 ? 1 / kt : 0;
  if (c.area) {
    Mat3 K;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = response(i, j);
    K = (0.5 * (K + K.transpose())).eval();
    K.diagonal().array() += kTurns * K.trace() + 1e-300;
    row.stop = K.inverse();
    row.response = kt;
  }
  return row;
}

}  // namespace

std::vector<ContactRow> rowsOf(const std::vector<SolverBody>& solverBodies,
                               const std::vector<SolverContact>& contacts) {
  std::vector<ContactRow> rows;
  rows.reserve(contacts.size());
  for (const SolverContact& c : contacts) rows.push_back(rowOf(c, solverBodies));
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const std::int32_t patch = contacts[k].patch;
    if (patch < 0) continue;
    const SolverContact& area = contacts[static_cast<std::size_t>(patch)];
    rows[k].at = (area.push.transpose() * (contacts[k].pushA - area.pushA)).tail<2>() / area.area->radius();
    ContactRow& row = rows[static_cast<std::size_t>(patch)];
    row.points.push_back(static_cast<std::uint32_t>(k));
    row.places.push_back(rows[k].at);
  }
  return rows;
}

LoadedArea::LoadedArea(const std::vector<SolverContact>& contacts, const ContactRow& row,
                       const ContactArea& area)
    : area_(area) {
  const std::vector<std::uint32_t>& points = row.points;
  for (const std::uint32_t k : points) load += std::max(0.0, contacts[k].impulse[0]);
  if (!(load > 0)) return;
  for (std::size_t i = 0; i < points.size(); ++i)
    centre_ += std::max(0.0, contacts[points[i]].impulse[0]) / load * row.places[i];
  to_(0, 0) = std::max(kNarrowest, area.widthUnder(centre_));
  to_(1, 0) = -centre_.y();
  to_(2, 0) = centre_.x();
}

ContactArea::Resistance LoadedArea::against(const Vec3& slip) const {
  ContactArea::Resistance r = area_.against(to_ * slip);
  r.force = to_.transpose() * r.force;
  r.slope = to_.transpose() * r.slope * to_;
  return r;
}

ContactArea::Need LoadedArea::needFor(const Vec3& force) const {
  const double width = to_(0, 0);
  const Vec3 narrow((force[0] - centre_.x() * force[2] + centre_.y() * force[1]) / width, force[1], force[2]);
  // A part of the strength along the plane, a part of it about the normal: together this is never too much.
  const double easy = std::fabs(narrow[0]) + narrow.tail<2>().norm();
  if (easy < 0.5) return {easy, Vec3::Zero()};
  ContactArea::Need need = area_.needFor(narrow);
  const double spin = need.slip[0] / width;
  need.slip = Vec3(spin, need.slip[1] + centre_.y() * spin, need.slip[2] - centre_.x() * spin);
  return need;
}

Vec3 LoadedArea::shareOf(const Vec2& at, const Vec3& slip) const {
  const ContactArea::Resistance r = area_.against(to_ * slip);
  const Vec2 off = at - centre_;
  const Vec3 moves = slip[0] * Vec3(0, -off.y(), off.x());
  Vec3 share = to_.transpose() * (r.force + r.slope * moves);
  share[0] += off.x() * r.force[2] - off.y() * r.force[1];
  return share;
}

}  // namespace stadion
