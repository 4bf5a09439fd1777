#include "engine/nodes/environment_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/core/state_fields.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/scene/scene.h"

namespace stadion {
namespace {

constexpr CommandId kIntensity = commandNamed("intensity"), kExposure = commandNamed("exposure");

}  // namespace

EnvironmentRecord EnvironmentNode::recordAt(Nanoseconds time) const {
  EnvironmentRecord record = record_;
  record.lit = switch_.on();
  record.intensity = static_cast<float>(intensity_.at(time));
  return record;
}

void EnvironmentNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void EnvironmentNode::state(StateFields& f) {
  fields(*this, f);
}

void EnvironmentNode::onEnter(Scene& scene) {
  scene.lights().environments().add(self(), recordAt(scene.now()));
}

bool EnvironmentNode::resume(Scene& scene) {
  if (!intensity_.isWithin(0, kMostIntensity)) return false;
  scene.lights().environments().set(self(), recordAt(scene.now()));
  return true;
}

void EnvironmentNode::onLeave(Scene& scene) {
  scene.lights().environments().remove(self());
}

void EnvironmentNode::receive(const Message& m, FrameContext& frame) {
  switch_.apply(m);
  if (m.command == kIntensity) intensity_.take(m, frame.effective(m), 0, kMostIntensity);
  if (m.command == CommandId::Reset) intensity_.reset();
}

void EnvironmentNode::simulate(FrameContext& frame) {
  fades_ = intensity_.fadesAfter(frame.now.time);
  frame.scene.lights().environments().set(self(), recordAt(frame.now.time));
}

TonesRecord TonesNode::recordAt(Nanoseconds time) const {
  const double stops = exposure_.at(time);
  return {stops == 0 ? 1.0f : static_cast<float>(det::pow(2, stops)), curve_};
}

void TonesNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void TonesNode::state(StateFields& f) {
  fields(*this, f);
}

void TonesNode::onEnter(Scene& scene) {
  scene.lights().tones().add(self(), recordAt(scene.now()));
}

bool TonesNode::resume(Scene& scene) {
  if (!exposure_.isWithin(-kMostStops, kMostStops)) return false;
  scene.lights().tones().set(self(), recordAt(scene.now()));
  return true;
}

void TonesNode::onLeave(Scene& scene) {
  scene.lights().tones().remove(self());
}

void TonesNode::receive(const Message& m, FrameContext& frame) {
  if (m.command == kExposure) exposure_.take(m, frame.effective(m), -kMostStops, kMostStops);
  if (m.command == CommandId::Reset) exposure_.reset();
}

void TonesNode::simulate(FrameContext& frame) {
  fades_ = exposure_.fadesAfter(frame.now.time);
  frame.scene.lights().tones().set(self(), recordAt(frame.now.time));
}

namespace {

std::unique_ptr<Node> makeEnvironment(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  EnvironmentRecord record;
  record.picture = r.surroundings;
  record.background = r.surroundings != kNoMesh && d.flag("background");
  const auto turn = det::sincos(d.number("turn") * kDegree);
  record.turnCos = static_cast<float>(turn.cos);
  record.turnSin = static_cast<float>(turn.sin);
  return std::make_unique<EnvironmentNode>(r.self, r.name, record, d.number("intensity"),
                                           d.flag("initstate"));
}

std::unique_ptr<Node> makeTones(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  return std::make_unique<TonesNode>(r.self, r.name, d.choice<ToneCurve>("curve"), d.number("exposure"));
}

void lintEnvironment(const Declaration& node, LintScope& scope) {
  if (node.has("background") && !node.has("file"))
    scope.warn(node, "background", "background has no effect: the sky itself is seen without a file");
  if (node.has("turn") && !node.has("file"))
    scope.warn(node, "turn", "turn has no effect: without a file, the sky is the same all around");
  scope.warnNeverOn(node);
}

constexpr AttributeSpec kEnvironmentRows[] = {
    {.name = "file",
     .kind = ValueKind::File,
     .help =
         "a picture of the surroundings, equirectangular (.hdr, .exr); without it, the sky gives the light"},
    {.name = "intensity",
     .kind = ValueKind::Number,
     .help = "what its light is multiplied with",
     .standard = "1",
     .range = {0, EnvironmentNode::kMostIntensity}},
    {.name = "turn",
     .kind = ValueKind::Number,
     .help = "how far it is turned about the vertical, counter-clockwise seen from above; at 0 the picture's "
             "middle is in front (+Y)",
     .standard = "0",
     .unit = "degrees",
     .range = kTurnRange},
    {.name = "background",
     .kind = ValueKind::Flag,
     .help = "whether the picture is seen behind everything, in place of the sky",
     .standard = "on"},
    kInitStateRow,
};
constexpr CommandSpec kEnvironmentCommands[] = {{"intensity", ArgumentKind::Faded,
                                                 "intensity NUMBER [fade SECONDS]",
                                                 "multiplies its light with this number, at once or slowly"}};

constexpr std::string_view kCurves[] = {"soft", "clamp", "neutral", "aces"};
constexpr AttributeSpec kTonesRows[] = {
    {.name = "exposure",
     .kind = ValueKind::Number,
     .help = "how much brighter the pictures are; each stop doubles the light",
     .standard = "0",
     .unit = "stops",
     .range = {-TonesNode::kMostStops, TonesNode::kMostStops}},
    {.name = "curve",
     .kind = ValueKind::Choice,
     .help = "what becomes of bright light: bent softly to white, cut, Khronos PBR Neutral, or a film curve "
             "(ACES)",
     .standard = "soft",
     .choices = kCurves},
};
constexpr CommandSpec kTonesCommands[] = {{"exposure", ArgumentKind::Faded, "exposure STOPS [fade SECONDS]",
                                           "sets the exposure, at once or slowly"}};

}  // namespace

constinit const NodeType kEnvironmentType{
    .name = "environment",
    .help = "light from all around, from a picture of the surroundings or from the sky",
    .attributes = kEnvironmentRows,
    .commands = kEnvironmentCommands,
    .traits = {Trait::Switched, Trait::Drawn, Trait::Surroundings},
    .make = makeEnvironment,
    .lint = lintEnvironment,
};

constinit const NodeType kTonesType{
    .name = "tones",
    .help = "exposure of the pictures, and how bright light is shown",
    .attributes = kTonesRows,
    .commands = kTonesCommands,
    .traits = {Trait::Single},
    .make = makeTones,
};

namespace node_types {

void addEnvironmentNode(NodeRegistrar& types) {
  types.add(kEnvironmentType);
  types.add(kTonesType);
}

}  // namespace node_types

}  // namespace stadion
