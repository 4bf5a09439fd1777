#include "engine/nodes/lod_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/scene/scene.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {

std::size_t LodNode::levelAt(double distance, std::size_t level, const std::vector<double>& ranges) {
  std::size_t now = 0;
  while (now < ranges.size() && distance >= ranges[now] * (now < level ? 1 - kBand : 1)) ++now;
  return now;
}

void LodNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  Scene& scene = frame.scene;
  const Vec3 head = scene.feed().rigPose() * scene.feed().headInRig(frame.input).p;
  const double distance = (scene.placements().world(placement()).translation() - head).norm();
  const double counted = distance * scene.degradation().stress() * scene.degradation().of(self()).lod;
  const std::size_t level = levelAt(counted, chosen_ ? level_ : 0, ranges_);
  if (!chosen_ || level != level_) choose(scene, level);
}

void LodNode::choose(Scene& scene, std::size_t level) {
  level_ = level;
  chosen_ = true;
  for (std::size_t i = 0; i < children_.size(); ++i)
    if (const auto* child = dynamic_cast<const PlacedNode*>(scene.find(children_[i])))
      scene.placements().setShown(child->placement(), i == level, Hider::Level);
}

namespace {

std::unique_ptr<Node> makeLod(const NodeRequest& r) {
  return std::make_unique<LodNode>(r.self, r.name, r.place, r.children, r.declaration.distances("ranges"));
}

void lintLod(const Declaration& node, LintScope& scope) {
  const std::size_t ranges = node.distances("ranges").size(), levels = scope.useOf(node).levels;
  if (levels < ranges)
    scope.warn(node, "ranges",
               fmt::format("{} has {} ranges for {} of its children: beyond them nothing is drawn",
                           LintScope::called(node), ranges, levels));
  if (levels > ranges + 1)
    scope.warn(node, "ranges",
               fmt::format("{} has {} children for {} ranges; those after the {}th are never drawn",
                           LintScope::called(node), levels, ranges, ranges + 1));
}

constexpr AttributeSpec kLodRows[] = {
    {.name = "ranges",
     .kind = ValueKind::Distances,
     .help = "how far away its first child is drawn, then its second, ...; beyond the last one the next "
             "child, if there is one more, or nothing. From the visitor's head to the node's place",
     .unit = "m",
     .range = kLengthRange,
     .required = true},
};

}  // namespace

constinit const NodeType kLodType{
    .name = "lod",
    .help = "draws one of its children, by how far away it is",
    .attributes = kLodRows,
    .traits = {Trait::Placed, Trait::Parent, Trait::Level, Trait::Moves},
    .make = makeLod,
    .lint = lintLod,
};

namespace node_types {

void addLodNode(NodeRegistrar& types) {
  types.add(kLodType);
}

}  // namespace node_types

}  // namespace stadion
