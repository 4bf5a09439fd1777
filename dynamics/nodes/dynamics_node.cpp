#include "dynamics/nodes/dynamics_node.h"

#include "dynamics/body/body_axes.h"
#include "dynamics/flight/flight_shape.h"
#include "dynamics/motion/body_flight.h"
#include "dynamics/nodes/body_maker.h"
#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/maths/functions.h"
#include "engine/scene/scene.h"
#include "engine/script/declaration_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {
namespace {

/// A field that a body of the same world carries goes straight for so long, on a grid of show time.
constexpr Nanoseconds kCarried = 2'000'000;

DynObjectNode* bodyAt(NodeRef ref, Scene& scene) {
  return dynamic_cast<DynObjectNode*>(scene.find(ref));
}
FieldNode* fieldAt(NodeRef ref, Scene& scene) {
  return dynamic_cast<FieldNode*>(scene.find(ref));
}

}  // namespace

void DynamicsNode::onLeave(Scene& scene) {
  for (const Field& f : fields_) {
    scene.schedule().unwatch(f.placement, self());
    if (FieldNode* node = fieldAt(f.ref, scene)) node->removeUser(self());
  }
  CollisionNode::onLeave(scene);
}

void DynamicsNode::addCollidee(Part& part, ObjectNode& object, Scene& scene) {
  auto* node = dynamic_cast<DynObjectNode*>(&object);
  if (!node) return;  // the checker lets only dynobjects be collidees of a dynamics node
  const BodyAttributes& body = node->body();
  if (!body.simulated) return;
  BodyDef def;
  part.fit = fitOf(object, scene);
  if (!part.fit || !part.fit->filled) part.fit = node->fit();
  part.shape = def.shape = addShape(part.fit);
  def.pose = part.pose;
  def.mass = body.massOf(*part.fit);
  def.surface = body.surface;
  def.damping = body.damping;
  def.dragArea = body.dragArea.value_or(part.fit->dragArea);
  def.releaseDistance = attributes_.releaseDistance;
  const Velocity start = startOf(*node, scene);
  def.v = start.v;
  def.omega = start.omega;
  def.flight = body.flight;
  if (def.flight) def.mass = revolved(def.mass, *def.flight);
  if (const Mesh* model = body.sticks ? scene.instances().mesh(object.appearance().mesh) : nullptr) {
    const Mesh mesh = scaled(*model, part.fit->scale.cast<float>());
    const Vec3 nose = body.nose ? *body.nose : measureShape(mesh, def.mass.centre).q_NA * Vec3::UnitX();
    def.embedding = tipEmbeddingAlong(nose, *body.sticks, body.tipDepth, mesh);
  }
  part.id = world_.addBody(def);
  world_.traceBody(part.id, true);  // nodes that look at it may be visited only after this one
  traced_.push_back(&part);
  for (const NodeRef field : node->hooked())
    if (const FieldId id = fieldFor(field, scene)) world_.hook(part.id, id, 0);  // from its beginning
  node->takeRequests();
  node->setSimulation({self(), part.id, &asking_});
  scene.placements().setAttached(part.placement, true);
  partOf_[part.id] = &part;
  node->setState(world_.state(part.id));
  node->hold(scene, scene.placements().world(part.placement));
}

/// Returns the start velocities from the script, in World.
DynamicsNode::Velocity DynamicsNode::startOf(const DynObjectNode& node, const Scene& scene) const {
  const Placements& placements = scene.placements();
  const Quat q_WP = poseOf(placements.world(placements.parent(node.placement()))).q;
  return {q_WP * node.body().velocity, q_WP * node.body().angularVelocity};
}

void DynamicsNode::removeCollidee(Part& part, Scene& scene) {
  grips_.forget(part.id);
  partOf_.erase(part.id);
  std::erase(traced_, &part);
  world_.removeBody(part.id);
  world_.removeShape(part.shape);
  DynObjectNode* node = bodyAt(part.ref, scene);
  if (!node) return;
  node->setSimulation({});
  scene.placements().setAttached(part.placement, node->isMovedFromOutside());
  node->place(scene, scene.placements().world(part.placement));
}

FieldId DynamicsNode::fieldFor(NodeRef ref, Scene& scene) {
  const auto known =
      std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.ref == ref; });
  if (known != fields_.end()) return known->id;
  FieldNode* node = fieldAt(ref, scene);
  if (!node) return 0;
  Field f;
  f.ref = ref;
  f.placement = node->placement();
  f.pose = scene.poseTracks().startOf(f.placement, scene.placements());
  f.strength = node->strength();
  f.id = world_.addField({node->law(scene), f.pose, f.pose, node->duration()}, false);
  if (node->on()) world_.switchField(f.id, true, node->activated());
  node->addUser(self());
  scene.schedule().watch(f.placement, self());
  fields_.push_back(f);
  return f.id;
}

/// The body that carries the field, if it is one of this node's.
BodyId DynamicsNode::carrierOf(PlacementId field, const Placements& placements) const {
  for (PlacementId id = placements.carrier(field); id != kWorldPlacement && id != kNoPlacement;
       id = placements.carrier(id))
    for (const Part& part : collidees_)
      if (part.ref.valid() && part.placement == id) return part.id;
  return 0;
}

// The fields' own nodes have had their turn: what they say now holds for the end of this frame.
bool DynamicsNode::followFields(FrameContext& frame, std::vector<Nanoseconds>& cuts) {
  bool any = false;
  for (Field& f : fields_) {
    f.track.clear();
    const FieldNode* node = fieldAt(f.ref, frame.scene);
    any = leaves(f, node != nullptr, frame, cuts) || any;
    if (!node) continue;
    world_.setFieldLaw(f.id, node->law(frame.scene));
    any = followTrack(f, frame, cuts) || any;
    followCarrier(f, *node, frame, cuts);
    f.strength = node->strength();
    for (const AxisKnot& k : f.strength) cuts.push_back(k.time);
    f.pose = node->pose(frame.scene);
    any = takeSwitches(f, *node, frame) || any;
  }
  return any;
}

/// Finds the time at which the field leaves the scene. True if that is in this frame.
bool DynamicsNode::leaves(Field& f, bool isThere, const FrameContext& frame, std::vector<Nanoseconds>& cuts) {
  f.leaveAt = isThere ? frame.scene.tree().endOf(f.ref.load) : 0;
  if (f.leaveAt > frame.now.time) return false;
  cuts.push_back(f.leaveAt);
  return true;
}

/// Reads the path of the field in this frame. True if it moves.
bool DynamicsNode::followTrack(Field& f, FrameContext& frame, std::vector<Nanoseconds>& cuts) {
  f.track = frame.scene.poseTracks().within(f.placement, f.pose, frame.start(), frame.now.time,
                                            frame.scene.placements());
  addCuts(f.track, cuts);
  return !f.track.empty();
}

/// Finds the body that carries the field. Where the body goes is only known from part to part of the frame.
void DynamicsNode::followCarrier(Field& f, const FieldNode& node, const FrameContext& frame,
                                 std::vector<Nanoseconds>& cuts) {
  f.carrier = carrierOf(f.placement, frame.scene.placements());
  if (!f.carrier) return;
  f.X_BF = world_.pose(f.carrier).inverse() * node.pose(frame.scene);
  for (Nanoseconds t = frame.start() / kCarried * kCarried; t < frame.now.time; t += kCarried)
    cuts.push_back(t);
}

/// Switches the field as its node was switched in this frame. True if it was.
bool DynamicsNode::takeSwitches(const Field& f, const FieldNode& node, const FrameContext& frame) {
  const std::vector<FieldNode::Change>& changes = node.changes(frame.now.frame);
  for (const FieldNode::Change& c : changes) world_.switchField(f.id, c.on, c.when);
  return !changes.empty();
}

bool DynamicsNode::takeOrders(FrameContext& frame, std::vector<Nanoseconds>& cuts) {
  using Kind = DynObjectNode::Request::Kind;
  orders_.clear();
  bool any = false;
  std::ranges::sort(asking_);
  for (const NodeRef ref : std::exchange(asking_, {})) {
    DynObjectNode* node = bodyAt(ref, frame.scene);
    if (!node) continue;
    for (DynObjectNode::Request& r : node->takeRequests()) {
      any = true;
      if (r.kind == Kind::Hook || r.kind == Kind::Unhook) {  // the world knows their times itself
        if (const FieldId field = fieldFor(r.field, frame.scene))
          r.kind == Kind::Hook ? world_.hook(node->bodyId(), field, r.when)
                               : world_.unhook(node->bodyId(), field, r.when);
        continue;
      }
      cuts.push_back(r.when);
      if (const auto hand = frame.scene.feed().poseTrackOf(r.tracker, frame)) addCuts(*hand, cuts);
      orders_.push_back({ref, std::move(r)});
    }
  }
  std::ranges::stable_sort(orders_, {}, [](const Order& o) { return o.what.when; });
  return any;
}

void DynamicsNode::apply(const Order& order, FrameContext& frame) {
  using Kind = DynObjectNode::Request::Kind;
  DynObjectNode* node = bodyAt(order.body, frame.scene);
  const auto at = node ? partOf_.find(node->bodyId()) : partOf_.end();
  if (at == partOf_.end()) return;  // its file was unloaded
  const Part* part = at->second;
  switch (order.what.kind) {
  case Kind::Reset: {
    grips_.forget(part->id);
    const Velocity start = startOf(*node, frame.scene);
    world_.placeBody(part->id, poseOf(frame.scene.placements().world(part->placement)), start.v, start.omega);
    node->hold(frame.scene, frame.scene.placements().world(part->placement));
    break;
  }
  case Kind::Release: letGo(*part, order.what.when, frame.scene); break;
  case Kind::Grab: grab(*part, order.what.tracker, order.what.when, frame); break;
  default: break;
  }
}

void DynamicsNode::grab(const Part& part, const std::string& tracker, Nanoseconds when, FrameContext& frame) {
  const PoseTrack* hand = frame.scene.feed().poseTrackOf(tracker, frame);
  if (!hand || when < hand->front().time) return;  // it is not known where the hand is
  PoseTrack way = *hand;
  letGo(part, when, frame.scene);
  if (const Grip* grip = grips_.grab(part.id, part.ref, tracker, std::move(way), when))
    carryFields(*grip, frame.scene);
}

/// The world is told which fields the hand carries: those below what follows the same tracker, or below the
/// body that it holds.
void DynamicsNode::carryFields(const Grip& grip, const Scene& scene) {
  std::vector<FieldId> carried;
  const auto moves = [&](NodeRef ref) {
    if (ref == grip.node) return true;
    const LoadedScene* load = scene.tree().load(ref.load);
    const auto* placed = load ? dynamic_cast<const PlacedNode*>(load->nodes[ref.position].get()) : nullptr;
    return placed && placed->follows(grip.tracker);
  };
  for (const Field& f : fields_)
    for (NodeRef at = f.ref; at.valid(); at = scene.tree().parentOf(at))
      if (moves(at)) {
        carried.push_back(f.id);
        break;
      }
  world_.carryFields(grip.body, std::move(carried));
}

void DynamicsNode::letGo(const Part& part, Nanoseconds when, Scene& scene) {
  const BodyId body = part.id;
  const std::optional<Grip> grip = grips_.open(body);
  if (!grip) return;
  // A hand of which nothing has been heard lately is taken to stand still, as its body does.
  const bool silent = grip->hand.way().back().time < when;
  HandMotion::Velocity hand = silent ? HandMotion::Velocity{} : grip->hand.velocity();
  const DynObjectNode* node = bodyAt(part.ref, scene);
  if (node && grip->jumped >= 0 && when - grip->jumped < HandMotion::kWindow)
    scene.warn(*node,
               fmt::format("is let go at {:.3f} s, but \"{}\" jumped at {:.3f} s; only what the hand did "
                           "after that counts for the throw",
                           toSeconds(when), grip->tracker, toSeconds(grip->jumped)));
  const ThrowSource source = node ? node->body().throwSource : ThrowSource::Both;
  if (source == ThrowSource::Field) hand = {};
  const Vec3 arm = world_.state(body).p - grip->hand.now().p;  // to the centre of mass
  Velocity thrown{hand.v + hand.omega.cross(arm), hand.omega};
  if (source != ThrowSource::Hand) thrown.v += world_.accumulatedVelocity(body);
  if (node && node->body().spin != 0 && part.fit)
    thrown.omega += node->body().spin * (world_.pose(body).q * symmetryAxis(node->body().massOf(*part.fit)));
  world_.releaseBody(body, thrown.v, thrown.omega);
}

bool DynamicsNode::prepare(FrameContext& frame, std::vector<Nanoseconds>& cuts) {
  const bool asked = takeOrders(frame, cuts);
  const bool fields = followFields(frame, cuts);
  grips_.follow(frame, cuts);
  for (const Grip& grip : grips_.all()) carryFields(grip, frame.scene);
  traced_.clear();
  for (Part& part : collidees_) {
    if (part.id == 0) continue;
    const bool watched = frame.scene.placements().watchedBelow(part.placement);
    world_.traceBody(part.id, watched);
    if (watched) traced_.push_back(&part);
  }
  return asked || fields || !grips_.empty();
}

bool DynamicsNode::needsScene(Nanoseconds end) const {
  return CollisionNode::needsScene(end) || !orders_.empty() ||
         std::ranges::any_of(fields_, [&](const Field& f) { return f.leaveAt <= end; });
}

/// Its own bodies only move as it says; it looks at colliders and fields.
bool DynamicsNode::looksAt(const Node& mover, const Scene& scene) const {
  const auto moved = [&](NodeRef node) { return node.valid() && isMovedBy(mover, node, scene); };
  return std::ranges::any_of(colliders_, moved, &Part::ref) ||
         std::ranges::any_of(fields_, moved, &Field::ref);
}

void DynamicsNode::addMovers(const Scene& scene, std::vector<NodeRef>& movers) const {
  CollisionNode::addMovers(scene, movers);
  for (const Field& f : fields_) addMover(f.ref, scene, movers);
}

void DynamicsNode::act(Nanoseconds time, FrameContext* frame) {
  grips_.jump(time);
  if (!frame) return;
  std::erase_if(fields_, [&](const Field& f) {
    if (f.leaveAt > time) return false;
    world_.removeField(f.id);
    frame->scene.schedule().unwatch(f.placement, self());
    return true;
  });
  const auto later = std::ranges::upper_bound(orders_, time, {}, [](const Order& o) { return o.what.when; });
  const std::vector<Order> due(orders_.begin(), later);
  orders_.erase(orders_.begin(), later);
  for (const Order& order : due) apply(order, *frame);
}

void DynamicsNode::move(Nanoseconds from, Nanoseconds to, bool jump) {
  grips_.move(from, to, jump);
  for (const Field& f : fields_) {
    if (!f.strength.empty())
      world_.setFieldStrength(f.id, axisOn(f.strength, jump ? to : from, jump ? Limit::Before : Limit::After),
                              axisOn(f.strength, to, Limit::Before));
    if (f.carrier)
      world_.moveField(f.id, world_.pose(f.carrier) * f.X_BF, world_.poseAhead(f.carrier, to) * f.X_BF);
    else if (f.track.empty())
      world_.moveField(f.id, f.pose, f.pose);
    else
      world_.moveField(f.id, poseOn(f.track, jump ? to : from, jump ? Limit::Before : Limit::After),
                       poseOn(f.track, to, Limit::Before));
  }
}

void DynamicsNode::hash(StateHash& h) const {
  CollisionNode::hash(h);
  grips_.hash(h);
  h.add(world_.recoveryDigest());
}

void DynamicsNode::state(StateFields& f) {
  CollisionNode::state(f);
  grips_.state(f);
  f("fields", fields_), f("asking", asking_), f("told of limit", toldOfLimit_);
}

SharedFit DynamicsNode::refit(const Part& part, const ObjectNode& object, const Scene& scene) {
  SharedFit fit = CollisionNode::refit(part, object, scene);
  const auto* node = dynamic_cast<const DynObjectNode*>(&object);
  return node && part.id && (!fit || !fit->filled) ? node->fit() : fit;
}

bool DynamicsNode::resume(Scene& scene) {
  if (!resumeParts(scene)) return false;
  // The field's file may have been unloaded; if it is loaded, the field exists.
  const auto isThere = [&](NodeRef ref) {
    const LoadedScene* load = scene.tree().load(ref.load);
    return !load || ref.position < load->nodes.size();
  };
  if (!std::ranges::all_of(fields_, isThere, &Field::ref)) return false;
  partOf_.clear();
  for (Part& part : collidees_) {
    DynObjectNode* node = part.id ? bodyAt(part.ref, scene) : nullptr;
    if (!node) continue;
    node->setSimulation({self(), part.id, &asking_});
    partOf_[part.id] = &part;
    if (node->body().flight && !world_.restoreFlight(part.id, node->body().flight)) return false;
  }
  return world_.complete();
}

/// Reports a body that has been taken out of the simulation in this frame.
void DynamicsNode::tellTrouble(const BodyState& before, DynObjectNode& node, FrameContext& frame) {
  const BodyState& now = node.state();
  const auto out = [](const BodyState& s) { return s.mode == BodyMode::Quarantined; };
  if (!out(now) || (out(before) && before.clock == now.clock)) return;
  frame.scene.warn(
      node, fmt::format("is out of the simulation from {:.3f} s on: {}; it stands still until its reset",
                        toSeconds(now.clock), world_.quarantineReason(node.bodyId())));
  node.raiseNow("onquarantine", now.clock, frame);
}

void DynamicsNode::tellCounts(FrameProbe& probe) const {
  const World::Counters& c = world_.counters();
  probe.counted(Count::Impacts, c.impacts, self());
  probe.counted(Count::Contacts, c.contacts, self());
  probe.counted(Count::Substeps, c.arcs + c.contactSteps, self());
}

/// Others see how the body has moved in this frame.
void DynamicsNode::publishWay(const Part& part, FrameContext& frame) {
  const ArcTrack& way = world_.arcsOf(part.id);
  DynObjectNode* node = bodyAt(part.ref, frame.scene);
  if (!node || way.empty() || (way.size() == 1 && way.front().stands())) return;
  node->setArcs(frame.now.frame, way);
  // A node that runs in some frames only knows more than those that look at this frame.
  if (frame.start() < frame.scene.frameStart()) return;
  const Pose begins = poseOn(way, frame.start(), Limit::Before);
  const PoseKnot first{frame.start(), part.pose, false};
  PoseTrack& track = frame.scene.poseTracks().of(part.placement, first);
  track.assign(1, first);
  const bool put = (begins.p - part.pose.p).norm() > 1e-9 * (1 + begins.p.norm()) ||
                   std::fabs(begins.q.dot(part.pose.q)) < 1 - 1e-12;
  if (put) track.push_back({frame.start(), begins, true});
  addChords(way, frame.now.time, track);
}

bool DynamicsNode::afterStep(FrameContext& frame) {
  bool any = false;
  for (const Part* part : traced_) publishWay(*part, frame);
  if (frame.probe) tellCounts(*frame.probe);
  if (world_.counters().limited > 0 && !std::exchange(toldOfLimit_, true))
    frame.scene.warn(*this, fmt::format("cut the frame at {:.3f} s short: its contacts came without end",
                                        toSeconds(frame.now.time)));
  for (const BodyId id : world_.changed()) {
    const auto at = partOf_.find(id);
    DynObjectNode* node = at == partOf_.end() ? nullptr : bodyAt(at->second->ref, frame.scene);
    if (!node) continue;
    Part& part = *at->second;
    const BodyState state = world_.state(id);
    any |= world_.moving(id);
    const bool same = state.pose.p == part.pose.p && state.pose.q.coeffs() == part.pose.q.coeffs();
    part.pose = state.pose;
    const BodyState before = node->state();
    node->setState(state);
    tellTrouble(before, *node, frame);
    // Its end is rounded up: what sticks has touched before, be it by less than a nanosecond.
    if (standsStill(state.mode) && (!standsStill(before.mode) || state.clock != before.clock))
      frame.scene.impacts().note(
          {node->self(), {}, state.p, state.clock + (state.clockRest > 0 ? 1 : 0), true});
    if (same)
      frame.scene.markChanged(*node);
    else
      node->hold(frame.scene, withScale(state.pose, frame.scene.placements().world(part.placement)));
  }
  return any || !grips_.empty();
}

namespace {

constexpr std::string_view kImpacts[] = {"exact", "paper"};

ImpactScheme impactsOf(const Declaration& d) {
  return {d.choice<ImpactScheme::Kind>("impact"), d.number("impacttolerance"), 1 / d.number("impactrate")};
}

/// What only the paper's scheme has a use for.
void checkImpacts(DeclarationCheck& check) {
  const Declaration& d = check.declaration();
  if (d.choice<ImpactScheme::Kind>("impact") == ImpactScheme::Kind::Paper) return;
  for (const std::string_view name : {"impacttolerance", "impactrate"})
    if (d.has(Attr::of(name)))
      check.error(Attr::of(name), fmt::format("{0} has no effect here; it needs impact=paper", name));
}

std::unique_ptr<Node> makeDynamics(const NodeRequest& r) {
  const auto& services = r.services.get<DynamicsServices>();
  CollisionAttributes attributes = collisionAttributesOf(r, *services.shapes);
  attributes.fineness = services.variation.fineness;
  attributes.impacts = services.variation.impacts.value_or(impactsOf(r.declaration));
  return std::make_unique<DynamicsNode>(r.self, r.name, std::move(attributes), services.shapes);
}

constexpr AttributeSpec kDynamicsRows[] = {
    kColliderRow,
    {.name = "collidee",
     .kind = ValueKind::Reference,
     .help = "a body that this node moves; a body belongs to one dynamics node",
     .repeatable = true,
     .targets = {{}, {"dynobject"}},
     .acts = true},
    kReleaseDistanceRow,
    {.name = "selfcollide",
     .kind = ValueKind::Flag,
     .help = "whether the bodies of this node collide with each other",
     .standard = "on"},
    {.name = "impact",
     .kind = ValueKind::Choice,
     .help = "how impacts are found: exactly, or as in the paper by steps that are subdivided",
     .standard = "exact",
     .choices = kImpacts},
    {.name = "impacttolerance",
     .kind = ValueKind::Number,
     .help = "of impact=paper: how near two surfaces are brought before they touch",
     .standard = "0.001",
     .unit = "m",
     .range = {1e-9, 0.1}},
    {.name = "impactrate",
     .kind = ValueKind::Number,
     .help = "of impact=paper: tests a second; what passes another thing between two tests is not seen",
     .standard = "60",
     .unit = "Hz",
     .range = {10, 10000}},
    kInitStateRow,
};

}  // namespace

constinit const NodeType kDynamicsType{
    .name = "dynamics",
    .help = "moves its bodies by forces and collisions",
    .attributes = kDynamicsRows,
    .events = kContactEvents,
    .traits = {Trait::Switched, Trait::Collides, Trait::OwnsBodies, Trait::Degradable},
    .make = makeDynamics,
    .check = checkImpacts,
    .lint = lintContacts,
};

namespace node_types {

void addDynamicsNode(NodeRegistrar& types) {
  types.add(kDynamicsType);
}

}  // namespace node_types

}  // namespace stadion
