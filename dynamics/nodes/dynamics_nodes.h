#pragma once
/// The node types of this layer. Their list is generated: every file `dynamics/nodes/x_y_node.cpp` defines
/// `node_types::addXYNode`.

namespace stadion {

class NodeRegistry;

void addDynamicsNodes(NodeRegistry& types);

}  // namespace stadion
