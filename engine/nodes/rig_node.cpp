#include "engine/nodes/rig_node.h"

#include "engine/build/lint.h"
#include "engine/build/model_content.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/input/axis_track.h"
#include "engine/input/tracker_names.h"
#include "engine/maths/angles.h"
#include "engine/nodes/rig_drive.h"
#include "engine/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion {

void RigNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  scene.feed().addRig(self(), placement(), eyeHeight_);
}

void RigNode::onLeave(Scene& scene) {
  scene.feed().dropRig(self());
  PlacedNode::onLeave(scene);
}

void NavigatorNode::receive(const Message& m, FrameContext& frame) {
  const Nanoseconds at = frame.effective(m);
  if (switch_.on()) drive(frame, at);  // what has passed up to the command still counts
  since_ = at;
  switch_.apply(m);
}

void NavigatorNode::simulate(FrameContext& frame) {
  if (switch_.on()) drive(frame, frame.now.time);
  since_ = frame.now.time;
  const TrackerSample* t = frame.input.find(attributes_.tracker);
  ended_ = frame.now.time;
  q_RT_ = t ? t->X_RT.q : Quat::Identity();
  p_RH_ = frame.scene.feed().headInRig(frame.input).p;
}

PoseTrack NavigatorNode::way(const TrackerSample* t, const FrameContext& frame, const Pose& before,
                             const Pose& now) const {
  PoseTrack way;
  if (ended_ == frame.start()) way.push_back({frame.start(), before, false});
  if (t)
    for (const PoseKnot& k : t->knots) way.push_back(k);
  if (!t || t->valid || t->knots.empty()) way.push_back({frame.now.time, now, false});
  return way;
}

void NavigatorNode::drive(FrameContext& frame, Nanoseconds until) {
  const TrackerSample* t = frame.input.find(attributes_.tracker);
  if (!t || !t->hasControls() || frame.now.step == 0) return;
  const auto axis = [&](std::size_t i) {
    return axisTrack(frame.input, attributes_.tracker, i, frame.start(), frame.now.time);
  };
  const AxisTrack turn = axis(0), forward = axis(1);
  const auto still = [](const AxisTrack& c) {
    return std::ranges::all_of(c, [](const AxisKnot& k) { return k.value == 0; });
  };
  if (still(turn) && still(forward)) return;

  const PoseTrack wand = way(t, frame, {Vec3::Zero(), q_RT_}, t->X_RT);
  const Pose head_R = frame.scene.feed().headInRig(frame.input);
  const PoseTrack head = way(frame.input.find(kHeadTracker), frame, {p_RH_, Quat::Identity()}, head_R);
  const Nanoseconds from = std::max(since_, frame.start());
  std::vector<Nanoseconds> stops{from, until};
  for (const PoseTrack* track : {&wand, &head})
    for (const PoseKnot& k : *track) stops.push_back(k.time);
  for (const AxisKnot& k : turn) stops.push_back(k.time);  // those of `forward` too
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());

  Pose X_WR = frame.scene.feed().rigPose();
  for (std::size_t i = 1; i < stops.size(); ++i) {
    if (stops[i - 1] < from || stops[i] > until) continue;
    const auto end = [&](Nanoseconds time, Limit limit) {
      return RigDrive::End{axisOn(turn, time, limit), axisOn(forward, time, limit),
                           poseOn(head, time, limit).p, poseOn(wand, time, limit).q};
    };
    const RigDrive drive{attributes_.turnRate, attributes_.speed, attributes_.fly,
                         toSeconds(stops[i] - stops[i - 1])};
    X_WR = drive.moved(X_WR, end(stops[i - 1], Limit::After), end(stops[i], Limit::Before));
  }
  frame.scene.moveRig(X_WR);
}

namespace {

enum class NavigatorMode : std::uint8_t { Walk, Fly };

std::unique_ptr<Node> makeNavigator(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  NavigatorNode::Attributes a;
  a.speed = d.number("speed");
  a.turnRate = d.number("turnrate") * kDegree;
  a.fly = d.choice<NavigatorMode>("mode") == NavigatorMode::Fly;
  a.tracker = std::string(d.text("tracker"));
  return std::make_unique<NavigatorNode>(r.self, r.name, a, d.flag("initstate"));
}

/// The eyes of a visitor without a tracker are at the camera and look where it looks, but level.
Affine placeBehind(const Affine& X_WN, const ModelCamera& camera, double eyeHeight) {
  Affine X = Affine::Identity();
  X.translation() = X_WN * vectorOf(camera.position) - eyeHeight * Vec3::UnitZ();
  Vec3 ahead = X_WN.linear() * vectorOf(camera.direction);
  ahead.z() = 0;
  const double length = ahead.norm();
  if (!(length > 1e-6)) return X;  // straight up or down
  ahead /= length;
  X.linear().col(0) = Vec3(ahead.y(), -ahead.x(), 0);
  X.linear().col(1) = ahead;
  return X;
}

std::unique_ptr<Node> makeRig(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const double eyeHeight = d.number("eyeheight");
  PlaceAttributes place = r.place;
  if (const auto model = d.has("camera") ? modelFor(r, "camera", "model") : std::nullopt)
    if (const ModelCamera* camera = findIn(model->mesh->cameras, r, "camera", "camera"))
      place.X_PN = placeBehind(model->X_WN, *camera, eyeHeight);
  return std::make_unique<RigNode>(r.self, r.name, place, eyeHeight);
}

void lintRig(const Declaration& node, LintScope& scope) {
  for (const char* stated : {"position", "orientation"})
    if (node.has("camera") && node.has(Attr::of(stated)))
      scope.warn(node, Attr::of(stated),
                 fmt::format("{} has no effect: the camera says where the rig starts", stated));
  if (node.has("model") && !node.has("camera"))
    scope.warn(node, "model", "model has no effect without camera=NAME, the name of a camera in its file");
}

constexpr std::string_view kNavigatorModes[] = {"walk", "fly"};
constexpr AttributeSpec kNavigatorRows[] = {
    {.name = "speed",
     .kind = ValueKind::Number,
     .help = "of the rig at full deflection of the joypad",
     .standard = "1.5",
     .unit = "m/s",
     .range = {0, 1000}},
    {.name = "turnrate",
     .kind = ValueKind::Number,
     .help = "of the rig at full deflection of the joypad",
     .standard = "45",
     .unit = "degrees/s",
     .range = {0, 3600}},
    {.name = "tracker",
     .kind = ValueKind::Tracker,
     .help = "the device that points the way",
     .standard = "wand"},
    {.name = "mode",
     .kind = ValueKind::Choice,
     .help = "keep the height, or follow the device up and down",
     .standard = "walk",
     .choices = kNavigatorModes},
    kInitStateRow,
};
constexpr AttributeSpec kRigRows[] = {
    {.name = "position",
     .kind = ValueKind::Vector,
     .help = "the middle of the floor of the display, in the world",
     .standard = "0, 0, 0",
     .unit = "m",
     .range = kPlaceRange},
    {.name = "orientation",
     .kind = ValueKind::Vector,
     .help = "rotations about the world's X axis, then Y, then Z",
     .standard = "0, 0, 0",
     .unit = "degrees",
     .range = kTurnRange},
    {.name = "eyeheight",
     .kind = ValueKind::Number,
     .help = "of the head above the floor while no tracker says where it is",
     .standard = "1.7",
     .unit = "m",
     .range = {0, 10}},
    {.name = "model",
     .kind = ValueKind::Reference,
     .help = "the object whose camera this rig starts at",
     .targets = kModelTypes},
    {.name = "camera",
     .kind = ValueKind::Words,
     .help = "the name of a camera in the file of the model: the head starts there and looks where it looks, "
             "but level"},
};

}  // namespace

constinit const NodeType kNavigatorType{
    .name = "navigator",
    .help = "lets the user move the rig with joypad and wand",
    .attributes = kNavigatorRows,
    .traits = {Trait::Switched},
    .make = makeNavigator,
};

constinit const NodeType kRigType{
    .name = "rig",
    .help = "the platform that carries walls, trackers and viewers through the world",
    .attributes = kRigRows,
    .traits = {Trait::Single, Trait::Parent, Trait::Moves},
    .make = makeRig,
    .lint = lintRig,
};

namespace node_types {

void addRigNode(NodeRegistrar& types) {
  types.add(kNavigatorType);
  types.add(kRigType);
}

}  // namespace node_types

}  // namespace stadion
