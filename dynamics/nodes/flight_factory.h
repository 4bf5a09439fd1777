#pragma once
/// From what the script says of a body's flight (`flight`, `coefficients`, `flighttable`, `bias`, `biasrate`,
/// `axes`, `nose`) to how it flies.

#include "dynamics/motion/body_flight.h"
#include "engine/asset/roots.h"
#include "engine/build/node_request.h"

namespace stadion {

/// Null for flight=point. Expects the request of a dynobject with its mesh. `mass`: of the body at the scale
/// of its declaration, at which its form is measured as well. Errors point at the attribute, or into the
/// table.
Result<std::shared_ptr<const BodyFlight>> flightOf(const NodeRequest& request, const MassProperties& mass,
                                                   const AssetRoots* roots);

/// NodeType::check of the dynobject: what only one way of flight has a use for.
void checkFlight(DeclarationCheck& check);

}  // namespace stadion
