#pragma once
/// `group` and `transform`: they place what is below them, and do nothing else.

#include "engine/core/node_type.h"

namespace stadion {

extern const NodeType kGroupType;
extern const NodeType kTransformType;

}  // namespace stadion
