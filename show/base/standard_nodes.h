#pragma once
/// The node types that every show may use: those of the engine and of dynamics.

#include "engine/core/node_registry.h"

#include <memory>

namespace stadion {

/// Node types as the parts of a run share them.
using SharedTypes = std::shared_ptr<const NodeRegistry>;

/// Returns the same registry each time, from any thread.
SharedTypes standardNodes();

}  // namespace stadion
