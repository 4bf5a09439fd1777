#include "pipeline/state/still_bounds.h"
#include "tests/pipeline/cull/cull_room.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using test::Random;
using test::thing;

struct Built {
  std::vector<std::byte> memory;
  BoundsTree tree;

  explicit Built(const std::vector<InstanceRecord>& records) : memory(stillBoundsBytes(records.size()) + 64) {
    std::byte* at = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64;
    buildStillBounds(records, at);
    tree = stillBounds(at, records.size());
  }
  float sphere(std::uint32_t place, std::uint32_t k) const {
    return tree.floats[place / 8 * 32 + 8 * k + place % 8];
  }
  float box(std::uint32_t level, std::uint32_t node, std::uint32_t k) const {
    return tree.floats[tree.layout.at[level] + node / 8 * 48 + 8 * k + node % 8];
  }
};

TEST(StillBounds, HoldEveryThingThatIsShownOnceAndEachBoxHoldsWhatIsBelow) {
  Random random(10);
  for (const std::uint32_t count : {0U, 1U, 8U, 9U, 64U, 65U, 513U, 5000U}) {
    std::vector<InstanceRecord> records;
    std::uint32_t shown = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      records.push_back(thing(Vec3(1e6, 0, 0) + random.within(100), random.sizeFrom(0.01, 10)));
      if (random.below(10) == 0)
        records.back().flags = 0;
      else
        ++shown;
    }
    const Built b(records);
    ASSERT_EQ(b.tree.count, shown);
    std::vector<int> times(count);
    for (std::uint32_t place = 0; place < shown; ++place) {
      const InstanceRecord& r = records[b.tree.indexOf(place)];
      ++times[b.tree.indexOf(place)];
      for (std::uint32_t k = 0; k < 3; ++k)
        EXPECT_NEAR(b.sphere(place, k), r.centre[k] - b.tree.origin[static_cast<int>(k)], 1e-4);
      EXPECT_EQ(b.sphere(place, 3), r.radius);
    }
    for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(times[i], isShown(records[i]) ? 1 : 0);
    for (std::uint32_t level = 1; level <= b.tree.top(); ++level)
      for (std::uint32_t node = 0; node < b.tree.nodes(level - 1); ++node)
        for (std::uint32_t k = 0; k < 3; ++k) {
          const bool lowest = level == 1;
          const float lo = lowest ? b.sphere(node, k) - b.sphere(node, 3) : b.box(level - 1, node, k);
          const float hi = lowest ? b.sphere(node, k) + b.sphere(node, 3) : b.box(level - 1, node, k + 3);
          ASSERT_LE(b.box(level, node / 8, k), lo);
          ASSERT_GE(b.box(level, node / 8, k + 3), hi);
        }
  }
}

/// Of all boxes of eight.
double volumeOf(const Built& b) {
  double volume = 0;
  for (std::uint32_t node = 0; node < b.tree.nodes(1); ++node) {
    double v = 1;
    for (std::uint32_t k = 0; k < 3; ++k) v *= double{b.box(1, node, k + 3) - b.box(1, node, k)};
    volume += v;
  }
  return volume;
}

TEST(StillBounds, NeighboursAreTogetherAndHugeThingsApart) {
  Random random(11);
  std::vector<InstanceRecord> records;
  for (int i = 0; i < 8000; ++i) records.push_back(thing(random.within(100), 0.1));
  const double fewHuge = [&] {
    std::vector<InstanceRecord> with = records;
    for (std::size_t i = 0; i < with.size(); i += 20) with[i].radius = 300;
    std::size_t spoilt = 0;
    const Built b(with);
    for (std::uint32_t node = 0; node < b.tree.nodes(1); ++node)
      spoilt += b.box(1, node, 3) - b.box(1, node, 0) > 100;
    return static_cast<double>(spoilt) / b.tree.nodes(1);
  }();
  // A cube of eight things that are spread evenly has a volume of 8e6 m3 / 1000; boxes around them are
  // smaller.
  EXPECT_LT(volumeOf(Built(records)), 8e6);
  EXPECT_LT(fewHuge, 0.1) << "a twentieth of all is huge, and hardly more boxes are";
}

TEST(StillBounds, TakeLittleMemory) {
  EXPECT_LT(stillBoundsBytes(1'000'000), 23.5e6);
}

}  // namespace
}  // namespace stadion
