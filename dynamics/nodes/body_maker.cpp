#include "dynamics/nodes/body_maker.h"

#include "dynamics/nodes/dyn_object_node.h"
#include "dynamics/nodes/flight_factory.h"
#include "dynamics/nodes/shape_store.h"
#include "engine/maths/angles.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <memory>

namespace stadion {
namespace {

constexpr double kWaterDensity = 1000;  // [kg/m3]
constexpr double kAirDensity = 1.225;   // [kg/m3] at sea level, 15 degrees C

void warnIfLighterThanAir(const NodeRequest& r, const MassProperties& mass, double volume) {
  if (mass.mass >= kAirDensity * volume) return;
  const Attr attr = r.declaration.has("mass") ? Attr("mass") : Attr("density");
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
  if (!d.has("centre") || r.mesh->standIn) return true;
  constexpr double kRounding = 1e-6;
  const Aabb& box = r.mesh->bounds;
  const Vec3 c = d.vec3("centre"), room = Vec3::Constant(kRounding * (box.hi - box.lo).norm());
  if (((box.lo - room - c).array() <= 0).all() && ((c - box.hi - room).array() <= 0).all()) return true;
  r.findings.error(d.where("centre"),
                   fmt::format("the centre of mass lies outside of the model, which reaches from "
                               "\"{:.4g}, {:.4g}, {:.4g}\" to \"{:.4g}, {:.4g}, {:.4g}\" m",
                               box.lo.x(), box.lo.y(), box.lo.z(), box.hi.x(), box.hi.y(), box.hi.z()),
                   d.excerpt("centre"));
  return false;
}

/// What has next to no inertia turns too fast for contact to be followed.
bool inertiaIsEnough(const NodeRequest& r, const MassProperties& mass, const MassProperties& even) {
  constexpr double kLeast = 0.01;
  const Declaration& d = r.declaration;
  const Vec3 least = kLeast * mass.mass / even.mass * even.inertia;
  if (!d.has("inertia") || (mass.inertia.array() >= least.array()).all()) return true;
  Vec3 named = least;
  std::sort(named.begin(), named.end());
  r.findings.error(
      d.where("inertia"),
      fmt::format("the moments must be at least \"{:.3g}, {:.3g}, {:.3g}\" kg*m2, a hundredth of what "
                  "{:.4g} kg have that fill the model evenly",
                  named.x(), named.y(), named.z(), mass.mass),
      d.excerpt("inertia"));
  return false;
}

/// Half the sum of the moments is that of the matter about the centre, which none of it is farther from than
/// the model's farthest point.
void warnOfImpossibleInertia(const NodeRequest& r, const MassProperties& mass) {
  const Declaration& d = r.declaration;
  if (!d.has("inertia")) return;
  const Vec3 scale = scaleOf(r.place.X_PN);
  double farthest = 0;
  for (const auto& p : r.mesh->positions)
    farthest = std::max(farthest, (Vec3(p[0], p[1], p[2]).cwiseProduct(scale) - mass.centre).squaredNorm());
  if (0.5 * mass.inertia.sum() <= 1.0001 * mass.mass * farthest) return;
  r.findings.warning(d.where("inertia"),
                     fmt::format("no body of {:.4g} kg within {:.4g} m of its centre of mass has so much "
                                 "inertia; the greatest sum of the three moments is {:.4g} kg*m2",
                                 mass.mass, std::sqrt(farthest), 2 * mass.mass * farthest),
                     d.excerpt("inertia"));
}

}  // namespace

BodyAttributes bodyAttributesOf(const Declaration& d) {
  BodyAttributes body;
  body.density = d.number("density") * kWaterDensity;
  body.mass = d.optionalNumber("mass");
  if (d.has("centre")) body.centre = d.vec3("centre");
  if (d.has("inertia")) body.inertia = d.vec3("inertia");
  // Only what the script states counts for a pair: a standard value must not outvote the other side.
  const auto stated = [&](Attr a) { return d.has(a) ? std::optional<double>(d.number(a)) : std::nullopt; };
  body.surface = {stated("friction"), stated("restitution"), stated("rolling")};
  body.damping = d.number("damping");
  body.dragArea = d.optionalNumber("dragarea");
  body.velocity = d.vec3("velocity");
  body.angularVelocity = d.vec3("angularvelocity") * kDegree;
  body.throwSource = d.choice<ThrowSource>("throw");
  body.spin = d.number("spin") * kDegree;
  if (d.has("nose")) body.nose = d.vec3("nose").normalized();
  if (const auto angle = d.optionalNumber("sticks")) body.sticks = *angle * kDegree;
  body.tipDepth = d.number("depth");
  for (const NodeReference& hook : d.references("hook")) body.hooks.push_back(std::string(hook.name));
  return body;
}

std::unique_ptr<Node> makeDynObject(const NodeRequest& r) {
  const DynamicsServices& services = r.services.get<DynamicsServices>();
  const Declaration& d = r.declaration;
  const auto fail = [&](const std::string& why) -> std::unique_ptr<Node> {
    const std::string model = "\"" + std::string(d.text("file")) + "\" ";
    r.findings.error(d.where("file"), model + why, d.excerpt("file"));
    return nullptr;
  };
  BodyAttributes body = bodyAttributesOf(d);
  Appearance appearance = r.appearance;
  if (services.variation.body) services.variation.body(r.self, appearance, body);
  auto fit = services.shapes->fit(*r.mesh, appearance, scaleOf(r.place.X_PN));
  if (!fit) return fail(fit.error().message);
  const FittedShape& fitted = *fit.value();
  if (!fitted.filled) return fail(fitted.filled.error().message);

  if (!centreIsInside(r)) return nullptr;
  const MassProperties mass = body.massOf(fitted);
  if (!mass.valid()) return fail("is too small or too large for a body");
  if (!inertiaIsEnough(r, mass, fitted.filled.value())) return nullptr;
  auto flight = flightOf(r, mass, services.roots);
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

DynamicsServices::DynamicsServices() : shapes(std::make_shared<ShapeStore>()) {}

DynamicsServices::DynamicsServices(DynamicsVariation varied, const AssetRoots* assetRoots)
    : shapes(std::make_shared<ShapeStore>()), variation(std::move(varied)), roots(assetRoots) {}

}  // namespace stadion
