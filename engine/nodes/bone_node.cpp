#include "engine/nodes/bone_node.h"

#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/figure/clip_words.h"
#include "engine/nodes/figure_node.h"
#include "engine/scene/scene.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {

BoneNode::BoneNode(NodeRef self, std::string name, PlaceAttributes place, std::optional<std::uint32_t> bone)
    : PlacedNode(kBoneType, self, std::move(name), std::move(place)), bone_(bone) {}

/// Null if its model is missing.
FigureNode* BoneNode::figure(Scene& scene) const {
  return bone_ ? dynamic_cast<FigureNode*>(scene.find(attributes().parent)) : nullptr;
}

void BoneNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  FigureNode* parent = figure(scene);
  if (!parent) return;
  parent->carry(self(), *bone_);
  parent->placeCarried(scene);
}

void BoneNode::onLeave(Scene& scene) {
  if (FigureNode* parent = figure(scene)) parent->letGo(self());
  PlacedNode::onLeave(scene);
}

bool BoneNode::resume(Scene& scene) {
  if (!PlacedNode::resume(scene)) return false;
  if (FigureNode* parent = figure(scene)) parent->carry(self(), *bone_);
  return true;
}

/// A reset or a detached node returns to the bone, also if the figure stands still.
void BoneNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  if (FigureNode* parent = figure(frame.scene)) parent->placeCarried(frame.scene);
}

namespace {

std::unique_ptr<Node> makeBone(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto parent = d.reference("parent");
  const std::optional<PlacedModel> model = parent ? r.model(*parent) : std::nullopt;
  std::optional<std::uint32_t> number;
  if (!model || (!model->mesh->skeleton && !model->mesh->standIn)) {
    r.findings.error(d.where("bone"), "a bone needs parent=NAME, the name of a figure in the same file",
                     d.excerpt("bone"));
  } else if (const auto& skeleton = model->mesh->skeleton) {
    const auto at = std::ranges::find(skeleton->bones, d.text("bone"), &Bone::name);
    if (at == skeleton->bones.end())
      r.findings.error(
          d.where("bone"),
          fmt::format("the figure has no bone \"{}\"; there are {}", d.text("bone"), boneNames(*skeleton)),
          d.excerpt("bone"));
    else
      number = static_cast<std::uint32_t>(at - skeleton->bones.begin());
  }
  return std::make_unique<BoneNode>(r.self, r.name, r.place, number);
}

constexpr AttributeSpec kBoneRows[] = {
    {.name = "bone",
     .kind = ValueKind::Words,
     .help = "the name of the bone: that of a node in the figure's file",
     .required = true},
};

}  // namespace

constinit const NodeType kBoneType{
    .name = "bone",
    .help = "a place that goes with a bone of a figure, which is its parent",
    .attributes = kBoneRows,
    .traits = {Trait::Placed, Trait::Parent, Trait::Level, Trait::Moves},
    .make = makeBone,
};

namespace node_types {

void addBoneNode(NodeRegistrar& types) {
  types.add(kBoneType);
}

}  // namespace node_types

}  // namespace stadion
