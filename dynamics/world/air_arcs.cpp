#include "dynamics/motion/stiff_step.h"
#include "dynamics/world/body_arcs.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kLongest = 0.05;     ///< step through air [s]
constexpr double kFirst = 0.004;      ///< step of a body that has made none [s]
constexpr double kShortest = 5e-5;    ///< step; what needs shorter ones is stiff [s]
constexpr double kStiff = 1.0 / 480;  ///< step of what is stiff [s]
constexpr double kBias = 1.0 / 120;   ///< how long a turn by bias is drawn out [s]

}  // namespace

/// Flight by the body's model of the air, one step; false if there is no air or no model.
bool BodyArcs::flyInAir(RigidBody& b, double tau, const CoupledState& s) {
  if (!b.flight->hasModel() || !fields_.inMedium(b)) return false;
  const auto push = [&](double at, const CoupledState& state, const Vec3& omega) {
    return fields_.airPush(b, state, omega, at);
  };
  double room = std::min(kLongest, fields_.knownFor(b, tau));
  room =
      std::min(room, fields_.timeToPass(b, s.p, s.v, room * fields_.accelerationAt(b, s.p, s.v, tau).norm()));
  double h = std::min(b.step > 0 ? b.step : kFirst, room);
  CoupledStep step;
  const auto change = [&] { return 0.9 * det::pow(step.error, -0.2); };
  for (int i = 0; i < 40; ++i) {
    step = coupledStep(push, tau, s, b.inertia, h);
    if (step.error <= 1) break;
    h *= std::clamp(change(), 0.1, 0.8);
    if (h < kShortest && h < room) {
      h = std::min(kStiff, room);
      step = stiffStep(push, tau, s, b.inertia, h);
      break;
    }
  }
  b.step = h == kStiff ? kShortest : h * (step.error > 0 ? std::clamp(change(), 0.3, 4.0) : 4.0);
  const Vec3 from[3] = {s.p, s.v, step.first.a}, to[3] = {step.end.p, step.end.v, step.last.a};
  const Spin spin = std::holds_alternative<SportsBall>(b.flight->model)
                        ? Spin::free(s.q, s.L, b.inertia)
                        : Spin::steered({s.q, s.L, step.first.torque},
                                        {step.end.q, step.end.L, step.last.torque}, h, b.inertia);
  setArc(b, tau, Path::hermite(from, to, h), spin, h, BodyMode::Flight);
  return true;
}

/// How the body turns from now on if no air turns it: freely, and by its bias.
Spin BodyArcs::spinFrom(const RigidBody& b, double tau, const CoupledState& s) const {
  if (!b.flight->flows()) return Spin::free(s.q, s.L, b.inertia);
  const auto turned = [&](const Quat& q, const Vec3& v) {
    return (biased(b.flight->bias, q * b.q_CA, v, 0.5 * kBias) * b.q_CA.conjugate()).normalized();
  };
  const Vec3 after = s.v + kBias * (fields_.accelerationAt(b, s.p, s.v, tau) - b.damping * s.v);
  const Quat free = Spin::unsteered(turned(s.q, s.v), s.L, b.inertia).orientation(kBias);
  Spin spin =
      Spin::steered({s.q, s.L, Vec3::Zero()}, {turned(free, after), s.L, Vec3::Zero()}, kBias, b.inertia);
  spin.horizon = kBias;
  return spin;
}

/// From tau on it turns so, on the same path.
void BodyArcs::setSpin(RigidBody& b, double tau, const Spin& spin) {
  b.spin = spin;
  b.spinStart = b.age(tau);
  b.validAge = std::min(b.pathAge, b.spinStart + spin.horizon);
  b.until = b.validAge - b.age0;
  ++b.version;
  traces_.note(b, tau);
}

void BodyArcs::turnByBias(RigidBody& b, double tau) {
  const Quat q_WA = biased(b.flight->bias, b.orientation(tau) * b.q_CA, b.velocity(tau), 0);
  const Vec3 L = b.angularMomentum(tau);
  setSpin(b, tau, Spin::free((q_WA * b.q_CA.conjugate()).normalized(), L, b.inertia));
}

}  // namespace stadion
