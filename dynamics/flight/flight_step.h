#pragma once
/// Fixed steps of a body through air: the default integrator of all rungs, for one body and for many.
///
/// Method   half a step of free flight, the air's kick, half a step of free flight: Strang splitting with the
///          exact parabola, the exact symmetric top and the exact flow of drag. One look at the model a step.
///          At 60 Hz a discus lands within 0.1 % and a javelin within 0.05 % (docs/flight.md).
/// Frames   A is the flight frame (flight_model.h); p, v, L, gravity and wind are in World.
/// Bits     the same on all machines; the steps of many give each body the bits of the single step.
/// Threads  a stepper is constant: share it.

#include "dynamics/flight/flight_model.h"

#include <memory>

namespace stadion {

/// A body of revolution as matter. `across` is the mean of two moments where they differ.
struct FlightBody {
  double mass = 1;    ///< [kg]
  double along = 1;   ///< moment of inertia about its axis [kg m2]
  double across = 1;  ///< moment of inertia about any axis across it [kg m2]
};

/// Where it is and how it moves.
struct FlightState {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();  ///< position and velocity of the centre of mass
  Quat q = Quat::Identity();                ///< A to World
  Vec3 L = Vec3::Zero();                    ///< angular momentum in World [kg m2/s]
};
/// L from the angular velocity in A, and back; `axis` is that of symmetry, 0 or 2.
Vec3 momentumOf(const FlightBody& body, int axis, const Quat& q, const Vec3& w_A);
Vec3 angularVelocityOf(const FlightBody& body, int axis, const FlightState& state);

/// Gravity and air around the body.
struct FlightAir {
  Vec3 gravity = Vec3(0, 0, -9.80665);  ///< [m/s2]
  Vec3 wind = Vec3::Zero();             ///< [m/s]
  double density = 1.225;               ///< [kg/m3]
};

/// States of many bodies as arrays, each as long as there are bodies: p, v (x, y, z), q (w, x, y, z), L.
class FlightSwarm {
public:
  static constexpr std::size_t kArrays = 13;
  explicit FlightSwarm(std::size_t bodies);
  std::size_t size() const { return bodies_; }
  FlightState at(std::size_t i) const;
  void set(std::size_t i, const FlightState& state);
  double* array(std::size_t which) { return numbers_.data() + which * stride_; }

private:
  std::size_t bodies_, stride_;  ///< stride: bodies, up to a whole number of lanes
  std::vector<double> numbers_;
};

/// Steps of one length for bodies of one kind. Borrows nothing: the model is copied.
class FlightStepper {
public:
  /// A model without an axis of its own turns about `axis`.
  FlightStepper(const FlightModel& model, const FlightBody& body, const FlightAir& air, double seconds,
                int axis = 0);
  FlightStepper(FlightStepper&&) noexcept;
  ~FlightStepper();

  void step(FlightState& state) const;
  /// All bodies of the swarm, several at a time; with AVX2 where the machine has it.
  void step(FlightSwarm& swarm) const;

private:
  struct Numbers;
  std::unique_ptr<const Numbers> numbers_;
};

}  // namespace stadion
