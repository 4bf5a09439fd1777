#pragma once
/// The body that `stadion fit` is about: a model file, or a dynobject of a script as SCRIPT.evs:NAME.

#include "dynamics/mass_properties.h"
#include "engine/asset/mesh.h"
#include "engine/diagnostic.h"

#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct FlownObject {
  Mesh mesh;  ///< at the script's scale
  MassProperties mass;
  std::optional<Vec3> nose;  ///< as the script says it
};

/// `massStated` [kg] goes before the script's and the density's. Errors as the importer and the checker say
/// them.
Result<FlownObject> readFlownObject(const std::string& object, const std::vector<std::string>& roots,
                                    std::optional<double> massStated);

}  // namespace stadion
