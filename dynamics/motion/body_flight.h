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

/// The same mass, its principal axes those of the flight frame and its two moments across the model's axis
/// made equal, if it nearly is such a body of revolution: a model's mesh is only as round as its facets.
/// Others keep theirs.
MassProperties revolved(const MassProperties& mass, const BodyFlight& flight);

}  // namespace stadion
