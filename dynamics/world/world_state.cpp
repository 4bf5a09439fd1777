// The world's state, field by field (engine/core/state_fields.h). All predicted events are restored, too.
// So the same events follow in the same order.

#include "dynamics/world/world_core.h"
#include "engine/core/state_fields.h"

#include <algorithm>
#include <utility>

namespace stadion {

constexpr Path::Kind lastOf(Path::Kind) {
  return Path::Kind::Damped;
}
constexpr SpinTerms::Kind lastOf(SpinTerms::Kind) {
  return SpinTerms::Kind::Steered;
}
constexpr LinearField::Unit lastOf(LinearField::Unit) {
  return LinearField::Unit::Force;
}
constexpr SphericalField::Falloff lastOf(SphericalField::Falloff) {
  return SphericalField::Falloff::Square;
}
constexpr MediumField::Region lastOf(MediumField::Region) {
  return MediumField::Region::Box;
}

// What the parts consist of.

static void fieldsOf(Aabb& b, StateFields& f) {
  f("low", b.lo), f("high", b.hi);
}
static void fieldsOf(Sphere& s, StateFields& f) {
  f("centre", s.centre), f("radius", s.radius);
}
static void fieldsOf(Instant& i, StateFields& f) {
  f("ns", i.ns), f("rest", i.rest);
}
static void fieldsOf(Surface& s, StateFields& f) {
  f("friction", s.friction), f("restitution", s.restitution), f("rolling", s.rolling);
}
static void fieldsOf(TipEmbedding& s, StateFields& f) {
  f("nose", s.nose), f("tip", s.tip), f("reach", s.reach), f("cosine", s.cosine), f("depth", s.depth);
}
static void fieldsOf(Drag& d, StateFields& f) {
  f("linear", d.linear), f("quadratic", d.quadratic), f("wind", d.wind);
}
static void fieldsOf(EvenPull& e, StateFields& f) {
  f("pull", e.pull), f("drag", e.drag);
}

/// Visits only the coefficients that the degree uses.
static void fieldsOf(Path& p, StateFields& f) {
  f("kind", p.kind), f("degree", p.degree), f("damping", p.damping), f("spare", p.spare);
  if (p.degree < 0 || p.degree > Path::kMostDegree) {
    p.degree = 0;
    return f.fail();
  }
  for (std::size_t i = 0; i <= static_cast<std::size_t>(std::max(2, p.degree)); ++i) f("c", p.c[i]);
}
static void fieldsOf(Spin& s, StateFields& f) {
  f("kind", s.kind), f("axis", s.axis), f("q0", s.q0), f("momentum", s.L), f("omega", s.omega);
  f("alpha", s.alpha), f("inverse inertia", s.inverse), f("horizon", s.horizon);
  const std::size_t terms = s.kind == Spin::Kind::Taylor    ? s.series.size()
                            : s.kind == Spin::Kind::Steered ? Spin::kSteered
                                                            : 0;
  for (std::size_t i = 0; i < terms; ++i) f("series", s.series[i]);
}
static void fieldsOf(GuidedMotion& m, StateFields& f) {
  f("start", m.start), f("end", m.end), f("v", m.v), f("omega", m.omega);
  f("begin", m.begin), f("rate", m.rate), f("moving", m.moving);
}
static void fieldsOf(Support& s, StateFields& f) {
  f("on", s.on), f("triangle", s.triangle), f("point", s.point), f("normal", s.normal), f("edges", s.edges);
  f("edge normals", s.edgeNormal), f("edge offsets", s.edgeOffset);
  f("friction", s.friction), f("rolling", s.rolling), f("restitution", s.restitution);
  if (s.edges < 0 || static_cast<std::size_t>(s.edges) > s.edgeNormal.size()) {
    s.edges = 0;
    f.fail();
  }
}
static void fieldsOf(WarmStart& p, StateFields& f) {
  f("key", p.key), f("force", p.force), f("step", p.step);
}
static void fieldsOf(Hook& h, StateFields& f) {
  f("field", h.field);
}
static void fieldsOf(SleepCandidate& c, StateFields& f) {
  f("v", c.v), f("omega", c.omega), f("since", c.since), f("span", c.span), f("balanced", c.balanced);
}
static void fieldsOf(PenetrationRecovery& w, StateFields& f) {
  f("of", w.of), f("normal", w.normal), f("side", w.side);
}
static void fieldsOf(Gap& g, StateFields& f) {
  f("distance", g.distance), f("point", g.point), f("normal", g.normal), f("face", g.face);
  f("triangle", g.triangle);
}
static void fieldsOf(Touch& t, StateFields& f) {
  f("tau", t.tau), f("gap", t.gap), f("swapped", t.swapped);
}

static void fieldsOf(LinearField& l, StateFields& f) {
  f("push", l.push), f("unit", l.unit);
}
static void fieldsOf(SphericalField& l, StateFields& f) {
  f("strength", l.strength), f("radius", l.radius), f("falloff", l.falloff), f("unit", l.unit);
}
static void fieldsOf(PointField& l, StateFields& f) {
  f("strength", l.strength), f("softening", l.softening), f("unit", l.unit);
}
static void fieldsOf(VortexField& l, StateFields& f) {
  f("strength", l.strength), f("core", l.core), f("inward", l.inward), f("radius", l.radius);
  f("unit", l.unit);
}
static void fieldsOf(MediumField& l, StateFields& f) {
  f("density", l.density), f("viscosity", l.viscosity), f("wind", l.wind), f("region", l.region);
  f("centre", l.centre), f("half", l.half);
}
template <std::size_t... I>
static void makeLaw(FieldLaw& law, std::size_t which, std::index_sequence<I...>) {
  ((which == I ? void(law.emplace<I>()) : void()), ...);
}
static void fieldsOf(ForceField& field, StateFields& f) {
  std::size_t which = field.law.index();
  f("law", which);
  if (which >= std::variant_size_v<FieldLaw>) return f.fail();
  if (f.restores()) makeLaw(field.law, which, std::make_index_sequence<std::variant_size_v<FieldLaw>>());
  std::visit([&](auto& law) { f("law", law); }, field.law);
  f("start", field.start), f("end", field.end), f("duration", field.duration);
  f("first", field.first), f("last", field.last);
}

static void fieldsOf(RigidBody& b, StateFields& f) {
  f("mode", b.mode), f("pose", b.pose);
  f("path", b.path), f("spin", b.spin), f("since", b.since), f("version", b.version);
  f("age", b.age0), f("until", b.until), f("valid", b.validAge), f("path valid", b.pathAge);
  f("spin start", b.spinStart);
  f("enabled", b.enabled), f("fresh", b.fresh), f("active", b.active), f("marked", b.marked);
  f("stirred", b.stirred), f("aligned", b.aligned), f("at most one near", b.atMostOneNear), f("lazy", b.lazy);
  f("shape", b.shapeId), f("surface", b.surface), f("mass", b.mass), f("inverse mass", b.inverseMass);
  f("inertia", b.inertia), f("even pull", b.even), f("X_NC", b.X_NC), f("X_CN", b.X_CN);
  f("centred", b.centred), f("bound", b.bound), f("reach", b.reach), f("damping", b.damping);
  f("drag area", b.dragArea), f("release distance", b.releaseDistance), f("embedding", b.embedding);
  f("q_CA", b.q_CA), f("end momentum", b.contact.endL), f("step", b.step), f("support", b.support);
  f("hooks", b.hooks), f("touching", b.contact.touching), f("leaning", b.contact.leaning),
      f("warm starts", b.contact.warmStarts);
  f("due", b.contact.dueAge), f("in pile", b.contact.inPile), f("wedged", b.contact.wedged),
      f("unsolved", b.contact.unsolved), f("energy credit", b.contact.energyCredit);
  f("sleeps next", b.contact.sleepsNext), f("rests in pile", b.contact.restsInPile),
      f("drift", b.contact.drift), f("twist", b.contact.twist);
  f("slot", b.contact.slot), f("held", b.grip.held), f("carried", b.grip.carried),
      f("accumulated", b.grip.accumulated);
  f("accumulated to", b.grip.accumulatedTo), f("free place", b.grip.freePlace), f("let go", b.grip.letGo),
      f("recoveries", b.grip.recoveries);
  f("impacts", b.impacts), f("impact span", b.impactSpan), f("quiet time", b.contact.quietTime),
      f("sleep candidate", b.contact.sleepCandidate);
  f("trouble", b.trouble), f("swept", b.swept), f("place", b.place), f("near collider", b.nearCollider);
}
static void fieldsOf(Collider& c, StateFields& f) {
  f("shape", c.shapeId), f("surface", c.surface), f("bound", c.bound), f("enabled", c.enabled);
  f("now", c.now), f("next", c.next), f("motion", c.motion), f("plane point", c.planePoint);
  f("plane normal", c.planeNormal), f("disturbed", c.disturbed), f("fresh", c.fresh);
  f("version", c.version), f("swept", c.swept), f("place", c.place);
}

void World::Core::visitState(StateFields& f) {
  time_.state(f);
  objects_.state(f);
  fields_.state(f);
  objects_.stateOfPairs(f);
  recoveries_.state(f);
  f("turns by frame", turnsByFrame_);
  changes_.stateOfMode(f);
  queue_.stateOfOrder(f);
  objects_.stateOfIds(f);
  fields_.stateOfIds(f);
  foresight_.state(f);
  queue_.stateOfTick(f);
  if (f.failed()) return;
  supports_.state(f);
  f("changed", changed_);
  changes_.stateOfColliders(f);
  commands_.state(f);
  queue_.state(f);
  if (f.failed()) return;
  memory_.state(f, [this](ContactSide p) { return objects_.versionPointer(p); });
  const auto findBody = [this](BodyId id) { return objects_.body(id); };
  active_.state(f, findBody);
  commands_.stateOfStirred(f, findBody);
  held_.state(f, findBody);
  changes_.stateOfBodies(f, findBody);
  boxes_.state(f);
}

void World::visitState(StateFields& f) {
  core_->visitState(f);
}

bool World::restoreShape(ShapeId id, std::shared_ptr<const Shape> shape) {
  return core_->objects_.restoreShape(id, std::move(shape));
}

bool World::restoreFlight(BodyId id, std::shared_ptr<const BodyFlight> flight) {
  return core_->objects_.restoreFlight(id, std::move(flight));
}

bool World::complete() const {
  return core_->objects_.complete();
}

}  // namespace stadion
