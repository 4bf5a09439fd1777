#include "engine/scene/object_node.h"

#include "engine/scene/scene.h"

namespace stadion {

void ObjectNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  instance_ = scene.instances().add(placement(), appearance_.mesh, appearance_.drawn, self());
}

bool ObjectNode::resume(Scene& scene) {
  return scene.instances().owns(instance_, self());
}

void ObjectNode::onLeave(Scene& scene) {
  scene.instances().remove(instance_);
  PlacedNode::onLeave(scene);
}

}  // namespace stadion
