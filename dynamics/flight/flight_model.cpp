#include "dynamics/flight/flight_model.h"

#include "dynamics/flight/model_laws.h"

#include <algorithm>

namespace stadion {
namespace {

template <class Law>
Wrench wrenchOfRevolution(const Law& law, const Vec3& k, double density, const Vec3& u, const Vec3& w) {
  const Airflow<double> flow = crossing(plain(u), plain(k)).flow;
  const Rates<double> r = law.rates(flow);
  const double half = 0.5 * density;
  const Vec3 across = u - flow.along * k, spin = w.dot(k) * k;
  return {-half * (r.across * across + (r.along * flow.along + r.push) * k),
          half * (r.turn * k.cross(u) - r.damp * (w - spin))};
}

struct Aerodynamics {
  double density;
  const Vec3 &u, &w;

  Wrench operator()(const BallisticFlight&) const { return {}; }
  Wrench operator()(const RodFlight& m) const {
    return wrenchOfRevolution(lawOf(m), Vec3::UnitX(), density, u, w);
  }
  Wrench operator()(const PlateFlight& m) const {
    return wrenchOfRevolution(lawOf(m), Vec3::UnitZ(), density, u, w);
  }
  Wrench operator()(const TableFlight& m) const {
    if (m.pieces.empty()) return {};
    return wrenchOfRevolution(lawOf(m), m.axis == 0 ? Vec3::UnitX() : Vec3::UnitZ(), density, u, w);
  }
  Wrench operator()(const SportsBall& m) const {
    const BallLaw law = lawOf(m);
    const Vec3 sideways = w.cross(u);
    const double speed = u.norm(), half = 0.5 * density;
    return {half * (law.swerve(speed, sideways.norm()) * sideways - law.drag(speed) * u), Vec3::Zero()};
  }
};

constexpr double kMany = 1e6;
constexpr Coefficient kRod[] = {{"axial area", "m2", 0, kMany},     {"cross area", "m2", 0, kMany},
                                {"lift area", "m2", -kMany, kMany}, {"cross arm", "m", -kMany, kMany},
                                {"lift arm", "m", -kMany, kMany},   {"damping", "m4", 0, kMany}};
constexpr Coefficient kPlate[] = {{"drag area", "m2", 0, kMany},
                                  {"lift area", "m2", 0, kMany},
                                  {"lift growth", "m2", -kMany, kMany},
                                  {"stall area", "m2", 0, kMany},
                                  {"moment volume", "m3", -kMany, kMany},
                                  {"stall", "", 1e-3, 1e3},
                                  {"damping", "m4", 0, kMany}};
constexpr Coefficient kBall[] = {{"radius", "m", 1e-4, 1e4},
                                 {"drag low", "", 0, 100},
                                 {"drag drop", "", 0, 100},
                                 {"critical speed", "m/s", 0, kMany},
                                 {"critical width", "m/s", 1e-3, kMany},
                                 {"lift most", "", -100, 100},
                                 {"lift scale", "", 1e-3, kMany}};

}  // namespace

Wrench aerodynamics(const FlightModel& model, double density, const Vec3& u, const Vec3& w) {
  return std::visit(Aerodynamics{density, u, w}, model);
}

std::optional<int> symmetryAxis(const FlightModel& model) {
  if (std::holds_alternative<RodFlight>(model)) return 0;
  if (std::holds_alternative<PlateFlight>(model)) return 2;
  if (const auto* table = std::get_if<TableFlight>(&model)) return table->axis;
  return std::nullopt;
}

FlightKind kindOf(const FlightModel& model) {
  constexpr FlightKind kinds[] = {FlightKind::Ballistic, FlightKind::Rod, FlightKind::Plate, FlightKind::Ball,
                                  FlightKind::Table};
  return kinds[model.index()];
}

std::span<const Coefficient> coefficientsOf(FlightKind kind) {
  switch (kind) {
  case FlightKind::Rod: return kRod;
  case FlightKind::Plate: return kPlate;
  case FlightKind::Ball: return kBall;
  default: return {};
  }
}

std::optional<FlightModel> modelFrom(FlightKind kind, std::span<const double> c) {
  if (c.empty() || c.size() != coefficientsOf(kind).size()) return std::nullopt;
  switch (kind) {
  case FlightKind::Rod: return RodFlight{c[0], c[1], c[2], c[3], c[4], c[5]};
  case FlightKind::Plate: return PlateFlight{c[0], c[1], c[2], c[3], c[4], c[5], c[6]};
  case FlightKind::Ball: return SportsBall{c[0], c[1], c[2], c[3], c[4], c[5], c[6]};
  default: return std::nullopt;
  }
}

std::vector<double> coefficientsOf(const FlightModel& model) {
  if (const auto* m = std::get_if<RodFlight>(&model))
    return {m->axialArea, m->crossArea, m->liftArea, m->crossArm, m->liftArm, m->damping};
  if (const auto* m = std::get_if<PlateFlight>(&model))
    return {m->dragArea, m->liftArea, m->liftGrowth, m->stallArea, m->momentVolume, m->stall, m->damping};
  if (const auto* m = std::get_if<SportsBall>(&model))
    return {m->radius,        m->dragLow,  m->dragDrop, m->criticalSpeed,
            m->criticalWidth, m->liftMost, m->liftScale};
  return {};
}

RodFlight javelinFlight(double length) {
  const double l = length / 2.65, area = l * l;
  return {9.331e-4 * area, 0.05328 * area, 0.0015 * area, 0.142 * l, 0.298 * l, 0.0103 * area * area};
}

PlateFlight discusFlight(double diameter) {
  const double d = diameter / 0.22, area = d * d;
  return {0.002004 * area, 0.08147 * area, 0.00782 * area, 0.0398 * area, 0.003009 * area * d, 0.262, 0};
}

SportsBall footballFlight(double radius) {
  SportsBall ball;
  ball.radius = radius;
  ball.criticalSpeed *= 0.11 / radius;  // the same Reynolds number
  ball.criticalWidth *= 0.11 / radius;
  return ball;
}

}  // namespace stadion
