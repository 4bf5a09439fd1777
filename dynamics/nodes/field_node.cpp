#include "dynamics/nodes/field_node.h"

#include "dynamics/nodes/dyn_object_node.h"
#include "dynamics/nodes/shape_store.h"
#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/scene/scene.h"
#include "engine/script/declaration_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {

FieldLaw FieldNode::law(const Scene& scene) const {
  const Vec3 scale = scaleOf(scene.placements().world(placement()));
  FieldLaw law = law_;
  if (auto* linear = std::get_if<LinearField>(&law)) linear->push = linear->push.cwiseProduct(scale);
  const double size = scale.maxCoeff();
  if (auto* spherical = std::get_if<SphericalField>(&law)) spherical->radius *= size;
  if (auto* point = std::get_if<PointField>(&law)) point->softening *= size;
  if (auto* vortex = std::get_if<VortexField>(&law)) {
    vortex->core *= size;
    vortex->radius *= size;
  }
  if (auto* medium = std::get_if<MediumField>(&law)) {
    medium->centre = medium->centre.cwiseProduct(scale);
    medium->half = medium->half.cwiseProduct(scale);
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
  if (centredOnMass_) moveToCentreOfMass(scene);
  since_ = scene.now();
  if (switch_.on() && duration_ > 0) scene.schedule().wakeAt(since_ + duration_, self());
}

void FieldNode::moveToCentreOfMass(Scene& scene) {
  const auto* body = dynamic_cast<const DynObjectNode*>(scene.find(attributes().parent));
  if (!body) return;
  const FittedShape& fit = *body->fit();
  Affine X_BF = attributes().X_PN;
  X_BF.pretranslate(body->body().massOf(fit).centre.cwiseQuotient(fit.scale));
  setHome(scene, scene.placements().world(body->placement()) * X_BF);
}

void FieldNode::change(bool on, Nanoseconds when, FrameContext& frame) {
  if (changedIn_ != frame.now.frame) changes_.clear();
  changedIn_ = frame.now.frame;
  changes_.push_back({when, on});
  if (on) {
    since_ = when;
    if (duration_ > 0) frame.scene.schedule().wakeAt(when + duration_, self());
  }
  for (const NodeRef user : users_) frame.scene.schedule().wakeNow(user);
}

void FieldNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  const Nanoseconds when = frame.effective(m);
  expire(when);  // before the command
  const bool before = switch_.on();
  if (!switch_.apply(m)) return;
  if (switch_.on() != before) raise(before ? Event("disabled") : Event("enabled"), when);
  change(switch_.on(), when, frame);
}

/// Ends an activation whose duration is over by then. The world ends it by itself, at the same exact time.
void FieldNode::expire(Nanoseconds by) {
  if (!switch_.on() || duration_ == 0 || since_ + duration_ > by) return;
  switch_.set(false);
  raise("expired", since_ + duration_);
}

void FieldNode::followAxis(FrameContext& frame) {
  if (!axis_) return;
  const double before = strength_.empty() ? 0 : strength_.back().value;
  strength_ = axisTrack(frame.input, axis_->tracker, axis_->axis, frame.start(), frame.now.time);
  if (std::ranges::any_of(strength_, [&](const AxisKnot& k) { return k.value != before; }))
    for (const NodeRef user : users_) frame.scene.schedule().wakeNow(user);
}

void FieldNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  followAxis(frame);
  expire(frame.now.time);
}

template <class Self, class Fields>
void FieldNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("switch", self.switch_), f("since", self.since_);
  if (!self.strength_.empty()) f.hashed(self.strength_.back().value);
  f.unhashed("strength", self.strength_), f.unhashed("changes", self.changes_);
  f.unhashed("changed in", self.changedIn_), f.unhashed("users", self.users_);
}

void FieldNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void FieldNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

constexpr double kStandardGravity = 9.80665;  // [m/s2]
constexpr double kDensityOfWater = 1000;      // [kg/m3]

enum class ForceUnit : std::uint8_t { Gravity, Acceleration, Newton };
enum class FieldMode : std::uint8_t { Attract, Repel };
enum class FieldFalloff : std::uint8_t { None, Linear, Square };
enum class FieldAnchor : std::uint8_t { Mass, Origin };
enum class DeviceAxis : std::uint8_t {};

/// The node that a field is attached to carries it; else its parent does.
PlaceAttributes fieldPlace(const NodeRequest& r) {
  PlaceAttributes place = r.place;
  if (const auto carrier = r.declaration.reference("attach")) place.parent = r.resolve(*carrier);
  return place;
}

/// Factor to SI, and whether the number is a force rather than an acceleration.
std::pair<double, LinearField::Unit> unitOf(const Declaration& d) {
  switch (d.choice<ForceUnit>("unit")) {
  case ForceUnit::Gravity: return {kStandardGravity, LinearField::Unit::Acceleration};
  case ForceUnit::Acceleration: return {1.0, LinearField::Unit::Acceleration};
  case ForceUnit::Newton: return {1.0, LinearField::Unit::Force};
  }
  return {1.0, LinearField::Unit::Acceleration};
}

std::unique_ptr<Node> makeField(const NodeRequest& r, FieldLaw law) {
  const Declaration& d = r.declaration;
  FieldAttributes a{law, fromSeconds(d.optionalNumber("duration").value_or(0)), d.flag("initstate"), {}};
  a.centredOnMass =
      d.takes("anchor") && d.has("attach") && d.choice<FieldAnchor>("anchor") == FieldAnchor::Mass;
  if (const auto axis = d.optionalChoice<DeviceAxis>("strengthaxis"))
    a.axis = {std::string(d.text("tracker")), static_cast<std::size_t>(*axis)};
  return std::make_unique<FieldNode>(r.type(), r.self, r.name, fieldPlace(r), std::move(a));
}

std::unique_ptr<Node> makeLinearField(const NodeRequest& r) {
  const auto [factor, unit] = unitOf(r.declaration);
  return makeField(r, LinearField{r.declaration.vec3("direction") * factor, unit});
}

std::unique_ptr<Node> makeSphericalField(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto [factor, unit] = unitOf(d);
  SphericalField law;
  law.radius = d.number("radius");
  law.strength = d.number("strength") * factor * (d.choice<FieldMode>("mode") == FieldMode::Attract ? -1 : 1);
  law.falloff = static_cast<SphericalField::Falloff>(d.choice<FieldFalloff>("falloff"));
  law.unit = unit;
  return makeField(r, law);
}

std::unique_ptr<Node> makePointField(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto [factor, unit] = unitOf(d);
  const double sign = d.choice<FieldMode>("mode") == FieldMode::Attract ? -1 : 1;
  return makeField(r, PointField{d.number("strength") * factor * sign, d.number("softening"), unit});
}

std::unique_ptr<Node> makeVortexField(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto [factor, unit] = unitOf(d);
  VortexField law{d.number("strength") * factor, d.number("core"), d.number("inward")};
  law.radius = d.optionalNumber("radius").value_or(law.radius);
  law.unit = unit;
  return makeField(r, law);
}

std::unique_ptr<Node> makeMediumField(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  MediumField law;
  law.density = d.number("density") * kDensityOfWater;
  law.viscosity = d.number("viscosity");
  law.wind = d.vec3("wind");
  if (const auto ball = d.sphere("sphere")) {
    law.region = MediumField::Region::Ball;
    law.centre = ball->centre;
    law.half.setConstant(ball->radius);
  } else if (const auto box = d.box("box")) {
    law.region = MediumField::Region::Box;
    law.centre = box->centre;
    law.half = 0.5 * box->edges;
  }
  return makeField(r, law);
}

void checkMedium(DeclarationCheck& check) {
  checkVolume(check, false);  // without a volume it is everywhere
}

void lintExpiry(const Declaration& node, LintScope& scope) {
  if (node.has("duration")) return;
  for (const EventMessage& m : node.eventMessages())
    if (m.event == Event("expired"))
      scope.warn(node, "eventmessage", "without a duration, this field never posts expired");
}

/// A node in another file may be a body.
void lintAnchor(const Declaration& node, LintScope& scope) {
  if (!node.has("anchor")) return;
  const auto carrier = node.reference("attach");
  if (!carrier) return scope.warn(node, "anchor", "the anchor has no effect without attach");
  if (node.choice<FieldAnchor>("anchor") != FieldAnchor::Mass || !scope.useOf(*carrier)) return;
  const Declaration named = scope.document()[carrier->declaration];
  if (named.kind() != NodeKind("dynobject"))
    scope.warn(node, "anchor",
               fmt::format("anchor=mass has no effect: {} is no body", LintScope::called(named)));
}

void lintField(const Declaration& node, LintScope& scope) {
  const NodeUse& use = scope.useOf(node);
  const bool linear = node.kind() == "forcelinear";
  if (node.kind() == "medium") {
    if (node.number("density") == 0 && node.number("viscosity") == 0)
      scope.warn(node, "density", "this medium holds nothing back: its density and viscosity are 0");
  } else if (linear ? node.has("direction") && node.vec3("direction").isZero(0)
                    : node.number("strength") == 0) {
    scope.warn(node, linear ? Attr("direction") : Attr("strength"), "this field exerts no force");
  }
  if (node.has("tracker") && !node.has("strengthaxis"))
    scope.warn(node, "tracker", "the tracker has no effect without strengthaxis");
  lintAnchor(node, scope);
  lintExpiry(node, scope);
  if (node.name().empty() || (scope.alone() && !use.hooked))
    scope.warn(node, "name", fmt::format("{} is never hooked to a body", LintScope::called(node)));
  scope.warnNeverOn(node);
}

constexpr std::string_view kDeviceAxes[] = {"0", "1", "2", "3", "4", "5", "6", "7"};
constexpr std::string_view kForceUnits[] = {"g", "m/s2", "N"};
constexpr std::string_view kFieldModes[] = {"attract", "repel"};
constexpr std::string_view kFieldAnchors[] = {"mass", "origin"};
constexpr std::string_view kFalloffs[] = {"none", "linear", "square"};
constexpr AttributeSpec kFieldDuration{
    .name = "duration",
    .kind = ValueKind::Number,
    .help = "longest time that one activation lasts; without it, until disabled",
    .unit = "s",
    .range = kTimeRange};
constexpr AttributeSpec kFieldUnit{
    .name = "unit",
    .kind = ValueKind::Choice,
    .help = "what the strength is counted in: standard gravity, acceleration or force",
    .standard = "g",
    .choices = kForceUnits};
constexpr AttributeSpec kFieldAxis{
    .name = "strengthaxis",
    .kind = ValueKind::Choice,
    .help = "axis of the device that the strength (of a medium, the wind) is multiplied by; without it, 1",
    .choices = kDeviceAxes};
constexpr AttributeSpec kFieldTracker{.name = "tracker",
                                      .kind = ValueKind::Tracker,
                                      .help = "the device of strengthaxis; while it is lost its axes are 0",
                                      .standard = "wand"};
constexpr AttributeSpec kAttachRow{.name = "attach",
                                   .kind = ValueKind::Reference,
                                   .help = "the node that the field moves and turns with",
                                   .targets = kPlacedOrRig,
                                   .acts = true};

constexpr AttributeSpec kFieldAnchor{
    .name = "anchor",
    .kind = ValueKind::Choice,
    .help = "what its place counts from if a body is named by `attach`: the body's centre of mass, or the "
            "origin of its model",
    .standard = "mass",
    .choices = kFieldAnchors};

constexpr EventSpec kFieldEvents[] = {{"enabled", "a command has enabled the field, which was disabled"},
                                      {"disabled", "a command has disabled the field, which was enabled"},
                                      {"expired", "the field's duration was over; it is disabled"}};

constexpr AttributeSpec kForceLinearRows[] = {
    {.name = "direction",
     .kind = ValueKind::Vector,
     .help = "direction and strength, in the node's coordinates; \"0, 0, -1\" is gravity",
     .unit = "the field's unit",
     .range = kForceRange,
     .required = true},
    kFieldUnit,
    kInitStateRow,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
};
constexpr AttributeSpec kForceSphericalRows[] = {
    {.name = "radius",
     .kind = ValueKind::Number,
     .help = "how far it reaches",
     .unit = "m",
     .range = kLengthRange,
     .required = true},
    {.name = "strength",
     .kind = ValueKind::Number,
     .help = "at the centre; `falloff` says how it falls from there",
     .standard = "1",
     .unit = "the field's unit",
     .range = {0, kFar}},
    {.name = "mode",
     .kind = ValueKind::Choice,
     .help = "towards the centre or away from it",
     .standard = "attract",
     .choices = kFieldModes},
    {.name = "falloff",
     .kind = ValueKind::Choice,
     .help = "how the strength falls with the distance",
     .standard = "none",
     .choices = kFalloffs},
    kFieldUnit,
    kInitStateRow,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
    kFieldAnchor,
};
constexpr AttributeSpec kFieldStrength{.name = "strength",
                                       .kind = ValueKind::Number,
                                       .help = "strength at 1 m from the centre",
                                       .standard = "1",
                                       .unit = "the field's unit",
                                       .range = {0, kFar}};
constexpr AttributeSpec kFieldMode{.name = "mode",
                                   .kind = ValueKind::Choice,
                                   .help = "towards the centre or away from it",
                                   .standard = "attract",
                                   .choices = kFieldModes};
constexpr AttributeSpec kForcePointRows[] = {
    kFieldStrength,
    kFieldMode,
    {.name = "softening",
     .kind = ValueKind::Number,
     .help = "nearer than about this the force stops growing",
     .standard = "0.1",
     .unit = "m",
     .range = kLengthRange},
    kFieldUnit,
    kInitStateRow,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
    kFieldAnchor,
};
constexpr AttributeSpec kForceVortexRows[] = {
    {.name = "strength",
     .kind = ValueKind::Number,
     .help = "strength at the core's edge; negative turns the other way",
     .standard = "1",
     .unit = "the field's unit",
     .range = kForceRange},
    {.name = "core",
     .kind = ValueKind::Number,
     .help = "radius up to which it grows; beyond, it falls with the distance",
     .standard = "1",
     .unit = "m",
     .range = kLengthRange},
    {.name = "radius",
     .kind = ValueKind::Number,
     .help = "how far it reaches; without it, everywhere",
     .unit = "m",
     .range = kLengthRange},
    {.name = "inward",
     .kind = ValueKind::Number,
     .help = "pull towards the axis, in multiples of the whirl",
     .standard = "0",
     .range = kForceRange},
    kFieldUnit,
    kInitStateRow,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
};
constexpr AttributeSpec kMediumRows[] = {
    {.name = "density",
     .kind = ValueKind::Number,
     .help = "relative to water; air has 0.001225",
     .standard = "0.001225",
     .range = {0, 1000}},
    {.name = "wind",
     .kind = ValueKind::Vector,
     .help = "how it flows, in the node's coordinates",
     .standard = "0, 0, 0",
     .unit = "m/s",
     .range = kForceRange},
    {.name = "viscosity",
     .kind = ValueKind::Number,
     .help = "rate at which it takes away speed, besides the drag that grows with the square",
     .standard = "0",
     .unit = "1/s",
     .range = {0, 1000}},
    {.name = "sphere",
     .kind = ValueKind::Sphere,
     .help = "where it is: centre and radius, in the node's coordinates; without it or a box, everywhere",
     .unit = "m",
     .range = kLengthRange},
    {.name = "box",
     .kind = ValueKind::Box,
     .help = "where it is: centre and edges, in the node's coordinates",
     .unit = "m",
     .range = kLengthRange},
    kInitStateRow,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
};

}  // namespace

constinit const NodeType kForceLinearType{
    .name = "forcelinear",
    .help = "a force field with the same force everywhere, such as gravity or a kick",
    .attributes = kForceLinearRows,
    .events = kFieldEvents,
    .traits = {Trait::Placed, Trait::Switched, Trait::Field},
    .make = makeLinearField,
    .lint = lintField,
};

constinit const NodeType kForceSphericalType{
    .name = "forcespherical",
    .help = "a force field around a centre",
    .attributes = kForceSphericalRows,
    .events = kFieldEvents,
    .traits = {Trait::Placed, Trait::Switched, Trait::Field},
    .make = makeSphericalField,
    .lint = lintField,
};

constinit const NodeType kForcePointType{
    .name = "forcepoint",
    .help = "attraction or repulsion by the inverse square of the distance",
    .attributes = kForcePointRows,
    .events = kFieldEvents,
    .traits = {Trait::Placed, Trait::Switched, Trait::Field},
    .make = makePointField,
    .lint = lintField,
};

constinit const NodeType kForceVortexType{
    .name = "forcevortex",
    .help = "a whirl about the node's Z axis",
    .attributes = kForceVortexRows,
    .events = kFieldEvents,
    .traits = {Trait::Placed, Trait::Switched, Trait::Field},
    .make = makeVortexField,
    .lint = lintField,
};

constinit const NodeType kMediumType{
    .name = "medium",
    .help = "air or water that bodies fly through, and its wind",
    .attributes = kMediumRows,
    .events = kFieldEvents,
    .traits = {Trait::Placed, Trait::Switched, Trait::Field},
    .make = makeMediumField,
    .check = checkMedium,
    .lint = lintField,
};

namespace node_types {

void addFieldNode(NodeRegistrar& types) {
  types.add(kForceLinearType);
  types.add(kForceSphericalType);
  types.add(kForcePointType);
  types.add(kForceVortexType);
  types.add(kMediumType);
}

}  // namespace node_types

}  // namespace stadion
