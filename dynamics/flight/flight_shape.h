#pragma once
/// What flight needs to know of a body's outside, measured once when it is loaded, and the models that follow
/// from it.
///
/// Frames   N is the mesh's, A the flight frame: axes along the principal axes of the surface, x the longest
///          (towards the nose), z the shortest; origin at the centre of mass.
/// Sources  principal axes: second moments of the surface's area, integrated exactly (`principal_axes.h`).
///          Rod: strips in cross flow (Hoerner, Fluid-Dynamic Drag, 1965; Allen & Perkins, NACA 1048, 1951).
///          Plate: the discus' fit, in shares of area and diameter.

#include "dynamics/flight/flight_model.h"
#include "dynamics/flight/principal_axes.h"
#include "engine/asset/mesh.h"

namespace stadion {

struct FlightShape {
  PrincipalAxes axes;     ///< principal axes of the surface, in N
  Quat q_NA;              ///< A to N
  double length = 0;      ///< extent along A's x [m]
  double width = 0;       ///< extent along A's y [m]
  double thickness = 0;   ///< extent along A's z [m]
  double frontArea = 0;   ///< seen along x [m2]
  double sideArea = 0;    ///< seen across x, mean over the directions [m2]
  double topArea = 0;     ///< seen along z [m2]
  double wetArea = 0;     ///< area of the whole surface [m2]
  double sideArm = 0;     ///< how far the side area's middle lies behind the centre of mass [m]
  double wetArm = 0;      ///< distance of the whole surface's middle behind the centre of mass [m]
  double noseArm = 0;     ///< how far before it the front grows to its full width, on average [m]
  double sideSpread = 0;  ///< second moment of the side area along x about the centre of mass [m4]

  /// Returns this shape `factor` times as large.
  FlightShape scaled(double factor) const;
  /// (l1 - l3) / l1 is below 2 %: it has no direction, and no bias turns it.
  bool round() const { return axes.round(); }
  /// Longer than wide more than wide rather than thick: a rod, else a plate.
  bool elongated() const;
};

/// Measures a mesh with its centre of mass in N. The nose is the end that `nose` points to. If it is not
/// stated, the nose is on the centre of mass's side of the surface's middle, where the wind keeps it. If
/// these coincide, the skewness of the surface decides.
FlightShape measureShape(const Mesh& mesh, const Vec3& centreOfMass,
                         const std::optional<Vec3>& nose = std::nullopt);

/// Models for a body of which nothing but its shape is known.
RodFlight rodFrom(const FlightShape& shape);
PlateFlight plateFrom(const FlightShape& shape);
/// A football of the same mean cross section.
SportsBall ballFrom(const FlightShape& shape);

/// The shipped fits by the names `coefficients=` knows: javelin (rod), discus (plate), football (ball), for a
/// body of this size; nothing if the kind has none of that name.
std::optional<FlightModel> shippedFlight(FlightKind kind, const std::string& name, const FlightShape& shape);
/// Returns the names of the shipped fits.
std::vector<std::string> shippedFlights(FlightKind kind);

}  // namespace stadion
