#pragma once
/// The three flying objects, their throws, and the errors of flights.
///
/// Frames   World: x downrange, y left, z up; g = 9.81 and rho = 1.2, as in the references.

#include "bench/flight/reference_models.h"
#include "dynamics/flight/flight_shape.h"
#include "dynamics/flight/trajectory.h"
#include "engine/maths/angles.h"

#include <functional>
#include <string>
#include <vector>

namespace stadion::bench {

constexpr double kGravity = 9.81, kDensity = 1.2;

enum class Thing { Javelin, Discus, Ball };

using AnyModel = std::function<Wrench(const Vec3& u, const Vec3& w)>;

struct ThingFacts {
  const char* name;
  FlightBody body;
  int axis;       ///< axis of symmetry in A: 0 = x, 2 = z
  double height;  ///< height of release [m]
  AnyModel exact;
  FlightModel shipped;   ///< model that was fitted to its reference flights
  FlightModel fromMesh;  ///< the model from its mesh alone
  FlightShape shape;
  Vec3 inertia() const {
    Vec3 i = Vec3::Constant(body.across);
    i[axis] = body.along;
    return i;
  }
};
const ThingFacts& factsOf(Thing thing);

/// A throw of one of the objects.
struct Throw {
  std::string name;
  Thing thing = Thing::Javelin;
  RigidFlight start;
  Vec3 wind = Vec3::Zero();

  runge_kutta::FlightConditions conditions() const;
  FlightAir air() const;
};

/// Returns a throw at `speed` [m/s], upwards by `gamma`, pitched by `alpha` more, then rolled about its own
/// x, with angular velocity w_A. Angles in degrees.
Throw thrown(Thing thing, double speed, double gamma, double alpha, double roll, const Vec3& w_A,
             const Vec3& wind);

/// The flights that ship with the program, with their exact end; empty if they cannot be read.
struct ReferenceFlight {
  Throw release;
  Trajectory path;
  bool smooth = true;
};
Result<std::vector<ReferenceFlight>> referenceFlights(const std::string& folder);

/// Returns `count` random throws: speed, angles, roll, wind of up to 5 m/s along x and y, pitch rate. They
/// are the same in every run.
std::vector<Throw> heldOut(Thing thing, int count);

/// Calls `step(flight)` of 1/hz s until the centre is on the ground, 20 s at most. Samples every 0.1 s (hz is
/// a multiple of 10), and the landing.
Trajectory flyBy(const Throw& release, int hz, const std::function<void(RigidFlight&)>& step);

/// The exact flight of the exact model.
Trajectory flyExactly(const Throw& release, double tolerance = 1e-11);

struct FlightErrors {
  double range = 0;     ///< error of the distance downrange, relative
  double landing = 0;   ///< distance of the points of landing, relative to the range
  double attitude = 0;  ///< error of the axis, mean over the flight [degrees]
};
FlightErrors errorsOf(const Trajectory& flight, const Trajectory& exact, int axis);

}  // namespace stadion::bench
