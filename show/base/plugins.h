#pragma once
/// Plugins: shared libraries that add node types (engine/build/plugin.h).
///
/// Ownership  a plugin stays loaded until the program ends: nodes and messages point into it.

#include "engine/base/diagnostic.h"
#include "show/base/standard_nodes.h"

#include <string>
#include <vector>

namespace stadion {

/// The standard node types and those of the plugins in these files, in this order.
Result<SharedTypes> nodesWith(const std::vector<std::string>& files);

}  // namespace stadion
