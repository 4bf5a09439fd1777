#pragma once
/// Static instances, stored once: one immutable chunk per loaded file, in shared memory.
///
/// Frames    records are in World.
/// Threads   add() and free() from any thread (the loader's); find() from any thread while the chunk lives.
/// Lifetime  whoever frees a chunk has made sure that no slot still shows it.

#include "engine/scene/records.h"
#include "pipeline/state/shared_segment.h"

#include <array>
#include <map>
#include <mutex>
#include <span>

namespace stadion {

constexpr std::size_t kSlots = 3;

/// One chunk as the stages see it.
struct ChunkView {
  std::span<const InstanceRecord> records;
  std::span<std::uint64_t> hidden;  ///< one bit per record, of the slot asked for: it has left the chunk
};

class ChunkArena {
public:
  ChunkArena();

  ChunkId add(std::span<const InstanceRecord> records);
  void free(ChunkId id);
  ChunkView find(ChunkId id, std::size_t slot) const;

  std::size_t bytesInUse() const;

private:
  struct Extent {
    std::size_t offset = 0, bytes = 0, count = 0;
  };

  std::size_t allocate(std::size_t bytes);

  mutable std::mutex mutex_;
  SharedSegment segment_;
  std::map<ChunkId, Extent> chunks_;
  std::map<std::size_t, std::size_t> free_;  ///< offset to bytes, neighbours merged
  ChunkId next_ = 1;
};

}  // namespace stadion
