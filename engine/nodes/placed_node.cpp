#include "engine/nodes/placed_node.h"

#include "engine/input/input_sample.h"
#include "engine/scene/scene.h"

namespace stadion {

namespace {

/// What attaching keeps: the lengths of the node's axes.
Vec3 scaleOf(const Affine& X) {
  return X.linear().colwise().norm().transpose();
}

}  // namespace

void PlacedNode::onEnter(Scene& scene) {
  placement_ = scene.placements().add(scene.placementFor(attributes_.parent, self()), attributes_.X_PN);
  shown_ = attributes_.shown;
  if (!shown_) scene.placements().setShown(placement_, false);
  X_PN_ = attributes_.X_PN;
}

void PlacedNode::onLeave(Scene& scene) {
  scene.placements().remove(placement_);
}

void PlacedNode::aboutToChange(Scene& scene) {
  scene.touch(self());
  if (!carriesStatics_) return;
  carriesStatics_ = false;
  scene.promoteBelow(self());
}

bool PlacedNode::place(Scene& scene, const Affine& X_WN) {
  aboutToChange(scene);
  if (!scene.placements().setWorld(placement_, X_WN)) return false;
  X_PN_ = scene.placements().local(placement_);
  return true;
}

void PlacedNode::becomeHome(Scene& scene, const Affine& X_WN) {
  if (place(scene, X_WN)) attributes_.X_PN = X_PN_;
}

void PlacedNode::resetPlace(Scene& scene) {
  aboutToChange(scene);
  follow_ = Follow::Nothing;
  X_PN_ = attributes_.X_PN;
  scene.placements().setLocal(placement_, X_PN_);
  shown_ = attributes_.shown;
  scene.placements().setShown(placement_, shown_);
}

void PlacedNode::follow(const std::string& what, const std::string& tracker, const FrameContext& frame) {
  follow_ = what == "position" ? Follow::Position : what == "orientation" ? Follow::Orientation : Follow::All;
  tracker_ = tracker;
  if (tracker_.empty()) tracker_ = frame.input.find("foot") ? "foot" : "wand";
}

void PlacedNode::receive(const Message& m, FrameContext& frame) {
  switch (m.verb) {
  case Verb::Attach:
    follow(m.arguments.empty() ? "all" : m.arguments[0], m.arguments.size() > 1 ? m.arguments[1] : "", frame);
    break;
  case Verb::Detach: stopFollowing(); break;
  case Verb::Show:
  case Verb::Hide:
    aboutToChange(frame.scene);
    shown_ = m.verb == Verb::Show;
    frame.scene.placements().setShown(placement_, shown_);
    break;
  case Verb::Reset: resetPlace(frame.scene); break;
  default: break;
  }
}

void PlacedNode::simulate(FrameContext& frame) {
  if (!attached()) return;
  const std::optional<Pose> X_WT = frame.scene.trackerInWorld(tracker_, frame.input);
  if (!X_WT) return;  // a silent tracker holds the node where it is
  const Affine& now = frame.scene.placements().world(placement_);
  Affine X = now;
  if (follow_ != Follow::Orientation) X.translation() = X_WT->p;
  if (follow_ != Follow::Position)
    X.linear() = X_WT->q.toRotationMatrix() * scaleOf(attributes_.X_PN).asDiagonal();
  if (X.matrix() != now.matrix()) place(frame.scene, X);
}

void PlacedNode::hash(StateHash& h) const {
  h.add(X_PN_);
  h.add(static_cast<std::uint32_t>(follow_));
  h.add(std::string_view(tracker_));
  h.add(shown_);
}

}  // namespace stadion
