#include "engine/scene/scene_snapshot.h"

#include "engine/core/named_state.h"
#include "engine/core/state_fields.h"
#include "engine/scene/placed_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace stadion {

constexpr Node::Missed lastOf(Node::Missed) {
  return Node::Missed::Time;
}

namespace {

/// Of the format; snapshots of other versions mean something else.
constexpr std::uint32_t kVersion = 11;
constexpr std::uint32_t kWithPlugins = 12;                  ///< the same with the names of plugins
constexpr Nanoseconds kLatest = 1'000'000'000'000'000'000;  ///< thirty years of a show [ns]

std::string pluginsOr(const std::string& plugins) {
  return plugins.empty() ? "no plugins" : "the plugins " + plugins;
}

}  // namespace

std::vector<std::uint8_t> SceneSnapshot::save() {
  SavedState out;
  visitAll(out);
  return out.take();
}

std::uint64_t SceneSnapshot::digest() {
  StateDigest digest;
  visitAll(digest);
  std::uint64_t files = filesOf(scene_);
  digest("files", files);
  return digest.value();
}

// The id of a mesh is a hash of its contents (MeshStore).
std::uint64_t SceneSnapshot::filesOf(const Scene& scene) {
  StateHash hash;
  for (const auto& [number, l] : scene.tree_.loads()) {
    hash.add(number);
    hash.add(l->script);
    for (const MeshId mesh : l->meshes) hash.add(mesh);
  }
  return hash.value();
}

void SceneSnapshot::visitAll(StateFields& f) {
  std::string plugins = scene_.loader_.plugins();
  std::uint32_t version = plugins.empty() ? kVersion : kWithPlugins;
  f("version", version);
  if (version == kWithPlugins) f("plugins", plugins);
  visitLoads(f);
  scene_.placements_.state(f);
  visitRest(f);
  visitNodes(f);
}

std::optional<std::string> SceneSnapshot::restore(std::span<const std::uint8_t> state,
                                                  const std::string& script) {
  scene_.requests_.setScript(script);
  RestoredState in(state);
  std::uint32_t version = 0;
  in("version", version);
  if (version != kVersion && version != kWithPlugins) return "it is none, or another version has written it";
  std::string plugins;
  if (version == kWithPlugins) in("plugins", plugins);
  if (!in.failed() && plugins != scene_.loader_.plugins())
    return fmt::format("it was saved with {}, and this program has {}", pluginsOr(plugins),
                       pluginsOr(scene_.loader_.plugins()));
  visitLoads(in);
  if (!in.failed()) scene_.placements_.state(in);
  if (!in.failed()) visitRest(in);
  if (!in.failed()) visitNodes(in);
  std::optional<std::string> why = "it does not fit the scripts and models that are here";
  if (in.complete() && consistent()) why = resume();
  if (!why) return {};
  // Nodes that were restored in part must not act any more, not even to leave.
  while (!scene_.tree_.loads().empty())
    scene_.loader_.dispose(scene_.tree_.remove(scene_.tree_.loads().begin()->first), 0);
  return why;
}

/// Visits which files are loaded and which are requested.
void SceneSnapshot::visitLoads(StateFields& f) {
  LoadRequests& requests = scene_.requests_;
  SceneTree& tree = scene_.tree_;
  requests.state(f);
  std::vector<std::uint32_t> present;
  for (const auto& [number, l] : tree.loads()) present.push_back(number);
  f("loads", present);
  if (f.restores()) {
    requests.requestAgain(f);
    if (f.failed()) return;
    for (const std::uint32_t number : present) {
      auto load = requests.asked(number) && !tree.load(number) ? scene_.loader_.take(number) : nullptr;
      if (!load) return f.fail();
      tree.restore(std::move(load));
    }
  }
  for (const std::uint32_t number : present)
    if (!f.failed()) visitLoad(f, number);
}

void SceneSnapshot::visitLoad(StateFields& f, std::uint32_t number) {
  LoadedScene& l = *scene_.tree_.load(number);
  f("since", l.since), f("until", l.until), f("chunk", l.chunkShown);
  // Static objects that were promoted, in the order in which they were.
  std::vector<std::uint32_t> order = l.enterOrder;
  f("order", order);
  if (!f.restores()) return;
  const bool longer = order.size() >= l.enterOrder.size() &&
                      std::equal(l.enterOrder.begin(), l.enterOrder.end(), order.begin());
  if (!longer) return f.fail();
  for (std::size_t i = l.enterOrder.size(); i < order.size(); ++i) {
    const auto s = std::ranges::lower_bound(l.statics, order[i], {}, &StaticObject::position);
    if (s == l.statics.end() || s->position != order[i] || l.nodes[order[i]]) return f.fail();
    scene_.tree_.makeNode(l, static_cast<std::size_t>(s - l.statics.begin()));
  }
  scene_.publisher_.resumeChunk(l);
}

/// Visits all that belongs to no node. The order is that of the format.
void SceneSnapshot::visitRest(StateFields& f) {
  Scene& s = scene_;
  f("now", s.time_.now), f("frame", s.time_.frame), f("frame start", s.time_.start);
  s.instances_.state(f);
  s.figures_.state(f);
  s.paints_.state(f);
  s.lights_.stateOfLights(f);
  s.sounds_.state(f);
  s.lights_.stateOfSkies(f);
  s.feed_.stateOfRigs(f);
  s.publisher_.stateOfChunks(f);
  f("messages", s.messages_);
  s.schedule_.stateOfAlarms(f);
  s.degradation_.state(f);
  s.schedule_.stateOfWatchers(f);
  s.impacts_.state(f);
  s.tree_.stateOfVersion(f);
  s.schedule_.stateOfLevels(f);
  s.feed_.stateOfInput(f);
  s.publisher_.stateOfShadows(f);
}

void SceneSnapshot::visitNodes(StateFields& f) {
  for (const auto& [number, l] : scene_.tree_.loads())
    for (const std::uint32_t position : l->enterOrder) {
      visitNode(f, *l->nodes[position]);
      if (f.failed()) return;
    }
}

void SceneSnapshot::visitNode(StateFields& f, Node& node) {
  Node::ScheduleState& s = node.scheduleState();
  f("rests", s.rests), f("pace", s.pace), f("missed", s.missed), f("level", s.level);
  if (f.restores() && s.pace > levelsOf(DegradationStep::Half)) return f.fail();
  node.state(f);
  f.about(0);
}

// Where a node is, for instance, follows from the node: the node's own difference says more.
std::optional<SceneSnapshot::Difference> SceneSnapshot::difference(std::span<const std::uint8_t> there) {
  StateDifference d(there);
  const auto found = [&](NodeRef node) -> std::optional<Difference> {
    if (!d.first()) return {};
    return Difference{node, d.first()->name, d.first()->here, d.first()->there};
  };
  std::uint32_t version = kVersion;
  d("version", version);
  visitLoads(d);
  scene_.placements_.state(d);
  visitRest(d);
  const auto elsewhere = found({});
  d.next();
  for (const auto& [number, l] : scene_.tree_.loads())
    for (const std::uint32_t position : l->enterOrder) {
      const Node& node = *l->nodes[position];
      visitNode(d, *l->nodes[position]);
      if (d.first()) return found(d.first()->part ? node.nodeOf(d.first()->part) : node.self());
    }
  return elsewhere;
}

std::vector<SceneSnapshot::NamedField> SceneSnapshot::named() {
  std::vector<NamedField> all;
  for (const auto& [number, l] : scene_.tree_.loads())
    for (const std::uint32_t position : l->enterOrder) {
      NamedState state;
      Node& node = *l->nodes[position];
      visitNode(state, node);
      for (auto& f : state.take())
        all.push_back({f.part ? node.nodeOf(f.part) : node.self(), std::move(f.name), std::move(f.value)});
    }
  NamedState rest;
  visitLoads(rest);
  scene_.placements_.state(rest);
  visitRest(rest);
  for (auto& f : rest.take()) all.push_back({{}, std::move(f.name), std::move(f.value)});
  return all;
}

/// Whether all that the restored parts refer to exists.
bool SceneSnapshot::consistent() const {
  const Scene& s = scene_;
  if (s.time_.now < 0 || s.time_.now > kLatest || s.time_.start < 0 || s.time_.start > s.time_.now)
    return false;
  return s.requests_.consistent(s.tree_) && s.degradation_.consistent() && s.feed_.consistent() &&
         s.instances_.consistent() && s.lights_.consistent() && s.sounds_.consistent() &&
         s.schedule_.consistent() && placementsAreDistinct();
}

/// Whether no node is the World and no two nodes have the same placement.
bool SceneSnapshot::placementsAreDistinct() const {
  std::set<PlacementId> used{kWorldPlacement};
  for (const auto& [number, l] : scene_.tree_.loads())
    for (const std::uint32_t position : l->enterOrder) {
      const PlacedNode* placed = l->nodes[position]->placed();
      if (placed && !(scene_.placements_.has(placed->placement()) && used.insert(placed->placement()).second))
        return false;
    }
  return true;
}

/// Puts the restored state into effect: reconnects nodes with the scene and publishes everything. Returns why
/// that is not possible.
std::optional<std::string> SceneSnapshot::resume() {
  scene_.instances_.resume();
  scene_.figures_.resume();
  if (!scene_.paints_.resume()) return "its paints cannot be";
  scene_.lights_.resume();
  for (const auto& [number, l] : scene_.tree_.loads())
    for (const std::uint32_t position : l->enterOrder)
      if (const auto& node = l->nodes[position]; !node->resume(scene_))
        return fmt::format("the node {} cannot go on from it", node->name());
  // Some nodes have made their meshes only now; a mesh that is still missing is of other files.
  if (!scene_.instances_.complete()) return "a model that it shows is not here";
  for (const auto& [number, l] : scene_.tree_.loads())
    for (const std::uint32_t position : l->enterOrder) {
      scene_.schedule_.update(*l->nodes[position]);
      scene_.hashes_.update(*l->nodes[position]);
    }
  scene_.schedule_.resume();
  return {};
}

}  // namespace stadion
