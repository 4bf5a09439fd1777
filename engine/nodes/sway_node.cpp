#include "engine/nodes/sway_node.h"

#include "engine/maths/functions.h"
#include "engine/prefetch.h"
#include "engine/scene/scene.h"

namespace stadion {
namespace {

constexpr double kTurn = 2 * 3.14159265358979323846;

/// Turned about +Z alone, and as wide as deep.
Mat3 uprightAxes(double along, double across, double up) {
  Mat3 axes;
  axes << along, -across, 0, across, along, 0, 0, 0, up;
  return axes;
}

}  // namespace

// Targets stand in its own file or in one around it: they stay as long as it does.
void SwayNode::settleTargets(Scene& scene) {
  if (settled_) return;
  settled_ = true;
  bool upright = sway_.angularVelocity.head<2>().isZero(0);
  std::vector<NodeRef> targets = sway_.targets;
  if (targets.empty()) targets.push_back(self());
  for (std::size_t k = 0; k < targets.size(); ++k) {
    Node* node = scene.find(targets[k]);
    PlacedNode* placed = node ? node->placed() : nullptr;
    if (!placed) continue;
    placed->letMove(scene);
    const Affine& X_PN = placed->attributes().X_PN;
    Swing swing;
    const Mat3 axes = X_PN.linear();
    swing.rest = X_PN.translation();
    swing.along = axes(0, 0), swing.across = axes(1, 0), swing.up = axes(2, 2);
    upright = upright && axes == uprightAxes(swing.along, swing.across, swing.up);
    axes_.push_back(axes);
    for (int i = 0; i < 3; ++i) {
      const det::SinCos phase = det::sincos(sway_.phase[i] + static_cast<double>(k) * sway_.phaseStep[i]);
      swing.ofSin[i] = sway_.amplitude[i] * phase.cos, swing.ofCos[i] = sway_.amplitude[i] * phase.sin;
    }
    nodes_.push_back(placed);
    placements_.push_back(placed->placement());
    swings_.push_back(swing);
  }
  if (upright) axes_ = {};
}

SwayNode::Moment SwayNode::momentAt(Nanoseconds elapsed) const {
  const double t = toSeconds(elapsed);
  Moment m;
  for (int i = 0; i < 3; ++i) {
    const det::SinCos angle = det::sincos(kTurn * sway_.frequency[i] * t);
    m.sin[i] = angle.sin, m.cos[i] = angle.cos;
  }
  m.turn = det::expRotation(sway_.angularVelocity * t).toRotationMatrix();
  return m;
}

void SwayNode::put(std::size_t i, const Moment& m, Affine& X_PN) const {
  const Swing& swing = swings_[i];
  if (axes_.empty()) {
    const double c = m.turn(0, 0), s = m.turn(1, 0);
    X_PN.linear() =
        uprightAxes(c * swing.along - s * swing.across, s * swing.along + c * swing.across, swing.up);
  } else {
    X_PN.linear().noalias() = m.turn * axes_[i];
  }
  X_PN.translation() = swing.rest + (m.sin.cwiseProduct(swing.ofSin) + m.cos.cwiseProduct(swing.ofCos));
}

void SwayNode::putTargets(Scene& scene) {
  settleTargets(scene);
  const Moment m = momentAt(elapsed_);
  scene.placements().setLocals(placements_, [&](std::size_t i, Affine& X_PN) {
    if (i + Placements::kAhead < swings_.size()) prefetch(&swings_[i + Placements::kAhead]);
    put(i, m, X_PN);
  });
  putAt_ = since_;
}

/// They stay where they are: from now on that is their own affair.
void SwayNode::leaveTargets(Scene& scene) {
  putTargets(scene);
  for (PlacedNode* node : nodes_)
    if (!node->moved()) node->stay(scene);
}

/// Tells those who look at what it moves how that goes from since_ on.
void SwayNode::trace(Nanoseconds to, FrameContext& frame) {
  settleTargets(frame.scene);
  if (to <= since_) return;
  // In its first frame nobody may have had the time to say that he looks.
  const Placements& placements = frame.scene.placements();
  if (putAt_ && !placements.anyWatched()) return;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if ((!putAt_ || placements.watchedBelow(placements_[i])) && !nodes_[i]->moved()) traceOne(i, to, frame);
}

void SwayNode::traceOne(std::size_t i, Nanoseconds to, FrameContext& frame) const {
  const Placements& placements = frame.scene.placements();
  const PlacementId id = placements_[i], up = placements.parent(id);
  const auto at = [&](Nanoseconds time) {
    Affine X_PN;
    put(i, momentAt(elapsed_ + (time - since_)), X_PN);
    return poseOf(withScale(frame.scene.courses().at(up, time, placements), placements.world(up)) * X_PN);
  };
  const Pose begin = at(since_);
  const bool goesOn = putAt_ == since_;
  Course& way =
      frame.scene.courses().of(id, {frame.start(), goesOn ? begin : poseOf(placements.world(id)), false});
  if (!goesOn) way.push_back({since_, begin, true});
  for (Nanoseconds time = (since_ / kChord + 1) * kChord; time < to; time += kChord)
    way.push_back({time, at(time), false});
  way.push_back({to, at(to), false});
}

/// They are put where t = 0 has them.
void SwayNode::jump(Nanoseconds when, FrameContext& frame) {
  settleTargets(frame.scene);
  const Placements& placements = frame.scene.placements();
  const auto pose = [&](std::size_t i) { return poseOf(placements.world(placements_[i])); };
  std::vector<std::pair<std::size_t, Course*>> watched;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (placements.watchedBelow(placements_[i]) && !nodes_[i]->moved())
      watched.emplace_back(i, &frame.scene.courses().of(placements_[i], {frame.start(), pose(i), false}));
  leaveTargets(frame.scene);
  for (const auto& [i, way] : watched) way->push_back({when, pose(i), true});
}

void SwayNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  since_ = scene.now();
}

/// Targets of files around its own stay behind.
void SwayNode::onLeave(Scene& scene) {
  for (PlacedNode* node : nodes_)
    if (node->self().load != self().load && !node->moved()) node->stay(scene);
  PlacedNode::onLeave(scene);
}

void SwayNode::advanceTo(Nanoseconds time, FrameContext& frame) {
  if (switch_.on()) {
    trace(time, frame);
    elapsed_ += time - since_;
  }
  since_ = time;
}

void SwayNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  // What has passed up to the command still counts.
  const bool moved = switch_.on();
  advanceTo(frame.effective(m), frame);
  if (switch_.obey(m) && m.verb == Verb::Reset) elapsed_ = 0;
  if (m.verb == Verb::Reset)
    jump(frame.effective(m), frame);
  else if (moved && !switch_.on())
    leaveTargets(frame.scene);
}

void SwayNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  if (!switch_.on()) return;
  advanceTo(frame.now.time, frame);
  putTargets(frame.scene);
}

void SwayNode::hash(StateHash& h) const {
  PlacedNode::hash(h);
  switch_.hash(h);
  h.add(elapsed_), h.add(since_);
}

}  // namespace stadion
