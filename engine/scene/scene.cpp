#include "engine/scene/scene.h"

#include "engine/nodes/object_node.h"

#include <algorithm>
#include <cassert>

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

Scene::Scene(SceneLoader& loader, MeshStore& meshes) : loader_(loader), meshes_(meshes) {}

Scene::~Scene() {
  while (!loads_.empty()) remove(loads_.rbegin()->first, 0);
}

bool Scene::open(const std::string& file) {
  const std::uint32_t number = requestLoad(file, {}, 0);
  applyLoads({});
  return loads_.contains(number);
}

void Scene::advance(const TimeSignature& now, const InputSample& input, ChangeSet& changes,
                    FrameProbe* probe) {
  counters_ = {};
  events_.clear();
  now_ = now.time;
  applyLoads(now);
  visit(now, input, probe);
  for (const NodeRef ref : touched_) {
    const auto at = loads_.find(ref.load);
    if (at != loads_.end() && at->second->nodes[ref.position]) rehash(*at->second->nodes[ref.position]);
  }
  touched_.clear();
  publish(now, input, changes);
}

// --- visiting
// --------------------------------------------------------------------------------------------------

void Scene::visit(const TimeSignature& now, const InputSample& input, FrameProbe* probe) {
  // Whom to visit: the busy, those with mail, those whose alarm rings, those who were woken after their turn.
  std::vector<Message> mail = messages_.takeDue(now.time);
  round_ = busy_;
  const auto call = [&](NodeRef ref) {
    Node* node = find(ref);
    if (node) round_.insert({node->rank(), ref});
    return node != nullptr;
  };
  for (const Message& m : mail) call(m.target) ? ++counters_.messagesDelivered : ++counters_.messagesLost;
  while (!wakes_.empty() && wakes_.begin()->at <= now.time) {
    call(wakes_.begin()->node);
    wakes_.erase(wakes_.begin());
  }
  std::vector<NodeRef> woken;
  woken.swap(wokenLate_);
  for (const NodeRef ref : woken) call(ref);
  wakeWatchers();
  std::stable_sort(mail.begin(), mail.end(),
                   [](const Message& a, const Message& b) { return a.target < b.target; });

  FrameContext frame{now, input, *this};
  while (!round_.empty()) {
    current_ = *round_.begin();
    round_.erase(round_.begin());
    Node* node = find(current_->node);
    if (!node) continue;
    const auto [first, last] =
        std::equal_range(mail.begin(), mail.end(), Message{0, {}, 0, current_->node, {}, {}, {}},
                         [](const Message& a, const Message& b) { return a.target < b.target; });
    node->cycle({first, last}, frame, probe);
    ++counters_.nodesVisited;
    setBusy(*node);
    rehash(*node);
    wakeWatchers();
  }
  current_.reset();
}

void Scene::wakeNow(NodeRef ref) {
  const Node* node = find(ref);
  if (!node) return;
  const Visit v{node->rank(), ref};
  if (current_ && *current_ < v)
    round_.insert(v);
  else if (!current_ || *current_ != v)
    wokenLate_.push_back(ref);
}

void Scene::watch(PlacementId placement, NodeRef watcher) {
  watchers_.insert({placement, watcher});
  placements_.watch(placement);
}

void Scene::unwatch(PlacementId placement, NodeRef watcher) {
  const auto [first, last] = watchers_.equal_range(placement);
  for (auto at = first; at != last; ++at)
    if (at->second == watcher) {
      watchers_.erase(at);
      return;
    }
}

void Scene::wakeWatchers() {
  for (const PlacementId p : placements_.takeMovedWatched()) {
    const auto [first, last] = watchers_.equal_range(p);
    // A node that moves what it watches does not wake itself.
    for (auto at = first; at != last; ++at)
      if (!current_ || current_->node != at->second) wakeNow(at->second);
  }
}

void Scene::setBusy(Node& node) {
  const Visit v{node.rank(), node.self()};
  if (node.busy())
    busy_.insert(v);
  else
    busy_.erase(v);
}

void Scene::wakeAt(Nanoseconds when, NodeRef node) {
  wakes_.insert({when, node});
}

// --- messages
// --------------------------------------------------------------------------------------------------

void Scene::post(const Node& sender, const Notification& n, Nanoseconds when) {
  Message m;
  m.due = when + n.delay;
  m.sender = sender.self();
  m.target = resolve(n.target, sender.self());
  m.verb = n.verb;
  m.arguments = n.arguments;
  if (!m.target.valid()) {
    ++counters_.messagesLost;
    return;
  }
  if (!n.arguments.empty()) m.node = resolve(n.arguments[0], sender.self());
  messages_.post(std::move(m));
}

bool Scene::command(const std::string& target, Verb verb, std::vector<std::string> arguments,
                    Nanoseconds when) {
  if (loads_.empty()) return false;
  const NodeRef root{loads_.begin()->first, 0};
  Message m;
  m.due = when;
  m.target = resolve(target, root);
  m.verb = verb;
  if (!arguments.empty()) m.node = resolve(arguments[0], root);
  m.arguments = std::move(arguments);
  if (!m.target.valid()) return false;
  messages_.post(std::move(m));
  return true;
}

void Scene::note(NodeRef node, Event event, Nanoseconds when) {
  events_.push_back({node, event, when});
}

// --- names
// -----------------------------------------------------------------------------------------------------

const Load* Scene::load(std::uint32_t number) const {
  const auto at = loads_.find(number);
  return at == loads_.end() ? nullptr : at->second.get();
}

Node* Scene::find(NodeRef ref) {
  const auto at = loads_.find(ref.load);
  if (at == loads_.end() || ref.position >= at->second->nodes.size()) return nullptr;
  Load& load = *at->second;
  if (load.nodes[ref.position]) return load.nodes[ref.position].get();
  const auto s = std::lower_bound(load.statics.begin(), load.statics.end(), ref.position,
                                  [](const StaticObject& o, std::uint32_t p) { return o.position < p; });
  if (s == load.statics.end() || s->position != ref.position) return nullptr;
  return promote(load, static_cast<std::size_t>(s - load.statics.begin()));
}

NodeRef Scene::resolve(const std::string& name, NodeRef from) const {
  const std::size_t slash = name.find('/');
  const std::string head = name.substr(0, slash);
  NodeRef found;
  for (const Load* l = load(from.load); l && !found.valid(); l = load(l->owner.load)) found = l->find(head);
  std::size_t at = slash;
  while (found.valid() && at != std::string::npos) {
    const std::size_t next = name.find('/', at + 1);
    const std::string part = name.substr(at + 1, next == std::string::npos ? next : next - at - 1);
    NodeRef inner;
    for (const auto& [number, l] : loads_)
      if (l->owner == found) inner = l->find(part);
    found = inner;
    at = next;
  }
  return found;
}

PlacementId Scene::placementFor(NodeRef parent, NodeRef child) {
  if (!parent.valid()) {
    const Load* own = load(child.load);
    if (!own || !own->owner.valid()) return kWorldPlacement;
    parent = own->owner;
  }
  const auto* placed = dynamic_cast<const PlacedNode*>(find(parent));
  return placed && placed->placement() != kNoPlacement ? placed->placement() : kWorldPlacement;
}

// --- static objects
// --------------------------------------------------------------------------------------------

NodeRef Scene::parentOf(NodeRef ref) const {
  const Load* l = load(ref.load);
  if (!l) return {};
  NodeRef parent;
  if (const auto* placed = dynamic_cast<const PlacedNode*>(l->nodes[ref.position].get()))
    parent = placed->attributes().parent;
  else {
    const auto s = std::lower_bound(l->statics.begin(), l->statics.end(), ref.position,
                                    [](const StaticObject& o, std::uint32_t p) { return o.position < p; });
    if (s != l->statics.end() && s->position == ref.position) parent = s->parent;
  }
  return parent.valid() ? parent : l->owner;
}

bool Scene::isBelow(NodeRef ref, NodeRef ancestor) const {
  for (NodeRef at = parentOf(ref); at.valid(); at = parentOf(at))
    if (at == ancestor) return true;
  return false;
}

void Scene::promoteBelow(NodeRef ref) {
  for (auto& [number, l] : loads_)
    for (std::size_t i = 0; i < l->statics.size(); ++i) {
      const NodeRef self{number, l->statics[i].position};
      if (!l->nodes[self.position] && isBelow(self, ref)) promote(*l, i);
    }
}

Node* Scene::promote(Load& load, std::size_t index, const Affine& moved) {
  const StaticObject& object = load.statics[index];
  const InstanceRecord& record = load.chunkRecords[index];
  const NodeRef self{load.number, object.position};
  PlaceAttributes place;
  place.parent = object.parent;
  Appearance appearance;
  appearance.mesh = record.mesh;
  appearance.drawn = (record.flags & InstanceRecord::kShown) != 0;
  std::string name;
  for (const auto& [n, position] : load.names)
    if (position == object.position) name = n;
  auto node = std::make_unique<ObjectNode>(NodeKind::Object, self, std::move(name), place, appearance);
  ObjectNode& added = *node;
  load.nodes[object.position] = std::move(node);
  load.enterOrder.push_back(object.position);
  enterNode(added);
  Affine X_WN;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 4; ++col) X_WN.matrix()(row, col) = record.model[4 * row + col];
  added.becomeHome(*this, moved * X_WN);
  staticChanges_.push_back({load.chunk, static_cast<std::uint32_t>(index), true});
  return &added;
}

// --- loading and unloading
// -------------------------------------------------------------------------------------

std::uint32_t Scene::requestLoad(const std::string& file, NodeRef owner, Nanoseconds at) {
  const std::uint32_t number = nextLoad_++;
  const auto* placed = owner.valid() ? dynamic_cast<const PlacedNode*>(find(owner)) : nullptr;
  loader_.request(number, file, owner, placed ? placements_.world(placed->placement()) : Affine::Identity());
  pendingLoads_.push_back({at, number, true});
  return number;
}

void Scene::requestUnload(std::uint32_t number, Nanoseconds at) {
  // A load that has not arrived yet is taken back as soon as it arrives.
  pendingLoads_.push_back({at, number, false});
}

void Scene::applyLoads(const TimeSignature& now) {
  // Installing a load may ask for more of them (sub-scenes that are there from the start).
  for (std::size_t i = 0; i < pendingLoads_.size();) {
    const Change change = pendingLoads_[i];
    if (change.at > now.time) {
      ++i;
      continue;
    }
    pendingLoads_.erase(pendingLoads_.begin() + static_cast<std::ptrdiff_t>(i));
    if (!change.load)
      remove(change.number, now.frame);
    else if (auto load = loader_.take(change.number))
      install(std::move(load));
    i = 0;
  }
}

void Scene::install(std::unique_ptr<Load> arrived) {
  Load& load = *arrived;
  if (load.owner.valid() && !find(load.owner)) {  // its scene node has gone meanwhile
    loader_.dispose(std::move(arrived), 0);
    return;
  }
  loads_[load.number] = std::move(arrived);
  ++loadsVersion_;
  for (const std::uint32_t position : load.enterOrder) enterNode(*load.nodes[position]);
  if (load.chunk != kNoChunk) chunkChanges_.push_back({load.chunk, true});
  auto* owner = dynamic_cast<PlacedNode*>(load.owner.valid() ? find(load.owner) : nullptr);
  if (!owner || load.statics.empty()) return;
  owner->carryStatics();
  // Its scene node has moved since the load was asked for: what was placed then must follow.
  const Affine& X_WO = placements_.world(owner->placement());
  if (X_WO.matrix() == load.X_WO.matrix()) return;
  const Affine moved = X_WO * load.X_WO.inverse();
  for (std::size_t i = 0; i < load.statics.size(); ++i) promote(load, i, moved);
}

void Scene::enterNode(Node& node) {
  node.enter(*this);
  setBusy(node);
  rehash(node);
}

void Scene::leaveNode(Node& node) {
  node.leave(*this);
  busy_.erase({node.rank(), node.self()});
  if (const auto h = hashes_.find(node.self()); h != hashes_.end()) {
    hashSum_ -= h->second;
    hashes_.erase(h);
  }
}

void Scene::remove(std::uint32_t number, std::uint64_t frame) {
  const auto at = loads_.find(number);
  if (at == loads_.end()) return;
  // What this load brought in itself goes first.
  std::vector<std::uint32_t> inner;
  for (const auto& [n, l] : loads_)
    if (l->owner.load == number) inner.push_back(n);
  for (auto n = inner.rbegin(); n != inner.rend(); ++n) remove(*n, frame);
  std::erase_if(pendingLoads_, [&](const Change& c) { return c.number == number; });

  Load& load = *at->second;
  for (auto p = load.enterOrder.rbegin(); p != load.enterOrder.rend(); ++p) leaveNode(*load.nodes[*p]);
  if (load.chunk != kNoChunk) chunkChanges_.push_back({load.chunk, false});
  std::erase_if(staticChanges_, [&](const ChangeSet::StaticItem& s) { return s.chunk == load.chunk; });
  std::unique_ptr<Load> gone = std::move(at->second);
  loads_.erase(at);
  ++loadsVersion_;
  loader_.dispose(std::move(gone), frame);
}

// --- what is drawn
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

// --- the visitor
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
  const Affine& X = placements_.world(rigs_.back().placement);
  // Scale has no meaning for the rig: its axes are made orthonormal again, forward (+Y) first.
  const Vec3 y = X.linear().col(1).normalized();
  const Vec3 x = (X.linear().col(0) - y * y.dot(X.linear().col(0))).normalized();
  Mat3 R;
  R << x, y, x.cross(y);
  return {X.translation(), Quat(R).normalized()};
}

std::optional<Pose> Scene::trackerInWorld(const std::string& tracker, const InputSample& input) const {
  const TrackerSample* t = input.find(tracker);
  if (!t || !t->valid) return std::nullopt;
  return rigPose() * t->X_RT;
}

Pose Scene::headInRig(const InputSample& input) const {
  const TrackerSample* head = input.find("head");
  if (head && head->valid) return head->X_RT;
  return {Vec3(0, 0, rigs_.empty() ? 1.7 : rigs_.back().eyeHeight), Quat::Identity()};
}

// --- the state hash
// --------------------------------------------------------------------------------------------

std::uint64_t Scene::nodeHash(const Node& node) const {
  StateHash h((std::uint64_t{node.self().load} << 32) | node.self().position);
  node.hash(h);
  return h.value();
}

void Scene::rehash(const Node& node) {
  // A sum over all nodes can be kept up by the change of one; each term knows its node's identity.
  std::uint64_t& known = hashes_[node.self()];
  const std::uint64_t now = nodeHash(node);
  hashSum_ += now - known;
  known = now;
}

std::uint64_t Scene::stateHash() const {
  StateHash h(hashSum_);
  h.add(now_);
  h.add(freeRig_);
  for (const auto& [number, l] : loads_) h.add(number);
  std::uint64_t pending = 0;
  for (const Message& m : messages_.pending()) {
    StateHash one(m.sequence);
    one.add(m.due), one.add(m.sender), one.add(m.target), one.add(static_cast<std::uint32_t>(m.verb));
    for (const std::string& a : m.arguments) one.add(std::string_view(a));
    pending += one.value();
  }
  h.add(pending);
  for (const Wake& w : wakes_) h.add(w.at), h.add(w.node);
  for (const Change& c : pendingLoads_) h.add(c.at), h.add(c.number), h.add(c.load);
  return h.value();
}

void Scene::forEachNode(const std::function<void(const Node&)>& f) const {
  for (const auto& [number, l] : loads_)
    for (const auto& node : l->nodes)
      if (node) f(*node);
}

}  // namespace stadion
