#pragma once
/// General integrators of a rigid body in air: for references, fits and benches, where `flight_step.h` is
/// what shows use.
///
/// Equations m v' = q F(u, w) + m g, I w' = M(u, w) - w x I w, q' = q (0, w) / 2, u = q* (v - wind).
/// Frames   p, v, gravity, wind in World; w, F, M in A.
/// Sources  Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 1993: classical order 4, and
///          Dormand & Prince 5(4) with step control.
/// Model    any `Wrench model(const Vec3& u, const Vec3& w)`.

#include "dynamics/flight/flight_step.h"
#include "dynamics/maths/dormand_prince.h"
#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {

/// A rigid body in flight with any principal moments, in A.
struct RigidFlight {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();
  Quat q = Quat::Identity();  ///< A to World
  Vec3 w = Vec3::Zero();      ///< angular velocity in A
};

namespace runge_kutta {

using State = Eigen::Matrix<double, 13, 1>;

inline State pack(const RigidFlight& f) {
  State y;
  y << f.p, f.v, f.q.w(), f.q.x(), f.q.y(), f.q.z(), f.w;
  return y;
}
inline RigidFlight unpack(const State& y) {
  return {y.segment<3>(0), y.segment<3>(3), Quat(y[6], y[7], y[8], y[9]).normalized(), y.segment<3>(10)};
}

/// Parameters of the equations above, besides the motion.
struct FlightConditions {
  double mass = 1;
  Vec3 inertia = Vec3::Ones();  ///< principal moments in A [kg m2]
  Vec3 gravity = Vec3::Zero(), wind = Vec3::Zero();
};

template <class Model>
State rate(const State& y, const FlightConditions& s, const Model& model) {
  const Quat q = Quat(y[6], y[7], y[8], y[9]).normalized();
  const Vec3 v = y.segment<3>(3), w = y.segment<3>(10);
  const Wrench f = model(Vec3(q.conjugate() * (v - s.wind)), w);
  const Quat dq = q * Quat(0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z());
  State d;
  d << v, s.gravity + q * f.force / s.mass, dq.w(), dq.x(), dq.y(), dq.z(),
      (f.torque - w.cross(s.inertia.cwiseProduct(w))).cwiseQuotient(s.inertia);
  return d;
}

/// Takes one classical step of order 4.
template <class Model>
void step4(RigidFlight& f, double h, const FlightConditions& s, const Model& model) {
  const State y = pack(f), a = rate(y, s, model), b = rate(y + 0.5 * h * a, s, model),
              c = rate(y + 0.5 * h * b, s, model), d = rate(y + h * c, s, model);
  f = unpack(y + h / 6 * (a + 2 * b + 2 * c + d));
}

/// Dormand and Prince's pair of orders 5 and 4.
class DormandPrince {
public:
  explicit DormandPrince(double tolerance) : tolerance_(tolerance) {}

  /// Advances by exactly `seconds` in steps of its own choice, at most a million.
  template <class Model>
  void advance(RigidFlight& f, double seconds, const FlightConditions& s, const Model& model) {
    double left = seconds;
    for (int n = 0; left > 0 && n < 1000000; ++n) {
      const double h = std::min(step_, left);
      const double error = tryStep(f, h, s, model);
      if (error <= 1 || h < 1e-9) {
        f = unpack(next_);
        left = h < left ? left - h : 0;
      }
      const double factor = std::clamp(0.9 * det::pow(std::max(error, 1e-12), -0.2), 0.2, 5.0);
      if (h == step_ || error > 1) step_ = h * factor;
    }
  }

private:
  double tolerance_, step_ = 1e-3;
  State next_;

  /// Returns the error of a step in multiples of the tolerance; leaves the result in `next_`.
  template <class Model>
  double tryStep(const RigidFlight& f, double h, const FlightConditions& s, const Model& model) {
    namespace pair = dormand_prince;
    const State y = pack(f);
    State k[pair::kStages], error = State::Zero();
    for (int i = 0; i < pair::kStages; ++i) {
      State sum = State::Zero();
      for (int j = 0; j < i; ++j) sum += pair::kWeights[i][j] * k[j];
      next_ = y + h * sum;
      k[i] = rate(next_, s, model);
      error += pair::kError[i] * k[i];
    }
    error *= h;
    const auto scale = 1 + y.cwiseAbs().cwiseMax(next_.cwiseAbs()).array();
    return (error.array() / scale).abs().maxCoeff() / tolerance_;
  }
};

}  // namespace runge_kutta
}  // namespace stadion
