#pragma once
/// The scene as the later stages see it: what App publishes each frame, in three slots.
///
/// A slot holds one whole frame: every instance that has ever moved, which static chunks are shown, lights,
/// sky and viewer. Publishing costs what changed since the slot was last written, not what exists: the slot
/// first copies what it missed from the newest one, then takes this frame's changes.
///
/// All of it is plain fixed-width records without pointers.
///
/// Threads  publish() and its parts by App alone, into a slot that nobody reads; view() by whoever holds a
/// lease on the
///          slot (FrameSlots decides who may do what when).

#include "pipeline/state/chunk_arena.h"
#include "pipeline/state/slot_memory.h"

#include <atomic>
#include <map>
#include <memory>

namespace stadion {

/// In the flags of a published instance: it has been published before, elsewhere or otherwise. What only ever
/// stood still is kept in the shadow maps.
constexpr std::uint32_t kMoves = 1U << 31;

/// So many instances, by id, that follow each other are told together to have changed.
constexpr std::size_t kInstancesAStamp = 64;

/// One frame's state, read-only. Valid while the lease on its slot is held.
struct SlotView {
  const TimeSignature* signature = nullptr;
  const ViewerRecord* viewer = nullptr;
  const SkyRecord* sky = nullptr;
  const ShadowRecord* shadows = nullptr;
  std::span<const LightRecord> lights;
  std::span<const InstanceRecord> instances;  ///< by InstanceId; radius < 0 = not there
  /// One of kInstancesAStamp: another one whenever one of them is not what it was in this slot.
  std::span<const std::atomic<std::uint32_t>> stamps;
  std::span<const ChunkId> chunks;  ///< shown
  const ChunkArena* arena = nullptr;
  std::size_t slot = 0;
  /// Changes whenever something comes or goes that has only ever stood still, in this slot or another.
  std::uint64_t stillVersion = 0;
  /// Counts the beginnings and the ends of writing to the slot: odd from App's start until it has published.
  const std::atomic<std::uint64_t>* writes = nullptr;
  std::uint64_t written = 0;  ///< when this view was made

  ChunkView chunk(ChunkId id) const { return arena->find(id, slot); }
  /// Whether what was read so far is one frame's: false if the slot has been taken away meanwhile.
  bool intact() const {
    return !writes || (written % 2 == 0 && writes->load(std::memory_order_acquire) == written);
  }
};

class SceneState final : public ChangeSet::Sink {
public:
  static constexpr std::size_t kMaxLights = kMostLights, kMaxChunks = kMostChunks;

  /// `memories` is how many slots really have memory of their own. Anything below kSlots is a broken
  /// pipeline, which tests use to show that they would notice.
  explicit SceneState(std::size_t memories = kSlots);
  ~SceneState() override;

  ChunkArena& arena() { return arena_; }

  /// Writes frame `changes.signature.frame` into `slot`. Returns the number of records copied, catching up
  /// included. Expects at most kMaxLights lights and kMaxChunks chunks (the scene sees to it).
  std::size_t publish(std::size_t slot, const ChangeSet& changes);
  /// The same in parts: begin(), take() any number of instances, each once, then finish() with the rest.
  void begin(std::size_t slot);
  void take(std::span<const ChangeSet::Instance> block) override;
  std::size_t finish(const ChangeSet& changes);
  SlotView view(std::size_t slot) const;
  /// How many changes are noted for slots that have not been written since: at most one a moved instance and
  /// one an object that has left a chunk that is shown, for each slot, however long the show runs.
  std::size_t noted() const;

private:
  struct Header;
  struct Slot;
  /// What a slot has missed since it was last written. App's own.
  struct Missed {
    std::vector<InstanceId> instances;                      ///< each once: marks_ says which are in it
    std::map<ChunkId, std::vector<std::uint32_t>> statics;  ///< who left which chunk, while it is shown
  };

  Header& header(std::size_t slot) const;
  InstanceRecord* instances(std::size_t slot) const;
  std::atomic<std::uint32_t>* stamps(std::size_t slot) const;
  void stamp(std::size_t slot, InstanceId id) const;
  void ensure(std::size_t slot, std::size_t instanceCount);
  bool movesBy(const ChangeSet::Instance& change);
  void makeRoom(std::size_t slot, std::size_t instanceCount);
  std::size_t catchUp(std::size_t slot);
  void apply(std::size_t slot, const ChangeSet& changes);
  void miss(std::size_t slot, const ChangeSet& changes);

  ChunkArena arena_;
  std::vector<std::unique_ptr<SlotMemory>> memory_;
  std::array<Missed, kSlots> missed_;
  /// Of an instance, App's own: what is known of it, and which slots have missed it.
  struct Marks {
    enum class Known : std::uint8_t { Absent, Still, Moves } known = Known::Absent;
    std::uint8_t missedBy = 0;  ///< one bit a slot
  };
  std::vector<Marks> marks_;  ///< by InstanceId
  std::uint64_t stillVersion_ = 0;
  std::size_t newest_ = 0;
  bool any_ = false;
  std::size_t writing_ = 0;  ///< the slot that was begun
  std::size_t taken_ = 0;    ///< instances since then
};

}  // namespace stadion
