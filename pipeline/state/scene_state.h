#pragma once
/// The scene as the later stages see it: App publishes it each frame, in three slots.
///
/// A slot holds one whole frame: every instance that has ever moved, the visible static chunks, lights, sky
/// and viewer. The cost of publishing depends on the changes since the slot was last written, not on the size
/// of the scene. The slot first copies missed changes from the newest one, then takes this frame's changes.
///
/// All data are plain fixed-width records without pointers.
///
/// Threads  publish() and its parts by App alone, into a slot that no thread reads; view() by a thread that
///          holds a lease on the slot (FrameSlots controls access).

#include "pipeline/state/chunk_arena.h"
#include "pipeline/state/slot_memory.h"
#include "pipeline/state/write_guard.h"

#include <atomic>
#include <map>
#include <memory>
#include <string_view>

namespace stadion {

/// A flag of a published instance: it was published before at another place or in another form. Shadow maps
/// are kept for instances that have never moved.
constexpr std::uint32_t kMoves = 1U << 31;

/// Number of instances, consecutive by id, that share one stamp.
constexpr std::size_t kInstancesAStamp = 64;

/// The state of a frame, read-only. Valid while the lease on its slot is held.
struct SlotView {
  const TimeSignature* signature = nullptr;
  const ViewerRecord* viewer = nullptr;
  const SkyRecord* sky = nullptr;
  const ShadowRecord* shadows = nullptr;
  std::span<const LightRecord> lights;
  std::span<const FigureRecord> figures;      ///< what each plays, by InstanceRecord::figure() - 1
  std::span<const PaintRecord> paints;        ///< by InstanceRecord::paint() - 1
  std::span<const InstanceRecord> instances;  ///< by InstanceId; radius < 0 = not there
  /// By block of kInstancesAStamp instances: a number that changes whenever an instance of the block changes
  /// in this slot.
  std::span<const std::atomic<std::uint32_t>> stamps;
  std::span<const ChunkId> chunks;  ///< shown
  const ChunkArena* arena = nullptr;
  std::size_t slot = 0;
  /// Changes whenever an instance that has never moved appears or disappears, in any slot.
  std::uint64_t stillVersion = 0;
  /// Counts the starts and ends of writing to the slot: odd from App's start until it has published.
  const std::atomic<std::uint64_t>* writes = nullptr;
  std::uint64_t written = 0;  ///< when this view was made

  ChunkView chunk(ChunkId id) const { return arena->find(id, slot); }
  /// Returns true if all data read so far belong to one frame; false if the slot was taken away meanwhile.
  bool intact() const {
    return !writes || (written % 2 == 0 && writes->load(std::memory_order_acquire) == written);
  }
};

/// A part of the published scene.
struct PublishedPlace {
  std::string_view field;  ///< as in the records
  NodeRef node;            ///< invalid: of no node
};

class SceneState final : public ChangeSet::Sink {
public:
  static constexpr std::size_t kMaxLights = kMostLights, kMaxChunks = kMostChunks;

  /// `memories` is the number of slots with memory of their own. Below kSlots the pipeline is broken: tests
  /// use this to show that they would notice.
  explicit SceneState(std::size_t memories = kSlots);
  ~SceneState() override;

  ChunkArena& arena() { return arena_; }

  /// Writes frame `changes.signature.frame` into `slot`. Returns the number of records copied, including
  /// missed ones. Expects at most kMaxLights lights and kMaxChunks chunks (the scene ensures this).
  std::size_t publish(std::size_t slot, const ChangeSet& changes);
  /// Publishes a frame in parts: begin(), then take() with any number of instances, each once, then finish()
  /// with the rest.
  void begin(std::size_t slot);
  void take(std::span<const ChangeSet::Instance> block) override;
  std::size_t finish(const ChangeSet& changes);
  SlotView view(std::size_t slot) const;

  /// From now on slots and static objects are read-only, except for App while it publishes. Expects a new
  /// guard, and that no stage runs. Throws std::bad_alloc.
  void guard(WriteGuard& guard);
  /// Before the guard goes.
  void unguard();
  /// Returns the record at an address that the guard has caught. Call it in the stage that wrote there, on
  /// the thread of its WriteGuard::Stage.
  PublishedPlace placeOf(const void* address) const;
  /// Returns the number of changes noted for slots that were not written since. Each slot has at most one for
  /// each moved instance and one for each object that has left a visible chunk, however long the show runs.
  std::size_t noted() const;

private:
  struct Header;
  struct Slot;
  /// The changes that a slot has missed since it was last written. Used by App only.
  struct Missed {
    std::vector<InstanceId> instances;  ///< instances that changed; marks_ ensures that each is here once
    std::map<ChunkId, std::vector<std::uint32_t>> statics;  ///< objects that left a chunk, while it is shown
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
  static PublishedPlace placeIn(const Header& header, const std::byte* address);
  void miss(std::size_t slot, const ChangeSet& changes);

  ChunkArena arena_;
  std::vector<std::unique_ptr<SlotMemory>> memory_;
  std::array<Missed, kSlots> missed_;
  /// The state of an instance, and the slots that have missed it. Used by App only.
  struct Marks {
    enum class Known : std::uint8_t { Absent, Still, Moves } known = Known::Absent;
    std::uint8_t missedBy = 0;  ///< slots that have missed the instance, one bit each
  };
  std::vector<Marks> marks_;  ///< by InstanceId
  std::uint64_t stillVersion_ = 0;
  std::size_t newest_ = 0;
  bool any_ = false;
  std::size_t writing_ = 0;      ///< the slot that was begun
  std::size_t taken_ = 0;        ///< instances since then
  WriteGuard* guard_ = nullptr;  ///< null: none; its range i is memory_[i]
};

}  // namespace stadion
