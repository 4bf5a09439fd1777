#include "engine/nodes/sway_node.h"

#include "engine/base/prefetch.h"
#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/scene/scene.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr double kTurn = 2 * kPi;

/// Turned about +Z alone, and as wide as deep.
Mat3 uprightAxes(double along, double across, double up) {
  Mat3 axes;
  axes << along, -across, 0, across, along, 0, 0, 0, up;
  return axes;
}

}  // namespace

// Targets stand in its own file or in one around it: they stay as long as it does.
void SwayNode::prepareTargets(Scene& scene) {
  if (prepared_) return;
  prepared_ = true;
  findTargets(scene);
  fleet_ = scene.placements().addFleet(*this, placements_);
}

bool SwayNode::resume(Scene& scene) {
  const Nanoseconds now = scene.now();
  if (since_ < 0 || since_ > now || elapsed_ < 0 || elapsed_ > now) return false;
  if (!prepared_) return true;
  findTargets(scene);
  return scene.placements().resumeFleet(fleet_, *this, placements_.size());
}

void SwayNode::findTargets(Scene& scene) {
  if (sway_.targets.empty()) sway_.targets.push_back(self());
  const std::size_t count = sway_.targets.size();
  nodes_.resize(count);
  placements_.resize(count, kNoPlacement);
  swings_.resize(count);
  axes_.resize(count, Mat3::Identity());
  for (std::size_t k = 0; k < count; ++k) prepareTarget(k, scene);
  const auto standsUpright = [&](const Swing& s) {
    return axes_[static_cast<std::size_t>(&s - swings_.data())] == uprightAxes(s.along, s.across, s.up);
  };
  if (sway_.angularVelocity.head<2>().isZero(0) && std::ranges::all_of(swings_, standsUpright)) axes_ = {};
  preparePhases();
}

void SwayNode::prepareTarget(std::size_t k, Scene& scene) {
  Node* node = scene.find(sway_.targets[k]);
  PlacedNode* placed = node ? node->placed() : nullptr;
  nodes_[k] = placed;
  if (placed) {
    placed->makeMovable(scene);
    placements_[k] = placed->placement();
    axes_[k] = placed->attributes().X_PN.linear();
    swings_[k].place = placed->attributes().X_PN.translation();
  }
  swings_[k].along = axes_[k](0, 0);
  swings_[k].across = axes_[k](1, 0);
  swings_[k].up = axes_[k](2, 2);
  Affine X_PN = Affine::Identity();
  X_PN.linear() = axes_[k];
  swings_[k].widens = sphereScale(X_PN);
}

void SwayNode::preparePhases() {
  const auto anglesAt = [](const Vec3& angle) {
    Angles a;
    for (int i = 0; i < 3; ++i) {
      const det::SinCos at = det::sincos(angle[i]);
      a.sin[i] = at.sin;
      a.cos[i] = at.cos;
    }
    return a;
  };
  for (std::size_t k = 0; k < nodes_.size(); k += kBlock)
    blocks_.push_back(anglesAt(sway_.phase + static_cast<double>(k) * sway_.phaseStep));
  for (std::size_t k = 0; k < std::min(kBlock, nodes_.size()); ++k) {
    const Angles step = anglesAt(static_cast<double>(k) * sway_.phaseStep);
    steps_.push_back({sway_.amplitude.cwiseProduct(step.sin), sway_.amplitude.cwiseProduct(step.cos)});
  }
}

SwayNode::Moment SwayNode::momentAt(Nanoseconds elapsed) const {
  const double t = toSeconds(elapsed);
  Moment m;
  for (int i = 0; i < 3; ++i) {
    const det::SinCos angle = det::sincos(kTurn * sway_.frequency[i] * t);
    m.first.sin[i] = angle.sin;
    m.first.cos[i] = angle.cos;
  }
  m.turn = det::expRotation(sway_.angularVelocity * t).toRotationMatrix();
  return m;
}

void SwayNode::putMembers(std::size_t first, std::span<MemberPlace> places) const {
  putAll(moment_, first, places);
}

void SwayNode::putAll(const Moment& m, std::size_t first, std::span<MemberPlace> places) const {
  const Vec3 &sin = m.first.sin, &cos = m.first.cos;
  for (std::size_t k = first, end = first + places.size(); k < end;) {
    const Angles& phase = blocks_[k / kBlock];
    const Angles block{sin.cwiseProduct(phase.cos) + cos.cwiseProduct(phase.sin),
                       cos.cwiseProduct(phase.cos) - sin.cwiseProduct(phase.sin)};
    for (const std::size_t last = std::min(end, (k / kBlock + 1) * kBlock); k < last; ++k) {
      if (k + kBlock < swings_.size()) prefetch(&swings_[k + kBlock]);
      put(k, m.turn, block, places[k - first]);
    }
  }
}

inline void SwayNode::put(std::size_t k, const Mat3& turn, const Angles& block, MemberPlace& place) const {
  const Swing& swing = swings_[k];
  const Angles& step = steps_[k % kBlock];
  std::array<double, 12>& m = place.rows;
  if (axes_.empty()) {
    const double c = turn(0, 0), s = turn(1, 0);
    const double along = c * swing.along - s * swing.across, across = s * swing.along + c * swing.across;
    m[0] = along;
    m[1] = -across;
    m[2] = 0;
    m[4] = across;
    m[5] = along;
    m[6] = 0;
    m[8] = 0;
    m[9] = 0;
    m[10] = swing.up;
  } else {
    const Mat3 axes = turn * axes_[k];
    for (int i = 0; i < 9; ++i) m[static_cast<std::size_t>(4 * (i / 3) + i % 3)] = axes(i / 3, i % 3);
  }
  const Vec3 at = swing.place + (block.sin.cwiseProduct(step.cos) + block.cos.cwiseProduct(step.sin));
  m[3] = at.x();
  m[7] = at.y();
  m[11] = at.z();
  place.widens = swing.widens;
}

void SwayNode::putTargets(Scene& scene) {
  prepareTargets(scene);
  moment_ = momentAt(elapsed_);
  scene.placements().moveFleet(fleet_);
  putAt_ = since_;
}

/// They stay where they are: from now on that is their own affair.
void SwayNode::leaveTargets(Scene& scene) {
  putTargets(scene);
  for (PlacedNode* node : nodes_)
    if (node && !node->isMovedFromOutside()) node->leaveFleet(scene);
}

/// Reports the targets' motion from since_ on to the nodes that watch them.
void SwayNode::trace(Nanoseconds to, FrameContext& frame) {
  prepareTargets(frame.scene);
  if (to <= since_) return;
  // In its first frame it reports always: watchers may not have registered yet.
  const Placements& placements = frame.scene.placements();
  if (putAt_ && !placements.anyWatched()) return;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_[k] && !nodes_[k]->isMovedFromOutside() && (!putAt_ || placements.watchedBelow(placements_[k])))
      traceOne(k, to, frame);
}

void SwayNode::traceOne(std::size_t k, Nanoseconds to, FrameContext& frame) const {
  const Placements& placements = frame.scene.placements();
  const PlacementId id = placements_[k], up = placements.parent(id);
  const auto at = [&](Nanoseconds time) {
    MemberPlace place;
    putAll(momentAt(elapsed_ + (time - since_)), k, {&place, 1});
    const Affine X_PN = place.affine();
    return poseOf(withScale(frame.scene.poseTracks().at(up, time, placements), placements.world(up)) * X_PN);
  };
  const Pose begin = at(since_);
  const bool goesOn = putAt_ == since_;
  PoseTrack& way =
      frame.scene.poseTracks().of(id, {frame.start(), goesOn ? begin : poseOf(placements.world(id)), false});
  // What they have missed they make up for, without the turns.
  if (since_ < frame.start()) return way.push_back({to, at(to), to == frame.start()});
  if (!goesOn) way.push_back({since_, begin, true});
  for (Nanoseconds time = (since_ / kChord + 1) * kChord; time < to; time += kChord)
    way.push_back({time, at(time), false});
  way.push_back({to, at(to), false});
}

/// They are put where t = 0 has them.
void SwayNode::jump(Nanoseconds when, FrameContext& frame) {
  prepareTargets(frame.scene);
  const Placements& placements = frame.scene.placements();
  const auto pose = [&](std::size_t k) { return poseOf(placements.world(placements_[k])); };
  std::vector<std::pair<std::size_t, PoseTrack*>> watched;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_[k] && !nodes_[k]->isMovedFromOutside() && placements.watchedBelow(placements_[k]))
      watched.emplace_back(k, &frame.scene.poseTracks().of(placements_[k], {frame.start(), pose(k), false}));
  leaveTargets(frame.scene);
  for (const auto& [k, way] : watched) way->push_back({when, pose(k), true});
}

void SwayNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  since_ = scene.now();
}

/// Targets of files around its own stay behind.
void SwayNode::onLeave(Scene& scene) {
  if (fleet_ != kNoFleet) scene.placements().removeFleet(fleet_);
  for (PlacedNode* node : nodes_)
    if (node && node->self().load != self().load && !node->isMovedFromOutside()) node->leaveFleet(scene);
  PlacedNode::onLeave(scene);
}

/// What has passed up to `time` does not count.
void SwayNode::restUntil(Nanoseconds time) {
  if (since_ >= time) return;
  if (putAt_ == since_) putAt_ = time;
  since_ = time;
}

void SwayNode::advanceTo(Nanoseconds time, FrameContext& frame) {
  if (frame.rested) restUntil(frame.start());
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
  if (switch_.apply(m) && m.command == CommandId::Reset) elapsed_ = 0;
  if (m.command == CommandId::Reset)
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

template <class Self, class Fields>
void SwayNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("switch", self.switch_), f("elapsed", self.elapsed_), f("since", self.since_);
  f.unhashed("put", self.putAt_), f.unhashed("settled", self.prepared_), f.unhashed("fleet", self.fleet_);
  f.unhashed("sin", self.moment_.first.sin), f.unhashed("cos", self.moment_.first.cos);
  f.unhashed("turn", self.moment_.turn);
}

void SwayNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void SwayNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

std::unique_ptr<Node> makeSway(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  SwayAttributes a;
  for (const NodeReference& target : d.references("target"))
    if (const NodeRef node = r.resolve(target); node.valid()) a.targets.push_back(node);
  a.amplitude = d.vec3("amplitude");
  a.frequency = d.vec3("frequency");
  a.phase = d.vec3("phase") * kDegree;
  a.phaseStep = d.vec3("phasestep") * kDegree;
  a.angularVelocity = d.vec3("angularvelocity") * kDegree;
  return std::make_unique<SwayNode>(r.self, r.name, r.place, std::move(a), d.flag("initstate"));
}

void lintSway(const Declaration& node, LintScope& scope) {
  lintTargets(node, scope);
  scope.warnRepeated(node, "target");
  const Vec3 amplitude = node.vec3("amplitude"), frequency = node.vec3("frequency");
  if (amplitude.isZero(0) && node.vec3("angularvelocity").isZero(0))
    scope.warn(
        node, "amplitude",
        fmt::format("{} moves nothing: its amplitude and angularvelocity are 0", LintScope::called(node)));
  for (int i = 0; i < 3; ++i)
    if (amplitude[i] != 0 && frequency[i] == 0)
      scope.warn(node, "frequency",
                 fmt::format("along {} it does not go to and fro: its frequency there is 0", "xyz"[i]));
  scope.warnNeverOn(node);
}

constexpr AttributeSpec kSwayRows[] = {
    {.name = "target",
     .kind = ValueKind::Reference,
     .help = "a node to move, each by itself; without any, the sway moves the nodes that have it as parent",
     .repeatable = true,
     .targets = kPlacedOrRig,
     .acts = true},
    {.name = "amplitude",
     .kind = ValueKind::Vector,
     .help = "how far it goes to either side of where the script puts it, along the axes of its parent",
     .standard = "0, 0, 0",
     .unit = "m",
     .range = kPlaceRange},
    {.name = "frequency",
     .kind = ValueKind::Scale,
     .help = "how often it goes to and fro, one number or one for each axis",
     .standard = "1",
     .unit = "Hz",
     .range = {0, 100}},
    {.name = "phase",
     .kind = ValueKind::Scale,
     .help = "where in its swing the first target begins, one number or one for each axis",
     .standard = "0",
     .unit = "degrees",
     .range = kTurnRange},
    {.name = "phasestep",
     .kind = ValueKind::Scale,
     .help = "how much farther in its swing each target is than the one before, so that they do not move in "
             "step",
     .standard = "0",
     .unit = "degrees",
     .range = kTurnRange},
    {.name = "angularvelocity",
     .kind = ValueKind::Vector,
     .help = "how fast each turns about itself, about the axes of its parent",
     .standard = "0, 0, 0",
     .unit = "degrees/s",
     .range = kTurnRange},
    kInitStateRow,
};

}  // namespace

constinit const NodeType kSwayType{
    .name = "sway",
    .help = "moves nodes to and fro and turns them evenly: boats, banners, a shoal",
    .attributes = kSwayRows,
    .traits = {Trait::Placed, Trait::Switched, Trait::Parent, Trait::Level, Trait::Moves, Trait::Degradable},
    .make = makeSway,
    .lint = lintSway,
};

namespace node_types {

void addSwayNode(NodeRegistrar& types) {
  types.add(kSwayType);
}

}  // namespace node_types

}  // namespace stadion
