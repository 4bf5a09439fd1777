// The scene's state, written down and put back (engine/core/state_fields.h). What follows from it by the same
// computation, such as what is published, is made anew.

#include "engine/scene/placed_node.h"
#include "engine/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace stadion {

constexpr Node::Missed lastOf(Node::Missed) {
  return Node::Missed::Time;
}

namespace {

/// Of what is written: older ones mean something else.
constexpr std::uint32_t kVersion = 3;
constexpr std::uint32_t kWithPlugins = 4;                   ///< the same with the names of plugins
constexpr Nanoseconds kLatest = 1'000'000'000'000'000'000;  ///< thirty years of a show [ns]

std::string pluginsOr(const std::string& plugins) {
  return plugins.empty() ? "no plugins" : "the plugins " + plugins;
}

}  // namespace

std::vector<std::uint8_t> Scene::save() {
  SavedState out;
  visitAll(out);
  return out.take();
}

std::uint64_t Scene::digest() {
  StateDigest digest;
  visitAll(digest);
  std::uint64_t files = this->files();
  digest("files", files);
  return digest.value();
}

// A mesh is known by what it consists of (MeshStore).
std::uint64_t Scene::files() const {
  StateHash hash;
  for (const auto& [number, l] : loads_) {
    hash.add(number), hash.add(l->script);
    for (const MeshId mesh : l->meshes) hash.add(mesh);
  }
  return hash.value();
}

void Scene::visitAll(StateFields& f) {
  std::string plugins = loader_.plugins();
  std::uint32_t version = plugins.empty() ? kVersion : kWithPlugins;
  f("version", version);
  if (version == kWithPlugins) f("plugins", plugins);
  visitLoads(f);
  placements_.state(f);
  visitRest(f);
  visitNodes(f);
}

std::optional<std::string> Scene::restore(std::span<const std::uint8_t> state, const std::string& script) {
  script_ = script;
  RestoredState in(state);
  std::uint32_t version = 0;
  in("version", version);
  if (version != kVersion && version != kWithPlugins) return "it is none, or another version has written it";
  std::string plugins;
  if (version == kWithPlugins) in("plugins", plugins);
  if (!in.failed() && plugins != loader_.plugins())
    return fmt::format("it was saved with {}, and this program has {}", pluginsOr(plugins),
                       pluginsOr(loader_.plugins()));
  visitLoads(in);
  if (!in.failed()) placements_.state(in);
  if (!in.failed()) visitRest(in);
  if (!in.failed()) visitNodes(in);
  std::optional<std::string> why = "it does not fit the scripts and models that are here";
  if (in.complete() && standsTogether()) why = resume();
  if (!why) return {};
  // Nodes that have been put back only in part must not act any more, not even to leave.
  for (auto& [number, load] : std::exchange(loads_, {})) loader_.dispose(std::move(load), 0);
  return why;
}

/// Which files are there, and which are asked for.
void Scene::visitLoads(StateFields& f) {
  f("next load", nextLoad_), f("asked for", asked_), f("pending", pendingLoads_);
  std::vector<std::uint32_t> there;
  for (const auto& [number, l] : loads_) there.push_back(number);
  f("loads", there);
  if (f.restores()) {
    // Who asks for a file has come with an earlier one, and says where it is to be.
    for (const auto& [number, asked] : asked_) {
      if (asked.owner.load >= number || !asked.X_WO.matrix().allFinite()) return f.fail();
      if (!asked.owner.valid() && asked.X_WO.matrix() != Affine::Identity().matrix()) return f.fail();
    }
    for (auto& [number, asked] : asked_) {
      if (!asked.owner.valid()) asked.file = script_;
      loader_.request(number, asked.file, asked.owner, asked.X_WO);
    }
    for (const std::uint32_t number : there) {
      auto load = asked_.contains(number) && !loads_.contains(number) ? loader_.take(number) : nullptr;
      if (!load) return f.fail();
      loads_[number] = std::move(load);
    }
  }
  for (const std::uint32_t number : there)
    if (!f.failed()) visitLoad(f, number);
}

void Scene::visitLoad(StateFields& f, std::uint32_t number) {
  Load& l = *loads_.at(number);
  f("since", l.since), f("until", l.until), f("chunk", l.chunkShown);
  // Static objects that have become nodes, in the order in which they have.
  std::vector<std::uint32_t> order = l.enterOrder;
  f("order", order);
  if (!f.restores()) return;
  const bool longer = order.size() >= l.enterOrder.size() &&
                      std::equal(l.enterOrder.begin(), l.enterOrder.end(), order.begin());
  if (!longer) return f.fail();
  for (std::size_t i = l.enterOrder.size(); i < order.size(); ++i) {
    const auto s = std::ranges::lower_bound(l.statics, order[i], {}, &StaticObject::position);
    if (s == l.statics.end() || s->position != order[i] || l.nodes[order[i]]) return f.fail();
    nodeInsteadOf(l, static_cast<std::size_t>(s - l.statics.begin()));
  }
  if (l.chunkShown && l.chunk != kNoChunk) chunkChanges_.push_back({l.chunk, true});
}

/// All that belongs to no node.
void Scene::visitRest(StateFields& f) {
  f("now", now_), f("frame", frame_), f("frame start", frameStart_);
  f("instances", instances_), f("free instances", freeInstances_), f("instances at", instancesAt_);
  f("lights", lights_), f("lights at", lightsAt_), f("shining", shining_), f("told of lights", toldOfLights_);
  f("sounds", sounds_), f("skies", skies_), f("rigs", rigs_), f("rig", freeRig_);
  f("chunks shown", chunksShown_);
  f("messages", messages_), f("wakes", wakes_), f("woken", wokenLate_);
  f("relief levels", reliefLevels_), f("reliefs", reliefs_), f("relief loads", reliefLoads_);
  f("stress", stressLevel_), f("put off", putOff_), f("paced", paced_);
  f("watchers", watchers_), f("load watchers", loadWatchers_), f("impact watchers", impactWatchers_);
  f("loads version", loadsVersion_), f("loads told", loadsTold_);
  f("levels' loads", levelsLoads_), f("levels settled", levelsSettled_);
  f("last input", lastInput_), f("shadow rings", shadowPlaces_);
}

void Scene::visitNodes(StateFields& f) {
  for (const auto& [number, l] : loads_)
    for (const std::uint32_t position : l->enterOrder) {
      visitNode(f, *l->nodes[position]);
      if (f.failed()) return;
    }
}

void Scene::visitNode(StateFields& f, Node& node) {
  Node::Standing& s = node.standing();
  f("rests", s.rests), f("pace", s.pace), f("missed", s.missed), f("level", s.level);
  if (f.restores() && s.pace > levelsOf(Concession::Half)) return f.fail();
  node.state(f);
  f.about(0);
}

// What is seen of a node, such as where it is, follows from the node: whoever asks wants to know which.
std::optional<Scene::Difference> Scene::difference(std::span<const std::uint8_t> there) {
  StateDifference d(there);
  const auto found = [&](NodeRef node) -> std::optional<Difference> {
    if (!d.first()) return {};
    return Difference{node, d.first()->name, d.first()->here, d.first()->there};
  };
  std::uint32_t version = kVersion;
  d("version", version);
  visitLoads(d);
  placements_.state(d);
  visitRest(d);
  const auto elsewhere = found({});
  d.next();
  for (const auto& [number, l] : loads_)
    for (const std::uint32_t position : l->enterOrder) {
      const Node& node = *l->nodes[position];
      visitNode(d, *l->nodes[position]);
      if (d.first()) return found(d.first()->part ? node.nodeOf(d.first()->part) : node.self());
    }
  return elsewhere;
}

/// Whether whatever names a placement, an instance or a node's place in a list names one that is there.
bool Scene::standsTogether() const {
  if (now_ < 0 || now_ > kLatest || frameStart_ < 0 || frameStart_ > now_ || stressLevel_ > kMostStress)
    return false;
  for (const Change& c : pendingLoads_)
    if (c.load && (!asked_.contains(c.number) || loads_.contains(c.number))) return false;
  for (const auto& [node, relief] : reliefs_)
    if (relief.pace > levelsOf(Concession::Half) || !std::isfinite(relief.lod)) return false;
  for (const TrackerSample& t : lastInput_.trackers)
    if (!t.X_RT.finite() || !std::ranges::all_of(t.knots, &Pose::finite, &PoseKnot::X)) return false;
  const auto placement = [&](PlacementId id) { return placements_.has(id); };
  for (const Instance& i : instances_)
    if (i.live && (!placement(i.placement) || i.placement >= instancesAt_.size())) return false;
  std::vector<char> seen(instances_.size(), 0);
  for (InstanceId id : instancesAt_)
    for (; id != kNoInstance; id = instances_[id].next)
      if (id >= instances_.size() || !instances_[id].live || std::exchange(seen[id], 1)) return false;
  for (InstanceId id = 0; id < instances_.size(); ++id)
    if (instances_[id].live != (seen[id] != 0)) return false;
  const auto free = [&](InstanceId id) { return id < instances_.size() && !instances_[id].live; };
  if (!std::ranges::all_of(freeInstances_, free)) return false;
  if (std::set(freeInstances_.begin(), freeInstances_.end()).size() != freeInstances_.size()) return false;
  for (const Light& l : lights_)
    if (l.live && (!placement(l.placement) || l.placement >= lightsAt_.size())) return false;
  if (std::ranges::any_of(shining_, [&](std::size_t h) { return h >= lights_.size(); })) return false;
  for (const SoundSpot& s : sounds_)
    if (s.live && !placement(s.placement)) return false;
  for (const Rig& r : rigs_)
    if (!placement(r.placement)) return false;
  for (const auto& [id, watcher] : watchers_)
    if (!placement(id)) return false;
  // No node is World, and no two are one.
  std::set<PlacementId> ofNodes{kWorldPlacement};
  for (const auto& [number, l] : loads_)
    for (const std::uint32_t position : l->enterOrder) {
      Node& node = *l->nodes[position];
      const PlacedNode* placed = node.placed();
      if (placed && !(placement(placed->placement()) && ofNodes.insert(placed->placement()).second))
        return false;
      const auto paced = paced_.find(node.self());
      const bool misses = node.standing().missed != Node::Missed::Nothing;
      if (misses && (paced == paced_.end() || paced->second.since < 0 || paced->second.since > now_))
        return false;
    }
  return true;
}

/// What was put back takes effect: nodes know the scene again, everything is published anew. Else why not.
std::optional<std::string> Scene::resume() {
  for (InstanceId id = 0; id < instances_.size(); ++id) {
    Instance& i = instances_[id];
    if (!i.live) continue;
    i.form = i.mesh == kNoMesh ? nullptr : meshes_.find(i.mesh);
    i.transparent = i.form && i.form->transparent();
    i.leveled = i.form && !i.form->levels.empty();
    markInstance(id);
  }
  lightsChanged_ = true;
  for (const auto& [number, l] : loads_)
    for (const std::uint32_t position : l->enterOrder)
      if (const auto& node = l->nodes[position]; !node->resume(*this))
        return fmt::format("the node {} cannot go on from it", node->name());
  // Some make theirs only now; what nobody has is of other files.
  for (const Instance& i : instances_)
    if (i.live && i.mesh != kNoMesh && !i.form) return "a model that it shows is not here";
  for (const auto& [number, l] : loads_)
    for (const std::uint32_t position : l->enterOrder) {
      setBusy(*l->nodes[position]);
      rehash(*l->nodes[position]);
    }
  agenda_.reorder();  // nodes that were busy before had no levels yet
  return {};
}

}  // namespace stadion
