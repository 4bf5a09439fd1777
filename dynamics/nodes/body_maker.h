#pragma once
/// Makes the node of a dynobject, and holds what the nodes of this layer share while a show is built.

#include "dynamics/collision/impact_scheme.h"
#include "engine/build/node_request.h"

#include <functional>
#include <memory>
#include <optional>

namespace stadion {

struct BodyAttributes;
class AssetRoots;
class ShapeStore;

/// How a show is built with other models than its script says, so that they can be compared.
struct DynamicsVariation {
  /// May change how a body looks to collisions (its shape) and what it is (fields, drag area). On the
  /// loader's thread; empty: nothing.
  std::function<void(NodeRef body, Appearance&, BodyAttributes&)> body;
  std::uint32_t fineness = 1;           ///< fineness of all dynamics nodes (World::setStepDivider)
  std::optional<ImpactScheme> impacts;  ///< impact scheme of all dynamics nodes; empty: as the script says
};

/// Returns the body attributes in the declaration of a dynobject. Its flight is left open, because it depends
/// on the model.
BodyAttributes bodyAttributesOf(const Declaration& dynobject);

/// NodeType::make of the dynobject.
std::unique_ptr<Node> makeDynObject(const NodeRequest& request);

/// The services of this layer (NodeServices). By default the script counts and no table of coefficients is
/// found.
struct DynamicsServices {
  DynamicsServices();
  explicit DynamicsServices(DynamicsVariation varied, const AssetRoots* assetRoots = nullptr);

  std::shared_ptr<ShapeStore> shapes;  ///< shapes of all nodes of a show
  DynamicsVariation variation;
  const AssetRoots* roots =
      nullptr;  ///< where tables of coefficients are looked for; null: nowhere. Borrowed
};

}  // namespace stadion
