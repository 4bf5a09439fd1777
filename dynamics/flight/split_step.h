#pragma once
/// The default step (`flight_step.h`) for any `Wrench model(u, w)`, w in A: how exact the method is by itself
/// can be seen with models that are exact. Slower than FlightStepper; the same but for what that knows of its
/// models (drag along and across, damping, and the moment in the middle of the kick).

#include "dynamics/flight/flight_step.h"
#include "engine/maths/functions.h"

namespace stadion {

/// Exact free flight for `seconds`, of a symmetric top about A's `axis`.
inline void freeFlight(FlightState& s, const FlightBody& body, int axis, const Vec3& gravity,
                       double seconds) {
  s.p += seconds * (s.v + 0.5 * seconds * gravity);
  s.v += seconds * gravity;
  const Vec3 k = Vec3::Unit(axis);
  const double spin = (1 / body.along - 1 / body.across) * s.L.dot(s.q * k);
  s.q = (det::expRotation(seconds / body.across * s.L) * s.q * det::expRotation(seconds * spin * k))
            .normalized();
}

template <class Model>
void splitStep(FlightState& s, const FlightBody& body, int axis, const FlightAir& air, double h,
               const Model& model) {
  freeFlight(s, body, axis, air.gravity, 0.5 * h);
  const Vec3 u = s.v - air.wind;
  const Wrench f = model(Vec3(s.q.conjugate() * u), angularVelocityOf(body, axis, s));
  const Vec3 gain = h / body.mass * (s.q * f.force);
  const double square = u.squaredNorm();
  // Drag by its exact flow, the rest as it is.
  const double drag = square > 0 ? std::max(-gain.dot(u) / square, 0.0) : 0;
  s.v = air.wind + (u + gain + drag * u) / (1 + drag);
  s.L += h * (s.q * f.torque);
  freeFlight(s, body, axis, air.gravity, 0.5 * h);
}

}  // namespace stadion
