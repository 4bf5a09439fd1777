#include "engine/scene/scene_tree.h"

#include "engine/core/state_fields.h"
#include "engine/scene/object_node.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

/// The index in `statics` of the object at this position; `statics.size()` if there is none.
std::size_t staticAt(const LoadedScene& load, std::uint32_t position) {
  const auto s = std::ranges::lower_bound(load.statics, position, {}, &StaticObject::position);
  return s != load.statics.end() && s->position == position
             ? static_cast<std::size_t>(s - load.statics.begin())
             : load.statics.size();
}

}  // namespace

const LoadedScene* SceneTree::load(std::uint32_t number) const {
  const auto at = loads_.find(number);
  return at == loads_.end() ? nullptr : at->second.get();
}

LoadedScene* SceneTree::load(std::uint32_t number) {
  return const_cast<LoadedScene*>(std::as_const(*this).load(number));
}

Node* SceneTree::find(NodeRef ref) {
  const auto at = loads_.find(ref.load);
  if (at == loads_.end() || ref.position >= at->second->nodes.size()) return nullptr;
  LoadedScene& load = *at->second;
  if (load.nodes[ref.position]) return load.nodes[ref.position].get();
  const std::size_t index = staticAt(load, ref.position);
  return index < load.statics.size() ? promote(load, index) : nullptr;
}

NodeRef SceneTree::resolve(const std::string& name, NodeRef from) const {
  std::string inside;
  const NodeRef found = resolveFirst(name, from, inside);
  return resolveInside(found, inside);
}

NodeRef SceneTree::resolveFirst(const std::string& name, NodeRef from, std::string& inside) const {
  inside.clear();
  const std::size_t slash = name.find('/');
  for (const LoadedScene* l = load(from.load); l; l = load(l->owner.load)) {
    if (const NodeRef whole = l->find(name); whole.valid()) return whole;
    if (slash == std::string::npos) continue;
    if (const NodeRef first = l->find(name.substr(0, slash)); first.valid()) {
      inside = name.substr(slash + 1);
      return first;
    }
  }
  return {};
}

NodeRef SceneTree::resolveInside(NodeRef from, std::string_view path) const {
  NodeRef found = from;
  while (found.valid() && !path.empty()) {
    const LoadedScene* inner = nullptr;
    for (const auto& [number, l] : loads_)
      if (l->owner == found) inner = l.get();
    if (!inner) return {};
    if (const NodeRef whole = inner->find(std::string(path)); whole.valid()) return whole;
    const std::size_t end = std::min(path.find('/'), path.size());
    found = inner->find(std::string(path.substr(0, end)));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return found;
}

NodeRef SceneTree::parentOf(NodeRef ref) const {
  const LoadedScene* l = load(ref.load);
  if (!l) return {};
  NodeRef parent;
  if (const auto* placed = dynamic_cast<const PlacedNode*>(l->nodes[ref.position].get()))
    parent = placed->attributes().parent;
  else if (const std::size_t index = staticAt(*l, ref.position); index < l->statics.size())
    parent = l->statics[index].parent;
  return parent.valid() ? parent : l->owner;
}

PlacementId SceneTree::placementFor(NodeRef parent, NodeRef child) {
  if (!parent.valid()) {
    const LoadedScene* own = load(child.load);
    if (!own || !own->owner.valid()) return kWorldPlacement;
    parent = own->owner;
  }
  Node* above = find(parent);
  const PlacedNode* placed = above ? above->placed() : nullptr;
  return placed && placed->placement() != kNoPlacement ? placed->placement() : kWorldPlacement;
}

Nanoseconds SceneTree::endOf(std::uint32_t number) const {
  Nanoseconds end = kNever;
  for (const LoadedScene* l = load(number); l; l = load(l->owner.load)) end = std::min(end, l->until);
  return end;
}

void SceneTree::forEachLoad(const std::function<void(const LoadedScene&)>& f) const {
  for (const auto& [number, l] : loads_) f(*l);
}

void SceneTree::forEachNode(const std::function<void(const Node&)>& f) const {
  for (const auto& [number, l] : loads_)
    for (const auto& node : l->nodes)
      if (node) f(*node);
}

bool SceneTree::isBelow(NodeRef ref, NodeRef ancestor) const {
  for (NodeRef at = parentOf(ref); at.valid(); at = parentOf(at))
    if (at == ancestor) return true;
  return false;
}

void SceneTree::promoteBelow(NodeRef ref) {
  for (auto& [number, l] : loads_)
    for (std::size_t i = 0; i < l->statics.size(); ++i) {
      const NodeRef self{number, l->statics[i].position};
      if (!l->nodes[self.position] && isBelow(self, ref)) promote(*l, i);
    }
}

Node& SceneTree::makeNode(LoadedScene& load, std::size_t index) {
  const StaticObject& object = load.statics[index];
  const InstanceRecord& record = load.chunkRecords[index];
  const NodeRef self{load.number, object.position};
  PlaceAttributes place;
  place.parent = object.parent;
  Appearance appearance;
  appearance.mesh = record.mesh;
  appearance.drawn = (record.flags & InstanceRecord::kShown) != 0;
  load.nodes[object.position] =
      std::make_unique<ObjectNode>(*load.staticType, self, load.nameOf(object), place, appearance);
  load.enterOrder.push_back(object.position);
  host_.leftChunk(load.chunk, static_cast<std::uint32_t>(index));
  return *load.nodes[object.position];
}

Node* SceneTree::promote(LoadedScene& load, std::size_t index, const Affine& moved) {
  const InstanceRecord& record = load.chunkRecords[index];
  Node& added = makeNode(load, index);
  Affine X_WN;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 4; ++col) X_WN.matrix()(row, col) = record.model[4 * row + col];
  host_.promoted(added, moved * X_WN);
  return &added;
}

LoadedScene& SceneTree::install(std::unique_ptr<LoadedScene> load) {
  LoadedScene& installed = *load;
  loads_[installed.number] = std::move(load);
  ++version_;
  return installed;
}

std::unique_ptr<LoadedScene> SceneTree::remove(std::uint32_t number) {
  const auto at = loads_.find(number);
  std::unique_ptr<LoadedScene> gone = std::move(at->second);
  loads_.erase(at);
  ++version_;
  return gone;
}

void SceneTree::end(std::uint32_t number, Nanoseconds at) {
  const auto known = loads_.find(number);
  if (known == loads_.end() || known->second->until == at) return;
  known->second->until = at;
  ++version_;
}

void SceneTree::restore(std::unique_ptr<LoadedScene> load) {
  const std::uint32_t number = load->number;
  loads_[number] = std::move(load);
}

void SceneTree::stateOfVersion(StateFields& f) {
  f("loads version", version_);
}

}  // namespace stadion
