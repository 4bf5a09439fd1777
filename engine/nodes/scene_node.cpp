#include "engine/nodes/scene_node.h"

#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {

constexpr Event lastOf(Event) {
  return static_cast<Event>(kEventCount - 1);
}

void SceneNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  if (initially_) load(scene, scene.now());
}

void SceneNode::load(Scene& scene, Nanoseconds at) {
  if (number_ != 0) return;
  number_ = scene.requestLoad(file_, self(), at);
  expected_.push_back({at, Event::Loaded});
  scene.wakeAt(at, self());
}

void SceneNode::unload(Scene& scene, Nanoseconds at) {
  if (number_ == 0) return;
  scene.requestUnload(number_, at);
  number_ = 0;
  expected_.push_back({at, Event::Unloaded});
  scene.wakeAt(at, self());
}

void SceneNode::receive(const Message& m, FrameContext& frame) {
  if (m.verb != Verb::Reset) PlacedNode::receive(m, frame);
  const Nanoseconds at = frame.effective(m) + ready_;
  switch (m.verb) {
  case Verb::Load: load(frame.scene, at); break;
  case Verb::Unload: unload(frame.scene, at); break;
  case Verb::Reset:
    resetPlace(frame.scene);
    unload(frame.scene, at);
    if (initially_) load(frame.scene, at);
    break;
  default: break;
  }
}

void SceneNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  std::erase_if(expected_, [&](const auto& e) {
    if (e.first > frame.now.time) return false;
    if (e.second == Event::Loaded && number_ != 0 && frame.scene.awaits(number_)) {  // it comes late
      frame.scene.wakeAt(frame.now.time + 1, self());
      return false;
    }
    // A file that could not be loaded is not there; the load may be asked for again.
    const bool failed = e.second == Event::Loaded && number_ != 0 && !frame.scene.load(number_);
    if (failed)
      number_ = 0;
    else
      raise(e.second, std::max(e.first, frame.now.time - frame.now.step));
    return true;
  });
}

template <class Self, class Fields>
void SceneNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("load", self.number_), f("expected", self.expected_);
}

void SceneNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void SceneNode::state(StateFields& f) {
  fields(*this, f);
}

}  // namespace stadion
