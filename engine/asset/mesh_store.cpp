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
  const MeshId id = next_++;
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

void MeshStore::collect(std::uint64_t shownFrame) {
  const std::lock_guard lock(mutex_);
  std::erase_if(unused_, [&](MeshId id) {
    const auto at = entries_.find(id);
    if (at == entries_.end() || at->second.uses > 0) return true;
    if (at->second.lastFrame > shownFrame) return false;
    byHash_.erase(at->second.mesh->hash);
    entries_.erase(at);
    freed_.push_back(id);
    return true;
  });
}

std::vector<MeshId> MeshStore::freedSince(std::size_t& cursor) const {
  const std::lock_guard lock(mutex_);
  std::vector<MeshId> ids(freed_.begin() + static_cast<std::ptrdiff_t>(std::min(cursor, freed_.size())),
                          freed_.end());
  cursor = freed_.size();
  return ids;
}

std::size_t MeshStore::size() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

}  // namespace stadion
