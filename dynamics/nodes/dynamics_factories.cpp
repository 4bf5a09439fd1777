#include "dynamics/nodes/dynamics_factories.h"

#include "dynamics/nodes/dynamics_node.h"
#include "dynamics/nodes/flight_factory.h"
#include "dynamics/nodes/shape_store.h"
#include "engine/maths/angles.h"
#include "engine/script/choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <memory>

namespace stadion {
namespace {

constexpr double kStandardGravity = 9.80665;  // [m/s2]
constexpr double kWaterDensity = 1000;        // [kg/m3]
constexpr double kAirDensity = 1.225;         // [kg/m3] at sea level, 15 degrees C

using Made = std::unique_ptr<Node>;

/// The node that a field is attached to carries it; else its parent does.
PlaceAttributes fieldPlace(const NodeRequest& r) {
  PlaceAttributes place = r.place;
  if (const auto carrier = r.declaration.reference(Attr::Attach)) place.parent = r.resolve(*carrier);
  return place;
}

/// Factor to SI, and whether the number is a force rather than an acceleration.
std::pair<double, LinearField::Unit> unitOf(const Declaration& d) {
  switch (d.choice<ForceUnit>(Attr::Unit)) {
  case ForceUnit::Gravity: return {kStandardGravity, LinearField::Unit::Acceleration};
  case ForceUnit::Acceleration: return {1.0, LinearField::Unit::Acceleration};
  case ForceUnit::Newton: return {1.0, LinearField::Unit::Force};
  }
  return {1.0, LinearField::Unit::Acceleration};
}

Made makeField(const NodeRequest& r, FieldLaw law) {
  const Declaration& d = r.declaration;
  FieldAttributes a{
      law, fromSeconds(d.optionalNumber(Attr::Duration).value_or(0)), d.flag(Attr::InitState), {}};
  if (const auto axis = d.optionalChoice<DeviceAxis>(Attr::StrengthAxis))
    a.axis = {std::string(d.text(Attr::Tracker)), static_cast<std::size_t>(*axis)};
  return std::make_unique<FieldNode>(d.kind(), r.self, r.name, fieldPlace(r), std::move(a));
}

Made makeLinear(const NodeRequest& r) {
  const auto [factor, unit] = unitOf(r.declaration);
  return makeField(r, LinearField{r.declaration.vec3(Attr::Direction) * factor, unit});
}

Made makeSpherical(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto [factor, unit] = unitOf(d);
  SphericalField law;
  law.radius = d.number(Attr::Radius);
  law.strength =
      d.number(Attr::Strength) * factor * (d.choice<FieldMode>(Attr::Mode) == FieldMode::Attract ? -1 : 1);
  law.falloff = static_cast<SphericalField::Falloff>(d.choice<FieldFalloff>(Attr::Falloff));
  law.unit = unit;
  return makeField(r, law);
}

Made makePoint(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto [factor, unit] = unitOf(d);
  const double sign = d.choice<FieldMode>(Attr::Mode) == FieldMode::Attract ? -1 : 1;
  return makeField(r, PointField{d.number(Attr::Strength) * factor * sign, d.number(Attr::Softening), unit});
}

Made makeVortex(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto [factor, unit] = unitOf(d);
  VortexField law{d.number(Attr::Strength) * factor, d.number(Attr::Core), d.number(Attr::Inward)};
  law.radius = d.optionalNumber(Attr::Radius).value_or(law.radius);
  law.unit = unit;
  return makeField(r, law);
}

Made makeMedium(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  MediumField law;
  law.density = d.number(Attr::Density) * kWaterDensity;
  law.viscosity = d.number(Attr::Viscosity);
  law.wind = d.vec3(Attr::Wind);
  if (const auto ball = d.sphere(Attr::Sphere)) {
    law.region = MediumField::Region::Ball;
    law.centre = ball->centre, law.half.setConstant(ball->radius);
  } else if (const auto box = d.box(Attr::Box)) {
    law.region = MediumField::Region::Box;
    law.centre = box->centre, law.half = 0.5 * box->edges;
  }
  return makeField(r, law);
}

void warnIfLighterThanAir(const NodeRequest& r, const MassProperties& mass, double volume) {
  if (mass.mass >= kAirDensity * volume) return;
  const Attr attr = r.declaration.has(Attr::Mass) ? Attr::Mass : Attr::Density;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "this body of %.3g kg is lighter than the air it displaces (%.3g kg); density is relative to water",
      mass.mass, kAirDensity * volume);
  r.findings.warning(r.declaration.where(attr), text, r.declaration.excerpt(attr));
}

/// A body's centre of mass is among its matter.
bool centreIsInside(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  if (!d.has(Attr::Centre) || r.mesh->standIn) return true;
  constexpr double kRounding = 1e-6;
  const Aabb& box = r.mesh->bounds;
  const Vec3 c = d.vec3(Attr::Centre), room = Vec3::Constant(kRounding * (box.hi - box.lo).norm());
  if (((box.lo - room - c).array() <= 0).all() && ((c - box.hi - room).array() <= 0).all()) return true;
  r.findings.error(d.where(Attr::Centre),
                   fmt::format("the centre of mass lies outside of the model, which reaches from "
                               "\"{:.4g}, {:.4g}, {:.4g}\" to \"{:.4g}, {:.4g}, {:.4g}\" m",
                               box.lo.x(), box.lo.y(), box.lo.z(), box.hi.x(), box.hi.y(), box.hi.z()),
                   d.excerpt(Attr::Centre));
  return false;
}

/// What has next to no inertia turns too fast for contact to be followed.
bool inertiaIsEnough(const NodeRequest& r, const MassProperties& mass, const MassProperties& even) {
  constexpr double kLeast = 0.01;
  const Declaration& d = r.declaration;
  const Vec3 least = kLeast * mass.mass / even.mass * even.inertia;
  if (!d.has(Attr::Inertia) || (mass.inertia.array() >= least.array()).all()) return true;
  Vec3 named = least;
  std::sort(named.begin(), named.end());
  r.findings.error(
      d.where(Attr::Inertia),
      fmt::format("the moments must be at least \"{:.3g}, {:.3g}, {:.3g}\" kg*m2, a hundredth of what "
                  "{:.4g} kg have that fill the model evenly",
                  named.x(), named.y(), named.z(), mass.mass),
      d.excerpt(Attr::Inertia));
  return false;
}

/// Half the sum of the moments is that of the matter about the centre, which none of it is farther from than
/// the model's farthest point.
void warnOfImpossibleInertia(const NodeRequest& r, const MassProperties& mass) {
  const Declaration& d = r.declaration;
  if (!d.has(Attr::Inertia)) return;
  const Vec3 scale = scaleOf(r.place.X_PN);
  double farthest = 0;
  for (const auto& p : r.mesh->positions)
    farthest = std::max(farthest, (Vec3(p[0], p[1], p[2]).cwiseProduct(scale) - mass.centre).squaredNorm());
  if (0.5 * mass.inertia.sum() <= 1.0001 * mass.mass * farthest) return;
  r.findings.warning(d.where(Attr::Inertia),
                     fmt::format("no body of {:.4g} kg within {:.4g} m of its centre of mass has so much "
                                 "inertia; the greatest sum of the three moments is {:.4g} kg*m2",
                                 mass.mass, std::sqrt(farthest), 2 * mass.mass * farthest),
                     d.excerpt(Attr::Inertia));
}

Made makeDynObject(const NodeRequest& r, ShapeStore& shapes, const DynamicsVariation& variation,
                   const AssetRoots* roots) {
  const Declaration& d = r.declaration;
  const auto fail = [&](const std::string& why) -> Made {
    const std::string model = "\"" + std::string(d.text(Attr::File)) + "\" ";
    r.findings.error(d.where(Attr::File), model + why, d.excerpt(Attr::File));
    return nullptr;
  };
  BodyAttributes body = bodyAttributesOf(d);
  Appearance appearance = r.appearance;
  if (variation.body) variation.body(r.self, appearance, body);
  auto fit = shapes.fit(*r.mesh, appearance, scaleOf(r.place.X_PN));
  if (!fit) return fail(fit.error().message);
  const FittedShape& fitted = *fit.value();
  if (!fitted.filled) return fail(fitted.filled.error().message);

  if (!centreIsInside(r)) return nullptr;
  const MassProperties mass = body.massOf(fitted);
  if (!mass.valid()) return fail("is too small or too large for a body");
  if (!inertiaIsEnough(r, mass, fitted.filled.value())) return nullptr;
  auto flight = flightOf(r, mass, roots);
  if (!flight) {
    r.findings.add(flight.error());
    return nullptr;
  }
  body.flight = std::move(flight.value());
  warnIfLighterThanAir(r, mass, fitted.filled.value().mass);
  warnOfImpossibleInertia(r, mass);
  return std::make_unique<DynObjectNode>(r.self, r.name, r.place, std::move(appearance), std::move(body),
                                         std::move(fit.value()));
}

CollisionAttributes collisionOf(const NodeRequest& r, ShapeStore& shapes) {
  const Declaration& d = r.declaration;
  CollisionAttributes a;
  for (const NodeReference& n : d.references(Attr::Collider)) a.colliders.push_back(std::string(n.name));
  for (const NodeReference& n : d.references(Attr::Collidee)) a.collidees.push_back(std::string(n.name));
  a.releaseDistance = d.number(Attr::ReleaseDistance);
  if (specOf(d.kind(), Attr::SelfCollide)) a.selfCollide = d.flag(Attr::SelfCollide);
  if (specOf(d.kind(), Attr::InitState)) a.on = d.flag(Attr::InitState);
  // Fitting a large model takes longer than a frame: it is done here, beside the show.
  for (const NodeReference& n : d.references(Attr::Collider))
    if (const auto model = r.model(n); model && model->mesh)
      if (auto fit = shapes.fit(*model->mesh, model->appearance, scaleOf(model->X_WN)))
        a.fits.push_back(std::move(fit.value()));
  return a;
}

}  // namespace

BodyAttributes bodyAttributesOf(const Declaration& d) {
  BodyAttributes body;
  body.density = d.number(Attr::Density) * kWaterDensity;
  body.mass = d.optionalNumber(Attr::Mass);
  if (d.has(Attr::Centre)) body.centre = d.vec3(Attr::Centre);
  if (d.has(Attr::Inertia)) body.inertia = d.vec3(Attr::Inertia);
  // Only what the script states counts for a pair: a standard value must not outvote the other side.
  const auto stated = [&](Attr a) { return d.has(a) ? std::optional<double>(d.number(a)) : std::nullopt; };
  body.surface = {stated(Attr::Friction), stated(Attr::Restitution), stated(Attr::Rolling)};
  body.damping = d.number(Attr::Damping);
  body.dragArea = d.optionalNumber(Attr::DragArea);
  body.velocity = d.vec3(Attr::Velocity);
  body.angularVelocity = d.vec3(Attr::AngularVelocity) * kDegree;
  body.throwSource = d.choice<ThrowSource>(Attr::Throw);
  body.spin = d.number(Attr::Spin) * kDegree;
  if (d.has(Attr::Nose)) body.nose = d.vec3(Attr::Nose).normalized();
  if (const auto angle = d.optionalNumber(Attr::Sticks)) body.sticks = *angle * kDegree;
  body.stickDepth = d.number(Attr::Depth);
  for (const NodeReference& hook : d.references(Attr::Hook)) body.hooks.push_back(std::string(hook.name));
  return body;
}

void addDynamicsFactories(NodeFactories& factories, const DynamicsVariation& variation,
                          const AssetRoots* roots) {
  const auto set = [&](NodeKind kind, NodeFactory make) {
    factories[static_cast<std::size_t>(kind)] = std::move(make);
  };
  const auto shapes = std::make_shared<ShapeStore>();
  set(NodeKind::ForceLinear, makeLinear), set(NodeKind::ForceSpherical, makeSpherical);
  set(NodeKind::ForcePoint, makePoint), set(NodeKind::ForceVortex, makeVortex);
  set(NodeKind::Medium, makeMedium);
  set(NodeKind::DynObject, [shapes, variation, roots](const NodeRequest& r) {
    return makeDynObject(r, *shapes, variation, roots);
  });
  set(NodeKind::Collision, [shapes](const NodeRequest& r) {
    return std::make_unique<CollisionNode>(NodeKind::Collision, r.self, r.name, collisionOf(r, *shapes),
                                           shapes);
  });
  set(NodeKind::Dynamics, [shapes, fineness = variation.fineness](const NodeRequest& r) {
    CollisionAttributes attributes = collisionOf(r, *shapes);
    attributes.fineness = fineness;
    return std::make_unique<DynamicsNode>(r.self, r.name, std::move(attributes), shapes);
  });
}

}  // namespace stadion
