#include "engine/nodes/light_node.h"

#include "engine/scene/scene.h"

namespace stadion {

void LightNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  handle_ = scene.addLight(placement(), light_, self());
  scene.setLight(handle_, light_, switch_.on());
}

bool LightNode::resume(Scene& scene) {
  if (!scene.isLight(handle_, self())) return false;
  scene.setLight(handle_, light_, switch_.on());
  return true;
}

void LightNode::onLeave(Scene& scene) {
  scene.removeLight(handle_);
  PlacedNode::onLeave(scene);
}

void LightNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  if (switch_.obey(m)) frame.scene.setLight(handle_, light_, switch_.on());
}

void SkyNode::onEnter(Scene& scene) {
  scene.addSky(self(), sky_);
}

bool SkyNode::resume(Scene& scene) {
  scene.setSky(self(), sky_);
  return true;
}

void SkyNode::onLeave(Scene& scene) {
  scene.removeSky(self());
}

}  // namespace stadion
