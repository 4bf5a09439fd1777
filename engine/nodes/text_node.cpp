#include "engine/nodes/text_node.h"

#include "engine/scene/scene.h"

#include <utility>

namespace stadion {

void TextNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  instance_ = scene.addInstance(placement(), kNoMesh, true, self());
  draw(scene);
}

void TextNode::onLeave(Scene& scene) {
  scene.removeInstance(instance_);
  scene.releaseMesh(std::exchange(mesh_, kNoMesh));
  PlacedNode::onLeave(scene);
}

void TextNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  if (m.verb == Verb::Say) say(m.arguments.empty() ? "" : m.arguments[0], frame.scene);
  if (m.verb == Verb::Reset) say(declared_, frame.scene);
}

void TextNode::say(std::string words, Scene& scene) {
  if (words == words_) return;
  words_ = std::move(words);
  draw(scene);
}

bool TextNode::resume(Scene& scene) {
  if (!scene.owns(instance_, self())) return false;
  draw(scene);
  return true;
}

void TextNode::draw(Scene& scene) {
  auto mesh = textMesh(words_, style_);
  const MeshId before = std::exchange(mesh_, mesh ? scene.addMesh(std::move(mesh)) : kNoMesh);
  scene.setMesh(instance_, mesh_);
  scene.releaseMesh(before);
}

template <class Self, class Fields>
void TextNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("words", self.words_);
  f.kept("instance", self.instance_);
}

void TextNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void TextNode::state(StateFields& f) {
  fields(*this, f);
}

}  // namespace stadion
