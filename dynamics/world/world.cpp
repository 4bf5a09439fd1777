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
bool usable(const std::optional<Stick>& s) {
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
  const Sphere bound = boundingSphere(*shape);
  if (!bound.centre.allFinite() || !(bound.radius > 0)) return 0;
  const ShapeId id = core_->nextShape++;
  Core::ShapeEntry& entry = core_->shapes.add(id);
  entry.shape = std::move(shape), entry.bound = bound;
  return id;
}

bool World::removeShape(ShapeId id) {
  const Core::ShapeEntry* s = core_->shapes.find(id);
  if (!s || s->uses > 0) return false;
  core_->shapes.erase(id);
  return true;
}

const Shape* World::shape(ShapeId id) const {
  const Core::ShapeEntry* s = core_->shapes.find(id);
  return s ? s->shape.get() : nullptr;
}

BodyId World::addBody(const BodyDef& d) {
  Core::ShapeEntry* s = core_->shapes.find(d.shape);
  if (!s || std::holds_alternative<PlaneShape>(*s->shape) || !d.mass.valid() || !usable(d.pose) ||
      !usable(d.surface) || !d.v.allFinite() || !d.omega.allFinite() || !(d.damping >= 0) ||
      !std::isfinite(d.damping) || !(d.releaseDistance >= 0) || !usable(d.stick))
    return 0;
  ++s->uses;
  const BodyId id = core_->nextBody++;
  RigidBody& b = core_->bodies.add(id);
  b.id = id, b.shapeId = d.shape, b.shape = s->shape.get(), b.bound = s->bound;
  b.surface = d.surface, b.mass = d.mass.mass, b.inverseMass = 1 / d.mass.mass, b.inertia = d.mass.inertia;
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
  b.centred = b.isBall() && b.eccentricity() <= 1e-9 * b.radius();
  b.damping = d.damping, b.dragArea = d.dragArea, b.releaseDistance = d.releaseDistance;
  b.stick = d.stick;
  core_->jerking = core_->jerking || (d.flight && d.flight->jerks());
  if (d.flight) b.flight = d.flight, b.q_CA = (b.X_NC.q.conjugate() * d.flight->q_NA).normalized();
  b.pose = unit(d.pose);
  const Pose X_WC = b.pose * b.X_NC;
  const Quat& q = X_WC.q;
  const Vec3 L = q * b.inertia.cwiseProduct(q.conjugate() * d.omega);
  core_->startFlight(b, core_->time_.now(), X_WC.p, d.v, q, L);
  return id;
}

bool World::removeBody(BodyId id) {
  RigidBody* b = core_->body(id);
  if (!b) return false;
  enableBody(id, false);
  --core_->shapes.find(b->shapeId)->uses;
  core_->memory.forget({true, id});
  std::erase_if(core_->commands, [&](const Core::Command& c) { return c.body == id; });
  std::erase_if(core_->ignored, [&](const auto& p) {
    return p.first == Party{true, id} || p.second == Party{true, id};
  });
  core_->leaners.erase(core_->leaners.lower_bound({{true, id}, 0}),
                       core_->leaners.lower_bound({{true, id + 1}, 0}));
  core_->forgetBody(*b);
  core_->bodies.erase(id);
  return true;
}

ColliderId World::addCollider(const ColliderDef& d) {
  Core::ShapeEntry* s = core_->shapes.find(d.shape);
  if (!s || !usable(d.pose) || !usable(d.surface)) return 0;
  ++s->uses;
  const ColliderId id = core_->nextCollider++;
  Collider& c = core_->colliders.add(id);
  c.id = id, c.shapeId = d.shape, c.shape = s->shape.get(), c.bound = s->bound, c.surface = d.surface;
  c.now = unit(d.pose);
  c.move(c.now, c.now, core_->time_.now(), 0);
  core_->told.push_back(id);
  return id;
}

bool World::removeCollider(ColliderId id) {
  Collider* c = core_->collider(id);
  if (!c) return false;
  enableCollider(id, false);
  --core_->shapes.find(c->shapeId)->uses;
  core_->memory.forget({false, id});
  std::erase_if(core_->ignored, [&](const auto& p) {
    return p.first == Party{false, id} || p.second == Party{false, id};
  });
  core_->nearColliders.remove(*c);
  core_->colliders.erase(id);
  return true;
}

bool World::moveCollider(ColliderId id, const Pose& end, bool teleport) {
  Collider* c = core_->collider(id);
  if (!c || !usable(end)) return false;
  c->nextWay.clear();
  if (teleport) {
    c->now = unit(end), c->next.reset();
    c->disturbed = true;
    core_->forgetSlack({false, id});
  } else {
    c->next = unit(end);
  }
  core_->told.push_back(id);
  return true;
}

bool World::moveCollider(ColliderId id, const Pose& end, const BodyWay& way) {
  if (!moveCollider(id, end)) return false;
  core_->collider(id)->nextWay = way;
  return true;
}

bool World::enableCollider(ColliderId id, bool on) {
  Collider* c = core_->collider(id);
  if (!c) return false;
  if (c->enabled == on) return true;
  c->enabled = on, c->fresh = on;
  ++c->version;
  core_->told.push_back(id);
  if (!on) {
    core_->nearColliders.remove(*c);
    core_->wakeOnto({false, id}, core_->time_.now());
    core_->memory.forget({false, id});
  }
  return true;
}

bool World::enableBody(BodyId id, bool on) {
  RigidBody* b = core_->body(id);
  if (!b) return false;
  if (b->enabled == on) return true;
  if (on) {
    b->enabled = b->fresh = true;
    const Pose X_WC = b->pose * b->X_NC;
    core_->startFlight(*b, core_->time_.now(), X_WC.p, Vec3::Zero(), X_WC.q, Vec3::Zero());
    return true;
  }
  b->enabled = false;
  core_->nearBodies.remove(*b);
  core_->freeze(*b, core_->time_.now());
  b->support.on = {};
  b->touching.clear();
  core_->wakeOnto({true, id}, core_->time_.now());
  core_->memory.forget({true, id});
  return true;
}

bool World::ignorePair(Party a, Party b, bool on) {
  const auto key = a < b ? std::pair(a, b) : std::pair(b, a);
  if (on) {
    core_->ignored.insert(key);
    core_->wakeOnto(a, core_->time_.now()), core_->wakeOnto(b, core_->time_.now());
  } else {
    core_->ignored.erase(key);
  }
  return true;
}

void World::setBodiesCollide(bool on) {
  core_->bodiesCollide = on;
}

FieldId World::addField(const ForceField& field, bool on) {
  if (!usable(field.start) || !usable(field.end) || field.duration < 0) return 0;
  const FieldId id = core_->nextField++;
  Core::FieldEntry& f = core_->fields.add(id);
  f.id = id, f.field = field, f.changed = true;
  if (on) switchField(id, true, core_->time_.t1());
  return id;
}

bool World::removeField(FieldId id) {
  if (!core_->fields.find(id)) return false;
  for (const RigidBody& body : core_->bodies)
    if (hooked(body.id, id)) unhook(body.id, id, core_->time_.t1());
  switchField(id, false, core_->time_.t1());
  // Due at once; without a frame in between nobody may keep feeling it.
  std::vector<Core::Command> due;
  for (const Core::Command& c : core_->commands)
    if (c.field == id && c.when <= core_->time_.t1()) due.push_back(c);
  std::erase_if(core_->commands, [&](const Core::Command& c) { return c.field == id; });
  for (const Core::Command& c : due)
    if (c.kind == Core::Command::Kind::Unhook || !c.on) core_->execute(c, core_->time_.now());
  core_->restartStirred(core_->time_.now());
  core_->fields.erase(id);
  return true;
}

bool World::moveField(FieldId id, const Pose& start, const Pose& end) {
  Core::FieldEntry* entry = core_->fields.find(id);
  if (!entry || !usable(start) || !usable(end)) return false;
  ForceField& f = entry->field;
  const bool was = f.moving();
  const bool same = f.end.p == start.p && f.end.q.coeffs() == start.q.coeffs();
  f.start = unit(start), f.end = unit(end);
  if (was || !same || f.moving()) entry->changed = true;
  return true;
}

bool World::setFieldStrength(FieldId id, double start, double end) {
  Core::FieldEntry* entry = core_->fields.find(id);
  if (!entry || !std::isfinite(start) || !std::isfinite(end)) return false;
  ForceField& f = entry->field;
  entry->changed = entry->changed || f.first != f.last || f.last != start || start != end;
  f.first = start, f.last = end;
  return true;
}

bool World::setFieldLaw(FieldId id, const FieldLaw& law) {
  Core::FieldEntry* f = core_->fields.find(id);
  if (!f) return false;
  f->changed = f->changed || f->field.law != law;
  f->field.law = law;
  return true;
}

bool World::switchField(FieldId id, bool on, Nanoseconds when) {
  if (!core_->fields.find(id)) return false;
  core_->insert({when, 0, Core::Command::Kind::Switch, id, 0, on, 0});
  return true;
}

bool World::fieldOn(FieldId id) const {
  const Core::FieldEntry* f = core_->fields.find(id);
  return f && f->on;
}

bool World::hook(BodyId body, FieldId field, Nanoseconds when) {
  if (!core_->body(body) || !core_->fields.find(field)) return false;
  core_->insert({when, 0, Core::Command::Kind::Hook, field, body, true, 0});
  return true;
}

bool World::unhook(BodyId body, FieldId field, Nanoseconds when) {
  if (!core_->body(body) || !core_->fields.find(field)) return false;
  core_->insert({when, 0, Core::Command::Kind::Unhook, field, body, false, 0});
  return true;
}

bool World::hooked(BodyId id, FieldId field) const {
  const RigidBody* b = core_->body(id);
  return b && std::any_of(b->hooks.begin(), b->hooks.end(), [&](const Hook& h) { return h.field == field; });
}

bool World::placeBody(BodyId id, const Pose& X_WN, const Vec3& v, const Vec3& omega) {
  RigidBody* b = core_->body(id);
  if (!b) return false;
  b->put = true;
  const bool placed = core_->putBody(*b, X_WN, v, omega);
  b->put = false;
  return placed;
}

bool World::Core::putBody(RigidBody& b, const Pose& X_WN, const Vec3& v, const Vec3& omega) {
  if (!usable(X_WN) || !v.allFinite() || !omega.allFinite()) return false;
  b.pose = unit(X_WN);
  b.trouble.clear();
  b.fresh = true;
  b.touching.clear(), b.waysOut.clear();
  const Pose X_WC = b.pose * b.X_NC;
  memory.forget({true, b.id});
  startFlight(b, time_.now(), X_WC.p, v, X_WC.q, X_WC.q * b.inertia.cwiseProduct(X_WC.q.conjugate() * omega));
  // One that is in trouble again at once is told of, too.
  if (b.mode == BodyMode::Quarantined && !b.active) b.active = true, active.push_back(&b);
  wakeOnto({true, b.id}, time_.now());
  return true;
}

bool World::push(BodyId id, const Vec3& impulse, const Vec3& at) {
  RigidBody* b = core_->body(id);
  if (!b || !impulse.allFinite() || !at.allFinite() || !b->movable()) return false;
  Mobile m = mobileOf(*b, core_->time_.now());
  m.apply(impulse, at);
  core_->afterImpulse(*b, m, core_->time_.now(), false);
  return true;
}

bool World::holdBody(BodyId id) {
  RigidBody* b = core_->body(id);
  if (!b || b->mode == BodyMode::Quarantined) return false;
  core_->freeze(*b, core_->time_.now());
  b->support.on = {};
  b->touching.clear(), b->waysOut.clear();
  core_->wakeOnto({true, id}, core_->time_.now());
  b->mode = BodyMode::Held;
  b->freePlace = b->pose * b->bound.centre;
  if (std::ranges::find(core_->held, b) == core_->held.end()) core_->held.push_back(b);
  b->held.way.clear(), b->nextWay.clear();
  b->held.set(b->pose, b->pose, core_->time_.now(), 0);
  b->carried.clear();
  b->wound.setZero();
  return true;
}

bool World::carryFields(BodyId id, std::vector<FieldId> fields) {
  RigidBody* b = core_->body(id);
  if (!b || b->mode != BodyMode::Held) return false;
  if (b->carried.empty()) b->woundTo = core_->time_.instantAt(core_->time_.now());
  b->carried = std::move(fields);
  return true;
}

Vec3 World::woundUp(BodyId id) const {
  const RigidBody* b = core_->body(id);
  return b && b->mode == BodyMode::Held ? Vec3(b->pose.q * b->wound) : Vec3::Zero();
}

bool World::moveHeld(BodyId id, const Pose& end, bool teleport) {
  RigidBody* b = core_->body(id);
  if (!b || b->mode != BodyMode::Held || !usable(end)) return false;
  b->nextWay.clear();
  if (teleport) {
    b->put = b->traced || b->awaited;
    b->pose = unit(end);
    core_->forgetSlack({true, id});
    b->held.set(b->pose, b->pose, core_->time_.now(), 0);
    b->freePlace = b->pose * b->bound.centre;
    b->fresh = true;
    core_->wakeOnto({true, id}, core_->time_.now());
  }
  b->held.start = b->pose;
  b->held.end = unit(end);
  ++b->version;
  return true;
}

bool World::moveHeld(BodyId id, const Pose& end, const BodyWay& way) {
  if (!moveHeld(id, end)) return false;
  core_->body(id)->nextWay = way;
  return true;
}

bool World::releaseBody(BodyId id, const Vec3& v, const Vec3& omega) {
  RigidBody* b = core_->body(id);
  if (!b || b->mode != BodyMode::Held || !core_->putBody(*b, b->pose, v, omega)) return false;
  b->letGo = true;
  return true;
}

bool World::advance(Nanoseconds t0, Nanoseconds t1, bool continues) {
  if (t1 < t0 || (core_->time_.started() && t0 != core_->time_.t1())) return false;
  if (!core_->time_.started()) core_->start(t0);
  core_->advance(t0, t1, continues);
  return true;
}

bool World::pause(Nanoseconds t0, Nanoseconds t1, bool continues) {
  if (t1 < t0 || (core_->time_.started() && t0 != core_->time_.t1())) return false;
  if (!core_->time_.started()) core_->start(t0);
  core_->pause(t1, continues);
  return true;
}

bool World::traceBody(BodyId id, bool on) {
  RigidBody* b = core_->body(id);
  if (!b) return false;
  if (b->traced != on) core_->trace(*b, on, b->awaited, core_->time_.now());
  return true;
}

const BodyWay& World::wayOf(BodyId id) const {
  static const BodyWay none;
  const RigidBody* b = core_->body(id);
  return b && b->traced ? b->trace : none;
}

const std::vector<BodyId>& World::changed() const {
  return core_->changed;
}

Pose World::pose(BodyId id) const {
  const RigidBody* b = core_->body(id);
  return b ? b->pose : Pose{};
}

Pose World::poseAhead(BodyId id, Nanoseconds when) const {
  const RigidBody* b = core_->body(id);
  if (!b) return {};
  if (b->mode == BodyMode::Held) return b->held.end;
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
  const RigidBody* b = core_->body(id);
  if (!b) return s;
  const double age = Instant{core_->time_.t1(), 0}.since(b->since);
  s.pose = b->pose, s.mode = b->mode, s.clock = b->since.ns, s.clockRest = b->since.rest;
  s.flight = flightClassOf(b->path), s.arcs = b->version;
  const Pose X_WC = b->pose * b->X_NC;
  if (b->mode == BodyMode::Held) {
    s.p = X_WC.p, s.q = X_WC.q, s.v = b->held.v, s.omega = b->held.omega;
    return s;
  }
  s.p = b->path.position(age), s.v = b->path.velocity(age), s.q = b->spin.orientation(age - b->spinStart);
  const double tau = age - b->age0;
  s.omega = b->turning(tau), s.L = b->momentum(tau);
  return s;
}

void World::setFineness(std::uint32_t parts) {
  core_->grid_.refine(parts);
}

BodyMode World::mode(BodyId id) const {
  const RigidBody* b = core_->body(id);
  return b ? b->mode : BodyMode::Rest;
}

bool World::moving(BodyId id) const {
  const BodyMode m = mode(id);
  return !standsStill(m);
}

std::string World::troubleOf(BodyId id) const {
  const RigidBody* b = core_->body(id);
  return b ? b->trouble : std::string();
}

double World::mass(BodyId id) const {
  const RigidBody* b = core_->body(id);
  return b ? b->mass : 0;
}

double World::kineticEnergy(BodyId id) const {
  const BodyState s = state(id);
  return 0.5 * mass(id) * s.v.squaredNorm() + 0.5 * s.omega.dot(s.L);
}

const std::vector<ContactEvent>& World::events() const {
  return core_->memory.events();
}

std::uint64_t World::pairsDigest() const {
  return core_->memory.digest();
}

std::uint64_t World::waysDigest() const {
  StateHash h;
  for (const RigidBody* b : core_->held)
    if (b->mode == BodyMode::Held) h.add(std::uint64_t{b->id}), h.add(b->freePlace);
  for (const BodyId id : core_->comingOut) {
    const RigidBody* b = core_->body(id);
    for (const WayOut& w : b ? b->waysOut : std::vector<WayOut>{})
      h.add(std::uint64_t{id}), h.add(std::uint64_t{w.of}), h.add(w.normal), h.add(w.side);
  }
  return h.value();
}

double World::separation(Party a, Party b) const {
  const auto sa = core_->side(a), sb = core_->side(b);
  if (!sa || !sb) return std::numeric_limits<double>::infinity();
  return gapBetween(*sa, *sb, core_->time_.now()).distance;
}

const World::Counters& World::counters() const {
  return core_->counters;
}

}  // namespace stadion
