#include "engine/scene/scene.h"

#include "engine/scene/object_node.h"

#include <algorithm>
#include <utility>

namespace stadion {

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

/// Takes a static object out of its chunk.
Node& Scene::nodeInsteadOf(Load& load, std::size_t index) {
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
  staticChanges_.push_back({load.chunk, static_cast<std::uint32_t>(index), true});
  return *load.nodes[object.position];
}

Node* Scene::promote(Load& load, std::size_t index, const Affine& moved) {
  const InstanceRecord& record = load.chunkRecords[index];
  Node& added = nodeInsteadOf(load, index);
  enterNode(added);
  Affine X_WN;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 4; ++col) X_WN.matrix()(row, col) = record.model[4 * row + col];
  added.placed()->becomeHome(*this, moved * X_WN);
  return &added;
}

std::uint32_t Scene::requestLoad(const std::string& file, NodeRef owner, Nanoseconds at) {
  const std::uint32_t number = nextLoad_++;
  const auto* placed = owner.valid() ? dynamic_cast<const PlacedNode*>(find(owner)) : nullptr;
  const Asked& asked =
      asked_[number] = {file, owner, placed ? placements_.world(placed->placement()) : Affine::Identity()};
  loader_.request(number, asked.file, asked.owner, asked.X_WO);
  pendingLoads_.push_back({at, number, true});
  return number;
}

void Scene::requestUnload(std::uint32_t number, Nanoseconds at) {
  // A load that has not arrived yet is taken back as soon as it arrives.
  pendingLoads_.push_back({at, number, false});
  if (!current_ || at > now_) return;
  // In this very frame: dynamics has not had its turn yet.
  foreseeUnloads(now_);
  for (const NodeRef watcher : loadWatchers_) wakeNow(watcher);
}

bool Scene::awaits(std::uint32_t number) const {
  return std::any_of(pendingLoads_.begin(), pendingLoads_.end(),
                     [&](const Change& c) { return c.load && c.number == number; });
}

void Scene::applyLoads(const TimeSignature& now, FrameProbe* probe) {
  if (pendingLoads_.empty()) return;
  const SpanScope span(probe, Span::Loading);
  foreseeUnloads(now.time);
  // Installing a load may ask for more of them (sub-scenes that are there from the start).
  for (std::size_t i = 0; i < pendingLoads_.size();) {
    const Change change = pendingLoads_[i];
    if (!change.load || change.at > now.time || !loader_.takesEffect(change.number, now.time)) {
      ++i;
      continue;
    }
    pendingLoads_.erase(pendingLoads_.begin() + static_cast<std::ptrdiff_t>(i));
    if (auto load = loader_.take(change.number))
      install(std::move(load), std::max(change.at, now.time - now.step));
    else
      asked_.erase(change.number);
    i = 0;
  }
  foreseeUnloads(now.time);
}

/// What goes in this frame stays to the frame's end, and is told when its time is.
void Scene::foreseeUnloads(Nanoseconds now) {
  for (const Change& change : pendingLoads_) {
    const auto at = change.load || change.at > now ? loads_.end() : loads_.find(change.number);
    if (at == loads_.end() || at->second->until == change.at) continue;
    at->second->until = change.at;
    ++loadsVersion_;
  }
}

void Scene::applyUnloads(const TimeSignature& now, FrameProbe* probe) {
  if (pendingLoads_.empty()) return;
  const SpanScope span(probe, Span::Loading);
  for (std::size_t i = 0; i < pendingLoads_.size();) {
    const Change change = pendingLoads_[i];
    if (change.load || change.at > now.time || awaits(change.number)) {  // what comes late cannot go before
      ++i;
      continue;
    }
    pendingLoads_.erase(pendingLoads_.begin() + static_cast<std::ptrdiff_t>(i));
    remove(change.number, now.frame);
    i = 0;
  }
}

Nanoseconds Scene::endOf(std::uint32_t number) const {
  Nanoseconds end = kNever;
  for (const Load* l = load(number); l; l = load(l->owner.load)) end = std::min(end, l->until);
  return end;
}

void Scene::install(std::unique_ptr<Load> arrived, Nanoseconds at) {
  Load& load = *arrived;
  if (load.owner.valid() && (!find(load.owner) || endOf(load.owner.load) <= at)) {
    asked_.erase(load.number);
    loader_.dispose(std::move(arrived), 0);  // its scene node has gone meanwhile
    return;
  }
  load.since = at;
  const Nanoseconds frameEnd = std::exchange(now_, at);
  loads_[load.number] = std::move(arrived);
  ++loadsVersion_;
  for (const std::uint32_t position : load.enterOrder) enterNode(*load.nodes[position]);
  now_ = frameEnd;
  auto* owner = dynamic_cast<PlacedNode*>(load.owner.valid() ? find(load.owner) : nullptr);
  if (load.chunk != kNoChunk && chunksShown_ < kMostChunks) {
    chunkChanges_.push_back({load.chunk, true});
    load.chunkShown = true;
    ++chunksShown_;
  }
  if (owner && !load.statics.empty()) owner->carryStatics();
  // Its scene node has moved since the load was asked for: what was placed then must follow.
  const Affine X_WO = owner ? placements_.world(owner->placement()) : load.X_WO;
  const bool moved = owner && X_WO.matrix() != load.X_WO.matrix();
  // Nothing may vanish: what no chunk can show any more is shown one by one.
  if (!moved && (load.chunkShown || load.chunk == kNoChunk)) return;
  const Affine by = moved ? Affine(X_WO * load.X_WO.inverse()) : Affine::Identity();
  for (std::size_t i = 0; i < load.statics.size(); ++i)
    if (!load.nodes[load.statics[i].position]) promote(load, i, by);
}

void Scene::enterNode(Node& node) {
  node.enter(*this);
  setBusy(node);
  rehash(node);
}

void Scene::leaveNode(Node& node) {
  node.leave(*this);
  agenda_.setBusy(node, false);
  hashSum_ -= std::exchange(node.standing().hash, 0);
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
  agenda_.settle();
  std::erase_if(touched_, [&](const Node* node) { return node->self().load == number; });
  if (load.chunkShown) chunkChanges_.push_back({load.chunk, false}), --chunksShown_;
  std::erase_if(staticChanges_, [&](const ChangeSet::StaticItem& s) { return s.chunk == load.chunk; });
  std::unique_ptr<Load> gone = std::move(at->second);
  loads_.erase(at);
  std::erase_if(wakes_, [&](const Wake& w) { return w.node.load == number; });
  std::erase_if(reliefLevels_, [&](const auto& r) { return r.first.load == number; });
  std::erase_if(putOff_, [&](NodeRef ref) { return ref.load == number; });
  std::erase_if(paced_, [&](const auto& p) { return p.first.load == number; });
  asked_.erase(number);
  ++loadsVersion_;
  loader_.dispose(std::move(gone), frame);
}

}  // namespace stadion
