#include "engine/build/builder.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/maths/srgb.h"
#include "engine/nodes/light_node.h"
#include "engine/nodes/lod_node.h"
#include "engine/nodes/measure_node.h"
#include "engine/nodes/path_node.h"
#include "engine/nodes/rig_node.h"
#include "engine/nodes/scene_node.h"
#include "engine/nodes/sound_node.h"
#include "engine/nodes/sway_node.h"
#include "engine/nodes/text_node.h"
#include "engine/nodes/timer_node.h"
#include "engine/nodes/trigger_node.h"
#include "engine/script/choice.h"

#include <algorithm>

namespace stadion {
namespace {

using Made = std::unique_ptr<Node>;

/// A colour as scripts write it (sRGB, 0 to 1) in linear light.
template <class Linear>
void setColour(const Vec3& srgb, Linear& linear, double factor = 1) {
  for (unsigned i = 0; i < 3; ++i) linear[i] = static_cast<float>(linearFromSrgb(srgb[i]) * factor);
}

Made makePlaced(const NodeRequest& r) {
  return std::make_unique<PlacedNode>(r.declaration.kind(), r.self, r.name, r.place);
}

Made makeLod(const NodeRequest& r) {
  return std::make_unique<LodNode>(r.self, r.name, r.place, r.children,
                                   r.declaration.distances(Attr::Ranges));
}

Made makeObject(const NodeRequest& r) {
  return std::make_unique<ObjectNode>(NodeKind::Object, r.self, r.name, r.place, r.appearance);
}

Made makeLight(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  LightRecord light;
  light.kind = static_cast<std::uint32_t>(d.choice<LightType>(Attr::Type));
  setColour(d.vec3(Attr::Colour), light.colour, d.number(Attr::Intensity));
  const Vec3 direction = d.vec3(Attr::Direction).normalized();
  for (int i = 0; i < 3; ++i) light.direction[i] = direction[i];
  light.range = static_cast<float>(d.optionalNumber(Attr::Range).value_or(0));
  if (d.choice<LightType>(Attr::Type) == LightType::Directional) light.range = d.flag(Attr::Shadows) ? 1 : 0;
  const double half = 0.5 * d.number(Attr::Angle) * kDegree;
  light.cosOuter = static_cast<float>(det::cos(half));
  light.cosInner = static_cast<float>(det::cos(0.8 * half));
  return std::make_unique<LightNode>(r.self, r.name, r.place, light, d.flag(Attr::InitState));
}

Made makeSky(const NodeRequest& r) {
  SkyRecord sky;
  setColour(r.declaration.vec3(Attr::Zenith), sky.zenith);
  setColour(r.declaration.vec3(Attr::Horizon), sky.horizon);
  setColour(r.declaration.vec3(Attr::Ground), sky.ground);
  setColour(r.declaration.vec3(Attr::Ambient), sky.ambient);
  sky.haze = static_cast<float>(r.declaration.optionalNumber(Attr::Haze).value_or(0));
  return std::make_unique<SkyNode>(r.self, r.name, sky);
}

Made makeText(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  TextStyle style;
  style.size = d.number(Attr::Size);
  style.depth = d.number(Attr::Depth);
  setColour(d.vec3(Attr::Colour), style.colour);
  if (d.has(Attr::Background)) setColour(d.vec3(Attr::Background), style.background.emplace());
  style.align = d.choice<TextAlign>(Attr::Align);
  style.lit = d.flag(Attr::Lit);
  return std::make_unique<TextNode>(r.self, r.name, r.place, unescaped(d.text(Attr::Text)), style);
}

Made makeMeasure(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto named = [&](Attr attr) {
    const auto reference = d.reference(attr);
    return reference ? std::string(reference->name) : std::string();
  };
  MeasureAttributes a;
  a.body = named(Attr::Body), a.ground = named(Attr::Ground);
  a.text = named(Attr::Text), a.against = named(Attr::Against);
  a.label = std::string(d.text(Attr::Label));
  a.from = d.choice<MeasureFrom>(Attr::From);
  a.duration = fromSeconds(d.number(Attr::Duration));
  if (const auto sector = d.optionalNumber(Attr::Sector)) a.cosHalfSector = det::cos(0.5 * *sector * kDegree);
  return std::make_unique<MeasureNode>(r.self, r.name, r.place, std::move(a));
}

Made makeTrigger(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  Region region;
  if (const auto box = d.box(Attr::Box)) {
    region.form = Region::Form::Box;
    region.centre = box->centre, region.halfSize = 0.5 * box->edges;
  } else if (const auto sphere = d.sphere(Attr::Sphere)) {
    region.centre = sphere->centre, region.radius = sphere->radius;
  }
  const bool wand = d.kind() == NodeKind::WandTrigger;
  return std::make_unique<TriggerNode>(d.kind(), r.self, r.name, r.place, region,
                                       wand ? std::string(d.text(Attr::Tracker)) : "head",
                                       d.flag(Attr::InitState));
}

Made makeTimer(const NodeRequest& r) {
  const Nanoseconds period = std::max<Nanoseconds>(1, fromSeconds(r.declaration.number(Attr::Period)));
  return std::make_unique<TimerNode>(r.self, r.name, period, r.declaration.flag(Attr::Repeat),
                                     r.declaration.flag(Attr::InitState));
}

Made makeScene(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  return std::make_unique<SceneNode>(r.self, r.name, r.place, std::string(d.text(Attr::File)),
                                     fromSeconds(d.number(Attr::Ready)), d.flag(Attr::InitState));
}

Made makePath(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  std::vector<Keyframe> keys;
  for (const PathKey& k : d.keys()) {
    const Vec3 turn = k.orientation * kDegree;
    keys.push_back({k.time, {k.position, det::fromEuler(turn.x(), turn.y(), turn.z())}});
  }
  const auto target = d.reference(Attr::Target);
  return std::make_unique<PathNode>(r.self, r.name, r.place, target ? r.resolve(*target) : NodeRef{},
                                    std::move(keys), d.flag(Attr::Loop), d.flag(Attr::Smooth),
                                    d.flag(Attr::InitState));
}

Made makeSway(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  SwayAttributes a;
  for (const NodeReference& target : d.references(Attr::Target))
    if (const NodeRef node = r.resolve(target); node.valid()) a.targets.push_back(node);
  a.amplitude = d.vec3(Attr::Amplitude), a.frequency = d.vec3(Attr::Frequency);
  a.phase = d.vec3(Attr::Phase) * kDegree, a.phaseStep = d.vec3(Attr::PhaseStep) * kDegree;
  a.angularVelocity = d.vec3(Attr::AngularVelocity) * kDegree;
  return std::make_unique<SwayNode>(r.self, r.name, r.place, std::move(a), d.flag(Attr::InitState));
}

Made makeSound(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  SoundNode::Attributes a;
  a.file = std::string(d.text(Attr::File));
  a.length = r.soundLength;
  a.gain = d.number(Attr::Gain);
  a.range = d.optionalNumber(Attr::Range).value_or(0);
  a.loop = d.flag(Attr::Loop);
  return std::make_unique<SoundNode>(r.self, r.name, r.place, std::move(a), d.flag(Attr::InitState));
}

Made makeNavigator(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  NavigatorNode::Attributes a;
  a.speed = d.number(Attr::Speed);
  a.turnRate = d.number(Attr::TurnRate) * kDegree;
  a.fly = d.choice<NavigatorMode>(Attr::Mode) == NavigatorMode::Fly;
  a.tracker = std::string(d.text(Attr::Tracker));
  return std::make_unique<NavigatorNode>(r.self, r.name, a, d.flag(Attr::InitState));
}

Made makeRig(const NodeRequest& r) {
  return std::make_unique<RigNode>(r.self, r.name, r.place, r.declaration.number(Attr::EyeHeight));
}

}  // namespace

void addEngineFactories(NodeFactories& factories) {
  const auto set = [&](NodeKind kind, NodeFactory make) { factories[static_cast<std::size_t>(kind)] = make; };
  set(NodeKind::Group, makePlaced), set(NodeKind::Transform, makePlaced);
  set(NodeKind::Lod, makeLod);
  set(NodeKind::Object, makeObject);
  set(NodeKind::Light, makeLight), set(NodeKind::Sky, makeSky);
  set(NodeKind::Text, makeText), set(NodeKind::Measure, makeMeasure);
  set(NodeKind::UserTrigger, makeTrigger), set(NodeKind::WandTrigger, makeTrigger);
  set(NodeKind::Timer, makeTimer);
  set(NodeKind::Scene, makeScene);
  set(NodeKind::Path, makePath);
  set(NodeKind::Sway, makeSway);
  set(NodeKind::Sound, makeSound);
  set(NodeKind::Navigator, makeNavigator), set(NodeKind::Rig, makeRig);
}

}  // namespace stadion
