#include "dynamics/nodes/dyn_object_node.h"

#include "dynamics/nodes/body_maker.h"
#include "dynamics/nodes/flight_factory.h"
#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/nodes/object_node.h"
#include "engine/scene/scene.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace stadion {
namespace {

/// About the longest, the middle and the shortest axis: that is how the moments of even matter rise.
void takeMoments(MassProperties& mass, const Vec3& moments) {
  const Vec3 even = mass.inertia;
  int order[3] = {0, 1, 2};
  std::stable_sort(order, order + 3, [&even](int i, int j) { return even[i] < even[j]; });
  for (int k = 0; k < 3; ++k) mass.inertia[order[k]] = moments[k];
}

}  // namespace

MassProperties BodyAttributes::massOf(const FittedShape& fit) const {
  const MassProperties& filled = fit.filled.value();
  MassProperties m = filled.withMass(mass.value_or(density * filled.mass));
  if (centre) m.centre = centre->cwiseProduct(fit.scale);
  if (inertia) takeMoments(m, *inertia);
  return m;
}

void DynObjectNode::onEnter(Scene& scene) {
  ObjectNode::onEnter(scene);
  hooked_.clear();
  for (const std::string& name : body_.hooks)
    if (const NodeRef field = scene.tree().resolve(name, self()); field.valid()) hooked_.push_back(field);
}

std::vector<DynObjectNode::Request> DynObjectNode::takeRequests() {
  return std::exchange(requests_, {});
}

void DynObjectNode::ask(Request request) {
  if (!simulation_.asking) return;  // no node would ever take it
  requests_.push_back(std::move(request));
  simulation_.asking->push_back(self());
}

void DynObjectNode::receive(const Message& m, FrameContext& frame) {
  const Nanoseconds when = frame.effective(m);
  const auto argument = [&](std::size_t i) { return m.arguments.size() > i ? m.arguments[i] : "wand"; };
  switch (m.command) {
  case CommandId::Hook:
  case CommandId::Unhook: {
    if (!m.node.valid()) return;
    const bool hook = m.command == CommandId::Hook;
    std::erase(hooked_, m.node);
    if (hook) hooked_.push_back(m.node);
    ask({when, hook ? Request::Kind::Hook : Request::Kind::Unhook, m.node, {}});
    break;
  }
  case CommandId::Grab: ask({when, Request::Kind::Grab, {}, argument(0)}); break;
  case CommandId::Attach: ask({when, Request::Kind::Grab, {}, argument(1)}); break;  // to the hand, as a body
  case CommandId::Release:
  case CommandId::Detach: ask({when, Request::Kind::Release, {}, {}}); break;
  case CommandId::Reset:
    restoreHooks(when, frame.scene);
    ask({when, Request::Kind::Reset, {}, {}});
    ObjectNode::receive(m, frame);
    break;
  default: ObjectNode::receive(m, frame); break;
  }
  if (simulation_.asking) frame.scene.schedule().wakeNow(simulation_.dynamics);
}

void DynObjectNode::restoreHooks(Nanoseconds when, Scene& scene) {
  // As at the start: the hooks of the script.
  for (const NodeRef field : hooked_) ask({when, Request::Kind::Unhook, field, {}});
  hooked_.clear();
  for (const std::string& name : body_.hooks)
    if (const NodeRef field = scene.tree().resolve(name, self()); field.valid()) {
      hooked_.push_back(field);
      ask({when, Request::Kind::Hook, field, {}});
    }
}

template <class Self, class Fields>
void DynObjectNode::fields(Self& self, Fields& f) {
  ObjectNode::fields(self, f);
  f("hooked", self.hooked_);
  auto& s = self.state_;
  f("centre of mass", s.p), f("attitude", s.q), f("velocity", s.v), f("angular velocity", s.omega);
  f("angular momentum", s.L), f("mode", s.mode), f("clock", s.clock), f("clock rest", s.clockRest);
  f.unhashed("pose", s.pose), f.unhashed("flight", s.flight), f.unhashed("arcs", s.arcs);
  f.unhashed("requests", self.requests_);
}

void DynObjectNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void DynObjectNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

void lintBody(const Declaration& node, LintScope& scope) {
  lintModel(node, scope);
  if (node.has("mass") && node.has("density"))
    scope.warn(node, "density", "density has no effect, since mass is stated too");
  scope.warnRepeated(node, "hook");
  if (scope.alone() && !scope.useOf(node).simulated)
    scope.warn(
        node, "name",
        fmt::format("{} is collidee of no dynamics node and will never move", LintScope::called(node)));
}

constexpr std::string_view kThrows[] = {"hand", "field", "both"};
constexpr std::string_view kFlights[] = {"point", "ballistic", "bias", "rod", "plate", "ball", "table"};
constexpr std::string_view kBiases[] = {"flow", "paper", "covariance"};
constexpr std::string_view kAxesFrom[] = {"area", "vertices"};
constexpr AttributeSpec kDynObjectRows[] = {
    kObjectFile,
    kObjectDraw,
    kObjectUnit,
    kObjectUp,
    kObjectShape,
    kObjectTolerance,
    kObjectLevels,
    {.name = "density",
     .kind = ValueKind::Number,
     .help = "relative to water; with the mesh's volume it gives the mass",
     .standard = "1",
     .range = {1e-6, 1000}},
    {.name = "mass",
     .kind = ValueKind::Number,
     .help = "overrides density",
     .unit = "kg",
     .range = {1e-9, 1e9}},
    {.name = "centre",
     .kind = ValueKind::Vector,
     .help = "the centre of mass in the model's coordinates, inside the model; if not stated, as of matter "
             "that fills it evenly",
     .unit = "m",
     .range = kPlaceRange},
    {.name = "inertia",
     .kind = ValueKind::Moments,
     .help = "moments about the longest, the middle and the shortest principal axis through the centre of "
             "mass; if not stated, as of matter that fills it evenly",
     .unit = "kg*m2",
     .range = {1e-15, 1e15}},
    {.name = "friction",
     .kind = ValueKind::Number,
     .help = "Coulomb coefficient; a pair takes the root of the product",
     .standard = "0.5",
     .range = {0, 10}},
    {.name = "restitution",
     .kind = ValueKind::Number,
     .help = "part of the closing speed that comes back from an impact; a pair takes the larger",
     .standard = "0.5",
     .range = kUnitInterval},
    {.name = "rolling",
     .kind = ValueKind::Number,
     .help = "rolling resistance coefficient of balls, rods and discs; a pair takes the larger",
     .standard = "0.01",
     .range = kUnitInterval},
    {.name = "damping",
     .kind = ValueKind::Number,
     .help = "rate at which the medium takes away speed",
     .standard = "0",
     .unit = "1/s",
     .range = {0, 1000}},
    {.name = "dragarea",
     .kind = ValueKind::Number,
     .help = "drag coefficient times cross section, for media; if not stated, 0.47 of a ball's or the mean "
             "of others'",
     .unit = "m2",
     .range = {0, 1e6}},
    {.name = "hook",
     .kind = ValueKind::Reference,
     .help = "a force field that acts on it from the start",
     .repeatable = true,
     .targets = kFieldTypes,
     .acts = true},
    {.name = "velocity",
     .kind = ValueKind::Vector,
     .help = "at the start and after reset, along the parent's axes",
     .standard = "0, 0, 0",
     .unit = "m/s",
     .range = kPlaceRange},
    {.name = "angularvelocity",
     .kind = ValueKind::Vector,
     .help = "at the start and after reset, about the parent's axes",
     .standard = "0, 0, 0",
     .unit = "degrees/s",
     .range = kTurnRange},
    {.name = "throw",
     .kind = ValueKind::Choice,
     .help = "what it takes along when a hand lets go: the hand's velocity, the pushes of the linear fields "
             "that the hand carries, or both",
     .standard = "both",
     .choices = kThrows},
    {.name = "spin",
     .kind = ValueKind::Number,
     .help = "what a hand that lets go adds to its turning, about the axis of symmetry",
     .standard = "0",
     .unit = "degrees/s",
     .range = kTurnRange},
    {.name = "nose",
     .kind = ValueKind::Direction,
     .help = "the way its tip points, in the model's coordinates; if not stated, along its longest axis to "
             "the heavier end",
     .range = kPlaceRange},
    {.name = "sticks",
     .kind = ValueKind::Number,
     .help = "it sticks fast in a collider that its tip meets first, within this angle of straight on; "
             "without it, never",
     .unit = "degrees",
     .range = {0, 90, true}},
    {.name = "depth",
     .kind = ValueKind::Number,
     .help = "how far its tip goes in where it sticks, the way it comes",
     .standard = "0.08",
     .unit = "m",
     .range = {0, 100}},
    {.name = "flight",
     .kind = ValueKind::Choice,
     .help = "how air acts on it: as on a point with drag, not at all, by the paper's bias, as on a rod, a "
             "plate or a ball, or by a table",
     .standard = "point",
     .choices = kFlights},
    {.name = "coefficients",
     .kind = ValueKind::Coefficients,
     .help = "of flight=rod, plate or ball, in the order of docs/flight.md; or javelin, discus or football; "
             "if not stated, from the model's form"},
    {.name = "flighttable",
     .kind = ValueKind::File,
     .help = "of flight=table: coefficients by the angle of attack (.csv)"},
    {.name = "bias",
     .kind = ValueKind::Choice,
     .help = "of flight=bias: its angle to the velocity decays evenly, or by a share in every frame as in "
             "the paper, or by the form's covariance; flow if not stated",
     .choices = kBiases},
    {.name = "biasrate",
     .kind = ValueKind::Number,
     .help = "of flight=bias: per second (flow), share of the angle in a frame (paper), per metre "
             "(covariance); if not stated 1.8, 0.03, 0.07",
     .range = {0, 1000}},
    {.name = "axes",
     .kind = ValueKind::Choice,
     .help = "of flight=bias: its axes from the surface's area, or from random vertices as in the paper; "
             "area if not stated",
     .choices = kAxesFrom},
};

constexpr EventSpec kBodyEvents[] = {
    {"onquarantine", "its state would have become infinite or undefined; it stands still until its reset"}};

constexpr CommandSpec kBodyCommands[] = {
    {"hook", ArgumentKind::Field, "hook FIELD", "the field acts on the body from now on"},
    {"unhook", ArgumentKind::Field, "unhook FIELD", "the field acts on the body no more"},
    {"grab", ArgumentKind::Tracker, "grab [TRACKER]",
     "the body is held by a tracker (wand if none is named) at the place where it was taken"},
    {"release", ArgumentKind::None, "release", "the body flies on with the velocity it was held with"}};

}  // namespace

constinit const NodeType kDynObjectType{
    .name = "dynobject",
    .help = "a body: a model with mass that a dynamics node moves",
    .attributes = kDynObjectRows,
    .events = kBodyEvents,
    .commands = kBodyCommands,
    .traits = {Trait::Placed, Trait::Parent, Trait::Level, Trait::Moves, Trait::Model},
    .make = makeDynObject,
    .check = checkFlight,
    .lint = lintBody,
};

namespace node_types {

void addDynObjectNode(NodeRegistrar& types) {
  types.add(kDynObjectType);
}

}  // namespace node_types

}  // namespace stadion
