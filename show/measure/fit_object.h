#pragma once
/// The body that `stadion fit` is about: a model file, or a dynobject of a script as SCRIPT.evs:NAME.

#include "dynamics/flight/flight_shape.h"
#include "dynamics/shapes/mass_properties.h"
#include "engine/asset/mesh.h"
#include "engine/base/diagnostic.h"

#include <optional>
#include <string>
#include <vector>

namespace stadion {

class NodeRegistry;

struct FlownObject {
  Mesh mesh;  ///< at the script's scale
  MassProperties mass;
  std::optional<Vec3> nose;  ///< as the script says it
};

/// Properties that replace those of the script or of the evenly filled model.
struct StatedMatter {
  std::optional<double> mass;   ///< [kg]
  std::optional<Vec3> centre;   ///< centre of mass, in the model's coordinates [m]
  std::optional<Vec2> moments;  ///< moments of inertia, along the axis of symmetry and across it [kg m2]
};

/// With the mass, centre and moments that a show would give it. A script that is part of a show is read with
/// the show's assets. Errors as the importer and the checker say them.
Result<FlownObject> readFlownObject(const std::string& object, const std::vector<std::string>& roots,
                                    const NodeRegistry& types, const StatedMatter& stated);

/// Moments along and across the axis of symmetry, as `inertia` of a dynobject has them.
Vec3 momentsOf(const Vec2& alongAndAcross, const FlightShape& shape);

}  // namespace stadion
