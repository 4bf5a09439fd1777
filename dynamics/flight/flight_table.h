#pragma once
/// A flight model from a table of coefficients, as wind tunnels and papers print them.
///
/// File     comma-separated, see `number_columns.h`; columns
///            alpha_deg  angle of attack, rising
///            CD, CL     drag and lift (or CA, CN: along the axis and across it)
///            CM         pitching moment about the centre of mass; positive raises the nose, away from the
///            wind CQ         optional: M = -(rho/2) area length^2 CQ |u| w across the axis
///          and settings  # area = [m2], # length = [m] (1 if absent), # axis = x or z.
/// Angle    axis = x (long bodies): between the nose and the velocity, 0 to 180; up to 90 only: flying tail
///          first it feels the same drag, and turns back as readily. axis = z (flat bodies): between the
///          plane and the velocity, 0 to 90 if both faces are alike, else -90 to 90, air from below positive.
/// Between  cubic through the rows, even or odd about the ends as symmetry has it.

#include "dynamics/flight/flight_model.h"
#include "engine/base/diagnostic.h"

#include <string>
#include <string_view>

namespace stadion {

/// No body is longer [m].
constexpr double kLongestBody = 1000;

/// `axis` is what a table means that does not say: 0 = x, 2 = z. No body of `bodyLength` [m] has coefficients
/// times area of more than four times that length to the power of their unit. Errors have file, line and
/// column.
Result<TableFlight> readFlightTable(std::string_view text, const std::string& file, int axis,
                                    double bodyLength = kLongestBody);

/// A row of a flight table, as numbers per area and length.
struct FlightTableRow {
  double alpha = 0;  ///< [rad]
  double drag = 0, lift = 0, moment = 0, damping = 0;
};
/// Makes the model from the numbers of a table. `rows` rise, from 0 (or -pi/2) on.
TableFlight tableFrom(const std::vector<FlightTableRow>& rows, double area, double length, int axis);
/// The file of such a table.
std::string flightTableText(const std::vector<FlightTableRow>& rows, double area, double length, int axis);

}  // namespace stadion
