#include "dynamics/nodes/collision_node.h"

#include "dynamics/nodes/body_shape.h"
#include "engine/scene/scene.h"

namespace stadion {

CollisionNode::CollisionNode(NodeKind kind, NodeRef self, std::string name, CollisionAttributes attributes)
    : Node(kind, self, std::move(name)), attributes_(std::move(attributes)), switch_(attributes_.on) {
  for (const std::string& n : attributes_.colliders) colliders_.push_back({n, {}, 0, 0, kNoPlacement, {}});
  for (const std::string& n : attributes_.collidees) collidees_.push_back({n, {}, 0, 0, kNoPlacement, {}});
  world_.setBodiesCollide(attributes_.selfCollide);
}

void CollisionNode::onEnter(Scene& scene) {
  advancedTo_ = scene.now();
  scene.wakeNow(self());
}

void CollisionNode::onLeave(Scene& scene) {
  for (Part& part : colliders_)
    if (part.ref.valid()) scene.unwatch(part.placement, self());
  for (Part& part : collidees_)
    if (part.ref.valid()) removeCollidee(part, scene);
}

void CollisionNode::receive(const Message& m, FrameContext&) {
  if (switch_.obey(m)) awake_ = true;
}

// Parts may stand in files that come and go; they are looked up again whenever a file has.
void CollisionNode::findParts(Scene& scene) {
  if (loadsSeen_ == scene.loadsVersion()) return;
  loadsSeen_ = scene.loadsVersion();
  const auto refresh = [&](std::vector<Part>& parts, auto add, auto drop) {
    for (Part& part : parts) {
      auto* object = dynamic_cast<ObjectNode*>(scene.find(scene.resolve(part.name, self())));
      const NodeRef now = object ? object->self() : NodeRef{};
      if (now == part.ref) continue;
      if (part.ref.valid()) drop(part);
      part.ref = now;
      if (!object) continue;
      part.placement = object->placement();
      part.pose = poseOf(scene.placements().world(part.placement));
      add(part, *object);
      awake_ = true;
    }
  };
  refresh(
      colliders_,
      [&](Part& part, ObjectNode& object) {
        const ColliderDef def = colliderOf(object, scene, world_);
        part.shape = def.shape;
        part.id = world_.addCollider(def);
        scene.watch(part.placement, self());
      },
      [&](Part& part) {
        world_.removeCollider(part.id);
        world_.removeShape(part.shape);
        scene.unwatch(part.placement, self());
      });
  refresh(
      collidees_, [&](Part& part, ObjectNode& object) { addCollidee(part, object, scene); },
      [&](Part& part) { removeCollidee(part, scene); });
}

std::vector<CollisionNode::Overlap> CollisionNode::overlaps(double deeperThan) const {
  std::vector<Overlap> found;
  const auto test = [&](const Part& a, Party partyA, const Part& b) {
    if (!a.ref.valid() || !b.ref.valid()) return;
    const double separation = world_.separation(partyA, {true, b.id});
    if (separation < -deeperThan) found.push_back({a.name, b.name, -separation});
  };
  for (std::size_t i = 0; i < collidees_.size(); ++i) {
    for (const Part& c : colliders_) test(c, {false, c.id}, collidees_[i]);
    for (std::size_t j = i + 1; j < collidees_.size(); ++j)
      test(collidees_[j], {true, collidees_[j].id}, collidees_[i]);
  }
  return found;
}

bool CollisionNode::moveColliders(FrameContext& frame) {
  bool any = false;
  for (Part& part : colliders_) {
    if (!part.ref.valid()) continue;
    const Pose pose = poseOf(frame.scene.placements().world(part.placement));
    if (pose.p == part.pose.p && pose.q.coeffs() == part.pose.q.coeffs()) continue;
    // What jumps farther than a hand can move has been put there, and gives no push.
    world_.moveCollider(part.id, pose, teleported(part.pose, pose, frame.now.step));
    part.pose = pose;
    any = true;
  }
  return any;
}

void CollisionNode::simulate(FrameContext& frame) {
  findParts(frame.scene);
  if (!switch_.on()) return;
  // Nothing moved while the node was not visited: the world only has to know that time has passed.
  if (advancedTo_ < frame.start()) world_.advance(advancedTo_, frame.start());
  const bool outside = moveColliders(frame);
  const bool asked = beforeStep(frame);
  world_.advance(frame.start(), frame.now.time);
  advancedTo_ = frame.now.time;
  for (const ContactEvent& e : world_.events())
    raise(e.kind == ContactEvent::Kind::Impact ? Event::OnImpact : Event::OnRelease, e.time);
  awake_ = afterStep(frame) || outside || asked;
}

void CollisionNode::addCollidee(Part& part, ObjectNode& object, Scene& scene) {
  BodyDef def;
  const ColliderDef collider = colliderOf(object, scene, world_);
  part.shape = def.shape = collider.shape;
  def.pose = collider.pose;
  def.releaseDistance = attributes_.releaseDistance;
  part.id = world_.addBody(def);
  world_.holdBody(part.id);
  scene.watch(part.placement, self());
}

void CollisionNode::removeCollidee(Part& part, Scene& scene) {
  world_.removeBody(part.id);
  world_.removeShape(part.shape);
  scene.unwatch(part.placement, self());
}

bool CollisionNode::beforeStep(FrameContext& frame) {
  bool any = false;
  for (Part& part : collidees_) {
    if (!part.ref.valid()) continue;
    const Pose pose = poseOf(frame.scene.placements().world(part.placement));
    if (pose.p == part.pose.p && pose.q.coeffs() == part.pose.q.coeffs()) continue;
    world_.moveHeld(part.id, pose);
    part.pose = pose;
    any = true;
  }
  return any;
}

bool CollisionNode::afterStep(FrameContext&) {
  return false;
}

void CollisionNode::hash(StateHash& h) const {
  switch_.hash(h);
  for (const PairState& p : world_.pairs()) {
    h.add(p.other.isBody), h.add(p.other.id), h.add(p.body);
    h.add(p.touching), h.add(p.fired), h.add(p.impact);
  }
}

}  // namespace stadion
