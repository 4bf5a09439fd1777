#include "bench/flight/exact_table.h"

#include <cmath>
#include <utility>

namespace stadion::bench {
namespace {

/// Damping of a rotation across the axis, per area and length squared at one angle: the mean of both planes.
double dampingAt(const AnyModel& model, const Vec3& u, const Vec3& k, const Vec3& side, double unit) {
  constexpr double kTurn = 0.3;
  double sum = 0;
  for (const Vec3& n : {side, Vec3(k.cross(side))})
    sum -= (model(u, kTurn * n).torque - model(u, -kTurn * n).torque).dot(n) / (2 * kTurn);
  return 0.5 * sum / (0.5 * kDensity * unit * u.norm());
}

}  // namespace

ExactTable exactTable(Thing thing) {
  const ThingFacts& facts = factsOf(thing);
  const bool rod = facts.axis == 0;
  const double area = rod ? facts.shape.sideArea : facts.shape.topArea, length = rod ? 2.65 : 0.22;
  std::vector<FlightTableRow> rows;
  const Vec3 k = Vec3::Unit(facts.axis), side = Vec3::UnitY();
  // Close rows where a javelin flies.
  for (double degrees = 0; degrees <= (rod ? 180 : 90); degrees += rod ? (degrees < 20 ? 1 : 5) : 2.5) {
    const double a = degrees * kDegree, speed = 30;
    // The nose is above the velocity: air from below.
    const Vec3 u(speed * std::cos(a), 0, -speed * std::sin(a));
    const Wrench f = facts.exact(u, Vec3::Zero());
    const Vec3 h = u / speed, up(std::sin(a), 0, std::cos(a));
    const double q = 0.5 * kDensity * speed * speed * area;
    rows.push_back({a, -f.force.dot(h) / q, f.force.dot(up) / q, -f.torque.y() / (q * length),
                    dampingAt(facts.exact, u, k, side, area * length * length)});
  }
  return {std::move(rows), area, length, facts.axis};
}

TableFlight tableOf(const ExactTable& t) {
  return tableFrom(t.rows, t.area, t.length, t.axis);
}

std::string textOf(const ExactTable& t) {
  return flightTableText(t.rows, t.area, t.length, t.axis);
}

}  // namespace stadion::bench
