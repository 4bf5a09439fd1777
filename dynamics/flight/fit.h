#pragma once
/// Which rung of the ladder is good enough for a body, and with which numbers.
///
/// Every rung that suits the body's shape is tuned to recorded flights (position, axis and landing; least
/// squares) and judged by how it lands and how its axis points. They come in the order of what a step costs
/// (docs/flight.md): ballistic, rod, plate, ball, table, bias.

#include "dynamics/flight/bias.h"
#include "dynamics/flight/flight_table.h"
#include "dynamics/flight/trajectory.h"

namespace stadion {

/// A body and how it has flown.
struct FitTask {
  FlightBody body;
  FlightShape shape;
  std::vector<Trajectory> flights;  ///< p of the centre of mass, q and w of A; each from release to landing
  FlightAir air;
};

/// How good is good enough.
struct FitTolerance {
  double landing = 0.01;  ///< between the points of landing, in parts of the range
  double attitude = 1e9;  ///< error of the axis, mean over a flight [degrees]
};

/// Over all flights, the worst.
struct FitErrors {
  double landing = 0, attitude = 0;
};

struct FittedRung {
  FlightKind kind = FlightKind::Ballistic;
  FlightModel model;                 ///< BallisticFlight for Bias
  Bias bias;                         ///< the bias; for Bias
  std::vector<FlightTableRow> rows;  ///< the rows; for Table
  double area = 1, length = 1;       ///< area and length to which the rows refer [m2, m]
  FitErrors errors;
  bool good = false;  ///< the errors are within the tolerance
};

/// All that suit the body, the cheapest first.
std::vector<FittedRung> fitRungs(const FitTask& task, const FitTolerance& tolerance);

/// How far off a rung is on these flights.
FitErrors errorsOf(const FitTask& task, const FlightModel& model, const Bias& bias);

}  // namespace stadion
