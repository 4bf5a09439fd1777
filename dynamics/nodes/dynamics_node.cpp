#include "dynamics/nodes/dynamics_node.h"

#include "dynamics/nodes/body_shape.h"
#include "engine/maths/functions.h"
#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {
namespace {

DynObjectNode* bodyAt(NodeRef ref, Scene& scene) {
  return dynamic_cast<DynObjectNode*>(scene.find(ref));
}
FieldNode* fieldAt(NodeRef ref, Scene& scene) {
  return dynamic_cast<FieldNode*>(scene.find(ref));
}

Affine withScale(const Pose& X_WN, const Affine& like) {
  Affine X = toAffine(X_WN);
  X.linear() = X.linear() * scaleOf(like).asDiagonal();
  return X;
}

}  // namespace

void DynamicsNode::onLeave(Scene& scene) {
  for (const Field& f : fields_) {
    scene.unwatch(f.placement, self());
    if (FieldNode* node = fieldAt(f.ref, scene)) node->removeUser(self());
  }
  CollisionNode::onLeave(scene);
}

void DynamicsNode::addCollidee(Part& part, ObjectNode& object, Scene& scene) {
  auto* node = dynamic_cast<DynObjectNode*>(&object);
  if (!node) return;  // the checker lets only dynobjects be collidees of a dynamics node
  const BodyAttributes& body = node->body();
  BodyDef def;
  std::optional<Shape> shape = node->takeShape();
  part.shape = def.shape = shape ? world_.addShape(std::move(*shape)) : addShapeOf(object, scene, world_);
  def.pose = part.pose;
  def.mass = body.mass;
  def.surface = body.surface;
  def.damping = body.damping;
  def.releaseDistance = attributes_.releaseDistance;
  part.id = world_.addBody(def);
  for (const NodeRef field : node->hooked())
    if (const FieldId id = fieldFor(field, scene)) world_.hook(part.id, id, scene.now());
  node->takeRequests();
  node->setSimulation(self());
  node->setState(world_.state(part.id));
}

void DynamicsNode::removeCollidee(Part& part, Scene& scene) {
  std::erase_if(grips_, [&](const Grip& g) { return g.body == part.id; });
  world_.removeBody(part.id);
  world_.removeShape(part.shape);
  if (DynObjectNode* node = bodyAt(part.ref, scene)) node->setSimulation({});
}

FieldId DynamicsNode::fieldFor(NodeRef ref, Scene& scene) {
  const auto known =
      std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.ref == ref; });
  if (known != fields_.end()) return known->id;
  FieldNode* node = fieldAt(ref, scene);
  if (!node) return 0;
  Field f{ref, 0, node->placement(), node->pose(scene)};
  f.id = world_.addField({node->law(scene), f.pose, f.pose, node->duration()}, false);
  if (node->on()) world_.switchField(f.id, true, node->activated());
  node->addUser(self());
  scene.watch(f.placement, self());
  fields_.push_back(f);
  return f.id;
}

// The fields' own nodes have had their turn: what they say now holds for the end of this frame.
bool DynamicsNode::moveFields(FrameContext& frame) {
  bool any = false;
  std::erase_if(fields_, [&](Field& f) {
    const FieldNode* node = fieldAt(f.ref, frame.scene);
    if (!node) {  // unloaded
      world_.removeField(f.id);
      frame.scene.unwatch(f.placement, self());
      return any = true;
    }
    const Pose pose = node->pose(frame.scene);
    if (pose.p != f.pose.p || pose.q.coeffs() != f.pose.q.coeffs()) any = true;
    world_.setFieldLaw(f.id, node->law(frame.scene));
    world_.moveField(f.id, f.pose, pose);
    f.pose = pose;
    for (const FieldNode::Change& c : node->changes(frame.now.frame)) {
      world_.switchField(f.id, c.on, c.when);
      any = true;
    }
    return false;
  });
  return any;
}

bool DynamicsNode::obeyRequests(FrameContext& frame) {
  bool any = false;
  for (Part& part : collidees_) {
    DynObjectNode* node = bodyAt(part.ref, frame.scene);
    if (!node) continue;
    const DynObjectNode::Requests asked = node->takeRequests();
    if (asked.reset) {
      letGo(part.id);
      world_.placeBody(part.id, poseOf(frame.scene.placements().world(part.placement)), Vec3::Zero(),
                       Vec3::Zero());
    }
    for (const DynObjectNode::HookChange& h : asked.hooks)
      if (const FieldId field = fieldFor(h.field, frame.scene))
        h.hooked ? world_.hook(part.id, field, h.when) : world_.unhook(part.id, field, h.when);
    if (asked.release) letGo(part.id);
    if (!asked.grab.empty()) grab(part, asked.grab, frame);
    any |= asked.reset || asked.release || !asked.hooks.empty() || !asked.grab.empty();
  }
  return any;
}

void DynamicsNode::grab(Part& part, const std::string& tracker, FrameContext& frame) {
  const auto X_WT = frame.scene.trackerInWorld(tracker, frame.input);
  if (!X_WT) return;
  letGo(part.id);
  const Pose now = world_.pose(part.id);
  grips_.push_back({part.id, tracker, X_WT->inverse() * now, now, Vec3::Zero(), Vec3::Zero()});
  world_.holdBody(part.id);
}

void DynamicsNode::letGo(BodyId body) {
  const auto grip = std::find_if(grips_.begin(), grips_.end(), [&](const Grip& g) { return g.body == body; });
  if (grip == grips_.end()) return;
  world_.releaseBody(body, grip->v, grip->omega);
  grips_.erase(grip);
}

bool DynamicsNode::moveGrips(FrameContext& frame) {
  for (Grip& grip : grips_) {
    const auto X_WT = frame.scene.trackerInWorld(grip.tracker, frame.input);
    if (!X_WT || frame.now.step <= 0) continue;
    const Pose pose = *X_WT * grip.X_TN;
    const double dt = toSeconds(frame.now.step);
    grip.v = (pose.p - grip.last.p) / dt;
    grip.omega = det::logRotation(pose.q * grip.last.q.conjugate()) / dt;
    if (teleported(grip.last, pose, frame.now.step)) grip.v = grip.omega = Vec3::Zero();
    grip.last = pose;
    world_.moveHeld(grip.body, pose);
  }
  return !grips_.empty();
}

bool DynamicsNode::beforeStep(FrameContext& frame) {
  const bool requests = obeyRequests(frame);
  const bool fields = moveFields(frame);
  return moveGrips(frame) || requests || fields;
}

bool DynamicsNode::afterStep(FrameContext& frame) {
  bool any = false;
  for (Part& part : collidees_) {
    DynObjectNode* node = bodyAt(part.ref, frame.scene);
    if (!node) continue;
    const BodyState state = world_.state(part.id);
    any |= world_.moving(part.id);
    const bool same = state.pose.p == part.pose.p && state.pose.q.coeffs() == part.pose.q.coeffs();
    part.pose = state.pose;
    node->setState(state);
    if (same)
      frame.scene.touch(node->self());
    else
      node->place(frame.scene, withScale(state.pose, frame.scene.placements().world(part.placement)));
  }
  return any || !grips_.empty();
}

}  // namespace stadion
