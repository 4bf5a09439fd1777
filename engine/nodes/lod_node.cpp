#include "engine/nodes/lod_node.h"

#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {

std::size_t LodNode::levelAt(double distance, std::size_t level, const std::vector<double>& ranges) {
  std::size_t now = 0;
  while (now < ranges.size() && distance >= ranges[now] * (now < level ? 1 - kBand : 1)) ++now;
  return now;
}

void LodNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  Scene& scene = frame.scene;
  const Vec3 head = scene.rigPose() * scene.headInRig(frame.input).p;
  const double distance = (scene.placements().world(placement()).translation() - head).norm();
  const double counted = distance * scene.stress() * scene.reliefOf(self()).lod;
  const std::size_t level = levelAt(counted, chosen_ ? level_ : 0, ranges_);
  if (!chosen_ || level != level_) choose(scene, level);
}

void LodNode::choose(Scene& scene, std::size_t level) {
  level_ = level, chosen_ = true;
  for (std::size_t i = 0; i < children_.size(); ++i)
    if (const auto* child = dynamic_cast<const PlacedNode*>(scene.find(children_[i])))
      scene.placements().setShown(child->placement(), i == level, Hider::Level);
}

}  // namespace stadion
