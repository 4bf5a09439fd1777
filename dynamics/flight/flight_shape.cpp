#include "dynamics/flight/flight_shape.h"

#include "engine/maths/angles.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// Which way along the first axis the nose is: +1 or -1.
double noseSide(const PrincipalAxes& axes, const Vec3& centreOfMass) {
  const double size = std::sqrt(axes.variance.x());
  const double ahead = (axes.q_NP.conjugate() * (centreOfMass - axes.centre)).x();
  if (std::fabs(ahead) > 1e-3 * size) return ahead < 0 ? -1 : 1;
  // The long tail is behind, the bulk in front.
  return axes.skewness.x() > 1e-6 * size * size * size ? -1 : 1;
}

/// Sums over the surface in A about the centre of mass.
struct Silhouettes {
  double front = 0, side = 0, top = 0, wet = 0;
  double frontMoment = 0, sideMoment = 0, wetMoment = 0, sideSecond = 0;
  Aabb box;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = 0.5 * (b - a).cross(c - a);
    const double area = n.norm(), middle = (a.x() + b.x() + c.x()) / 3;
    // Mean of x^2 over the triangle.
    const double square = (a.x() * a.x() + b.x() * b.x() + c.x() * c.x() + 9 * middle * middle) / 12;
    // Half of what faces a direction or its opposite is seen from there. About the axis |n| cos has the mean
    // 2 / pi.
    const double sideways = std::sqrt(n.y() * n.y() + n.z() * n.z()) / kPi;
    front += std::max(n.x(), 0.0);
    frontMoment += std::max(n.x(), 0.0) * middle;
    side += sideways;
    sideMoment += sideways * middle;
    sideSecond += sideways * square;
    top += 0.5 * std::fabs(n.z());
    wet += area;
    wetMoment += area * middle;
    for (const Vec3& p : {a, b, c}) box.include(p);
  }
};

}  // namespace

bool FlightShape::elongated() const {
  return axes.variance.x() - axes.variance.y() > axes.variance.y() - axes.variance.z();
}

FlightShape FlightShape::scaled(double f) const {
  FlightShape s = *this;
  s.axes.centre *= f;
  s.axes.variance *= f * f;
  s.axes.skewness *= f * f * f;
  for (double* l : {&s.length, &s.width, &s.thickness, &s.sideArm, &s.wetArm, &s.noseArm}) *l *= f;
  for (double* a : {&s.frontArea, &s.sideArea, &s.topArea, &s.wetArea}) *a *= f * f;
  s.sideSpread *= f * f * f * f;
  return s;
}

FlightShape measureShape(const Mesh& mesh, const Vec3& centreOfMass, const std::optional<Vec3>& nose) {
  FlightShape s;
  s.axes = surfaceAxes(mesh);
  s.q_NA = s.axes.q_NP;
  const double side = nose ? nose->dot(s.q_NA * Vec3::UnitX()) : noseSide(s.axes, centreOfMass);
  if (side < 0) s.q_NA = s.q_NA * Quat(0, 0, 0, 1);  // half a turn about z
  Silhouettes sum;
  const auto corner = [&](std::size_t i) -> Vec3 {
    const auto& p = mesh.positions[mesh.indices[i]];
    return s.q_NA.conjugate() * (Vec3(p[0], p[1], p[2]) - centreOfMass);
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    sum.add(corner(i), corner(i + 1), corner(i + 2));
  if (!(sum.wet > 0)) return s;
  const Vec3 extent = sum.box.hi - sum.box.lo;
  s.length = extent.x();
  s.width = extent.y();
  s.thickness = extent.z();
  s.frontArea = sum.front;
  s.sideArea = sum.side;
  s.topArea = sum.top;
  s.wetArea = sum.wet;
  s.sideArm = sum.side > 0 ? -sum.sideMoment / sum.side : 0;
  s.wetArm = -sum.wetMoment / sum.wet;
  s.noseArm = sum.front > 0 ? sum.frontMoment / sum.front : 0;
  s.sideSpread = sum.sideSecond;
  return s;
}

RodFlight rodFrom(const FlightShape& s) {
  constexpr double kCrossDrag = 1.0;  // of a long cylinder with free ends
  constexpr double kSkin = 0.0037;    // turbulent friction on the whole surface
  constexpr double kBluntness = 0.5;  // axial drag of nose and tail together
  constexpr double kNoseLift = 1.0;   // of the growing cross section; half of slender-body theory
  constexpr double kSwing = 0.35;     // sine of the angles between spins' cross flow and flight
  RodFlight m;
  const double skin = kSkin * s.wetArea, nose = kNoseLift * s.frontArea;
  m.axialArea = kBluntness * s.frontArea + skin;
  m.crossArea = kCrossDrag * s.sideArea;
  m.crossArm = s.sideArm;
  m.liftArea = skin + nose;
  m.liftArm = m.liftArea > 0 ? (skin * s.wetArm - nose * s.noseArm) / m.liftArea : 0;
  m.damping = kSwing * kCrossDrag * s.sideSpread;
  return m;
}

PlateFlight plateFrom(const FlightShape& s) {
  const double diameter = std::sqrt(4 / kPi * s.topArea);
  PlateFlight m = discusFlight(diameter);
  if (!(diameter > 0)) return m;
  // Edge-on drag: friction on both sides, and the form's that goes with the thickness.
  constexpr double kFriction = 0.008, kForm = 0.224;
  m.dragArea = s.topArea * (kFriction + kForm * s.thickness / diameter);
  return m;
}

SportsBall ballFrom(const FlightShape& s) {
  return footballFlight(std::max(std::sqrt(0.25 * s.wetArea / kPi), 1e-4));
}

std::vector<std::string> shippedFlights(FlightKind kind) {
  switch (kind) {
  case FlightKind::Rod: return {"javelin"};
  case FlightKind::Plate: return {"discus"};
  case FlightKind::Ball: return {"football"};
  default: return {};
  }
}

std::optional<FlightModel> shippedFlight(FlightKind kind, const std::string& name, const FlightShape& s) {
  const std::vector<std::string> known = shippedFlights(kind);
  if (std::ranges::find(known, name) == known.end()) return std::nullopt;
  switch (kind) {
  case FlightKind::Rod: return javelinFlight(s.length);
  case FlightKind::Plate: return discusFlight(std::sqrt(4 / kPi * s.topArea));
  default: return ballFrom(s);
  }
}

}  // namespace stadion
