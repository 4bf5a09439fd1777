#pragma once
/// The node types of the engine and of dynamics, for tests that read scripts.

#include "dynamics/nodes/dynamics_nodes.h"
#include "engine/core/node_registry.h"
#include "engine/nodes/engine_nodes.h"

namespace stadion {

inline const NodeRegistry& testTypes() {
  static const NodeRegistry kTypes = [] {
    NodeRegistry types;
    addEngineNodes(types), addDynamicsNodes(types);
    return types;
  }();
  return kTypes;
}

}  // namespace stadion
