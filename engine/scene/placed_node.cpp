#include "engine/scene/placed_node.h"

#include "engine/input/input_sample.h"
#include "engine/input/tracker_names.h"
#include "engine/scene/scene.h"

namespace stadion {

void PlacedNode::onEnter(Scene& scene) {
  placement_ =
      scene.placements().add(scene.tree().placementFor(attributes_.parent, self()), attributes_.X_PN);
  shown_ = attributes_.shown;
  if (!shown_) scene.placements().setShown(placement_, false);
  X_PN_ = attributes_.X_PN;
}

void PlacedNode::onLeave(Scene& scene) {
  scene.placements().remove(placement_);
}

void PlacedNode::aboutToChange(Scene& scene) {
  scene.markChanged(*this);
  makeMovable(scene);
}

void PlacedNode::makeMovable(Scene& scene) {
  if (!carriesStatics_) return;
  carriesStatics_ = false;
  scene.tree().promoteBelow(self());
}

void PlacedNode::leaveFleet(Scene& scene) {
  X_PN_ = scene.placements().local(placement_);
  scene.markChanged(*this);
}

bool PlacedNode::place(Scene& scene, const Affine& X_WN) {
  aboutToChange(scene);
  if (!scene.placements().setWorld(placement_, X_WN)) return false;
  X_PN_ = scene.placements().local(placement_);
  return true;
}

bool PlacedNode::placeInParent(Scene& scene, const Affine& X_PN) {
  aboutToChange(scene);
  if (!scene.placements().setLocal(placement_, X_PN)) return false;
  X_PN_ = X_PN;
  return true;
}

bool PlacedNode::hold(Scene& scene, const Affine& X_WN, HeldParts parts) {
  aboutToChange(scene);
  if (!scene.placements().holdInWorld(placement_, X_WN, parts)) return false;
  X_PN_ = X_WN;
  return true;
}

void PlacedNode::rejoin(Scene& scene, const Affine& X_WP) {
  if (attached() || scene.placements().heldParts(placement_) == HeldParts::Nothing) return;
  scene.placements().rejoin(placement_, X_WP);
  leaveFleet(scene);
}

void PlacedNode::setHome(Scene& scene, const Affine& X_WN) {
  if (place(scene, X_WN)) attributes_.X_PN = X_PN_;
}

void PlacedNode::resetPlace(Scene& scene) {
  aboutToChange(scene);
  setFollowing(HeldParts::Nothing, scene);
  X_PN_ = attributes_.X_PN;
  scene.placements().setLocal(placement_, X_PN_);
  shown_ = attributes_.shown;
  scene.placements().setShown(placement_, shown_);
}

/// While a tracker moves the node, nothing else does.
void PlacedNode::setFollowing(HeldParts parts, Scene& scene) {
  follow_ = parts;
  scene.placements().setAttached(placement_, isMovedFromOutside());
}

void PlacedNode::follow(const Message& m, FrameContext& frame) {
  const Nanoseconds when = frame.effective(m);
  if (attached()) trace(when, frame);
  const std::string_view what = m.arguments.empty() ? "all" : std::string_view(m.arguments[0]);
  setFollowing(what == "position"      ? HeldParts::Position
               : what == "orientation" ? HeldParts::Orientation
                                       : HeldParts::All,
               frame.scene);
  tracker_ = m.arguments.size() > 1 ? m.arguments[1] : "";
  if (tracker_.empty()) tracker_ = frame.input.find(kFootTracker) ? kFootTracker : kWandTracker;
  traced_ = when;
  arrived_ = false;
}

void PlacedNode::stopFollowing(Nanoseconds when, FrameContext& frame) {
  if (attached() && trace(when, frame))
    hold(frame.scene, placedAt(poseTrack(frame).back().X, frame.scene), follow_);
  setFollowing(HeldParts::Nothing, frame.scene);
}

void PlacedNode::resetAt(Nanoseconds when, FrameContext& frame) {
  if (attached()) trace(when, frame);
  PoseTrack& way = poseTrack(frame);
  resetPlace(frame.scene);
  way.push_back({when, poseOf(frame.scene.placements().world(placement_)), true});
}

/// Its pose track in this frame, begun where it is if nothing has been said of it yet.
PoseTrack& PlacedNode::poseTrack(FrameContext& frame) const {
  return frame.scene.poseTracks().of(
      placement_, {frame.start(), poseOf(frame.scene.placements().world(placement_)), false});
}

/// Where the node is while its tracker is at X_WT: what it does not take over is its own.
Pose PlacedNode::following(const Pose& X_WT, const Pose& own) const {
  return {follow_ == HeldParts::Orientation ? own.p : X_WT.p,
          follow_ == HeldParts::Position ? own.q : X_WT.q};
}

/// Its placement with X_WN as far as it follows, and its own scale.
Affine PlacedNode::placedAt(const Pose& X_WN, const Scene& scene) const {
  Affine X = scene.placements().world(placement_);
  if (follow_ != HeldParts::Orientation) X.translation() = X_WN.p;
  if (follow_ != HeldParts::Position)
    X.linear() = X_WN.q.toRotationMatrix() * scaleOf(attributes_.X_PN).asDiagonal();
  return X;
}

/// Continues its pose track along the tracker's up to `to`. False if the tracker is silent.
bool PlacedNode::trace(Nanoseconds to, FrameContext& frame) {
  const PoseTrack* tracker = frame.scene.feed().poseTrackOf(tracker_, frame);
  if (!tracker) return false;
  PoseTrack& way = poseTrack(frame);
  const Pose own = way.back().X;
  const Nanoseconds from = std::max(traced_, frame.start()), known = tracker->front().time;
  const auto at = [&](Nanoseconds time, Limit limit) {
    return following(poseOn(*tracker, time, limit), own);
  };
  if (arrived_ && from == frame.start() && known == from)
    way.front().X = at(from, Limit::Before);
  else if (!arrived_ && known <= from)
    way.push_back({from, at(from, Limit::After), true});
  for (const PoseKnot& k : *tracker)
    if (k.time > from && k.time <= to) way.push_back({k.time, following(k.X, own), k.jump});
  if (way.back().time < to && known <= to) way.push_back({to, at(to, Limit::Before), false});
  arrived_ = arrived_ || known <= to;
  traced_ = to;
  return known <= to;
}

void PlacedNode::receive(const Message& m, FrameContext& frame) {
  switch (m.command) {
  case CommandId::Attach: follow(m, frame); break;
  case CommandId::Detach: stopFollowing(frame.effective(m), frame); break;
  case CommandId::Show:
  case CommandId::Hide:
    aboutToChange(frame.scene);
    shown_ = m.command == CommandId::Show;
    frame.scene.placements().setShown(placement_, shown_);
    break;
  case CommandId::Reset: resetAt(frame.effective(m), frame); break;
  default: break;
  }
}

void PlacedNode::simulate(FrameContext& frame) {
  if (!attached() || !trace(frame.now.time, frame)) return;  // a silent tracker holds the node where it is
  const PoseTrack& way = poseTrack(frame);
  const Affine X = placedAt(way.back().X, frame.scene);
  if (moves(way) || X.matrix() != frame.scene.placements().world(placement_).matrix())
    hold(frame.scene, X, follow_);
}

void PlacedNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void PlacedNode::state(StateFields& f) {
  fields(*this, f);
}

}  // namespace stadion
