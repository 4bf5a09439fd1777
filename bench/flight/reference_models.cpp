#include "bench/flight/reference_models.h"

#include "engine/maths/angles.h"

#include <cmath>

namespace stadion::bench {
namespace {

/// Gauss and Legendre's eight points on -1..1 and their weights.
constexpr double kPoints[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr double kWeights[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                               0.1012285362903763};

/// The outline: distance from the tip and diameter [m].
constexpr double kAt[] = {0, .15, .525, 1.05, 1.30, 1.85, 2.50, 2.65};
constexpr double kDiameter[] = {.003, .020, .024, .027, .027, .0245, .011, .0035};

}  // namespace

StripJavelin::StripJavelin(double density) {
  constexpr double kCentre = 1.05, kCross = 1.0, kSkin = 0.0037, kLift = 0.5, kNose = 0.5;
  std::size_t next = 0;
  for (std::size_t segment = 0; segment < 7; ++segment) {
    const double length = kAt[segment + 1] - kAt[segment];
    const double taper = (kDiameter[segment + 1] - kDiameter[segment]) / length;
    for (std::size_t i = 0; i < 8; ++i) {
      const double share = 0.5 * (1 + (i % 2 ? 1 : -1) * kPoints[i / 2]);
      const double strip = 0.5 * length * kWeights[i / 2], x = kAt[segment] + share * length;
      const double d = kDiameter[segment] + share * length * taper;
      stations_[next++] = {kCentre - x, 0.5 * density * kCross * d * strip,
                           0.5 * density * kSkin * kPi * d * strip,
                           x < kCentre ? density * kLift * 0.5 * kPi * d * taper * strip : 0};
    }
  }
  nose_ = 0.5 * density * kNose * 0.25 * kPi * .027 * .027;
}

Wrench StripJavelin::operator()(const Vec3& u, const Vec3& w) const {
  Wrench f;
  for (const Station& s : stations_) {
    const double y = u.y() + w.z() * s.ahead, z = u.z() - w.y() * s.ahead;
    const double across = std::sqrt(y * y + z * z), speed = std::sqrt(across * across + u.x() * u.x());
    const double pull = -(s.cross * across + s.skin * speed + s.lift * u.x());
    f.force += Vec3(-s.skin * speed * u.x(), pull * y, pull * z);
    f.torque += s.ahead * Vec3(0, -pull * z, pull * y);
  }
  f.force.x() -= nose_ * u.x() * std::fabs(u.x());
  return f;
}

Wrench WingDiscus::operator()(const Vec3& u, const Vec3& w) const {
  constexpr double kWide = .22, kArea = 0.25 * kPi * kWide * kWide;
  const double speed = u.norm();
  if (!(speed > 1e-12)) return {};
  const Vec3 h = u / speed, n = Vec3::UnitZ();
  const double s = -h.z(), sa = std::fabs(s), c = std::sqrt(1 - std::min(s * s, 1.0)), sign = s < 0 ? -1 : 1;
  const double attached = 1 / (1 + std::exp((std::asin(std::min(sa, 1.0)) - kPi / 6) / (kPi / 90)));
  const double plate = 1.08 * sa * (1.6 - .6 * sa);
  const double lift = sign * (attached * (1.79 * sa * c + 1.5 * sa * sa) + (1 - attached) * plate);
  const double drag =
      .06 + .9 * attached * (1.79 * sa * sa * c + 1.5 * sa * sa * sa) + (1 - attached) * plate * sa;
  const double moment = sign * (.21 * attached * 1.79 * sa * c + .05 * (1 - attached) * plate);
  const double q = 0.5 * density_ * speed * speed * kArea;
  return {q * (lift * (n + s * h) - drag * h),
          q * kWide * moment * h.cross(n) -
              0.5 * density_ * kArea * kWide * kWide * .05 * speed * Vec3(w.x(), w.y(), 0)};
}

Wrench CrisisBall::operator()(const Vec3& u, const Vec3& w) const {
  constexpr double kRadius = .11, kArea = kPi * kRadius * kRadius;
  const double speed = u.norm();
  if (!(speed > 1e-12)) return {};
  const Vec3 h = u / speed, side = w.cross(h);
  const double across = side.norm();
  const double drag = .155 + .346 / (1 + std::exp((speed - 12.19) / 1.309));
  const double lift = -.33 * std::expm1(-kRadius * across / speed / .17);
  const Vec3 along = across > 1e-12 ? Vec3(side / across) : Vec3::Zero();
  return {0.5 * density_ * kArea * speed * speed * (lift * along - drag * h), Vec3::Zero()};
}

}  // namespace stadion::bench
