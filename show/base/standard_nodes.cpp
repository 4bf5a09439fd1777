#include "show/base/standard_nodes.h"

#include "dynamics/nodes/dynamics_nodes.h"
#include "engine/nodes/engine_nodes.h"

namespace stadion {

SharedTypes standardNodes() {
  auto types = std::make_shared<NodeRegistry>();
  addEngineNodes(*types);
  addDynamicsNodes(*types);
  return types;
}

}  // namespace stadion
