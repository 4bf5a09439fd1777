#pragma once
/// Random rooms and things for the tests of Cull, and the simplest Cull there is, to compare with.

#include "pipeline/cull/cull.h"
#include "pipeline/cull/eye_test.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace stadion::test {

class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  /// Evenly from `least` to `most`.
  double from(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(engine_);
  }
  /// As often from 1 to 10 as from 10 to 100.
  double sizeFrom(double least, double most) { return std::exp(from(std::log(least), std::log(most))); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  Vec3 within(double half) { return {from(-half, half), from(-half, half), from(-half, half)}; }
  Quat turned() { return Quat(from(-1, 1), from(-1, 1), from(-1, 1), from(0.1, 1)).normalized(); }

private:
  std::mt19937 engine_;
};

inline InstanceRecord thing(const Vec3& centre, double radius, std::uint32_t mesh = 1,
                            NodeRef owner = {1, 0}) {
  InstanceRecord r{};
  r.model[0] = r.model[5] = r.model[10] = radius;
  for (int k = 0; k < 3; ++k) r.model[4 * k + 3] = r.centre[k] = centre[k];
  r.radius = static_cast<float>(radius), r.mesh = mesh, r.flags = InstanceRecord::kShown, r.owner = owner;
  return r;
}

inline Wall wallOf(const Vec3& lowerLeft, const Vec3& lowerRight, const Vec3& upperLeft) {
  Wall w;
  w.lowerLeft = lowerLeft, w.lowerRight = lowerRight, w.upperLeft = upperLeft;
  return w;
}

/// The six sides of a box about the rig's origin, seen from inside.
inline std::vector<WallViews> boxRoom(double half, const DepthRange& depth) {
  const double h = half;
  std::vector<WallViews> views;
  for (const Wall& wall :
       {wallOf({-h, h, -h}, {h, h, -h}, {-h, h, h}), wallOf({-h, -h, -h}, {-h, h, -h}, {-h, -h, h}),
        wallOf({h, h, -h}, {h, -h, -h}, {h, h, h}), wallOf({-h, -h, -h}, {h, -h, -h}, {-h, h, -h}),
        wallOf({h, -h, -h}, {-h, -h, -h}, {h, -h, h}), wallOf({-h, h, h}, {h, h, h}, {-h, -h, h})}) {
    WallViews view;
    view.views = viewsOf(wall, true), view.depth = depth;
    views.push_back(view);
  }
  return views;
}

/// Heads in the middle, close to a wall, in a corner, and leaning out of the room.
inline Pose headIn(double half, Random& random) {
  Vec3 p = random.within(0.5 * half);
  for (std::uint32_t lean = random.below(4); lean > 0; --lean)
    p[static_cast<int>(random.below(3))] = (random.below(2) ? 1 : -1) * random.from(0.9, 1.02) * half;
  return {p, random.turned()};
}

/// Everything of a slot, one record after the other.
template <class F>
void forEachRecord(const SlotView& state, const F& f) {
  for (const ChunkId id : state.chunks) {
    const ChunkView chunk = state.chunk(id);
    for (std::size_t i = 0; i < chunk.records.size(); ++i)
      if (!((chunk.hidden[i / 64] >> (i % 64)) & 1)) f(chunk.records[i]);
  }
  for (const InstanceRecord& r : state.instances) f(r);
}

/// What a wall may see, by looking at every record.
inline std::vector<const InstanceRecord*> simplySeen(const SlotView& state, const WallViews& view) {
  const PlacedViews placed = place(*state.viewer, view, {});
  const ConvexVolume volume = placed.volume(0, placed.count);
  std::vector<const InstanceRecord*> seen;
  forEachRecord(state, [&](const InstanceRecord& r) {
    const Vec3 centre = Vec3(r.centre[0], r.centre[1], r.centre[2]) - placed.origin;
    if (isShown(r) && volume.mayTouch(Sphere{centre, r.radius})) seen.push_back(&r);
  });
  return seen;
}

/// What goes into the order of a list, compared as it is written down.
inline void simplySort(DrawList& list) {
  std::sort(list.opaque.begin(), list.opaque.end(), [](const DrawItem& a, const DrawItem& b) {
    const auto rank = [](const DrawItem& d) { return d.views == 1 ? 0 : d.views == 2 ? 2 : 1; };
    return std::tuple(a.mesh, a.level, rank(a), a.distance, a.owner, a.model) <
           std::tuple(b.mesh, b.level, rank(b), b.distance, b.owner, b.model);
  });
  std::sort(list.transparent.begin(), list.transparent.end(), [](const DrawItem& a, const DrawItem& b) {
    return std::tuple(a.owner, a.mesh, a.model) < std::tuple(b.owner, b.mesh, b.model);
  });
}

/// The same as WallCull::fill, as it is written down.
inline DrawList simplyFilled(const SlotView& state, const WallViews& view) {
  DrawList list;
  place(*state.viewer, view, {}).setUp(list);
  const EyeTest sees(list, false, view.width, view.height);
  for (const InstanceRecord* r : simplySeen(state, view)) {
    DrawItem item;
    for (int k = 0; k < 12; ++k)
      item.model[static_cast<std::size_t>(k)] =
          static_cast<float>(r->model[k] - (k % 4 == 3 ? list.origin[k / 4] : 0.0));
    item.mesh = r->mesh, item.owner = r->owner;
    std::array<float, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = static_cast<float>(r->centre[k] - list.origin[static_cast<int>(k)]);
    item.distance = std::sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    item.views = sees.viewsThatSee(at, r->radius);
    if (item.views == 0) continue;
    (r->flags & InstanceRecord::kTransparent ? list.transparent : list.opaque).push_back(item);
  }
  simplySort(list);
  return list;
}

inline bool alike(const DrawItem& a, const DrawItem& b) {
  return std::tie(a.model, a.mesh, a.owner, a.distance, a.pixels, a.level, a.views) ==
         std::tie(b.model, b.mesh, b.owner, b.distance, b.pixels, b.level, b.views);
}

/// Plays changes into the slots in turn, as a show does.
struct Frames {
  SceneState state;
  ViewerRecord viewer;
  std::size_t frame = 0;

  SlotView publish(ChangeSet changes) {
    const std::size_t slot = frame % kSlots;
    changes.viewer = viewer;
    changes.signature.frame = frame++;
    state.publish(slot, changes);
    return state.view(slot);
  }
};

}  // namespace stadion::test
