#include "show/base/standard_nodes.h"

#include "dynamics/nodes/dynamics_nodes.h"
#include "engine/nodes/engine_nodes.h"

namespace stadion {

SharedTypes standardNodes() {
  // Nothing changes them: a show with plugins has a registry of its own.
  static const SharedTypes standard = [] {
    auto types = std::make_shared<NodeRegistry>();
    addEngineNodes(*types);
    addDynamicsNodes(*types);
    return types;
  }();
  return standard;
}

}  // namespace stadion
