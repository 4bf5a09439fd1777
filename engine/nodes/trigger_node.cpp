#include "engine/nodes/trigger_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/input/tracker_names.h"
#include "engine/scene/scene.h"
#include "engine/script/declaration_check.h"

#include <algorithm>
#include <cmath>

namespace stadion {

bool Region::contains(const Vec3& p) const {
  if (form == Form::Sphere) return (p - centre).squaredNorm() <= radius * radius;
  return ((p - centre).cwiseAbs().array() <= halfSize.array()).all();
}

std::optional<Region::Chord> Region::chord(const Vec3& a, const Vec3& b) const {
  const Vec3 d = b - a;
  if (form == Form::Sphere) {
    // |a - c + s d|^2 = r^2, as A s^2 + 2 B s + C = 0; the root that suffers no cancellation gives the other.
    const Vec3 m = a - centre;
    const double A = d.squaredNorm(), B = m.dot(d), C = m.squaredNorm() - radius * radius;
    const double discriminant = B * B - A * C;
    if (!(discriminant > 0)) return std::nullopt;
    const double q = -(B + (B < 0 ? -1 : 1) * std::sqrt(discriminant));
    const double s = q / A, t = C / q;
    if (!(s - s == 0) || !(t - t == 0) || s == t) return std::nullopt;
    return Chord{std::min(s, t), std::max(s, t)};
  }
  Chord part{-1e300, 1e300};
  for (int i = 0; i < 3; ++i) {
    const double low = centre[i] - halfSize[i] - a[i], high = centre[i] + halfSize[i] - a[i];
    if (d[i] == 0) {
      if (low > 0 || high < 0) return std::nullopt;
      continue;
    }
    part.in = std::max(part.in, std::min(low / d[i], high / d[i]));
    part.out = std::min(part.out, std::max(low / d[i], high / d[i]));
  }
  return part.in < part.out && part.in > -1e300 ? std::optional(part) : std::nullopt;
}

double Region::crossing(const Vec3& a, const Vec3& b) const {
  const std::optional<Chord> part = chord(a, b);
  return part ? std::clamp(contains(a) ? part->out : part->in, 0.0, 1.0) : 1.0;
}

const PoseTrack& TriggerNode::wayInRig(const FrameContext& frame) {
  PoseTrack& way = way_;
  way.clear();
  const TrackerSample* t = frame.input.find(tracker_);
  // A device without a pose is where the visitor's head is.
  const bool byHead = tracker_ == kHeadTracker || (t && t->controlsOnly);
  if (byHead) t = frame.input.find(kHeadTracker);
  if (looked_) {
    way.push_back({seen_, {p_RV_, Quat::Identity()}, false});
  } else if (seen_ < frame.now.time) {  // it begins to look inside this frame
    const InputSample& before = frame.scene.feed().lastInput();
    const TrackerSample* was = byHead ? before.find(kHeadTracker) : before.find(tracker_);
    if (byHead && (was ? was->valid : !t || t->knots.empty()))
      way.push_back({frame.start(), {frame.scene.feed().headInRig(before).p, Quat::Identity()}, false});
    else if (was && was->valid)
      way.push_back({frame.start(), {was->X_RT.p, Quat::Identity()}, false});
  }
  if (t)
    for (const PoseKnot& k : t->knots)
      if (k.time > seen_) way.push_back({k.time, {k.X.p, Quat::Identity()}, k.jump});
  const bool there = t && t->valid;
  const bool reached = !way.empty() && way.back().time >= frame.now.time;  // by a jump at the frame's end
  if (byHead && (there || !t || t->knots.empty())) {
    if (!reached)
      way.push_back({frame.now.time, {frame.scene.feed().headInRig(frame.input).p, Quat::Identity()}, false});
  } else if (there && !reached) {
    way.push_back({frame.now.time, {t->X_RT.p, Quat::Identity()}, false});
  } else if (!there && (!t || t->knots.empty())) {
    way.clear();  // a silent device changes nothing
  }
  return way;
}

std::uint32_t TriggerNode::heldBefore(const TrackerSample& t, Nanoseconds time,
                                      const FrameContext& frame) const {
  const TrackerSample* was = frame.scene.feed().lastInput().find(tracker_);
  std::uint32_t held = was ? was->buttons : t.controls.empty() ? t.buttons : t.controls.front().buttons;
  for (const ControlKnot& c : t.controls)
    if (c.time < time) held = c.buttons;
  return held;
}

/// Returns the times up to `until` at which the visitor's way or the controls have a knot.
const std::vector<Nanoseconds>& TriggerNode::stopsOf(const PoseTrack& way, const TrackerSample* t,
                                                     Nanoseconds start, Nanoseconds until) {
  stops_.assign({std::max(seen_, start), until});
  for (const PoseKnot& k : way) stops_.push_back(k.time);
  if (t)
    for (const ControlKnot& c : t->controls) stops_.push_back(c.time);
  std::sort(stops_.begin(), stops_.end());
  stops_.erase(std::unique(stops_.begin(), stops_.end()), stops_.end());
  return stops_;
}

/// Maps a point of the rig to the node. The room moves evenly within the frame, as seen from the trigger.
Vec3 TriggerNode::inNode(const Vec3& p_R, Nanoseconds time, const Affine& X_NR,
                         const FrameContext& frame) const {
  const double s = looked_ && frame.now.step > 0
                       ? static_cast<double>(time - frame.start()) / static_cast<double>(frame.now.step)
                       : 1.0;
  if (s == 1 || X_NR_.matrix() == X_NR.matrix()) return X_NR * p_R;
  return (1 - s) * (X_NR_ * p_R) + s * (X_NR * p_R);
}

void TriggerNode::beginLooking(const Vec3& p_N, Nanoseconds time, const TrackerSample* t,
                               const FrameContext& frame) {
  last_ = p_N;
  inside_ = region_.contains(last_);
  if (inside_) raise("enter", time);
  // What was held down before was not pressed here; at the very start it was.
  if (t && frame.now.step > 0) buttons_ = heldBefore(*t, time, frame);
}

void TriggerNode::followVisitor(FrameContext& frame, Nanoseconds until) {
  const PoseTrack& way = wayInRig(frame);
  const TrackerSample* t = kind() == "wandtrigger" ? frame.input.find(tracker_) : nullptr;
  if (way.empty()) {
    if (looked_ && t) watchLost(*t, frame, until);
    return;
  }
  const Affine X_NR =
      frame.scene.placements().world(placement()).inverse() * toAffine(frame.scene.feed().rigPose());
  for (const Nanoseconds time : stopsOf(way, t, frame.start(), until)) {
    if (time > until || (looked_ ? time <= seen_ : time < std::max(seen_, way.front().time))) continue;
    const Vec3 p_RV = poseOn(way, time, Limit::After).p;
    const Vec3 p_NV = inNode(p_RV, time, X_NR, frame);
    if (looked_) {
      const bool jumps = jumpsAt(way, time);
      if (jumps) goTo(inNode(poseOn(way, time, Limit::Before).p, time, X_NR, frame), false, time);
      goTo(p_NV, jumps || seen_ < frame.start(), time);  // a gap in its way is a jump, too
    } else {
      beginLooking(p_NV, time, t, frame);
    }
    looked_ = true;
    seen_ = time;
    p_RV_ = p_RV;
    if (t) watchButtons(*t, time, time == frame.now.time);
  }
  if (until == frame.now.time) X_NR_ = X_NR;
}

void TriggerNode::goTo(const Vec3& p, bool jumped, Nanoseconds time) {
  const auto when = [&](double s) {
    const auto span = static_cast<double>(time - seen_);
    return seen_ + static_cast<Nanoseconds>(std::clamp(s, 0.0, 1.0) * span + 0.5);
  };
  const bool inside = region_.contains(p);
  if (inside != inside_) {
    raise(inside ? Event("enter") : Event("exit"), jumped ? time : when(region_.crossing(last_, p)));
  } else if (!inside && !jumped) {
    const std::optional<Region::Chord> part = region_.chord(last_, p);
    if (part && part->in > 0 && part->out < 1) {
      raise("enter", when(part->in));
      raise("exit", when(part->out));
    }
  }
  inside_ = inside;
  last_ = p;
}

void TriggerNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  seen_ = scene.now();
}

void TriggerNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  const Nanoseconds at = frame.effective(m);
  const bool before = switch_.on();
  if (before) followVisitor(frame, at);  // what has happened up to the command still counts
  if (switch_.apply(m) && (!before || m.command == CommandId::Reset)) {
    inside_ = looked_ = false;
    seen_ = at;
  }
  if (!switch_.on() || !looked_) pressed_ = 0;
}

void TriggerNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  if (switch_.on()) followVisitor(frame, frame.now.time);
}

void TriggerNode::watchButtons(const TrackerSample& t, Nanoseconds time, bool atEnd) {
  std::uint32_t now = t.buttons;
  if (!atEnd) {
    now = buttons_;  // a device that does not know tells at the frame's end
    for (const ControlKnot& c : t.controls)
      if (c.time <= time) now = c.buttons;
  }
  raiseReleases(now, time);
  constexpr Event press[] = {Event("button1"), Event("button2"), Event("button3"), Event("button4")};
  for (std::uint32_t b = 0; b < 4; ++b)
    if (inside_ && (now & ~buttons_ & (1U << b))) {
      raise(press[b], time);
      pressed_ |= 1U << b;
    }
  buttons_ = now;
}

void TriggerNode::raiseReleases(std::uint32_t down, Nanoseconds time) {
  constexpr Event release[] = {Event("button1up"), Event("button2up"), Event("button3up"),
                               Event("button4up")};
  for (std::uint32_t b = 0; b < 4; ++b)
    if (pressed_ & ~down & (1U << b)) raise(release[b], time);
  pressed_ &= down;
}

void TriggerNode::watchLost(const TrackerSample& t, const FrameContext& frame, Nanoseconds until) {
  for (const ControlKnot& c : t.controls)
    if (c.time > seen_ && c.time <= until) raiseReleases(c.buttons, c.time);
  if (until == frame.now.time) raiseReleases(t.buttons, until);
}

template <class Self, class Fields>
void TriggerNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("switch", self.switch_), f("inside", self.inside_), f("looked", self.looked_), f("seen", self.seen_);
  f("visitor", self.last_), f("in rig", self.p_RV_), f("rig", self.X_NR_);
  f.hashed(std::uint64_t{self.pressed_} << 32 | self.buttons_);
  f.unhashed("pressed", self.pressed_), f.unhashed("buttons", self.buttons_);
}

void TriggerNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void TriggerNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

std::unique_ptr<Node> makeTrigger(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  Region region;
  if (const auto box = d.box("box")) {
    region.form = Region::Form::Box;
    region.centre = box->centre;
    region.halfSize = 0.5 * box->edges;
  } else if (const auto sphere = d.sphere("sphere")) {
    region.centre = sphere->centre;
    region.radius = sphere->radius;
  }
  const bool wand = d.kind() == "wandtrigger";
  return std::make_unique<TriggerNode>(r.type(), r.self, r.name, r.place, region,
                                       wand ? std::string(d.text("tracker")) : kHeadTracker,
                                       d.flag("initstate"));
}

void checkTrigger(DeclarationCheck& check) {
  checkVolume(check, true);
}

constexpr AttributeSpec kTriggerSphere{.name = "sphere",
                                       .kind = ValueKind::Sphere,
                                       .help =
                                           "the space watched: centre and radius, in the node's coordinates",
                                       .unit = "m",
                                       .range = kLengthRange};
constexpr AttributeSpec kTriggerBox{.name = "box",
                                    .kind = ValueKind::Box,
                                    .help = "the space watched: centre and edges, in the node's coordinates",
                                    .unit = "m",
                                    .range = kLengthRange};
constexpr AttributeSpec kUserTriggerRows[] = {kTriggerSphere, kTriggerBox, kInitStateRow};
constexpr AttributeSpec kWandTriggerRows[] = {
    kTriggerSphere,
    kTriggerBox,
    kInitStateRow,
    {.name = "tracker", .kind = ValueKind::Tracker, .help = "the device that is watched", .standard = "wand"},
};

constexpr EventSpec kUserTriggerEvents[] = {
    {"enter", "the tracked thing has come into the trigger's space; also if it is there at the start"},
    {"exit", "the tracked thing has left the trigger's space"}};

constexpr EventSpec kWandTriggerEvents[] = {
    {"enter", "the tracked thing has come into the trigger's space; also if it is there at the start"},
    {"exit", "the tracked thing has left the trigger's space"},
    {"button1", "button 1 was pressed inside the trigger's space"},
    {"button2", "button 2 was pressed inside the trigger's space"},
    {"button3", "button 3 was pressed inside the trigger's space"},
    {"button4", "button 4 was pressed inside the trigger's space"},
    {"button1up",
     "button 1 was let go, after its press in the region was reported; the device may be anywhere"},
    {"button2up",
     "button 2 was let go, after its press in the region was reported; the device may be anywhere"},
    {"button3up",
     "button 3 was let go, after its press in the region was reported; the device may be anywhere"},
    {"button4up",
     "button 4 was let go, after its press in the region was reported; the device may be anywhere"}};

}  // namespace

constinit const NodeType kUserTriggerType{
    .name = "usertrigger",
    .help = "notices the user's head in a part of space",
    .attributes = kUserTriggerRows,
    .events = kUserTriggerEvents,
    .traits = {Trait::Placed, Trait::Switched},
    .make = makeTrigger,
    .check = checkTrigger,
    .lint = lintSender,
};

constinit const NodeType kWandTriggerType{
    .name = "wandtrigger",
    .help = "notices a hand-held device and its buttons in a part of space",
    .attributes = kWandTriggerRows,
    .events = kWandTriggerEvents,
    .traits = {Trait::Placed, Trait::Switched},
    .make = makeTrigger,
    .check = checkTrigger,
    .lint = lintSender,
};

namespace node_types {

void addTriggerNode(NodeRegistrar& types) {
  types.add(kUserTriggerType);
  types.add(kWandTriggerType);
}

}  // namespace node_types

}  // namespace stadion
