#pragma once
/// The node types of this floor, for the factory table.

#include "engine/script/builder.h"

namespace stadion {

void addDynamicsFactories(NodeFactories& factories);

}  // namespace stadion
