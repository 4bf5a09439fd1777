#include "engine/nodes/sound_node.h"

#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {

SoundNode::SoundNode(NodeRef self, std::string name, PlaceAttributes place, Attributes a, bool on)
    : PlacedNode(NodeKind::Sound, self, std::move(name), std::move(place)), attributes_(std::move(a)),
      switch_(on) {
  if (attributes_.loop) attributes_.length = std::max(attributes_.length, kShortestPass);
}

void SoundNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  handle_ = scene.addSound(placement());
  if (switch_.on()) startAt(scene.now(), scene);
}

void SoundNode::onLeave(Scene& scene) {
  scene.removeSound(handle_);
  PlacedNode::onLeave(scene);
}

void SoundNode::startAt(Nanoseconds when, Scene& scene) {
  since_ = when, due_ = when + attributes_.length;
  scene.wakeAt(due_, self());
  publish(scene);
}

void SoundNode::publish(Scene& scene) {
  heard_ = switch_.on();
  tell(scene);
}

bool SoundNode::resume(Scene& scene) {
  if (!scene.isSound(handle_, placement())) return false;
  // Each pass that it has missed is told.
  const bool repeats = switch_.on() && attributes_.loop;
  if (since_ < 0 || due_ < 0) return false;
  if (repeats && (scene.now() - due_) / attributes_.length > kMostPasses) return false;
  tell(scene);
  return true;
}

void SoundNode::tell(Scene& scene) const {
  scene.setSound(handle_, heard_,
                 {self(), attributes_.file, Vec3::Zero(), attributes_.gain, attributes_.range,
                  attributes_.loop, since_});
}

void SoundNode::endPasses(Nanoseconds time) {
  while (switch_.on() && due_ <= time) {
    raise(Event::Finished, due_);
    if (attributes_.loop)
      due_ += attributes_.length;
    else
      switch_.set(false);
  }
}

void SoundNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  endPasses(frame.effective(m));  // what has passed up to the command still counts
  if (switch_.obey(m) && switch_.on()) startAt(frame.effective(m), frame.scene);
}

void SoundNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  endPasses(frame.now.time);
  if (switch_.on()) frame.scene.wakeAt(due_, self());
  if (heard_ != switch_.on()) publish(frame.scene);
}

template <class Self, class Fields>
void SoundNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("switch", self.switch_), f("since", self.since_), f("due", self.due_);
  f.kept("handle", self.handle_), f.kept("heard", self.heard_);
}

void SoundNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void SoundNode::state(StateFields& f) {
  fields(*this, f);
}

}  // namespace stadion
