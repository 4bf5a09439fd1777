#include "pipeline/state/chunk_arena.h"

#include "pipeline/state/still_bounds.h"

#include <cstring>
#include <fcntl.h>
#include <new>

namespace stadion {
namespace {

constexpr std::size_t kPage = 4096;

std::size_t hiddenWords(std::size_t count) {
  return (count + 63) / 64;
}

/// Returns the position of a chunk's bounds, behind the records and the bits of all slots.
std::size_t boundsAt(std::size_t count) {
  const std::size_t bytes =
      count * sizeof(InstanceRecord) + kSlots * hiddenWords(count) * sizeof(std::uint64_t);
  return (bytes + 63) / 64 * 64;
}

std::size_t bytesFor(std::size_t count) {
  return (boundsAt(count) + stillBoundsBytes(count) + kPage - 1) / kPage * kPage;
}

}  // namespace

ChunkArena::ChunkArena() : segment_("stadion-chunks", kReserve) {}

std::size_t ChunkArena::allocate(std::size_t bytes) {
  for (auto at = free_.begin(); at != free_.end(); ++at) {
    if (at->second < bytes) continue;
    const auto [offset, size] = *at;
    free_.erase(at);
    if (size > bytes) free_[offset + bytes] = size - bytes;
    return offset;
  }
  const std::size_t end = chunks_.empty() && free_.empty() ? 0 : [this] {
    std::size_t e = 0;
    for (const auto& [id, x] : chunks_) e = std::max(e, x.offset + x.bytes);
    for (const auto& [offset, size] : free_) e = std::max(e, offset + size);
    return e;
  }();
  segment_.growTo(end + bytes);
  return end;
}

ChunkId ChunkArena::add(std::span<const InstanceRecord> records) {
  ChunkId id = kNoChunk;
  const Extent x = reserve(records.size(), id);
  std::byte* at = segment_.data() + x.offset;
  if (!records.empty()) std::memcpy(at, records.data(), records.size_bytes());
  std::memset(at + records.size_bytes(), 0, x.bytes - records.size_bytes());
  try {
    buildStillBounds(records, at + boundsAt(x.count));
  } catch (...) {
    free(id);
    throw;
  }
  return id;
}

/// No stage uses the chunk before add() has returned.
ChunkArena::Extent ChunkArena::reserve(std::size_t count, ChunkId& id) {
  const std::lock_guard lock(mutex_);
  Extent x;
  x.count = count;
  x.bytes = bytesFor(count);
  x.offset = allocate(x.bytes);
  id = next_++;
  chunks_[id] = x;
  return x;
}

void ChunkArena::free(ChunkId id) {
  const std::lock_guard lock(mutex_);
  const auto at = chunks_.find(id);
  if (at == chunks_.end()) return;
  std::size_t offset = at->second.offset, bytes = at->second.bytes;
  chunks_.erase(at);
  segment_.discard(offset, bytes);
  const auto after = free_.lower_bound(offset);
  if (after != free_.end() && after->first == offset + bytes) {
    bytes += after->second;
    free_.erase(after);
  }
  auto before = free_.lower_bound(offset);
  if (before != free_.begin() && (--before)->first + before->second == offset) {
    before->second += bytes;
    return;
  }
  free_[offset] = bytes;
}

ChunkView ChunkArena::find(ChunkId id, std::size_t slot) const {
  const std::lock_guard lock(mutex_);
  const auto at = chunks_.find(id);
  if (at == chunks_.end()) return {};
  const Extent& x = at->second;
  const std::byte* base = (readers_ ? *readers_ : segment_).data() + x.offset;
  return {{reinterpret_cast<const InstanceRecord*>(base), x.count},
          {reinterpret_cast<const std::uint64_t*>(base + hiddenAt(x, slot)), hiddenWords(x.count)},
          stillBounds(base + boundsAt(x.count), x.count)};
}

/// Behind the records.
std::size_t ChunkArena::hiddenAt(const Extent& x, std::size_t slot) {
  return x.count * sizeof(InstanceRecord) + slot * hiddenWords(x.count) * sizeof(std::uint64_t);
}

std::span<std::uint64_t> ChunkArena::hidden(ChunkId id, std::size_t slot) {
  const std::lock_guard lock(mutex_);
  const auto at = chunks_.find(id);
  if (at == chunks_.end()) return {};
  const Extent& x = at->second;
  return {reinterpret_cast<std::uint64_t*>(segment_.data() + x.offset + hiddenAt(x, slot)),
          hiddenWords(x.count)};
}

std::span<std::byte> ChunkArena::separateReaders() {
  const std::lock_guard lock(mutex_);
  if (!readers_) {
    const int descriptor = fcntl(segment_.descriptor(), F_DUPFD_CLOEXEC, 0);
    if (descriptor < 0) throw std::bad_alloc();
    readers_ = std::make_unique<SharedSegment>(descriptor, kReserve, SharedSegment::Access::Read);
  }
  return {readers_->data(), kReserve};
}

const InstanceRecord* ChunkArena::recordAt(const void* address) const {
  const std::lock_guard lock(mutex_);
  if (!readers_) return nullptr;
  const auto* at = static_cast<const std::byte*>(address);
  for (const auto& [id, x] : chunks_) {
    const std::byte* first = readers_->data() + x.offset;
    if (at < first || at >= first + x.count * sizeof(InstanceRecord)) continue;
    const auto index = static_cast<std::size_t>(at - first) / sizeof(InstanceRecord);
    return reinterpret_cast<const InstanceRecord*>(first) + index;
  }
  return nullptr;
}

std::size_t ChunkArena::bytesInUse() const {
  const std::lock_guard lock(mutex_);
  std::size_t bytes = 0;
  for (const auto& [id, x] : chunks_) bytes += x.bytes;
  return bytes;
}

}  // namespace stadion
