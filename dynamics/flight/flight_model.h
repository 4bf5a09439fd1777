#pragma once
/// How air pushes and turns a body in flight: a ladder of models, each a closed form.
///
/// Frames   everything is in the flight frame A, whose origin is the centre of mass. Long bodies: +x is the
///          nose. Flat bodies: z is the axis, either way round. A comes from the body's surface
///          (`flight_shape.h`).
/// Motion   `u` is the centre's velocity relative to the air, `w` the angular velocity.
/// Force    of all models but the ball's and the table's, with k the axis, u_k = u.k, u_p = u - u_k k:
///            F = -(rho/2) (across u_p + along u_k k),   M = (rho/2) (turn k x u - damp w_p)
///          `across`, `along`, `turn` and `damp` follow from |u|, u_k and |u_p|; see each model.
/// Values   areas are drag coefficient times area. Nothing depends on the mass.
/// Sources  docs/flight.md. The numbers for javelin, discus and football are fits to strip and wing models.
/// Threads  plain values.

#include "engine/maths/maths.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace stadion {

/// The rungs, as the script names them. `Bias` has no wrench: it turns the body by hand (`bias.h`).
enum class FlightKind { Ballistic, Bias, Rod, Plate, Ball, Table };

/// Force and torque of the air on a body.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< at the centre of mass [N]
  Vec3 torque = Vec3::Zero();  ///< about it [N m]
};

/// No air.
struct BallisticFlight {};

/// A long body: drag along it, drag and lift across it that act behind the centre and turn the nose into the
/// wind. across = crossArea |u_p| + liftArea u_x, along = axialArea |u|,
/// turn = crossArm crossArea |u_p| + liftArm liftArea u_x, damp = damping |u|.
struct RodFlight {
  double axialArea = 0;  ///< [m2]
  double crossArea = 0;  ///< [m2]
  double liftArea = 0;   ///< [m2]
  double crossArm = 0;   ///< how far behind the centre the cross drag acts [m]
  double liftArm = 0;    ///< distance of the lift's point behind the centre [m]
  double damping = 0;    ///< damping of the angular velocity across [m4]
};

/// A flat body that spins about its axis: lift that grows with the angle of attack and stalls. With
/// s = |u_z| / |u|, g = 1 / (1 + (s^2 / stall)^8):
/// across = dragArea |u|, along = across + |u| (g (liftArea + liftGrowth s) + (1 - g) stallArea (1.6 - 0.6
/// s)), turn = g momentVolume u_z, damp = damping |u|.
struct PlateFlight {
  double dragArea = 0;      ///< [m2]
  double liftArea = 0;      ///< [m2]
  double liftGrowth = 0;    ///< [m2]
  double stallArea = 0;     ///< [m2]
  double momentVolume = 0;  ///< nose-up moment before the stall [m3]
  double stall = 0.262;     ///< sine squared of the stall angle
  double damping = 0;       ///< damping of the angular velocity across [m4]
};

/// A ball: drag that falls at the critical speed, and Magnus lift that saturates with the spin.
/// CD = dragLow + dragDrop / (1 + exp((|u| - criticalSpeed) / criticalWidth)),
/// CL = liftMost (1 - exp(-S / liftScale)) with S = radius |w x u| / u^2, along w x u.
struct SportsBall {
  double radius = 0.11;          ///< [m]
  double dragLow = 0.155;        ///< drag coefficient far above the critical speed
  double dragDrop = 0.346;       ///< how much more it is far below
  double criticalSpeed = 12.19;  ///< [m/s]
  double criticalWidth = 1.309;  ///< [m/s]
  double liftMost = 0.33;        ///< lift coefficient of a fast spin
  double liftScale = 0.17;
};

/// A body of revolution from a table of coefficients, see `flight_table.h`.
/// F = -(rho/2) |u| (across u_p + |u| along k), M = (rho/2) |u| (turn k x u - damp w_p); the four follow
/// smoothly from the angle between k and u.
struct TableFlight {
  static constexpr std::size_t kPieces = 128;  ///< from 0 to 180 degrees, evenly in `pieceAt`
  struct Piece {                               ///< cubics in the piece's own 0..1, rising powers
    std::array<double, 4> across{}, along{}, turn{}, damp{};
  };
  int axis = 0;               ///< k: 0 = x, 2 = z
  std::vector<Piece> pieces;  ///< kPieces of them; empty: no air
};

using FlightModel = std::variant<BallisticFlight, RodFlight, PlateFlight, SportsBall, TableFlight>;

/// Returns the wrench of air with `density` [kg/m3] on a body with velocity u [m/s] and angular velocity w
/// [rad/s] relative to the air, in A. Finite for finite motion; no air speed gives no force.
Wrench aerodynamics(const FlightModel& model, double density, const Vec3& u, const Vec3& w);

/// The axis of symmetry in A: 0 = x (rod), 2 = z (plate), as the table says; nothing where the model has
/// none.
std::optional<int> symmetryAxis(const FlightModel& model);

FlightKind kindOf(const FlightModel& model);

/// A number of `coefficients="..."` in a script, in their order there.
struct Coefficient {
  const char* name;
  const char* unit;
  double least, most;
};
/// Returns the coefficients of rod, plate and ball; empty for other kinds.
std::span<const Coefficient> coefficientsOf(FlightKind kind);
/// The model with these numbers; nothing if they are too many or too few or the kind has none. (Ranges are
/// the caller's to check, with the table above.)
std::optional<FlightModel> modelFrom(FlightKind kind, std::span<const double> coefficients);
/// The other way.
std::vector<double> coefficientsOf(const FlightModel& model);

/// The shipped fits, for a body of another size with the same shape.
RodFlight javelinFlight(double length = 2.65);
PlateFlight discusFlight(double diameter = 0.22);
SportsBall footballFlight(double radius = 0.11);

}  // namespace stadion
