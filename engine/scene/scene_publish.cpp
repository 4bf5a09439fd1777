#include "engine/scene/scene.h"

#include "engine/maths/functions.h"
#include "engine/nodes/placed_node.h"

#include <algorithm>

namespace stadion {
namespace {

/// What shines on a show that declares no light.
LightRecord afternoonSun() {
  LightRecord sun;
  const Vec3 direction = Vec3(-0.45, 0.35, -0.8).normalized();
  const float colour[3] = {1.0f, 0.96f, 0.88f};
  for (int i = 0; i < 3; ++i) sun.direction[i] = direction[i], sun.colour[i] = colour[i];
  return sun;
}

}  // namespace

// ---------------------------------------------------------------------------------------------

InstanceId Scene::addInstance(PlacementId placement, MeshId mesh, bool drawn, std::uint32_t owner) {
  InstanceId id;
  if (freeInstances_.empty()) {
    id = static_cast<InstanceId>(instances_.size());
    instances_.emplace_back();
  } else {
    id = freeInstances_.back();
    freeInstances_.pop_back();
  }
  Instance& i = instances_[id];
  i.placement = placement, i.mesh = mesh, i.owner = owner, i.drawn = drawn, i.live = true;
  if (instancesAt_.size() <= placement) instancesAt_.resize(placement + 1);
  instancesAt_[placement].push_back(id);
  markInstance(id);
  return id;
}

void Scene::setDrawn(InstanceId id, bool drawn) {
  instances_[id].drawn = drawn;
  markInstance(id);
}

void Scene::removeInstance(InstanceId id) {
  Instance& i = instances_[id];
  std::erase(instancesAt_[i.placement], id);
  i.live = false;
  markInstance(id);
  freeInstances_.push_back(id);
}

void Scene::markInstance(InstanceId id) {
  if (instances_[id].changed) return;
  instances_[id].changed = true;
  changedInstances_.push_back(id);
}

std::size_t Scene::addLight(PlacementId placement, const LightRecord& local) {
  lightsChanged_ = true;
  auto at = std::find_if(lights_.begin(), lights_.end(), [](const Light& l) { return !l.live; });
  if (at == lights_.end()) at = lights_.insert(lights_.end(), Light{});
  *at = {placement, local, true, true};
  return static_cast<std::size_t>(at - lights_.begin());
}

void Scene::setLight(std::size_t handle, const LightRecord& local, bool on) {
  lights_[handle].local = local;
  lights_[handle].on = on;
  lightsChanged_ = true;
}

void Scene::removeLight(std::size_t handle) {
  lights_[handle].live = false;
  lightsChanged_ = true;
}

void Scene::publish(const TimeSignature& now, const InputSample& input, ChangeSet& changes) {
  changes.clear();
  changes.signature = now;
  changes.chunks.swap(chunkChanges_);
  changes.statics.swap(staticChanges_);
  for (const PlacementId p : placements_.takeChanged()) {
    if (p < instancesAt_.size())
      for (const InstanceId id : instancesAt_[p]) markInstance(id);
    for (const Light& l : lights_) lightsChanged_ |= l.live && l.placement == p;
  }
  for (const InstanceId id : changedInstances_) publishInstance(id, changes);
  changedInstances_.clear();
  counters_.changesPublished = changes.instances.size();
  if (lightsChanged_) publishLights(changes);
  changes.sky = sky_;
  changes.viewer.set(rigPose(), headInRig(input));
  changes.viewer.poseTime = input.time;
}

void Scene::publishInstance(InstanceId id, ChangeSet& changes) {
  Instance& i = instances_[id];
  i.changed = false;
  ChangeSet::Instance change{id, {}};
  change.record.radius = -1;
  const Mesh* mesh = i.live ? meshes_.find(i.mesh) : nullptr;
  if (mesh)
    change.record = makeInstance(placements_.world(i.placement), *mesh, i.mesh,
                                 i.drawn && placements_.shown(i.placement), i.owner);
  changes.instances.push_back(change);
}

void Scene::publishLights(ChangeSet& changes) {
  changes.lightsChanged = true;
  const bool anyLight = std::any_of(lights_.begin(), lights_.end(), [](const Light& l) { return l.live; });
  if (!anyLight) changes.lights.push_back(afternoonSun());
  for (const Light& l : lights_) {
    if (!l.live || !l.on) continue;
    LightRecord r = l.local;
    const Affine& X_WN = placements_.world(l.placement);
    const Vec3 p = X_WN * Vec3(r.position[0], r.position[1], r.position[2]);
    const Vec3 d = (X_WN.linear() * Vec3(r.direction[0], r.direction[1], r.direction[2])).stableNormalized();
    for (int k = 0; k < 3; ++k) r.position[k] = p[k], r.direction[k] = d[k];
    changes.lights.push_back(r);
  }
  lightsChanged_ = false;
}

// -----------------------------------------------------------------------------------------------

void Scene::setRig(NodeRef rig, PlacementId placement, double eyeHeight) {
  rigs_.push_back({rig, placement, eyeHeight});
}

void Scene::dropRig(NodeRef rig) {
  std::erase_if(rigs_, [&](const Rig& r) { return r.node == rig; });
}

void Scene::moveRig(const Pose& X_WR) {
  auto* node = rigs_.empty() ? nullptr : dynamic_cast<PlacedNode*>(find(rigs_.back().node));
  if (node)
    node->place(*this, toAffine(X_WR));
  else if (X_WR.finite())
    freeRig_ = X_WR;
}

Pose Scene::rigPose() const {
  if (rigs_.empty()) return freeRig_;
  return poseOf(placements_.world(rigs_.back().placement));  // scale has no meaning for the rig
}

std::optional<Pose> Scene::trackerInWorld(const std::string& tracker, const InputSample& input) const {
  const TrackerSample* t = input.find(tracker);
  if (!t || !t->valid) return std::nullopt;
  return rigPose() * t->X_RT;
}

std::optional<Course> Scene::trackerCourse(const std::string& tracker, const FrameContext& frame) const {
  const TrackerSample* t = frame.input.find(tracker);
  if (!t || !t->valid) return std::nullopt;
  const Nanoseconds start = frame.start(), end = frame.now.time;
  const Pose X_WR = rigPose();
  const bool rides = X_WR.p != rigStart_.p || X_WR.q.coeffs() != rigStart_.q.coeffs();
  Course way;
  const auto add = [&](Nanoseconds time, const Pose& X_RT, bool jump) {
    const double s = static_cast<double>(time - start) / static_cast<double>(end - start);
    const Pose X_WT = (rides && time < end ? det::interpolate(rigStart_, X_WR, s) : X_WR) * X_RT;
    jump = jump || way.empty() || teleported(way.back().X, X_WT, time - way.back().time);
    way.push_back({time, X_WT, jump});
  };
  if (const TrackerSample* was = lastInput_.find(tracker); was && was->valid && start < end) {
    add(start, was->X_RT, false);
    way.front().jump = false;
  }
  for (const PoseKnot& k : t->knots)
    if (k.X.finite() && k.time >= (way.empty() ? start : way.back().time) && k.time <= end)
      add(k.time, k.X, k.jump);
  if (way.empty() || way.back().time < end) add(end, t->X_RT, false);
  return way;
}

Pose Scene::headInRig(const InputSample& input) const {
  const TrackerSample* head = input.find("head");
  if (head && head->valid) return head->X_RT;
  return {Vec3(0, 0, rigs_.empty() ? 1.7 : rigs_.back().eyeHeight), Quat::Identity()};
}

}  // namespace stadion
