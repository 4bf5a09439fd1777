#pragma once
/// The node types of this floor, for the factory table.

#include "engine/build/builder.h"

#include <functional>

namespace stadion {

struct BodyAttributes;
class AssetRoots;

/// How a show is built with other models than its script says, so that they can be compared.
struct DynamicsVariation {
  /// May change how a body looks to collisions (its shape) and what it is (fields, drag area). On the
  /// loader's thread; empty: nothing.
  std::function<void(NodeRef body, Appearance&, BodyAttributes&)> body;
  std::uint32_t fineness = 1;  ///< of all dynamics nodes, as in World::setFineness
};

/// What a dynobject's declaration says of its body; its flight, which depends on the model, is left open.
BodyAttributes bodyAttributesOf(const Declaration& dynobject);

/// `roots`: where tables of coefficients are looked for; null: nowhere. Borrowed.
void addDynamicsFactories(NodeFactories& factories, const DynamicsVariation& variation = {},
                          const AssetRoots* roots = nullptr);

}  // namespace stadion
