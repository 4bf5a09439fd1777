#include "engine/nodes/object_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/script/file_path.h"
#include "engine/script/object_parts.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::string_view kModelEndings[] = {"obj", "3ds", "gltf", "glb", "dae", "fbx", "ply", "stl"};

}  // namespace

void lintModel(const Declaration& node, LintScope& scope) {
  if (isPartByUse(node)) return;  // that of its object
  const std::string ending = endingOf(node.text("file"));
  if (std::find(std::begin(kModelEndings), std::end(kModelEndings), ending) == std::end(kModelEndings))
    scope.warn(node, "file",
               fmt::format(
                   "\"{}\" is not in a format that is read (.obj, .3ds, .gltf, .glb, .dae, .fbx, .ply, .stl)",
                   node.text("file")));
}

namespace {

std::unique_ptr<Node> makeObject(const NodeRequest& r) {
  return std::make_unique<ObjectNode>(r.type(), r.self, r.name, r.place, r.appearance);
}

constexpr AttributeSpec kObjectRows[] = {kObjectFile,  kObjectDraw,      kObjectUnit,   kObjectUp,
                                         kObjectShape, kObjectTolerance, kObjectLevels, kObjectPart};

}  // namespace

constinit const NodeType kObjectType{
    .name = "object",
    .help = "a model from a file, drawn and solid but not moved by dynamics",
    .attributes = kObjectRows,
    .traits = {Trait::Placed, Trait::Parent, Trait::Level, Trait::Model},
    .make = makeObject,
    .lint = lintModel,
};

namespace node_types {

void addObjectNode(NodeRegistrar& types) {
  types.add(kObjectType);
}

}  // namespace node_types

}  // namespace stadion
