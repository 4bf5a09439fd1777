#include "engine/asset/mesh_store.h"

#include <algorithm>
#include <cassert>

namespace stadion {

MeshId MeshStore::add(std::unique_ptr<const Mesh> mesh) {
  const std::lock_guard lock(mutex_);
  if (const auto known = byHash_.find(mesh->hash); known != byHash_.end()) {
    ++entries_[known->second].uses;
    return known->second;
  }
  auto id = static_cast<MeshId>(mesh->hash ^ (mesh->hash >> 32));
  while (id == kNoMesh || entries_.contains(id)) ++id;
  byHash_[mesh->hash] = id;
  entries_[id] = {std::move(mesh), 1, 0};
  return id;
}

void MeshStore::retain(MeshId id) {
  const std::lock_guard lock(mutex_);
  ++entries_.at(id).uses;
}

void MeshStore::release(MeshId id, std::uint64_t lastFrame) {
  const std::lock_guard lock(mutex_);
  const auto at = entries_.find(id);
  if (at == entries_.end()) return;
  assert(at->second.uses > 0);
  at->second.lastFrame = std::max(at->second.lastFrame, lastFrame);
  if (--at->second.uses == 0) unused_.push_back(id);
}

const Mesh* MeshStore::find(MeshId id) const {
  const std::lock_guard lock(mutex_);
  const auto at = entries_.find(id);
  return at == entries_.end() ? nullptr : at->second.mesh.get();
}

std::vector<MeshId> MeshStore::used() const {
  const std::lock_guard lock(mutex_);
  std::vector<MeshId> ids;
  for (const auto& [id, entry] : entries_)
    if (entry.uses > 0) ids.push_back(id);
  return ids;
}

bool MeshStore::holds(MeshId id, std::uint64_t hash) const {
  const std::lock_guard lock(mutex_);
  const auto at = entries_.find(id);
  return at != entries_.end() && at->second.mesh->hash == hash;
}

void MeshStore::collect(std::uint64_t shownFrame) {
  const std::lock_guard lock(mutex_);
  std::erase_if(unused_, [&](MeshId id) {
    const auto at = entries_.find(id);
    if (at == entries_.end() || at->second.uses > 0) return true;
    if (at->second.lastFrame > shownFrame) return false;
    byHash_.erase(at->second.mesh->hash);
    entries_.erase(at);
    ++freedCount_;
    return true;
  });
}

std::uint64_t MeshStore::freedCount() const {
  const std::lock_guard lock(mutex_);
  return freedCount_;
}

std::size_t MeshStore::size() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

}  // namespace stadion
