#include "engine/nodes/light_node.h"

#include "engine/build/lint.h"
#include "engine/build/model_content.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/scene/scene.h"

#include <fmt/format.h>

namespace stadion {

void LightNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  handle_ = scene.lights().add(placement(), light_, self());
  scene.lights().set(handle_, light_, switch_.on());
}

bool LightNode::resume(Scene& scene) {
  if (!scene.lights().owns(handle_, self())) return false;
  scene.lights().set(handle_, light_, switch_.on());
  return true;
}

void LightNode::onLeave(Scene& scene) {
  scene.lights().remove(handle_);
  PlacedNode::onLeave(scene);
}

void LightNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  if (switch_.apply(m)) frame.scene.lights().set(handle_, light_, switch_.on());
}

void SkyNode::onEnter(Scene& scene) {
  scene.lights().addSky(self(), sky_);
}

bool SkyNode::resume(Scene& scene) {
  scene.lights().setSky(self(), sky_);
  return true;
}

void SkyNode::onLeave(Scene& scene) {
  scene.lights().removeSky(self());
}

namespace {

enum class LightType : std::uint8_t { Directional, Point, Spot };

enum class Falloff : std::uint8_t { Range, Square };

void setCone(double inner, double outer, LightRecord& light) {
  light.cosInner = static_cast<float>(det::cos(inner));
  light.cosOuter = static_cast<float>(det::cos(outer));
}

void setRange(const Declaration& d, double range, LightRecord& light) {
  light.range = static_cast<float>(range);
  if (light.kind == static_cast<std::uint32_t>(LightType::Directional))
    light.range = d.flag("shadows") ? 1 : 0;
}

/// What the script states.
LightRecord statedLight(const Declaration& d) {
  LightRecord light;
  light.kind = static_cast<std::uint32_t>(d.choice<LightType>("type"));
  setColour(d.vec3("colour"), light.colour, d.number("intensity"));
  const Vec3 direction = d.vec3("direction").normalized();
  for (int i = 0; i < 3; ++i) light.direction[i] = direction[i];
  light.fallsOff = d.choice<Falloff>("falloff") == Falloff::Square;
  setRange(d, d.optionalNumber("range").value_or(0), light);
  const double half = 0.5 * d.number("angle") * kDegree;
  setCone(0.8 * half, half, light);
  return light;
}

/// The light of a file; what the script states replaces what the file says.
LightRecord lightOf(const ModelLight& source, const Declaration& d) {
  LightRecord light = statedLight(d);
  if (!d.has("type")) light.kind = static_cast<std::uint32_t>(source.kind);
  if (!d.has("direction"))
    for (int i = 0; i < 3; ++i) light.direction[i] = double{source.direction[static_cast<std::size_t>(i)]};
  if (!d.has("colour"))
    for (std::size_t i = 0; i < 3; ++i)
      light.colour[i] = source.colour[i] * static_cast<float>(d.number("intensity"));
  if (!d.has("falloff")) light.fallsOff = true;
  setRange(d, d.has("range") ? d.number("range") : double{source.range}, light);
  if (!d.has("angle")) setCone(double{source.innerAngle}, double{source.outerAngle}, light);
  return light;
}

std::unique_ptr<Node> makeLight(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  PlaceAttributes place = r.place;
  LightRecord light = statedLight(d);
  if (const auto model = d.has("source") ? modelFor(r, "source", "parent") : std::nullopt)
    if (const ModelLight* source = findIn(model->mesh->lights, r, "source", "light")) {
      light = lightOf(*source, d);
      place.X_PN = Eigen::Translation3d(vectorOf(source->position)) * place.X_PN;
    }
  return std::make_unique<LightNode>(r.self, r.name, place, light, d.flag("initstate"));
}

std::unique_ptr<Node> makeSky(const NodeRequest& r) {
  SkyRecord sky;
  setColour(r.declaration.vec3("zenith"), sky.zenith);
  setColour(r.declaration.vec3("horizon"), sky.horizon);
  setColour(r.declaration.vec3("ground"), sky.ground);
  setColour(r.declaration.vec3("ambient"), sky.ambient);
  sky.haze = static_cast<float>(r.declaration.optionalNumber("haze").value_or(0));
  return std::make_unique<SkyNode>(r.self, r.name, sky);
}

void lintLight(const Declaration& node, LintScope& scope) {
  const std::string_view type = node.text("type");
  if (node.has("intensity") && node.number("intensity") == 0)
    scope.warn(node, "intensity", "a light of intensity 0 lights nothing");
  if (node.has("angle") && type != "spot" && !node.has("source"))
    scope.warn(node, "angle", "angle has no effect: only a spot light has one");
  if (node.has("range") && type == "directional" && !node.has("source"))
    scope.warn(node, "range", "range has no effect: a directional light reaches everywhere");
  if (node.has("shadows") && type != "directional")
    scope.warn(node, "shadows", "shadows has no effect: only a directional light casts them");
  if (node.has("falloff") && type == "directional" && !node.has("source"))
    scope.warn(node, "falloff", "falloff has no effect: a directional light is as bright everywhere");
  if (node.has("direction") && type == "point")
    scope.warn(node, "direction", "direction has no effect: a point light shines all around");
  scope.warnNeverOn(node);
  if (node.flag("initstate") && scope.tally("light") == kMostLights + 1) {
    std::size_t all = 0;
    for (const Declaration light : scope.document())
      all += light.kind() == "light" && light.flag("initstate");
    scope.warn(
        node, "type",
        fmt::format("{} lights are on at the start, but only {} shine at a time: those that are brightest "
                    "where the visitor is",
                    all, kMostLights));
  }
}

constexpr std::string_view kFalloffs[] = {"range", "square"};
constexpr std::string_view kLightTypes[] = {"directional", "point", "spot"};
constexpr AttributeSpec kLightRows[] = {
    {.name = "type",
     .kind = ValueKind::Choice,
     .help = "parallel rays, rays from the position, or a cone from the position",
     .standard = "directional",
     .choices = kLightTypes},
    {.name = "colour",
     .kind = ValueKind::Colour,
     .help = "red, green, blue (sRGB)",
     .standard = "1, 1, 1",
     .range = kColourRange},
    {.name = "intensity",
     .kind = ValueKind::Number,
     .help = "brightness; 1 lights a white surface fully, at 1 m for point and spot",
     .standard = "1",
     .range = {0, 1e6}},
    {.name = "direction",
     .kind = ValueKind::Direction,
     .help = "where the rays go, in the node's coordinates",
     .standard = "0, 0, -1",
     .range = kPlaceRange},
    {.name = "range",
     .kind = ValueKind::Number,
     .help = "point and spot: how far the light reaches",
     .standard = "100",
     .unit = "m",
     .range = kLengthRange},
    {.name = "falloff",
     .kind = ValueKind::Choice,
     .help =
         "point and spot: how the light becomes weaker: evenly up to its range, or with the square of the "
         "distance, too",
     .standard = "range",
     .choices = kFalloffs},
    {.name = "angle",
     .kind = ValueKind::Number,
     .help = "spot: full opening angle of the cone",
     .standard = "45",
     .unit = "degrees",
     .range = {0, 180, true}},
    {.name = "shadows",
     .kind = ValueKind::Flag,
     .help = "directional: whether things cast shadows; of several such lights, the first that is on",
     .standard = "on"},
    {.name = "source",
     .kind = ValueKind::Words,
     .help = "the name of a light in the file of the parent, which is an object: this light has its place "
             "and all "
             "that is not stated; intensity multiplies the file's"},
    kInitStateRow,
};
constexpr AttributeSpec kSkyRows[] = {
    {.name = "zenith",
     .kind = ValueKind::Colour,
     .help = "colour straight up (sRGB)",
     .standard = "0.25, 0.45, 0.8",
     .range = kColourRange},
    {.name = "horizon",
     .kind = ValueKind::Colour,
     .help = "colour at eye level, and of the haze (sRGB)",
     .standard = "0.75, 0.85, 0.95",
     .range = kColourRange},
    {.name = "ground",
     .kind = ValueKind::Colour,
     .help = "colour straight down (sRGB)",
     .standard = "0.35, 0.32, 0.28",
     .range = kColourRange},
    {.name = "ambient",
     .kind = ValueKind::Colour,
     .help = "light that reaches every surface (sRGB)",
     .standard = "0.4, 0.42, 0.45",
     .range = kColourRange},
    {.name = "haze",
     .kind = ValueKind::Number,
     .help = "distance over which two thirds of the contrast are lost; 0 is clear air",
     .standard = "0",
     .unit = "m",
     .range = kDistanceRange},
};

}  // namespace

constinit const NodeType kLightType{
    .name = "light",
    .help = "lights the scene",
    .attributes = kLightRows,
    .traits = {Trait::Placed, Trait::Switched},
    .make = makeLight,
    .lint = lintLight,
};

constinit const NodeType kSkyType{
    .name = "sky",
    .help = "what is seen behind everything, and the light that comes from all sides",
    .attributes = kSkyRows,
    .traits = {Trait::Single, Trait::Drawn},
    .make = makeSky,
};

namespace node_types {

void addLightNode(NodeRegistrar& types) {
  types.add(kLightType);
  types.add(kSkyType);
}

}  // namespace node_types

}  // namespace stadion
