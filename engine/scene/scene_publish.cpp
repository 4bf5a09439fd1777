#include "engine/scene/scene.h"

#include "engine/maths/functions.h"
#include "engine/scene/placed_node.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

namespace stadion {
namespace {

/// What shines on a show that declares no light.
LightRecord afternoonSun() {
  LightRecord sun;
  const Vec3 direction = Vec3(-0.45, 0.35, -0.8).normalized();
  const float colour[3] = {1.0f, 0.96f, 0.88f};
  for (int i = 0; i < 3; ++i) sun.direction[i] = direction[i], sun.colour[i] = colour[i];
  sun.range = 1;
  return sun;
}

/// How much of the light arrives at p, as the shaders have it (a spot's cone does not count: it may light
/// what is seen).
double brightnessAt(const Vec3& p_W, const LightRecord& light) {
  const double colour =
      0.2126 * double{light.colour[0]} + 0.7152 * double{light.colour[1]} + 0.0722 * double{light.colour[2]};
  if (light.kind == 0) return colour;
  const double squared = (Vec3(light.position[0], light.position[1], light.position[2]) - p_W).squaredNorm();
  const double range = double{light.range};
  return colour / (1 + (range > 0 ? squared / (range * range) : 0));
}

}  // namespace

InstanceId Scene::addInstance(PlacementId placement, MeshId mesh, bool drawn, NodeRef owner) {
  InstanceId id;
  if (freeInstances_.empty()) {
    id = static_cast<InstanceId>(instances_.size());
    instances_.emplace_back();
  } else {
    id = freeInstances_.back();
    freeInstances_.pop_back();
  }
  Instance& i = instances_[id];
  i.placement = placement, i.owner = owner, i.drawn = drawn, i.live = true;
  if (instancesAt_.size() <= placement) instancesAt_.resize(placement + std::size_t{1}, kNoInstance);
  i.next = std::exchange(instancesAt_[placement], id);
  setMesh(id, mesh);
  return id;
}

void Scene::setDrawn(InstanceId id, bool drawn) {
  instances_[id].drawn = drawn;
  markInstance(id);
}

void Scene::removeInstance(InstanceId id) {
  Instance& i = instances_[id];
  InstanceId* at = &instancesAt_[i.placement];
  while (*at != id) at = &instances_[*at].next;
  *at = i.next;
  i.live = false;
  markInstance(id);
  freeInstances_.push_back(id);
}

void Scene::setMesh(InstanceId id, MeshId mesh) {
  Instance& i = instances_[id];
  i.mesh = mesh;
  i.form = mesh == kNoMesh ? nullptr : meshes_.find(mesh);
  i.transparent = i.form && i.form->transparent();
  i.leveled = i.form && !i.form->levels.empty();
  markInstance(id);
}

/// This frame is not published yet: the last one that may show the mesh came before it.
void Scene::releaseMesh(MeshId mesh) {
  if (mesh != kNoMesh) meshes_.release(mesh, frame_);
}

void Scene::markInstance(InstanceId id) {
  if (instances_[id].changed) return;
  instances_[id].changed = true;
  changedInstances_.push_back(id);
}

void Scene::markInstancesAt(PlacementId placement) {
  if (placement >= instancesAt_.size()) return;
  for (InstanceId id = instancesAt_[placement]; id != kNoInstance; id = instances_[id].next) markInstance(id);
}

std::size_t Scene::addLight(PlacementId placement, const LightRecord& local, NodeRef node) {
  lightsChanged_ = true;
  auto at = std::find_if(lights_.begin(), lights_.end(), [](const Light& l) { return !l.live; });
  if (at == lights_.end()) at = lights_.insert(lights_.end(), Light{});
  *at = {placement, local, node, true, true};
  if (lightsAt_.size() <= placement) lightsAt_.resize(placement + 1);
  ++lightsAt_[placement];
  return static_cast<std::size_t>(at - lights_.begin());
}

void Scene::setLight(std::size_t handle, const LightRecord& local, bool on) {
  lights_[handle].local = local;
  lights_[handle].on = on;
  lightsChanged_ = true;
}

void Scene::removeLight(std::size_t handle) {
  lights_[handle].live = false;
  --lightsAt_[lights_[handle].placement];
  lightsChanged_ = true;
}

std::size_t Scene::addSound(PlacementId placement) {
  auto at = std::find_if(sounds_.begin(), sounds_.end(), [](const SoundSpot& s) { return !s.live; });
  if (at == sounds_.end()) at = sounds_.insert(sounds_.end(), SoundSpot{});
  *at = {placement, {}, false, true};
  return static_cast<std::size_t>(at - sounds_.begin());
}

void Scene::setSound(std::size_t handle, bool on, const SoundRecord& sound) {
  sounds_[handle].on = on;
  sounds_[handle].sound = sound;
}

void Scene::removeSound(std::size_t handle) {
  sounds_[handle] = {};
}

void Scene::listen(const InputSample& input, SoundScape& out) const {
  out.time = now_;
  out.X_WH = rigPose() * headInRig(input);
  out.sounds.clear();
  for (const SoundSpot& s : sounds_) {
    if (!s.on) continue;
    out.sounds.push_back(s.sound);
    out.sounds.back().position = placements_.world(s.placement).translation();
  }
}

void Scene::publish(const TimeSignature& now, const InputSample& input, ChangeSet& changes) {
  changes.clear();
  changes.signature = now;
  changes.chunks.swap(chunkChanges_);
  changes.statics.swap(staticChanges_);
  // What moved and nothing else needs no mark. The rest is marked, so that it goes once.
  for (const PlacementId p : placements_.takeChanged()) {
    if (hasInstances(p)) publishAt(p, placements_.world(p), placements_.shown(p), changes);
    lightsChanged_ |= hasLights(p);
  }
  placements_.takeMovedFleets([&](std::span<const PlacementId> ids, std::span<const MemberPlace> places) {
    publishFleet(ids, places, changes);
  });
  for (const InstanceId id : changedInstances_) {
    const Instance& i = instances_[id];
    instances_[id].changed = false;
    const PlacementId p = i.live ? i.placement : kWorldPlacement;
    publishInstance(i, id, placements_.world(p), placements_.shown(p), changes);
  }
  changedInstances_.clear();
  handOn(changes);
  if (lightsChanged_ || !shining_.empty()) publishLights(input, changes);
  changes.sky = skies_.empty() ? SkyRecord{} : skies_.back().record;
  look(input, changes);
  changes.viewer.poseTime = input.time;
  changes.viewer.stress = stress();
}

void Scene::look(const InputSample& input, ChangeSet& changes) const {
  changes.viewer.set(rigPose(), headInRig(input));
  ShadowPlaces rings = shadowPlaces_;
  changes.shadows = rings.follow(changes.viewer.headInWorld());
}

/// All but where it is.
inline void Scene::describe(const Instance& i, bool shown, InstanceRecord& r) const {
  r.mesh = i.mesh, r.owner = i.owner;
  r.flags =
      (i.drawn && shown ? InstanceRecord::kShown : 0) | (i.transparent ? InstanceRecord::kTransparent : 0);
  r.lodFactor = i.leveled ? static_cast<float>(reliefOf(i.owner).lod) : 0;
}

/// Hands on those before it, when there are enough.
inline InstanceRecord& Scene::nextRecord(InstanceId id, ChangeSet& changes) {
  if (changes.instances.size() >= ChangeSet::kBlock) handOn(changes);
  ++counters_.changesPublished;
  ChangeSet::Instance& change = changes.instances.emplace_back();
  change.id = id;
  return change.record;
}

/// Those that stand there and are not marked.
void Scene::publishAt(PlacementId p, const Affine& X_WN, bool shown, ChangeSet& changes) {
  for (InstanceId id = instancesAt_[p]; id != kNoInstance; id = instances_[id].next)
    if (!instances_[id].changed) publishInstance(instances_[id], id, X_WN, shown, changes);
}

void Scene::publishFleet(std::span<const PlacementId> ids, std::span<const MemberPlace> places,
                         ChangeSet& changes) {
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const PlacementId p = ids[k];
    lightsChanged_ |= hasLights(p);
    if (p >= instancesAt_.size()) continue;  // kNoPlacement, too
    for (InstanceId id = instancesAt_[p]; id != kNoInstance; id = instances_[id].next) {
      const Instance& i = instances_[id];
      if (i.changed || !i.form) continue;
      InstanceRecord& r = nextRecord(id, changes);
      placeInstance(r, places[k].rows, places[k].widens, i.form->sphere);
      describe(i, true, r);
    }
  }
}

void Scene::publishInstance(const Instance& i, InstanceId id, const Affine& X_WN, bool shown,
                            ChangeSet& changes) {
  InstanceRecord& r = nextRecord(id, changes);
  if (!i.live || !i.form) {
    r = InstanceRecord{};
    r.radius = -1;
    return;
  }
  if (const std::optional<MemberPlace> member = placements_.inFleet(i.placement))
    placeInstance(r, member->rows, member->widens, i.form->sphere);
  else
    placeInstance(r, X_WN, i.form->sphere);
  describe(i, shown, r);
}

void Scene::handOn(ChangeSet& changes) {
  if (!changes.sink || changes.instances.empty()) return;
  changes.sink->take(changes.instances);
  changes.instances.clear();
}

void Scene::findLightsThatShine() {
  wanted_.clear();
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].live && lights_[i].on && placements_.shown(lights_[i].placement)) wanted_.push_back(i);
}

/// Those that are brightest where the visitor is; among equals the one that came first.
void Scene::chooseLights(const Vec3& head_W) {
  chosen_ = wanted_;
  if (wanted_.size() <= kMostLights) return;
  brightest_.clear();
  for (const std::size_t h : wanted_)
    brightest_.emplace_back(-brightnessAt(head_W, lightInWorld(lights_[h])), h);
  std::sort(brightest_.begin(), brightest_.end(), [this](const auto& a, const auto& b) {
    return std::tie(a.first, lights_[a.second].node) < std::tie(b.first, lights_[b.second].node);
  });
  chosen_.clear();
  for (std::size_t i = 0; i < kMostLights; ++i) chosen_.push_back(brightest_[i].second);
  std::sort(chosen_.begin(), chosen_.end());
  tellOfTooManyLights();
}

LightRecord Scene::lightInWorld(const Light& light) const {
  LightRecord r = light.local;
  r.owner = light.node;
  const Affine& X_WN = placements_.world(light.placement);
  const Vec3 p = X_WN * Vec3(r.position[0], r.position[1], r.position[2]);
  const Vec3 d = (X_WN.linear() * Vec3(r.direction[0], r.direction[1], r.direction[2])).stableNormalized();
  for (int k = 0; k < 3; ++k) r.position[k] = p[k], r.direction[k] = d[k];
  return r;
}

void Scene::publishLights(const InputSample& input, ChangeSet& changes) {
  findLightsThatShine();
  chooseLights(rigPose() * headInRig(input).p);
  const bool tooMany = wanted_.size() > kMostLights;
  const bool same = tooMany && chosen_ == shining_;
  shining_.clear();
  if (tooMany) shining_ = chosen_;
  if (same && !lightsChanged_) return;
  lightsChanged_ = false;
  changes.lightsChanged = true;
  const bool anyLight = std::any_of(lights_.begin(), lights_.end(), [](const Light& l) { return l.live; });
  if (!anyLight) changes.lights.push_back(afternoonSun());
  for (const std::size_t h : chosen_) changes.lights.push_back(lightInWorld(lights_[h]));
}

void Scene::tellOfTooManyLights() {
  if (toldOfLights_) return;
  toldOfLights_ = true;
  constexpr std::size_t kMostNames = 5;
  SourcePosition where;
  std::string names;
  std::size_t dark = 0;
  for (const std::size_t h : wanted_) {
    if (std::binary_search(chosen_.begin(), chosen_.end(), h)) continue;
    const NodeRef node = lights_[h].node;
    const Load* from = load(node.load);
    const std::uint32_t line =
        from && node.position < from->lines.size() ? from->lines[node.position] : std::uint32_t{0};
    if (dark == 0 && from) where = {from->file, line, line > 0 ? 1u : 0u};
    if (dark++ >= kMostNames) continue;
    const Node* light = from ? from->nodes[node.position].get() : nullptr;
    names += names.empty() ? "" : ", ";
    names += light && !light->name().empty() ? "\"" + light->name() + "\"" : "line " + std::to_string(line);
  }
  if (dark > kMostNames) names += " and " + std::to_string(dark - kMostNames) + " more";
  loader_.report({Severity::Warning,
                  where,
                  std::to_string(wanted_.size()) + " lights are on, of which the " +
                      std::to_string(kMostLights) +
                      " brightest where the visitor is shine; dark at the moment: " + names,
                  {}});
}

void Scene::setSky(NodeRef node, const SkyRecord& sky) {
  for (Sky& s : skies_)
    if (s.node == node) s.record = sky;
}

void Scene::removeSky(NodeRef node) {
  std::erase_if(skies_, [&](const Sky& s) { return s.node == node; });
}

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

const Course* Scene::trackerCourse(const std::string& tracker, const FrameContext& frame) {
  const TrackerSample* t = frame.input.find(tracker);
  if (!t || !t->valid) return nullptr;
  // Who has not looked for some frames: where it was before this one nobody remembers.
  const Nanoseconds start = frameStart_, end = frame.now.time;
  Course& way = trackerWay_;
  way.clear();
  // Only the tracker can jump: how the rig has moved is known.
  const auto add = [&](Nanoseconds time, const Pose& X_RT, bool jump) {
    way.push_back({time, X_RT, jump || way.empty() || teleported(way.back().X, X_RT, time - way.back().time)});
  };
  if (const TrackerSample* was = lastInput_.find(tracker); was && was->valid && start < end) {
    add(start, was->X_RT, false);
    way.front().jump = false;
  }
  for (const PoseKnot& k : t->knots)
    if (k.X.finite() && k.time >= (way.empty() ? start : way.back().time) && k.time <= end)
      add(k.time, k.X, k.jump);
  if (way.empty() || way.back().time < end) add(end, t->X_RT, false);
  rideAlong(way, start, end);
  return &way;
}

/// From the rig's coordinates to World.
void Scene::rideAlong(Course& way, Nanoseconds start, Nanoseconds end) {
  const Pose X_WR = rigPose();
  Course &rig = rigWay_, &ridden = riddenWay_;
  rig.clear(), ridden.clear();
  if (!rigs_.empty()) {
    rig = courses_.within(rigs_.back().placement, rigStart_, start, end, placements_);
  } else if (X_WR.p != rigStart_.p || X_WR.q.coeffs() != rigStart_.q.coeffs()) {
    rig.push_back({start, rigStart_, false}), rig.push_back({end, X_WR, false});
  }
  if (rig.empty()) {
    for (PoseKnot& k : way) k.X = X_WR * k.X;
    return;
  }
  const Nanoseconds known = way.front().time;
  const auto add = [&](Nanoseconds time, const Pose& X_RT, bool jump) {
    const bool arrived = time == end && (jump || !rig.back().jump);
    const Pose X = arrived ? rig.back().X : poseOn(rig, time, jump ? Limit::After : Limit::Before);
    ridden.push_back({time, X * X_RT, jump});
  };
  std::size_t next = 0;
  for (const PoseKnot& k : way) {
    for (; next < rig.size() && rig[next].time < k.time; ++next)
      if (rig[next].time > known) add(rig[next].time, poseOn(way, rig[next].time, Limit::Before), rig[next].jump);
    add(k.time, k.X, k.jump || jumpsAt(rig, k.time));
    while (next < rig.size() && rig[next].time == k.time) ++next;
  }
  way.swap(ridden);
}

Pose Scene::headInRig(const InputSample& input) const {
  const TrackerSample* head = input.find("head");
  if (head && head->valid) return head->X_RT;
  return {Vec3(0, 0, rigs_.empty() ? 1.7 : rigs_.back().eyeHeight), Quat::Identity()};
}

}  // namespace stadion
