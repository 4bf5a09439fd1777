#pragma once
/// Static instances, stored once: one immutable chunk per loaded file, in shared memory, with the hierarchy
/// of its bounds (still_bounds.h).
///
/// Frames    records are in World.
/// Threads   add() and free() from any thread (the loader's); find() from any thread while the chunk lives.
/// Lifetime  the caller of free() makes sure that no slot shows the chunk any more.
/// Access    what find() returns is for reading; only hidden() is for writing, by App.

#include "engine/published/records.h"
#include "pipeline/state/bounds_tree.h"
#include "pipeline/state/shared_segment.h"

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <span>

namespace stadion {

constexpr std::size_t kSlots = 3;  ///< slots of the published scene: one to write, two to read

/// A chunk as the stages see it.
struct ChunkView {
  std::span<const InstanceRecord> records;
  /// One bit per record, for the requested slot: set if the object has left the chunk.
  std::span<const std::uint64_t> hidden;
  BoundsTree bounds;  ///< bounds of all shown records, including those that have left
};

class ChunkArena {
public:
  ChunkArena();

  /// Also builds the hierarchy. Meanwhile other threads may use the arena.
  ChunkId add(std::span<const InstanceRecord> records);
  void free(ChunkId id);
  ChunkView find(ChunkId id, std::size_t slot) const;
  /// Returns ChunkView::hidden of the chunk for App to write; empty if there is no such chunk.
  std::span<std::uint64_t> hidden(ChunkId id, std::size_t slot);

  /// From now on find() returns places in a second mapping, which is read-only. Returns all of it. Earlier
  /// places remain good. Throws std::bad_alloc.
  std::span<std::byte> separateReaders();
  /// The record that contains this address of the second mapping; null: none does.
  const InstanceRecord* recordAt(const void* address) const;

  std::size_t bytesInUse() const;

private:
  struct Extent {
    std::size_t offset = 0, bytes = 0, count = 0;
  };

  static constexpr std::size_t kReserve = std::size_t{1} << 34;

  static std::size_t hiddenAt(const Extent& x, std::size_t slot);
  Extent reserve(std::size_t count, ChunkId& id);
  std::size_t allocate(std::size_t bytes);

  mutable std::mutex mutex_;
  SharedSegment segment_;
  std::unique_ptr<SharedSegment> readers_;  ///< the second mapping; null: there is one only
  std::map<ChunkId, Extent> chunks_;
  std::map<std::size_t, std::size_t> free_;  ///< offset to bytes, neighbours merged
  ChunkId next_ = 1;
};

}  // namespace stadion
