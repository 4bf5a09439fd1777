#include "dynamics/world/world.h"

#include "dynamics/world/world_core.h"
#include "engine/core/state_hash.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

bool usable(const std::optional<double>& x, double most) {
  return !x || (*x >= 0 && *x <= most);
}
bool usable(const Surface& s) {
  return usable(s.friction, 1e6) && usable(s.restitution, 1) && usable(s.rolling, 1e6);
}
bool usable(const std::optional<TipEmbedding>& s) {
  return !s || (std::fabs(s->nose.norm() - 1) < 1e-6 && std::isfinite(s->tip) && std::isfinite(s->reach) &&
                std::isfinite(s->cosine) && std::isfinite(s->depth));
}
bool usable(const Pose& X) {
  return X.finite() && std::fabs(X.q.norm() - 1) < 1e-3 && X.p.cwiseAbs().maxCoeff() < 1e12;
}
Pose unit(const Pose& X) {
  return {X.p, X.q.normalized()};
}

}  // namespace

World::World() : core_(std::make_unique<Core>()) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

ShapeId World::addShape(std::shared_ptr<const Shape> shape) {
  return core_->objects_.addShape(std::move(shape));
}

bool World::removeShape(ShapeId id) {
  return core_->objects_.removeShape(id);
}

const Shape* World::shape(ShapeId id) const {
  return core_->objects_.shape(id);
}

BodyId World::addBody(const BodyDef& d) {
  const Shape* shape = core_->objects_.shape(d.shape);
  if (!shape || std::holds_alternative<PlaneShape>(*shape) || !d.mass.valid() || !usable(d.pose) ||
      !usable(d.surface) || !d.v.allFinite() || !d.omega.allFinite() || !(d.damping >= 0) ||
      !std::isfinite(d.damping) || !(d.releaseDistance >= 0) || !usable(d.embedding))
    return 0;
  RigidBody& b = core_->objects_.addBody(d.shape);
  b.surface = d.surface;
  b.mass = d.mass.mass;
  b.inverseMass = 1 / d.mass.mass;
  b.inertia = d.mass.inertia;
  b.X_NC = {d.mass.centre, d.mass.axes.normalized()};
  if (const auto* ball = std::get_if<BallShape>(b.shape);
      ball && (ball->centre - d.mass.centre).norm() <= 1e-6 * ball->radius &&
      b.inertia.maxCoeff() - b.inertia.minCoeff() <= 1e-6 * b.inertia.maxCoeff()) {
    b.X_NC = {ball->centre,
              Quat::Identity()};  // rounding of a mesh integral: the centre of mass is the ball's centre
    b.inertia.setConstant(b.inertia.mean());
  }
  b.X_CN = b.X_NC.inverse();
  b.aligned = b.X_NC.p.isZero(0) && b.X_NC.q.coeffs() == Quat::Identity().coeffs();
  b.centred = b.isBall() && b.eccentricity() <= 1e-9 * b.radius();
  b.reach = (b.bound.centre - b.X_NC.p).norm() + b.bound.radius;
  b.damping = d.damping;
  b.dragArea = d.dragArea;
  b.releaseDistance = d.releaseDistance;
  b.embedding = d.embedding;
  core_->turnsByFrame_ = core_->turnsByFrame_ || (d.flight && d.flight->jerks());
  if (d.flight) {
    b.flight = d.flight;
    b.q_CA = (b.X_NC.q.conjugate() * d.flight->q_NA).normalized();
  }
  b.pose = unit(d.pose);
  const Pose X_WC = b.pose * b.X_NC;
  const Quat& q = X_WC.q;
  const Vec3 L = q * b.inertia.cwiseProduct(q.conjugate() * d.omega);
  core_->arcs_.startFlight(b, core_->time_.partEnd(), X_WC.p, d.v, q, L);
  return b.id;
}

bool World::removeBody(BodyId id) {
  RigidBody* b = core_->objects_.body(id);
  if (!b) return false;
  enableBody(id, false);
  core_->memory_.forget({true, id});
  core_->commands_.forgetBody(id);
  core_->supports_.forgetBody(id);
  core_->forgetBody(*b);
  core_->objects_.remove(*b);
  return true;
}

ColliderId World::addCollider(const ColliderDef& d) {
  if (!core_->objects_.shape(d.shape) || !usable(d.pose) || !usable(d.surface)) return 0;
  Collider& c = core_->objects_.addCollider(d.shape);
  c.surface = d.surface;
  c.now = unit(d.pose);
  c.move(c.now, c.now, core_->time_.partEnd(), 0);
  core_->changes_.mark(c.id);
  return c.id;
}

bool World::removeCollider(ColliderId id) {
  Collider* c = core_->objects_.collider(id);
  if (!c) return false;
  enableCollider(id, false);
  core_->memory_.forget({false, id});
  core_->boxes_.remove(*c);
  core_->objects_.remove(*c);
  return true;
}

bool World::moveCollider(ColliderId id, const Pose& end, bool teleport) {
  Collider* c = core_->objects_.collider(id);
  if (!c || !usable(end)) return false;
  c->nextArcs.clear();
  if (teleport) {
    c->now = unit(end);
    c->next.reset();
    c->disturbed = true;
    core_->releases_.forgetSlack({false, id});
  } else {
    c->next = unit(end);
  }
  core_->changes_.mark(id);
  return true;
}

bool World::moveCollider(ColliderId id, const Pose& end, const ArcTrack& arcs) {
  if (!moveCollider(id, end)) return false;
  core_->objects_.collider(id)->nextArcs = arcs;
  return true;
}

bool World::enableCollider(ColliderId id, bool on) {
  Collider* c = core_->objects_.collider(id);
  if (!c) return false;
  if (c->enabled == on) return true;
  c->enabled = on;
  c->fresh = on;
  ++c->version;
  core_->changes_.mark(id);
  if (!on) {
    core_->boxes_.remove(*c);
    core_->waking_.wakeOnto({false, id}, core_->time_.partEnd());
    core_->memory_.forget({false, id});
  }
  return true;
}

bool World::enableBody(BodyId id, bool on) {
  RigidBody* b = core_->objects_.body(id);
  if (!b) return false;
  if (b->enabled == on) return true;
  if (on) {
    b->enabled = b->fresh = true;
    const Pose X_WC = b->pose * b->X_NC;
    core_->arcs_.startFlight(*b, core_->time_.partEnd(), X_WC.p, Vec3::Zero(), X_WC.q, Vec3::Zero());
    return true;
  }
  b->enabled = false;
  core_->boxes_.remove(*b);
  core_->arcs_.freeze(*b, core_->time_.partEnd());
  b->support.on = {};
  b->contact.touching.clear();
  core_->waking_.wakeOnto({true, id}, core_->time_.partEnd());
  core_->memory_.forget({true, id});
  return true;
}

void World::ignorePair(ContactSide a, ContactSide b, bool on) {
  core_->objects_.ignore(a, b, on);
  if (on) {
    core_->waking_.wakeOnto(a, core_->time_.partEnd());
    core_->waking_.wakeOnto(b, core_->time_.partEnd());
  }
}

void World::setBodiesCollide(bool on) {
  if (core_->objects_.bodiesCollide() == on) return;
  core_->objects_.setBodiesCollide(on);
  if (on) return;
  for (const RigidBody& b : core_->objects_.bodies())
    core_->waking_.wakeOnto({true, b.id}, core_->time_.partEnd());
}

FieldId World::addField(const ForceField& field, bool on) {
  if (!usable(field.start) || !usable(field.end) || field.duration < 0) return 0;
  const FieldId id = core_->fields_.add(field);
  if (on) switchField(id, true, core_->time_.t1());
  return id;
}

bool World::removeField(FieldId id) {
  if (!core_->fields_.find(id)) return false;
  for (const RigidBody& body : core_->objects_.bodies())
    if (isHooked(body, id)) unhook(body.id, id, core_->time_.t1());
  switchField(id, false, core_->time_.t1());
  // Without a frame in between, no body may go on feeling it.
  core_->commands_.finish(id);
  core_->restartStirred(core_->time_.partEnd());
  core_->fields_.erase(id);
  return true;
}

bool World::moveField(FieldId id, const Pose& start, const Pose& end) {
  return usable(start) && usable(end) && core_->fields_.move(id, start, end);
}

bool World::setFieldStrength(FieldId id, double start, double end) {
  return core_->fields_.setStrength(id, start, end);
}

bool World::setFieldLaw(FieldId id, const FieldLaw& law) {
  return core_->fields_.setLaw(id, law);
}

bool World::switchField(FieldId id, bool on, Nanoseconds when) {
  if (!core_->fields_.find(id)) return false;
  core_->commands_.switchField(id, on, when);
  return true;
}

bool World::fieldOn(FieldId id) const {
  const FieldEntry* f = core_->fields_.find(id);
  return f && f->on;
}

bool World::hook(BodyId body, FieldId field, Nanoseconds when) {
  if (!core_->objects_.body(body) || !core_->fields_.find(field)) return false;
  core_->commands_.hook(body, field, when);
  return true;
}

bool World::unhook(BodyId body, FieldId field, Nanoseconds when) {
  if (!core_->objects_.body(body) || !core_->fields_.find(field)) return false;
  core_->commands_.unhook(body, field, when);
  return true;
}

bool World::hooked(BodyId id, FieldId field) const {
  const RigidBody* b = core_->objects_.body(id);
  return b && isHooked(*b, field);
}

bool World::placeBody(BodyId id, const Pose& X_WN, const Vec3& v, const Vec3& omega) {
  RigidBody* b = core_->objects_.body(id);
  if (!b) return false;
  b->trace.put = true;
  const bool placed = core_->putBody(*b, X_WN, v, omega);
  b->trace.put = false;
  return placed;
}

bool World::Core::putBody(RigidBody& b, const Pose& X_WN, const Vec3& v, const Vec3& omega) {
  if (!usable(X_WN) || !v.allFinite() || !omega.allFinite()) return false;
  b.pose = unit(X_WN);
  b.trouble.clear();
  b.fresh = true;
  b.contact.touching.clear();
  b.grip.recoveries.clear();
  const Pose X_WC = b.pose * b.X_NC;
  memory_.forget({true, b.id});
  arcs_.startFlight(b, time_.partEnd(), X_WC.p, v, X_WC.q,
                    X_WC.q * b.inertia.cwiseProduct(X_WC.q.conjugate() * omega));
  // Reports a body that is in trouble again at once, too.
  if (b.mode == BodyMode::Quarantined) active_.add(b);
  waking_.wakeOnto({true, b.id}, time_.partEnd());
  return true;
}

bool World::push(BodyId id, const Vec3& impulse, const Vec3& at) {
  RigidBody* b = core_->objects_.body(id);
  if (!b || !impulse.allFinite() || !at.allFinite() || !b->movable()) return false;
  SolverBody m = solverBodyOf(*b, core_->time_.partEnd());
  m.apply(impulse, at);
  core_->impacts_.afterImpulse(*b, m, core_->time_.partEnd(), false);
  return true;
}

bool World::holdBody(BodyId id) {
  RigidBody* b = core_->objects_.body(id);
  if (!b || b->mode == BodyMode::Quarantined) return false;
  core_->arcs_.freeze(*b, core_->time_.partEnd());
  b->support.on = {};
  b->contact.touching.clear();
  b->grip.recoveries.clear();
  core_->waking_.wakeOnto({true, id}, core_->time_.partEnd());
  core_->held_.add(*b);
  return true;
}

bool World::carryFields(BodyId id, std::vector<FieldId> fields_) {
  RigidBody* b = core_->objects_.body(id);
  if (!b || b->mode != BodyMode::Held) return false;
  core_->held_.carryFields(*b, std::move(fields_));
  return true;
}

Vec3 World::accumulatedVelocity(BodyId id) const {
  const RigidBody* b = core_->objects_.body(id);
  return b && b->mode == BodyMode::Held ? Vec3(b->pose.q * b->grip.accumulated) : Vec3::Zero();
}

bool World::moveHeld(BodyId id, const Pose& end, bool teleport) {
  RigidBody* b = core_->objects_.body(id);
  if (!b || b->mode != BodyMode::Held || !usable(end)) return false;
  b->grip.nextArcs.clear();
  if (teleport) {
    b->trace.put = b->trace.traced || b->trace.awaited;
    b->pose = unit(end);
    core_->releases_.forgetSlack({true, id});
    b->grip.held.set(b->pose, b->pose, core_->time_.partEnd(), 0);
    b->grip.freePlace = b->pose * b->bound.centre;
    b->fresh = true;
    core_->waking_.wakeOnto({true, id}, core_->time_.partEnd());
  }
  b->grip.held.start = b->pose;
  b->grip.held.end = unit(end);
  ++b->version;
  return true;
}

bool World::moveHeld(BodyId id, const Pose& end, const ArcTrack& arcs) {
  if (!moveHeld(id, end)) return false;
  core_->objects_.body(id)->grip.nextArcs = arcs;
  return true;
}

bool World::releaseBody(BodyId id, const Vec3& v, const Vec3& omega) {
  RigidBody* b = core_->objects_.body(id);
  if (!b || b->mode != BodyMode::Held || !core_->putBody(*b, b->pose, v, omega)) return false;
  b->grip.letGo = true;
  return true;
}

bool World::advance(Nanoseconds from, Nanoseconds to, bool continues) {
  if (to < from || (core_->time_.started() && from != core_->time_.t1())) return false;
  if (!core_->time_.started()) core_->start(from);
  core_->advance(from, to, continues);
  return true;
}

bool World::pause(Nanoseconds from, Nanoseconds to, bool continues) {
  if (to < from || (core_->time_.started() && from != core_->time_.t1())) return false;
  if (!core_->time_.started()) core_->start(from);
  core_->pause(to, continues);
  return true;
}

bool World::traceBody(BodyId id, bool on) {
  RigidBody* b = core_->objects_.body(id);
  if (!b) return false;
  if (b->trace.traced != on) core_->traces_.trace(*b, on, b->trace.awaited, core_->time_.partEnd());
  return true;
}

const ArcTrack& World::arcsOf(BodyId id) const {
  static const ArcTrack none;
  const RigidBody* b = core_->objects_.body(id);
  return b && b->trace.traced ? b->trace.arcs : none;
}

const std::vector<BodyId>& World::changed() const {
  return core_->changed_;
}

Pose World::pose(BodyId id) const {
  const RigidBody* b = core_->objects_.body(id);
  return b ? b->pose : Pose{};
}

Pose World::poseAhead(BodyId id, Nanoseconds when) const {
  const RigidBody* b = core_->objects_.body(id);
  if (!b) return {};
  if (b->mode == BodyMode::Held) return b->grip.held.end;
  const double tau = core_->time_.tauOf(when), known = std::min(tau, b->until);
  Pose X = b->poseAt(known);
  X.p += (tau - known) * b->velocity(known);
  return X.finite() ? X : b->pose;
}

namespace {

FlightClass flightClassOf(const Path& path) {
  if (path.kind == Path::Kind::Damped || path.isParabola()) return FlightClass::Exact;
  return path.degree == Path::kMostDegree ? FlightClass::Series : FlightClass::Steps;
}

}  // namespace

BodyState World::state(BodyId id) const {
  BodyState s;
  const RigidBody* b = core_->objects_.body(id);
  if (!b) return s;
  const double age = Instant{core_->time_.t1(), 0}.since(b->since);
  s.pose = b->pose;
  s.mode = b->mode;
  s.clock = b->since.ns;
  s.clockRest = b->since.rest;
  s.flight = flightClassOf(b->path);
  s.arcs = b->version;
  const Pose X_WC = b->pose * b->X_NC;
  if (b->mode == BodyMode::Held) {
    s.p = X_WC.p;
    s.q = X_WC.q;
    s.v = b->grip.held.v;
    s.omega = b->grip.held.omega;
    return s;
  }
  s.p = b->path.position(age);
  s.v = b->path.velocity(age);
  s.q = b->spin.orientation(age - b->spinStart);
  const double tau = age - b->age0;
  s.omega = b->angularVelocity(tau);
  s.L = b->angularMomentum(tau);
  return s;
}

void World::setStepDivider(std::uint32_t parts) {
  core_->grid_.refine(parts);
}

void World::setImpactScheme(const ImpactScheme& scheme) {
  core_->search_.set(scheme);
}

BodyMode World::mode(BodyId id) const {
  const RigidBody* b = core_->objects_.body(id);
  return b ? b->mode : BodyMode::Rest;
}

bool World::awaitsCommands() const {
  return !core_->commands_.empty();
}

bool World::moving(BodyId id) const {
  const BodyMode m = mode(id);
  return !standsStill(m);
}

std::string World::quarantineReason(BodyId id) const {
  const RigidBody* b = core_->objects_.body(id);
  return b ? b->trouble : std::string();
}

double World::mass(BodyId id) const {
  const RigidBody* b = core_->objects_.body(id);
  return b ? b->mass : 0;
}

double World::kineticEnergy(BodyId id) const {
  const BodyState s = state(id);
  return 0.5 * mass(id) * s.v.squaredNorm() + 0.5 * s.omega.dot(s.L);
}

const std::vector<ContactEvent>& World::events() const {
  return core_->memory_.events();
}

std::uint64_t World::pairsDigest() const {
  return core_->memory_.digest();
}

std::uint64_t World::recoveryDigest() const {
  return core_->recoveries_.digest();
}

double World::separation(ContactSide a, ContactSide b) const {
  const auto sa = core_->objects_.side(a), sb = core_->objects_.side(b);
  if (!sa || !sb) return std::numeric_limits<double>::infinity();
  return gapBetween(*sa, *sb, core_->time_.partEnd()).distance;
}

const World::Counters& World::counters() const {
  return core_->counters_;
}

}  // namespace stadion
