#include "engine/scene/object_node.h"

#include "engine/scene/scene.h"

namespace stadion {

void ObjectNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  instance_ = scene.addInstance(placement(), appearance_.mesh, appearance_.drawn, self());
}

bool ObjectNode::resume(Scene& scene) {
  return scene.owns(instance_, self());
}

void ObjectNode::onLeave(Scene& scene) {
  scene.removeInstance(instance_);
  PlacedNode::onLeave(scene);
}

}  // namespace stadion
