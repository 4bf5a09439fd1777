#include "dynamics/nodes/field_node.h"

#include "dynamics/nodes/shape_store.h"
#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {

FieldLaw FieldNode::law(const Scene& scene) const {
  const Vec3 scale = scaleOf(scene.placements().world(placement()));
  FieldLaw law = law_;
  if (auto* linear = std::get_if<LinearField>(&law)) linear->push = linear->push.cwiseProduct(scale);
  const double size = scale.maxCoeff();
  if (auto* spherical = std::get_if<SphericalField>(&law)) spherical->radius *= size;
  if (auto* point = std::get_if<PointField>(&law)) point->softening *= size;
  if (auto* vortex = std::get_if<VortexField>(&law)) vortex->core *= size, vortex->radius *= size;
  if (auto* medium = std::get_if<MediumField>(&law)) {
    medium->centre = medium->centre.cwiseProduct(scale), medium->half = medium->half.cwiseProduct(scale);
    medium->half.x() =
        medium->region == MediumField::Region::Ball ? medium->half.x() / scale.x() * size : medium->half.x();
  }
  return law;
}

Pose FieldNode::pose(const Scene& scene) const {
  return poseOf(scene.placements().world(placement()));
}

const std::vector<FieldNode::Change>& FieldNode::changes(std::uint64_t frame) const {
  static const std::vector<Change> none;
  return frame == changedIn_ ? changes_ : none;
}

void FieldNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  since_ = scene.now();
  if (switch_.on() && duration_ > 0) scene.wakeAt(since_ + duration_, self());
}

void FieldNode::change(bool on, Nanoseconds when, FrameContext& frame) {
  if (changedIn_ != frame.now.frame) changes_.clear();
  changedIn_ = frame.now.frame;
  changes_.push_back({when, on});
  if (on) {
    since_ = when;
    if (duration_ > 0) frame.scene.wakeAt(when + duration_, self());
  }
  for (const NodeRef user : users_) frame.scene.wakeNow(user);
}

void FieldNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  const Nanoseconds when = frame.effective(m);
  // A duration that ran out before this command came first.
  if (switch_.on() && duration_ > 0 && since_ + duration_ <= when) switch_.set(false);
  if (switch_.obey(m)) change(switch_.on(), when, frame);
}

void FieldNode::followAxis(FrameContext& frame) {
  if (!axis_) return;
  const double before = strength_.empty() ? 0 : strength_.back().value;
  strength_ = axisCourse(frame.input, axis_->tracker, axis_->axis, frame.start(), frame.now.time);
  if (std::ranges::any_of(strength_, [&](const AxisKnot& k) { return k.value != before; }))
    for (const NodeRef user : users_) frame.scene.wakeNow(user);
}

void FieldNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  followAxis(frame);
  // The world ends the activation by itself, at the same exact time.
  if (switch_.on() && duration_ > 0 && since_ + duration_ <= frame.now.time) switch_.set(false);
}

template <class Self, class Fields>
void FieldNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("switch", self.switch_), f("since", self.since_);
  if (!self.strength_.empty()) f.hashed(self.strength_.back().value);
  f.kept("strength", self.strength_), f.kept("changes", self.changes_);
  f.kept("changed in", self.changedIn_), f.kept("users", self.users_);
}

void FieldNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void FieldNode::state(StateFields& f) {
  fields(*this, f);
}

}  // namespace stadion
