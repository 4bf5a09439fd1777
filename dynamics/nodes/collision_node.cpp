#include "dynamics/nodes/collision_node.h"

#include "dynamics/collision/broad_phase.h"
#include "dynamics/nodes/body_maker.h"
#include "dynamics/nodes/dyn_object_node.h"
#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/core/state_fields.h"
#include "engine/scene/scene.h"
#include "engine/script/object_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr Nanoseconds kMostBehind = fromSeconds(10);  ///< of a restored state: what moves in it

/// The box around the ball around a shape. Of an unbounded plane it is as good as everywhere.
Aabb boxAround(const Shape& shape, const Pose& X_WN) {
  const Sphere ball = boundingSphere(shape);
  const Vec3 centre = X_WN * ball.centre, reach = Vec3::Constant(std::min(ball.radius, 1e299));
  return {centre - reach, centre + reach};
}

std::shared_ptr<const Shape> shapeOf(const SharedFit& fit) {
  return {fit, &fit->choice.shape};
}

}  // namespace

CollisionNode::CollisionNode(const NodeType& type, NodeRef self, std::string name,
                             CollisionAttributes attributes, std::shared_ptr<ShapeStore> shapes)
    : Node(type, self, std::move(name)), attributes_(std::move(attributes)), shapes_(std::move(shapes)),
      switch_(attributes_.on), on_(attributes_.on) {
  const auto part = [](const std::string& n) {
    Part p;
    p.name = n;
    return p;
  };
  for (const std::string& n : attributes_.colliders) colliders_.push_back(part(n));
  for (const std::string& n : attributes_.collidees) collidees_.push_back(part(n));
  world_.setBodiesCollide(attributes_.selfCollide);
  world_.setStepDivider(attributes_.fineness);
  world_.setImpactScheme(attributes_.impacts);
}

void CollisionNode::onEnter(Scene& scene) {
  advancedTo_ = scene.now();
  scene.schedule().watchLoads(self());
  scene.schedule().wakeNow(self());
}

void CollisionNode::onLeave(Scene& scene) {
  scene.schedule().unwatchLoads(self());
  for (Part& part : colliders_)
    if (part.ref.valid()) scene.schedule().unwatch(part.placement, self());
  for (Part& part : collidees_)
    if (part.ref.valid()) removeCollidee(part, scene);
}

void CollisionNode::receive(const Message& m, FrameContext& frame) {
  if (!switch_.apply(m)) return;
  awake_ = true;
  switchings_.push_back({frame.effective(m), switch_.on()});
}

// Parts may stand in files that come and go; they are looked up again whenever a file has.
void CollisionNode::findParts(Scene& scene) {
  if (loadsSeen_ == scene.tree().version()) return;
  loadsSeen_ = scene.tree().version();
  comingOrGoing_.clear();
  for (std::vector<Part>* parts : {&colliders_, &collidees_})
    for (Part& part : *parts) {
      findPart(part, scene);
      if (part.next.valid() || part.leaveAt != SceneTree::kNever) comingOrGoing_.push_back(&part);
    }
}

void CollisionNode::findPart(Part& part, Scene& scene) {
  auto* object = dynamic_cast<ObjectNode*>(scene.find(scene.tree().resolve(part.name, self())));
  const NodeRef found = object ? object->self() : NodeRef{};
  if (part.ref.valid()) part.leaveAt = scene.find(part.ref) ? scene.tree().endOf(part.ref.load) : 0;
  part.next = {};
  if (found == part.ref) return;
  if (object) {
    part.next = found;
    part.nextAt = scene.tree().load(found.load)->since;
    part.leaveAt = std::min(part.leaveAt, part.nextAt);
  } else {
    part.leaveAt = 0;
  }
}

/// Parts go and come at the exact times of their files.
void CollisionNode::changeParts(Nanoseconds time, FrameContext& frame) {
  Scene& scene = frame.scene;
  for (Part* part : comingOrGoing_) {
    const bool isCollider = part >= colliders_.data() && part < colliders_.data() + colliders_.size();
    if (part->ref.valid() && part->leaveAt <= time) {
      if (isCollider)
        removeCollider(*part, scene);
      else
        removeCollidee(*part, scene);
      part->ref = {};
      part->id = 0;
      part->fit = nullptr;
      part->track.clear();
      part->arcs.clear();
    }
    if (!part->next.valid() || part->nextAt > time || part->ref.valid()) continue;
    auto* object = dynamic_cast<ObjectNode*>(scene.find(part->next));
    const NodeRef ref = std::exchange(part->next, NodeRef{});
    if (!object) continue;
    part->ref = ref;
    part->leaveAt = scene.tree().endOf(ref.load);
    part->placement = object->placement();
    bring(*part, *object, isCollider, time, frame);
  }
}

/// A part comes where it is at that time, and goes on from there.
void CollisionNode::bring(Part& part, ObjectNode& object, bool isCollider, Nanoseconds time,
                          FrameContext& frame) {
  const Placements& placements = frame.scene.placements();
  part.pose = poseOf(placements.world(part.placement));
  if (!isCollider && !followsCollidees()) return addCollidee(part, object, frame.scene);
  followFrom(part, frame.scene.poseTracks().startOf(part.placement, placements), frame);
  const Pose now = part.pose;
  if (moves(part)) part.pose = poseAt(part, time, Limit::After);
  if (isCollider)
    addCollider(part, object, frame.scene);
  else
    addCollidee(part, object, frame.scene);
  part.pose = now;
}

void CollisionNode::addCollider(Part& part, const ObjectNode& object, Scene& scene) {
  part.id = world_.addCollider(colliderOf(part, object, scene));
  scene.schedule().watch(part.placement, self());
}

void CollisionNode::removeCollider(Part& part, Scene& scene) {
  world_.removeCollider(part.id);
  world_.removeShape(part.shape);
  scene.schedule().unwatch(part.placement, self());
}

std::vector<CollisionNode::Overlap> CollisionNode::overlaps(double deeperThan) const {
  // In the order of the script, colliders first.
  struct Present {
    const Part* part;
    ContactSide key;
    Aabb box{};
    std::uint32_t place = kUnfiled;
  };
  std::vector<Present> all;
  for (const Part& p : colliders_)
    if (p.ref.valid()) all.push_back({&p, {false, p.id}});
  const std::size_t bodies = all.size();
  for (const Part& p : collidees_)
    if (p.ref.valid()) all.push_back({&p, {true, p.id}});
  std::vector<BroadPhase<Present>::Entry> entries;
  for (Present& p : all) {
    if (const Shape* shape = world_.shape(p.part->shape))
      p.box = boxAround(*shape, p.key.isBody ? world_.pose(p.key.id) : p.part->pose);
    entries.push_back({p.box, &p});
  }
  BroadPhase<Present> near;
  near.file(std::move(entries));

  std::vector<Overlap> found;
  std::vector<const Present*> partners;
  for (std::size_t i = bodies; i < all.size(); ++i) {
    partners.clear();
    near.eachNear(all[i].box, [&](const Present& other) {
      if (!other.key.isBody || &other > &all[i]) partners.push_back(&other);
    });
    std::ranges::sort(partners);
    for (const Present* other : partners) {
      const double separation = world_.separation(other->key, all[i].key);
      if (separation < -deeperThan) found.push_back({other->part->name, all[i].part->name, -separation});
    }
  }
  return found;
}

std::vector<CollisionNode::Participant> CollisionNode::participants() const {
  std::vector<Participant> all;
  for (const std::vector<Part>* list : {&colliders_, &collidees_})
    for (const Part& part : *list)
      if (part.ref.valid()) all.push_back({part.ref, part.fit.get()});
  return all;
}

SharedFit CollisionNode::fitOf(const ObjectNode& object, const Scene& scene) {
  return fitAt(scaleOf(scene.placements().world(object.placement())), object, scene);
}

SharedFit CollisionNode::fitAt(const Vec3& scale, const ObjectNode& object, const Scene& scene) {
  const Mesh* mesh = scene.instances().mesh(object.appearance().mesh);
  if (!mesh) return nullptr;
  auto fit = shapes_->fit(*mesh, object.appearance(), scale);
  return fit ? std::move(fit.value()) : nullptr;
}

ShapeId CollisionNode::addShape(const SharedFit& fit) {
  return fit ? world_.addShape(shapeOf(fit)) : 0;
}

ColliderDef CollisionNode::colliderOf(Part& part, const ObjectNode& object, const Scene& scene) {
  part.fit = fitOf(object, scene);
  part.shape = addShape(part.fit);
  ColliderDef def;
  def.pose = part.pose;
  def.shape = part.shape;
  // A body that another dynamics node moves takes part with the surface that its script gave it.
  if (const auto* body = dynamic_cast<const DynObjectNode*>(&object)) def.surface = body->body().surface;
  return def;
}

void CollisionNode::addCuts(const PoseTrack& track, std::vector<Nanoseconds>& cuts) {
  for (const PoseKnot& k : track) cuts.push_back(k.time);
}

bool CollisionNode::follow(Part& part, FrameContext& frame, std::vector<Nanoseconds>& cuts) const {
  part.track.clear();
  part.arcs.clear();
  if (!part.ref.valid()) return false;
  followFrom(part, part.pose, frame);
  if (!part.arcs.empty()) {
    for (const ArcPiece& p : part.arcs)
      if (p.jump) cuts.push_back(p.begins());
  } else {
    addCuts(part.track, cuts);
  }
  return moves(part);
}

/// The way of a part that was at `before` when the frame began.
void CollisionNode::followFrom(Part& part, const Pose& before, FrameContext& frame) const {
  const Placements& placements = frame.scene.placements();
  const PoseTracks& tracks = frame.scene.poseTracks();
  // What has moved while this node was kept from running is put where it has come to.
  const Pose start = frame.rested ? tracks.startOf(part.placement, placements) : before;
  part.track = tracks.within(part.placement, start, frame.start(), frame.now.time, placements);
  if (frame.rested && !(start.p == before.p && start.q.coeffs() == before.q.coeffs())) {
    if (part.track.empty()) part.track.push_back({frame.start(), start, false});
    part.track.front().jump = true;
    part.track.insert(part.track.begin(), {frame.start(), before, false});
  } else if (!part.track.empty()) {
    if (!followBody(part, before, frame) && bends(part.track)) part.arcs = arcsOf(part.track);
  }
  part.pose = poseOf(placements.world(part.placement));
}

/// Where a body that another dynamics node moves carries the part, and nothing else does, it goes as that has
/// gone.
bool CollisionNode::followBody(Part& part, const Pose& before, const FrameContext& frame) const {
  const Scene& scene = frame.scene;
  const Placements& placements = scene.placements();
  const DynObjectNode* body = nullptr;
  for (NodeRef at = part.ref; at.valid() && !body; at = scene.tree().parentOf(at)) {
    const LoadedScene* load = scene.tree().load(at.load);
    body = load ? dynamic_cast<const DynObjectNode*>(load->nodes[at.position].get()) : nullptr;
  }
  const ArcTrack* way = body && body->movedBy() != self() ? body->arcsIn(frame.now.frame) : nullptr;
  if (!way) return false;
  for (PlacementId id = part.placement; id != body->placement(); id = placements.carrier(id))
    if (id == kWorldPlacement || id == kNoPlacement) return false;  // a tracker has it
  const Pose X_NP =
      poseOf(placements.world(body->placement())).inverse() * poseOf(placements.world(part.placement));
  const Pose begins = poseOn(*way, frame.start(), Limit::Before) * X_NP;
  const bool rides = (begins.p - before.p).norm() <= 1e-9 * (1 + before.p.norm()) &&
                     std::fabs(begins.q.dot(before.q)) >= 1 - 1e-12;
  if (!rides) return false;  // it moves on the body
  part.arcs = *way;
  if (part.ref != body->self())
    for (ArcPiece& p : part.arcs) p.X_CN = p.X_CN * X_NP;
  return true;
}

bool CollisionNode::jumps(const Part& part, Nanoseconds time) {
  return part.arcs.empty() ? jumpsAt(part.track, time) : jumpsAt(part.arcs, time);
}

Pose CollisionNode::poseAt(const Part& part, Nanoseconds time, Limit limit) {
  return part.arcs.empty() ? poseOn(part.track, time, limit) : poseOn(part.arcs, time, limit);
}

bool CollisionNode::foresee(FrameContext& frame, std::vector<Nanoseconds>& cuts) {
  bool any = false;
  for (const Part* part : comingOrGoing_) {
    const bool goes = part->ref.valid() && part->leaveAt <= frame.now.time, comes = part->next.valid();
    if (goes) cuts.push_back(part->leaveAt);
    if (comes) cuts.push_back(part->nextAt);
    any |= goes || comes;
  }
  for (const Switching& s : switchings_) {
    cuts.push_back(s.when);
    any = true;
  }
  for (Part& part : colliders_) any |= follow(part, frame, cuts);
  return prepare(frame, cuts) || any;
}

void CollisionNode::actAt(Nanoseconds time, FrameContext* frame) {
  for (const Switching& s : switchings_)
    if (s.when == time) on_ = s.on;
  if (frame) changeParts(time, *frame);
  for (const Part& part : colliders_)
    if (jumps(part, time)) world_.moveCollider(part.id, poseAt(part, time, Limit::After), true);
  act(time, frame);
}

void CollisionNode::step(FrameContext* frame) {
  // Nothing moved while the node was not visited: the world only has to know that time has passed.
  const Nanoseconds begin = std::max(advancedTo_, step_.from);
  bool continues = false;
  const auto pass = [&](Nanoseconds from, Nanoseconds to) {
    const bool runs = on_ && !(step_.rested && to <= step_.from);
    if (runs)
      world_.advance(from, to, continues);
    else
      world_.pause(from, to, continues);
    continues = true;
  };
  if (advancedTo_ < begin) pass(advancedTo_, begin);
  advancedTo_ = std::max(begin, step_.to);
  std::vector<Nanoseconds>& cuts = step_.cuts;
  std::erase_if(cuts, [&](Nanoseconds t) { return t <= begin || t > advancedTo_; });
  cuts.push_back(advancedTo_);
  std::ranges::sort(cuts);
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  actAt(begin, frame);
  Nanoseconds from = begin;
  for (const Nanoseconds to : cuts) {
    for (const Part& part : colliders_) {
      if (!moves(part)) continue;
      const Pose end = poseAt(part, to, Limit::Before);
      on_ && !part.arcs.empty() ? world_.moveCollider(part.id, end, part.arcs)
                                : world_.moveCollider(part.id, end, !on_);
    }
    move(from, to, !on_);
    pass(from, to);
    if (to > begin) actAt(to, frame);
    from = to;
  }
  step_.done = true;
}

void CollisionNode::simulate(FrameContext& frame) {
  findParts(frame.scene);
  step_ = {
      frame.start(), std::min(frame.now.time, frame.scene.tree().endOf(self().load)), {}, false, frame.rested,
      false};
  step_.outside = foresee(frame, step_.cuts);
  if (needsScene(frame.now.time)) step(&frame);
}

void CollisionNode::simulateApart() {
  if (!step_.done) step(nullptr);
}

void CollisionNode::afterSimulation(FrameContext& frame) {
  switchings_.clear();
  for (const ContactEvent& e : world_.events())
    raise(e.kind == ContactEvent::Kind::Impact ? Event("onimpact") : Event("onrelease"), e.time);
  if (frame.scene.impacts().wanted()) noteImpacts(frame.scene);
  std::erase_if(comingOrGoing_,
                [](const Part* p) { return !p->next.valid() && p->leaveAt == SceneTree::kNever; });
  awake_ = afterStep(frame) || step_.outside || world_.awaitsCommands();
}

NodeRef CollisionNode::nodeOf(ContactSide key) const {
  const std::vector<Part>& parts = key.isBody ? collidees_ : colliders_;
  const auto at = std::ranges::find_if(parts, [&](const Part& p) { return p.ref.valid() && p.id == key.id; });
  return at == parts.end() ? NodeRef{} : at->ref;
}

void CollisionNode::noteImpacts(Scene& scene) const {
  for (const ContactEvent& e : world_.events())
    if (e.kind == ContactEvent::Kind::Impact)
      scene.impacts().note({nodeOf({true, e.body}), nodeOf(e.other), e.point, e.time});
}

bool CollisionNode::needsScene(Nanoseconds) const {
  return !comingOrGoing_.empty();
}

bool CollisionNode::awaits(const Node& earlier, const Scene& scene) const {
  // What is placed before must be in its place: else the frame would be simulated twice.
  return earlier.rank() < Rank::Dynamics || loadsSeen_ != scene.tree().version() || looksAt(earlier, scene);
}

bool CollisionNode::looksAt(const Node& mover, const Scene& scene) const {
  for (const std::vector<Part>* parts : {&colliders_, &collidees_})
    for (const Part& part : *parts)
      if (part.ref.valid() && isMovedBy(mover, part.ref, scene)) return true;
  return false;
}

void CollisionNode::addMovers(const Scene& scene, std::vector<NodeRef>& movers) const {
  for (const Part& part : colliders_) addMover(part.ref, scene, movers);
}

void CollisionNode::addMover(NodeRef node, const Scene& scene, std::vector<NodeRef>& movers) const {
  for (NodeRef at = node; at.valid(); at = scene.tree().parentOf(at)) {
    const LoadedScene* load = scene.tree().load(at.load);
    const auto* body = load ? dynamic_cast<const DynObjectNode*>(load->nodes[at.position].get()) : nullptr;
    if (!body || !body->movedBy().valid() || body->movedBy() == self()) continue;
    if (std::ranges::find(movers, body->movedBy()) == movers.end()) movers.push_back(body->movedBy());
  }
}

bool CollisionNode::isMovedBy(const Node& mover, NodeRef node, const Scene& scene) {
  for (NodeRef at = node; at.valid(); at = scene.tree().parentOf(at)) {
    const LoadedScene* load = scene.tree().load(at.load);
    const auto* body = load ? dynamic_cast<const DynObjectNode*>(load->nodes[at.position].get()) : nullptr;
    if (body && body->movedBy() == mover.self()) return true;
  }
  return false;
}

void CollisionNode::addCollidee(Part& part, ObjectNode& object, Scene& scene) {
  BodyDef def;
  const ColliderDef collider = colliderOf(part, object, scene);
  def.shape = collider.shape;
  def.pose = collider.pose;
  def.releaseDistance = attributes_.releaseDistance;
  part.id = world_.addBody(def);
  world_.holdBody(part.id);
  scene.schedule().watch(part.placement, self());
}

void CollisionNode::removeCollidee(Part& part, Scene& scene) {
  world_.removeBody(part.id);
  world_.removeShape(part.shape);
  scene.schedule().unwatch(part.placement, self());
}

bool CollisionNode::prepare(FrameContext& frame, std::vector<Nanoseconds>& cuts) {
  bool any = false;
  for (Part& part : collidees_) any |= follow(part, frame, cuts);
  return any;
}

void CollisionNode::act(Nanoseconds time, FrameContext*) {
  for (const Part& part : collidees_)
    if (jumps(part, time)) world_.moveHeld(part.id, poseAt(part, time, Limit::After), true);
}

void CollisionNode::move(Nanoseconds, Nanoseconds to, bool jump) {
  for (const Part& part : collidees_) {
    if (!moves(part)) continue;
    const Pose end = poseAt(part, to, Limit::Before);
    jump || part.arcs.empty() ? world_.moveHeld(part.id, end, jump)
                              : world_.moveHeld(part.id, end, part.arcs);
  }
}

bool CollisionNode::afterStep(FrameContext&) {
  return false;
}

void CollisionNode::state(StateFields& f) {
  f("switch", switch_), f("on", on_), f("awake", awake_), f("loads", loadsSeen_), f("to", advancedTo_);
  for (Part& part : colliders_) f("collider", part);
  for (Part& part : collidees_) {
    f.about(part.id);
    f("collidee", part);
  }
  f.about(0);
  world_.visitState(f);
}

NodeRef CollisionNode::nodeOf(std::uint32_t part) const {
  const auto its = std::ranges::find(collidees_, part, &Part::id);
  return its == collidees_.end() ? self() : its->ref;
}

bool CollisionNode::resumeParts(Scene& scene) {
  // What moves was simulated up to now, or a few frames ago; what lasts longer does not count.
  const auto stands = [this](const Part& p) { return p.id == 0 || standsStill(world_.mode(p.id)); };
  const Nanoseconds behind = scene.now() - advancedTo_;
  const bool mayBe =
      !on_ || scheduleState().missed == Missed::Time || std::ranges::all_of(collidees_, stands);
  if (behind < 0 || (behind > kMostBehind && !mayBe)) return false;
  comingOrGoing_.clear();
  for (std::vector<Part>* parts : {&colliders_, &collidees_})
    for (Part& part : *parts) {
      if (part.next.valid() || part.leaveAt != SceneTree::kNever) comingOrGoing_.push_back(&part);
      if (!part.refit) continue;
      const auto* object = dynamic_cast<const ObjectNode*>(scene.find(part.ref));
      if (!object) return false;
      part.fit = refit(part, *object, scene);
      if (!part.fit || !world_.restoreShape(part.shape, shapeOf(part.fit))) return false;
    }
  return true;
}

bool CollisionNode::resume(Scene& scene) {
  return resumeParts(scene) && world_.complete();
}

void CollisionNode::hash(StateHash& h) const {
  h.add(switch_.on());
  h.add(world_.pairsDigest());
}

CollisionAttributes collisionAttributesOf(const NodeRequest& r, ShapeStore& shapes) {
  const Declaration& d = r.declaration;
  CollisionAttributes a;
  for (const NodeReference& n : d.references("collider")) a.colliders.push_back(std::string(n.name));
  for (const NodeReference& n : d.references("collidee")) a.collidees.push_back(std::string(n.name));
  a.releaseDistance = d.number("releasedistance");
  if (d.takes("selfcollide")) a.selfCollide = d.flag("selfcollide");
  a.on = d.flag("initstate");
  // Fitting a large model takes longer than a frame: it is done here, beside the show.
  for (const NodeReference& n : d.references("collider"))
    if (const auto model = r.model(n); model && model->mesh)
      if (auto fit = shapes.fit(*model->mesh, model->appearance, scaleOf(model->X_WN)))
        a.fits.push_back(std::move(fit.value()));
  return a;
}

/// A part that the script names is no longer in its object.
static void lintParts(const Declaration& node, LintScope& scope) {
  const auto colliders = node.references("collider");
  const auto isNamed = [&](std::string_view name) {
    return std::ranges::any_of(colliders, [&](const NodeReference& r) { return r.name == name; });
  };
  for (const Declaration part : scope.document()) {
    if (!isPartByUse(part)) continue;
    const std::string_view object = part.name().substr(0, part.name().find('/'));
    for (const NodeReference& r : colliders)
      if (r.name == object && !isNamed(part.name()))
        scope.warnAt(
            r.where,
            fmt::format("\"{}\" collides without its part \"{}\", which line {} names; add collider={} if "
                        "the part is to collide too",
                        object, part.name(), part.line(), part.name()));
  }
}

void lintContacts(const Declaration& node, LintScope& scope) {
  const auto collidees = node.references("collidee");
  if (collidees.empty())
    scope.warn(node, "name", fmt::format("{} has no collidee and so no effect", LintScope::called(node)));
  scope.warnRepeated(node, "collider");
  lintParts(node, scope);
  scope.warnNeverOn(node);
}

namespace {

std::unique_ptr<Node> makeCollision(const NodeRequest& r) {
  const auto& shapes = r.services.get<DynamicsServices>().shapes;
  return std::make_unique<CollisionNode>(r.type(), r.self, r.name, collisionAttributesOf(r, *shapes), shapes);
}

constexpr AttributeSpec kCollisionRows[] = {
    kColliderRow,
    {.name = "collidee",
     .kind = ValueKind::Reference,
     .help = "is tested against every collider",
     .repeatable = true,
     .targets = kModelTypes,
     .acts = true},
    kReleaseDistanceRow,
    kInitStateRow,
};

}  // namespace

constinit const NodeType kCollisionType{
    .name = "collision",
    .help = "notices contact between objects and leaves them where they are",
    .attributes = kCollisionRows,
    .events = kContactEvents,
    .traits = {Trait::Switched, Trait::Collides, Trait::Degradable},
    .make = makeCollision,
    .lint = lintContacts,
};

namespace node_types {

void addCollisionNode(NodeRegistrar& types) {
  types.add(kCollisionType);
}

}  // namespace node_types

}  // namespace stadion
