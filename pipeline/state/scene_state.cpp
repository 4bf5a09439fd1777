#include "pipeline/state/scene_state.h"

#include "engine/base/prefetch.h"

#include <algorithm>
#include <cassert>

namespace stadion {

struct SceneState::Header {
  TimeSignature signature;
  ViewerRecord viewer;
  SkyRecord sky;
  ShadowRecord shadows;
  std::uint64_t stillVersion;
  std::atomic<std::uint64_t> writes;
  std::uint32_t lightCount, chunkCount, figureCount, paintCount;
  std::uint64_t instanceCount;
  LightRecord lights[kMaxLights];
  ChunkId chunks[kMaxChunks];
  FigureRecord figures[kMostFigures];
  PaintRecord paints[kMostPaints];
};

namespace {

constexpr std::size_t kReserve = std::size_t{1} << 32;
/// Room for the stamps of all instances that the reservation can hold; unused room takes no memory.
constexpr std::size_t kStamps = std::size_t{1} << 19;
static_assert(kStamps * kInstancesAStamp * sizeof(InstanceRecord) >= kReserve);

/// Behind the header.
constexpr std::size_t kStampsAt = std::size_t{1} << 20;
constexpr std::size_t kInstancesAt = kStampsAt + kStamps * sizeof(std::uint32_t);

std::string_view publishedField(const InstanceRecord& r, const void* address) {
  const auto* at = static_cast<const std::byte*>(address);
  const auto in = [&](const auto& field) {
    const auto* first = reinterpret_cast<const std::byte*>(&field);
    return at >= first && at < first + sizeof field;
  };
  return in(r.model)    ? "model"
         : in(r.centre) ? "centre"
         : in(r.radius) ? "radius"
         : in(r.mesh)   ? "mesh"
         : in(r.flags)  ? "flags"
         : in(r.owner)  ? "owner"
                        : "lodFactor";
}

void setBit(std::span<std::uint64_t> words, std::uint32_t index, bool on) {
  const std::uint64_t bit = std::uint64_t{1} << (index % 64);
  words[index / 64] = on ? words[index / 64] | bit : words[index / 64] & ~bit;
}

bool bitOf(std::span<const std::uint64_t> words, std::uint32_t index) {
  return (words[index / 64] >> (index % 64)) & 1;
}

}  // namespace

SceneState::SceneState(std::size_t memories) {
  static_assert(sizeof(Header) <= kStampsAt);
  for (std::size_t i = 0; i < memories; ++i) {
    memory_.push_back(std::make_unique<SlotMemory>(kReserve));
    memory_.back()->growTo(kInstancesAt);
    new (memory_.back()->data()) Header{};
  }
}

SceneState::~SceneState() = default;

SceneState::Header& SceneState::header(std::size_t slot) const {
  return *reinterpret_cast<Header*>(memory_[slot % memory_.size()]->data());
}

std::atomic<std::uint32_t>* SceneState::stamps(std::size_t slot) const {
  return reinterpret_cast<std::atomic<std::uint32_t>*>(memory_[slot % memory_.size()]->data() + kStampsAt);
}

InstanceRecord* SceneState::instances(std::size_t slot) const {
  return reinterpret_cast<InstanceRecord*>(memory_[slot % memory_.size()]->data() + kInstancesAt);
}

/// Written after the record: a reader that reads the stamp first finds that record, or sees a newer stamp
/// later.
void SceneState::stamp(std::size_t slot, InstanceId id) const {
  const auto now = static_cast<std::uint32_t>(header(slot).writes.load(std::memory_order_relaxed));
  stamps(slot)[id / kInstancesAStamp].store(now, std::memory_order_release);
}

void SceneState::ensure(std::size_t slot, std::size_t instanceCount) {
  Header& h = header(slot);
  if (instanceCount <= h.instanceCount) return;
  memory_[slot % memory_.size()]->growTo(kInstancesAt + instanceCount * sizeof(InstanceRecord));
  InstanceRecord* at = instances(slot);
  for (std::size_t i = h.instanceCount; i < instanceCount; ++i) at[i].radius = -1;
  for (std::size_t i = h.instanceCount; i < instanceCount; i += kInstancesAStamp)
    stamp(slot, static_cast<InstanceId>(i));
  if (instanceCount > 0) stamp(slot, static_cast<InstanceId>(instanceCount - 1));
  h.instanceCount = instanceCount;
}

void SceneState::makeRoom(std::size_t slot, std::size_t instanceCount) {
  if (marks_.size() < instanceCount) marks_.resize(instanceCount);
  ensure(slot, marks_.size());
}

/// Copies missed records from the newest slot, except those written already. Returns the number of copies.
std::size_t SceneState::catchUp(std::size_t slot) {
  Missed& missed = missed_[slot];
  const auto bit = static_cast<std::uint8_t>(1U << slot);
  std::size_t copied = 0;
  InstanceRecord* here = instances(slot);
  const InstanceRecord* there = instances(newest_);
  for (const InstanceId id : missed.instances) {
    if ((marks_[id].missedBy & bit) == 0) continue;
    marks_[id].missedBy = static_cast<std::uint8_t>(marks_[id].missedBy & ~bit);
    if (slot == newest_) continue;
    here[id] = there[id];
    stamp(slot, id);
    ++copied;
  }
  if (any_ && slot != newest_) {
    Header& to = header(slot);
    const Header& from = header(newest_);
    for (const auto& [chunk, indices] : missed.statics) {
      const ChunkView was = arena_.find(chunk, newest_);
      if (was.records.empty()) continue;
      const std::span<std::uint64_t> is = arena_.hidden(chunk, slot);
      for (const std::uint32_t index : indices) setBit(is, index, bitOf(was.hidden, index));
    }
    to.lightCount = from.lightCount;
    std::copy_n(from.lights, from.lightCount, to.lights);
    to.figureCount = from.figureCount;
    std::copy_n(from.figures, from.figureCount, to.figures);
    to.paintCount = from.paintCount;
    std::copy_n(from.paints, from.paintCount, to.paints);
    to.chunkCount = from.chunkCount;
    std::copy_n(from.chunks, from.chunkCount, to.chunks);
  }
  missed.instances.clear();
  missed.statics.clear();
  return copied;
}

namespace {

/// Returns true if both records have the same place, form and visibility.
bool standAlike(const InstanceRecord& a, const InstanceRecord& b) {
  constexpr std::uint32_t kSeen = InstanceRecord::kShown | InstanceRecord::kTransparent;
  return (a.flags & kSeen) == (b.flags & kSeen) && a.mesh == b.mesh && a.radius == b.radius &&
         std::equal(a.model, a.model + 12, b.model);
}

}  // namespace

/// Notes that the instance is published. Returns true if it was published before at another place. The newest
/// slot still has its previous record.
bool SceneState::movesBy(const ChangeSet::Instance& change) {
  using Known = Marks::Known;
  Known& known = marks_[change.id].known;
  const bool there = change.record.radius >= 0;
  const Known before = known;
  if (there && change.record.figure() != 0) {  // it may move where it stands
    known = Known::Moves;
    if (before == Known::Still) ++stillVersion_;
    return true;
  }
  if (before == Known::Moves && there) return true;
  // A change of detail alone does not move the instance.
  if (before == Known::Still && there && standAlike(change.record, instances(newest_)[change.id]))
    return false;
  known = !there ? Known::Absent : known == Known::Absent ? Known::Still : Known::Moves;
  if (before == Known::Still || known == Known::Still) ++stillVersion_;
  return known == Known::Moves;
}

void SceneState::apply(std::size_t slot, const ChangeSet& changes) {
  Header& h = header(slot);
  if (!changes.chunks.empty() || !changes.statics.empty()) ++stillVersion_;
  for (const ChangeSet::StaticItem& s : changes.statics)
    if (const std::span<std::uint64_t> hidden = arena_.hidden(s.chunk, slot); !hidden.empty())
      setBit(hidden, s.index, s.hidden);
  for (const ChangeSet::Chunk& c : changes.chunks) {
    ChunkId* end = std::remove(h.chunks, h.chunks + h.chunkCount, c.id);
    assert(!c.shown || end < h.chunks + kMaxChunks);
    if (c.shown && end < h.chunks + kMaxChunks) *end++ = c.id;
    h.chunkCount = static_cast<std::uint32_t>(end - h.chunks);
  }
  if (changes.lightsChanged) {
    assert(changes.lights.size() <= kMaxLights);
    h.lightCount = static_cast<std::uint32_t>(std::min(changes.lights.size(), kMaxLights));
    std::copy_n(changes.lights.begin(), h.lightCount, h.lights);
  }
  if (changes.figuresChanged) {
    assert(changes.figures.size() <= kMostFigures);
    h.figureCount = static_cast<std::uint32_t>(std::min(changes.figures.size(), kMostFigures));
    std::copy_n(changes.figures.begin(), h.figureCount, h.figures);
  }
  if (changes.paintsChanged) {
    assert(changes.paints.size() <= kMostPaints);
    h.paintCount = static_cast<std::uint32_t>(std::min(changes.paints.size(), kMostPaints));
    std::copy_n(changes.paints.begin(), h.paintCount, h.paints);
  }
  h.sky = changes.sky;
  h.viewer = changes.viewer;
  h.shadows = changes.shadows;
  h.stillVersion = stillVersion_;
  h.signature = changes.signature;
}

void SceneState::miss(std::size_t slot, const ChangeSet& changes) {
  Missed& missed = missed_[slot];
  for (const ChangeSet::StaticItem& s : changes.statics) {
    std::vector<std::uint32_t>& indices = missed.statics[s.chunk];
    // An object leaves its chunk once; a repeated message is ignored.
    if (indices.empty() || indices.back() != s.index) indices.push_back(s.index);
  }
  // A slot may never be written while the others always are, so obsolete entries must be removed here.
  for (const ChangeSet::Chunk& c : changes.chunks)
    if (!c.shown) missed.statics.erase(c.id);
}

std::size_t SceneState::noted() const {
  std::size_t count = 0;
  for (const Missed& missed : missed_) {
    count += missed.instances.size();
    for (const auto& [chunk, indices] : missed.statics) count += indices.size();
  }
  return count;
}

std::size_t SceneState::publish(std::size_t slot, const ChangeSet& changes) {
  begin(slot);
  return finish(changes);
}

void SceneState::begin(std::size_t slot) {
  writing_ = slot;
  taken_ = 0;
  if (guard_) guard_->open(slot % memory_.size());
  // Odd during writing, also after a frame that was begun and abandoned.
  std::atomic<std::uint64_t>& writes = header(slot).writes;
  writes.fetch_add(writes.load(std::memory_order_relaxed) % 2 == 0 ? 1 : 2, std::memory_order_acq_rel);
}

void SceneState::take(std::span<const ChangeSet::Instance> block) {
  constexpr auto kAll = static_cast<std::uint8_t>((1U << kSlots) - 1);
  const auto others = static_cast<std::uint8_t>(kAll & ~(1U << writing_));
  std::size_t end = 0;
  for (const ChangeSet::Instance& i : block) end = std::max(end, i.id + std::size_t{1});
  makeRoom(writing_, end);
  if (block.empty()) return;
  InstanceRecord* records = instances(writing_);
  InstanceId last = block.front().id;
  for (const ChangeSet::Instance& i : block) {
    // Instances that move together were mostly added together: the next block is probably the neighbour.
    if (i.id + block.size() < marks_.size()) prefetch(&records[i.id + block.size()]);
    if (i.id / kInstancesAStamp != last / kInstancesAStamp) stamp(writing_, last);
    last = i.id;
    Marks& marks = marks_[i.id];
    const bool goesOn = marks.known == Marks::Known::Moves && i.record.radius >= 0;
    const bool moves = goesOn || movesBy(i);
    InstanceRecord& record = records[i.id];
    record = i.record;
    if (moves) record.flags |= kMoves;
    // This slot has the record; the others have missed it from now on.
    const auto missed = static_cast<std::uint8_t>(others & ~marks.missedBy);
    marks.missedBy = others;
    for (std::size_t slot = 0; missed >> slot != 0; ++slot)
      if ((missed >> slot) & 1) missed_[slot].instances.push_back(i.id);
  }
  stamp(writing_, last);
  taken_ += block.size();
}

std::size_t SceneState::finish(const ChangeSet& changes) {
  take(changes.instances);
  const std::size_t slot = writing_;
  const std::size_t copied = catchUp(slot);
  apply(slot, changes);
  header(slot).writes.fetch_add(1, std::memory_order_acq_rel);
  if (guard_) guard_->close(slot % memory_.size());
  for (std::size_t other = 0; other < kSlots; ++other)
    if (other != slot) miss(other, changes);
  newest_ = slot;
  any_ = true;
  return taken_ + copied;
}

SlotView SceneState::view(std::size_t slot) const {
  const Header& h = header(slot);
  SlotView v;
  v.writes = &h.writes;
  v.written = h.writes.load(std::memory_order_acquire);
  v.signature = &h.signature;
  v.viewer = &h.viewer;
  v.sky = &h.sky;
  v.shadows = &h.shadows;
  v.lights = {h.lights, h.lightCount};
  v.figures = {h.figures, h.figureCount};
  v.paints = {h.paints, h.paintCount};
  v.instances = {instances(slot), h.instanceCount};
  v.stamps = {stamps(slot), (h.instanceCount + kInstancesAStamp - 1) / kInstancesAStamp};
  v.chunks = {h.chunks, h.chunkCount};
  v.arena = &arena_;
  v.slot = slot;
  v.stillVersion = h.stillVersion;
  return v;
}

void SceneState::guard(WriteGuard& guard) {
  for (const auto& memory : memory_) guard.add(memory->data(), kReserve);
  const std::span<std::byte> still = arena_.separateReaders();
  guard.close(guard.add(still.data(), still.size()));
  guard_ = &guard;
}

void SceneState::unguard() {
  guard_ = nullptr;
}

PublishedPlace SceneState::placeOf(const void* address) const {
  const auto* at = static_cast<const std::byte*>(address);
  if (const InstanceRecord* still = arena_.recordAt(at)) return {publishedField(*still, at), still->owner};
  for (std::size_t slot = 0; slot < memory_.size(); ++slot) {
    const std::byte* first = memory_[slot]->data();
    if (at < first || at >= first + kReserve) continue;
    const Header& h = header(slot);
    if (at < first + kStampsAt) return placeIn(h, at);
    if (at < first + kInstancesAt) return {"stamps", {}};
    const auto index = static_cast<std::size_t>(at - first - kInstancesAt) / sizeof(InstanceRecord);
    if (index >= h.instanceCount) return {"instances", {}};
    const InstanceRecord& record = instances(slot)[index];
    return {publishedField(record, at), record.owner};
  }
  return {"chunks", {}};
}

PublishedPlace SceneState::placeIn(const Header& h, const std::byte* address) {
  const auto in = [&](const auto& field) {
    const auto* first = reinterpret_cast<const std::byte*>(&field);
    return address >= first && address < first + sizeof field;
  };
  for (const LightRecord& light : h.lights)
    if (in(light)) return {"lights", light.owner};
  return {in(h.signature) ? "signature"
          : in(h.viewer)  ? "viewer"
          : in(h.sky)     ? "sky"
          : in(h.shadows) ? "shadows"
          : in(h.chunks)  ? "chunks"
          : in(h.figures) ? "figures"
          : in(h.paints)  ? "paints"
                          : "header",
          {}};
}

}  // namespace stadion
