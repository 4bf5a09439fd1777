#include "pipeline/cull/room_cull.h"

#include <algorithm>
#include <bit>

namespace stadion {

/// What the search found in one frame.
struct RoomCull::SearchedFrame {
  std::size_t slot = 0;
  std::uint64_t written = kNever;  ///< which of the slot's frames; kNever: none that another wall may see
  std::atomic<std::uint32_t> holders = 0;
  std::vector<VisibleSet> walls;

  static constexpr std::uint64_t kNever = ~std::uint64_t{0};
};

RoomCull::Visibility::~Visibility() {
  if (frame_) frame_->holders.fetch_sub(1, std::memory_order_release);
}

const VisibleSet& RoomCull::Visibility::on(std::size_t wall) const {
  return frame_->walls[wall];
}

RoomCull::RoomCull(std::vector<WallViews> walls, const BoundsKernels& kernels)
    : walls_(std::move(walls)), bounds_(kernels) {}

RoomCull::~RoomCull() = default;

RoomCull::Visibility RoomCull::visibleIn(const SlotView& state, const EyeChoice& choice) {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find_if(
      frames_, [&](const auto& f) { return f->slot == state.slot && f->written == state.written; });
  const bool first = known == frames_.end();
  SearchedFrame& frame = first ? roomFor(state) : **known;
  frame.holders.fetch_add(1, std::memory_order_relaxed);
  Visibility visible(&frame);
  if (first) {
    search(state, choice, frame);
    if (state.intact())
      frame.written = state.written;
    else
      moving_[state.slot].forget();
  }
  return visible;
}

/// Returns room for a new frame: that of an earlier frame of the slot, which is over unless a wall was late.
RoomCull::SearchedFrame& RoomCull::roomFor(const SlotView& state) {
  const auto over = [&](const auto& f) {
    return f->slot == state.slot && f->holders.load(std::memory_order_acquire) == 0;
  };
  const auto at = std::ranges::find_if(frames_, over);
  SearchedFrame& frame =
      at != frames_.end() ? **at : *frames_.emplace_back(std::make_unique<SearchedFrame>());
  frame.slot = state.slot;
  frame.written = SearchedFrame::kNever;
  return frame;
}

/// `each(tree, record)`: the instances first; record(index) is null for what is not there.
template <class Each>
void RoomCull::eachTree(const SlotView& state, const Each& each) {
  each(moving_[state.slot].update(state),
       [&](std::uint32_t id) { return id < state.instances.size() ? &state.instances[id] : nullptr; });
  for (const ChunkId id : state.chunks) {
    const ChunkView chunk = state.chunk(id);
    each(chunk.bounds, [&](std::uint32_t i) -> const InstanceRecord* {
      const bool there = i < chunk.records.size() && !((chunk.hidden[i / 64] >> (i % 64)) & 1);
      return there ? &chunk.records[i] : nullptr;
    });
  }
}

void RoomCull::addVolumes(std::uint32_t wall, const PlacedViews& placed) {
  for (std::uint32_t first = 0, end = 0; first < placed.count; first = end) {
    end = placed.endOfScreen(first);
    volumes_.push_back({placed.volume(first, end), placed.origin});
    wallsOf_.push_back(wall);
  }
}

/// `each(first, count)`: parts of the volumes that one search takes. A wall's volumes lie in one part.
template <class Each>
void RoomCull::eachPart(const Each& each) const {
  for (std::size_t first = 0; first < volumes_.size();) {
    std::size_t end = std::min(first + BoundsSearch::kMostVolumes, volumes_.size());
    while (end < volumes_.size() && wallsOf_[end] == wallsOf_[end - 1]) --end;
    each(first, end - first);
    first = end;
  }
}

void RoomCull::search(const SlotView& state, const EyeChoice& choice, SearchedFrame& frame) {
  volumes_.clear();
  wallsOf_.clear();
  frame.walls.resize(walls_.size());
  for (std::uint32_t number = 0; number < walls_.size(); ++number) {
    const WallViews& wall = walls_[number];
    VisibleSet& set = frame.walls[number];
    set.tested = 0;
    set.records.clear();
    set.from = wall.camera ? wall.camera->view() : std::nullopt;
    set.looks = !wall.camera || set.from;
    if (!set.looks) continue;
    set.placed = place(*state.viewer, wall, choice, set.from ? &*set.from : nullptr);
    addVolumes(number, set.placed);
  }
  recordsOf_.clear();
  for (const std::uint32_t wall : wallsOf_) recordsOf_.push_back(&frame.walls[wall].records);
  eachTree(state, [&](const BoundsTree& tree, const auto& recordAt) {
    eachPart([&](std::size_t first, std::size_t count) {
      for (const TreeSphere& sphere : bounds_.find(tree, std::span(volumes_).subspan(first, count)))
        if (const InstanceRecord* r = recordAt(tree.indexOf(sphere.place))) keep(sphere, first, *r);
      for (std::size_t v = 0; v < count; ++v) frame.walls[wallsOf_[first + v]].tested += bounds_.tested()[v];
    });
  });
}

/// Keeps the record for the walls that surely show it, and for those for which a test of the record decides.
/// Bit v of the sphere's masks: volumes_[first + v].
void RoomCull::keep(const TreeSphere& sphere, std::size_t first, const InstanceRecord& r) const {
  const std::vector<const InstanceRecord*>* kept = nullptr;  // the volumes of a wall follow each other
  for (unsigned bits = sphere.seen | sphere.unsure; bits != 0; bits &= bits - 1) {
    const auto bit = static_cast<std::size_t>(std::countr_zero(bits)), v = first + bit;
    std::vector<const InstanceRecord*>* records = recordsOf_[v];
    if (records == kept) continue;
    if (!((sphere.seen >> bit) & 1)) {
      const Vec3 centre = Vec3(r.centre[0], r.centre[1], r.centre[2]) - volumes_[v].origin;
      if (!volumes_[v].volume.mayTouch(Sphere{centre, r.radius})) continue;
    }
    records->push_back(&r);
    kept = records;
  }
}

void RoomCull::reached(const SlotView& state, const EyeChoice& choice, std::size_t wall,
                       std::vector<NodeRef>& owners) {
  const Visibility visible = visibleIn(state, choice);
  if (!visible.on(wall).looks) return;
  const std::lock_guard lock(mutex_);
  volumes_.clear();
  wallsOf_.clear();
  addVolumes(static_cast<std::uint32_t>(wall), visible.on(wall).placed);
  eachTree(state, [&](const BoundsTree& tree, const auto& recordAt) {
    bounds_.find(tree, volumes_);
    for (const TreeGroup& group : bounds_.reached())
      for (std::uint32_t place = BoundsLayout::kWide * group.group;
           place < std::min(tree.count, BoundsLayout::kWide * (group.group + 1)); ++place)
        if (const InstanceRecord* r = recordAt(tree.indexOf(place)); r && isShown(*r))
          owners.push_back(r->owner);
  });
}

}  // namespace stadion
