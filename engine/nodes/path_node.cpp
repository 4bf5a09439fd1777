#include "engine/nodes/path_node.h"

#include "engine/maths/functions.h"
#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {
namespace {

/// The tangent at key k by finite differences over the neighbours' own times.
Vec3 tangent(const std::vector<Keyframe>& keys, std::size_t k) {
  const std::size_t before = k == 0 ? k : k - 1, after = std::min(k + 1, keys.size() - 1);
  return (keys[after].X_PN.p - keys[before].X_PN.p) / (keys[after].time - keys[before].time);
}

Vec3 hermite(const std::vector<Keyframe>& keys, std::size_t k, double s) {
  const double h = keys[k + 1].time - keys[k].time;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * keys[k].X_PN.p + (s3 - 2 * s2 + s) * h * tangent(keys, k) +
         (-2 * s3 + 3 * s2) * keys[k + 1].X_PN.p + (s3 - s2) * h * tangent(keys, k + 1);
}

}  // namespace

Pose PathNode::poseAt(double seconds) const {
  if (keys_.size() == 1 || seconds <= keys_.front().time) return keys_.front().X_PN;
  if (seconds >= keys_.back().time) return keys_.back().X_PN;
  const auto after = std::upper_bound(keys_.begin(), keys_.end(), seconds,
                                      [](double t, const Keyframe& key) { return t < key.time; });
  const auto k = static_cast<std::size_t>(after - keys_.begin()) - 1;
  const double s = (seconds - keys_[k].time) / (keys_[k + 1].time - keys_[k].time);
  Pose X = det::interpolate(keys_[k].X_PN, keys_[k + 1].X_PN, s);
  if (smooth_) X.p = hermite(keys_, k, s);
  return X;
}

void PathNode::putTarget(Scene& scene) {
  Node* node = target_.valid() ? scene.find(target_) : this;
  if (auto* placed = dynamic_cast<PlacedNode*>(node); placed && !placed->moved()) {
    const PlacementId up = scene.placements().parent(placed->placement());
    Affine X_PN = toAffine(poseAt(toSeconds(elapsed_)));
    X_PN.linear() = X_PN.linear() * placed->attributes().X_PN.linear().colwise().norm().asDiagonal();
    placed->place(scene, scene.placements().world(up) * X_PN);
  }
}

void PathNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  since_ = scene.now();
}

void PathNode::advanceTo(Nanoseconds time) {
  if (switch_.on()) elapsed_ += time - since_;
  since_ = time;
  if (!switch_.on() || elapsed_ < length()) return;
  if (loop_ && length() > 0) {
    for (; elapsed_ >= length(); elapsed_ -= length()) raise(Event::Finished, time - (elapsed_ - length()));
    return;
  }
  raise(Event::Finished, time - (elapsed_ - length()));
  elapsed_ = length();
  switch_.set(false);
}

void PathNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  // What has passed up to the command still counts.
  const bool moved = switch_.on();
  advanceTo(frame.effective(m));
  const bool before = switch_.on();
  if (switch_.obey(m)) {
    const bool again = !before && switch_.on() && elapsed_ >= length();
    if (again || m.verb == Verb::Reset) elapsed_ = 0;
  }
  // Once it is off nobody else puts the target where it is at this time.
  if ((moved && !switch_.on()) || m.verb == Verb::Reset) putTarget(frame.scene);
}

void PathNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  if (!switch_.on()) return;
  advanceTo(frame.now.time);
  putTarget(frame.scene);
}

void PathNode::hash(StateHash& h) const {
  PlacedNode::hash(h);
  switch_.hash(h);
  h.add(elapsed_), h.add(since_);
}

}  // namespace stadion
