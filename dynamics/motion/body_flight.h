#pragma once
/// How one body flies: which model the air acts on it by, or which bias turns it.
///
/// A model of the air acts while the body is hooked to a medium, with that medium's density and wind, and
/// stands for the drag that the medium has on a point; without a medium there is no air. A bias turns the
/// body with or without one; its path is that of a point. What touches something feels the air as a point.
///
/// Ownership  constant, shared by all bodies of the same make.

#include "dynamics/flight/bias.h"
#include "dynamics/flight/flight_model.h"
#include "dynamics/shapes/mass_properties.h"

namespace stadion {

struct BodyFlight {
  FlightModel model;             ///< BallisticFlight if none
  Bias bias;                     ///< rate 0 if none
  Quat q_NA = Quat::Identity();  ///< flight frame A to the node's N
  bool inVacuum = false;         ///< the air does nothing: not even drag

  bool hasModel() const { return !std::holds_alternative<BallisticFlight>(model); }
  /// A bias that acts between frames, and one that acts once a frame.
  bool flows() const { return bias.rate != 0 && bias.form != BiasForm::Paper; }
  bool jerks() const { return bias.rate != 0 && bias.form == BiasForm::Paper; }
};

/// Returns the mass of a body of revolution: principal axes are those of the flight frame, and the two
/// moments across the model's axis are equal. A model's mesh is only as round as its facets. If the body is
/// not nearly one of revolution, returns `mass` unchanged.
MassProperties revolved(const MassProperties& mass, const BodyFlight& flight);

}  // namespace stadion
