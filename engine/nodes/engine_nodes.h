#pragma once
/// The node types of this layer. Their list is generated: every file `engine/nodes/x_y_node.cpp` defines
/// `node_types::addXYNode`.

namespace stadion {

class NodeRegistry;

void addEngineNodes(NodeRegistry& types);

}  // namespace stadion
