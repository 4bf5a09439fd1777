#include "engine/nodes/group_node.h"

#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"

namespace stadion {

namespace {

std::unique_ptr<Node> makePlaced(const NodeRequest& r) {
  return std::make_unique<PlacedNode>(r.type(), r.self, r.name, r.place);
}

}  // namespace

constinit const NodeType kGroupType{
    .name = "group",
    .help = "gathers nodes under one name and place",
    .traits = {Trait::Placed, Trait::Parent, Trait::Level},
    .make = makePlaced,
};

constinit const NodeType kTransformType{
    .name = "transform",
    .help = "places its children; made to be moved by messages and paths",
    .traits = {Trait::Placed, Trait::Parent, Trait::Level},
    .make = makePlaced,
};

namespace node_types {

void addGroupNode(NodeRegistrar& types) {
  types.add(kGroupType);
  types.add(kTransformType);
}

}  // namespace node_types

}  // namespace stadion
