/// Beside exact culling for each eye alone: nothing is ever missed, and hardly anything kept in vain.

#include "tests/pipeline/cull/cull_room.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

using test::Random;
using test::thing;

/// Nearest to p of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 nearestOf(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  return a + (ab * vb + ac * vc) / (va + vb + vc);
}

/// What one eye sees, as a solid (World axes relative to the head).
struct Solid {
  ConvexVolume planes;
  std::array<Vec3, 8> corners;  ///< near, then far, each from the lower left, counter-clockwise

  Solid(const PlacedViews& placed, std::uint32_t v) : planes(placed.volume(v, v + 1)) {
    const EyeFrustum f = eyeFrustum(*placed.views[v].screen, placed.views[v].eye, placed.depth);
    const Affine X_RE = f.X_ER.inverse();
    for (std::size_t i = 0; i < 8; ++i) {
      const double scale = i < 4 ? 1 : f.depth.far / f.depth.near;
      const bool right = i % 4 == 1 || i % 4 == 2, up = i % 4 >= 2;
      const Vec3 p_E(scale * (right ? f.right : f.left), scale * (up ? f.top : f.bottom),
                     -scale * f.depth.near);
      corners[i] = placed.X_WR * (X_RE * p_E) - placed.origin;
    }
  }
  double distance(const Vec3& p) const {
    if (planes.contains(p)) return 0;
    constexpr std::size_t kFaces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                          {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    double least = 1e300;
    for (const auto& f : kFaces)
      for (const std::size_t k : {1, 2})
        least = std::min(least, (p - nearestOf(p, corners[f[0]], corners[f[k]], corners[f[k + 1]])).norm());
    return least;
  }
};

struct CullCounts {
  std::size_t touched = 0, kept = 0;
  double excess() const { return static_cast<double>(kept) / static_cast<double>(touched) - 1; }
};

/// Culls `count` spheres about the visitor for a random room; nothing that an eye can see may be missing.
void cullOneRoom(Random& random, std::uint32_t count, const auto& radius, CullCounts& counts) {
  const double half = random.from(0.5, 3);
  std::vector<WallViews> views = test::boxRoom(half, {0.1, random.sizeFrom(10, 500)});
  for (WallViews& view : views) view.eyeSeparation = random.from(0, 0.08);
  const Vec3 rig = random.below(3) == 0 ? random.within(1e6) : random.within(50);
  test::Frames f;
  f.viewer.set({rig, random.turned()}, test::headIn(half, random));
  const double spread = random.sizeFrom(0.2, 1.5) * views[0].depth.far;
  std::vector<InstanceRecord> records;
  for (std::uint32_t i = 0; i < count; ++i) records.push_back(thing(rig + random.within(spread), radius()));
  ChangeSet c;
  c.chunks = {{f.state.arena().add(records), true}};
  RoomCull room(views);
  const SlotView state = f.publish(c);
  const RoomCull::Visibility seen = room.visibleIn(state);
  for (std::size_t wall = 0; wall < views.size(); ++wall) {
    const PlacedViews placed = place(f.viewer, views[wall], {});
    const Solid left(placed, 0), right(placed, 1);
    std::vector<const InstanceRecord*> kept = seen.on(wall).records;
    std::ranges::sort(kept);
    const ChunkView chunk = state.chunk(1);
    for (const InstanceRecord& r : chunk.records) {
      const Vec3 p = Vec3(r.centre[0], r.centre[1], r.centre[2]) - placed.origin;
      const double away = std::min(left.distance(p), right.distance(p)) - double{r.radius};
      const bool isKept = std::ranges::binary_search(kept, &r);
      const double rounded = 1e-9 * (p.norm() + views[wall].depth.far);
      if (away < -rounded) {
        ASSERT_TRUE(isKept) << fmt::format("wall {}, radius {}, {} m inside", wall, r.radius, -away);
      }
      counts.touched += away <= 0, counts.kept += isKept;
    }
  }
}

TEST(ExactCull, NothingIsMissedAndHardlyAnythingKeptInVain) {
  Random random(8);
  CullCounts all;
  for (int room = 0; room < 300; ++room) {
    CullCounts one;
    ASSERT_NO_FATAL_FAILURE(cullOneRoom(
        random, 400, [&] { return random.sizeFrom(1e-3, 2); }, one));
    all.touched += one.touched, all.kept += one.kept;
  }
  RecordProperty("excess", fmt::format("{:.4f}", all.excess()));
  fmt::print("{} seen, {:.2f} % more kept\n", all.touched, 100 * all.excess());
  EXPECT_GT(all.touched, 20000U);
  EXPECT_LE(all.excess(), 0.02);
  EXPECT_GE(all.excess(), 0);
}

TEST(ExactCull, NothingIsMissedHoweverLargeOrSmall) {
  Random random(9);
  for (int room = 0; room < 150; ++room) {
    CullCounts one;
    ASSERT_NO_FATAL_FAILURE(cullOneRoom(
        random, 300, [&] { return random.sizeFrom(1e-6, 1e4); }, one));
  }
}

}  // namespace
}  // namespace stadion
