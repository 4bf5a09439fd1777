/// Draw lists are those of the simplest Cull, item by item.

#include "tests/pipeline/cull/cull_room.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

namespace stadion {
namespace {

using test::boxRoom;
using test::Frames;
using test::Random;
using test::thing;

std::vector<InstanceRecord> crowd(Random& random, std::uint32_t count) {
  std::vector<InstanceRecord> records;
  for (std::uint32_t i = 0; i < count; ++i) {
    records.push_back(thing(random.within(30), 0.3, 1 + 1000003 * random.below(9), {1, random.below(50)}));
    if (random.below(10) == 0) records.back().flags |= InstanceRecord::kTransparent;
    if (random.below(10) == 0) {  // at the same distance as the one before
      const InstanceRecord& other = records[random.below(i + 1)];
      std::copy_n(other.centre, 3, records.back().centre);
    }
  }
  return records;
}

void expectAlike(std::vector<DrawItem> a, const std::vector<DrawItem>& b) {
  for (DrawItem& item : a) item.pixels = 0;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(test::alike(a[i], b[i])) << "item " << i;
}

TEST(DrawLists, AreThoseOfTheSimplestCullWhereverRecordsLie) {
  Random random(6);
  const std::vector<WallViews> views = boxRoom(1.5, {0.1, 40});
  for (int round = 0; round < 20; ++round) {
    Frames f;
    f.viewer.set({random.within(10), random.turned()}, test::headIn(1.5, random));
    const std::vector<InstanceRecord> all = crowd(random, round < 3 ? 60 : 2000);
    ChangeSet still, moving;
    still.chunks = {{f.state.arena().add(all), true}};
    for (const InstanceRecord& r : all)
      moving.instances.push_back({static_cast<InstanceId>(moving.instances.size()), r});
    Frames other;
    other.viewer = f.viewer;
    const SlotView a = f.publish(still), b = other.publish(moving);
    RoomCull roomA(views), roomB(views);
    for (std::uint32_t wall = 0; wall < views.size(); ++wall) {
      DrawList fromChunk, fromInstances;
      WallCull({roomA}, wall).fill(a, {}, fromChunk);
      WallCull({roomB}, wall).fill(b, {}, fromInstances);
      const DrawList simple = test::simplyFilled(a, views[wall]);
      for (const DrawList& list : {fromChunk, fromInstances}) {
        ASSERT_NO_FATAL_FAILURE(expectAlike(list.opaque, simple.opaque));
        ASSERT_NO_FATAL_FAILURE(expectAlike(list.transparent, simple.transparent));
        EXPECT_EQ(list.origin, simple.origin);
        EXPECT_EQ(list.views[1].view, simple.views[1].view);
      }
    }
  }
}

TEST(DrawLists, WhereEyesMayGoBeforeTheyDrawBothDrawAll) {
  Random random(16);
  std::vector<WallViews> views = boxRoom(1.5, {0.1, 40});
  views[0].eyeSeparation = 0.5;
  Frames f;
  ChangeSet c;
  c.chunks = {{f.state.arena().add(crowd(random, 2000)), true}};
  const SlotView state = f.publish(c);
  const auto forOneEye = [&](const HeadReach& reach) {
    views[0].reach = reach;
    RoomCull room(views);
    DrawList list;
    WallCull({.room = room, .oneSample = true}, 0).fill(state, {}, list);
    return std::ranges::count_if(list.opaque, [](const DrawItem& d) { return d.views != 3; });
  };
  EXPECT_GT(forOneEye({}), 0);
  EXPECT_EQ(forOneEye({0.05, 0.25}), 0);
}

TEST(DrawLists, AreSortedByWhatThingsAre) {
  Random random(7);
  for (const std::uint32_t count : {0U, 1U, 2U, 63U, 64U, 65U, 5000U}) {
    std::vector<InstanceRecord> records(count);
    std::vector<DrawnRecord> opaque, transparent;
    DrawList simple;
    for (InstanceRecord& r : records) {
      DrawItem item;
      item.mesh = random.below(3) ? random.below(5) : random.below(~0U);
      item.level = random.below(3);
      item.views = 1 + random.below(3);
      item.distance = random.below(4) ? static_cast<float>(random.sizeFrom(1e-6, 1e9)) : 0;
      item.owner = {random.below(3), random.below(3)};
      item.model.fill(0);
      item.model[random.below(12)] = static_cast<float>(random.from(-1, 1));
      std::ranges::copy(item.model, r.model);
      r.owner = item.owner, r.mesh = item.mesh;
      opaque.push_back({&r, item.mesh, item.distance, item.level, item.views});
      simple.opaque.push_back(item), simple.transparent.push_back(item);
    }
    transparent = opaque;
    test::simplySort(simple);
    DrawOrder order;
    order.sortOpaque(opaque), order.sortTransparent(transparent);
    const auto placeOf = [](const DrawnRecord& d) {
      std::array<float, 12> model;
      std::ranges::transform(d.record->model, model.begin(), [](double x) { return static_cast<float>(x); });
      return std::tuple(d.distance, d.mesh, d.record->owner, model);
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      const DrawItem &a = simple.opaque[i], &b = simple.transparent[i];
      ASSERT_EQ(placeOf(opaque[i]), std::tuple(a.distance, a.mesh, a.owner, a.model)) << i << " of " << count;
      ASSERT_EQ(std::tie(opaque[i].level, opaque[i].views), std::tie(a.level, a.views));
      const auto [distance, mesh, owner, model] = placeOf(transparent[i]);
      ASSERT_EQ(std::tuple(mesh, owner, model), std::tuple(b.mesh, b.owner, b.model));
    }
  }
}

TEST(DrawLists, AShowWithoutShadowsLooksForNoCasters) {
  Frames f;
  ChangeSet c;
  c.lightsChanged = true, c.lights.resize(1);
  c.lights[0].range = 1;  // casts shadows
  c.instances = {{0, thing({0, 5, 0}, 1)}};
  const SlotView state = f.publish(c);
  const std::vector<WallViews> views = boxRoom(1.5, {0.1, 40});
  RoomCull room(views);
  StillCasters still;
  DrawList list;
  WallCull({room, &still}, 0).fill(state, {}, list);
  EXPECT_EQ(list.shadows.light, 0);
  WallCull({room}, 0).fill(state, {}, list);
  EXPECT_EQ(list.shadows.light, -1);
}

/// Notes what it is told.
class Probe final : public FrameProbe {
public:
  void began(Span, std::uint64_t, std::uint32_t) override {}
  void began(Span what, NodeRef) override { spans.push_back(what); }
  void ended(Span) override {}
  void counted(Count what, std::uint64_t amount, NodeRef) override { counts[what] = amount; }
  bool wantsShares(std::uint64_t, std::uint32_t) const override { return true; }
  void shared(Span what, std::uint64_t, std::uint32_t, std::span<const NodeRef> nodes) override {
    shares[what] = {nodes.begin(), nodes.end()};
  }

  std::vector<Span> spans;
  std::map<Count, std::uint64_t> counts;
  std::map<Span, std::multiset<NodeRef>> shares;
};

TEST(DrawLists, ReportWhatWasTestedAndForWhichNodes) {
  Random random(14);
  Frames f;
  ChangeSet c;
  std::vector<InstanceRecord> records;
  for (std::uint32_t i = 0; i < 5000; ++i) records.push_back(thing(random.within(100), 0.2, 1, {1, i}));
  c.chunks = {{f.state.arena().add(records), true}};
  for (std::uint32_t i = 0; i < 3; ++i) c.instances.push_back({i, thing({0, 5.0 + i, 0}, 0.1, 1, {2, i})});
  const SlotView state = f.publish(c);
  const std::vector<WallViews> views = boxRoom(1.5, {0.1, 40});
  RoomCull room(views);
  for (const std::uint32_t wall : {0U, 4U}) {  // the first that comes searches for all
    Probe probe;
    DrawList list;
    WallCull({.room = room, .probe = &probe}, wall).fill(state, {}, list);
    EXPECT_EQ(probe.spans, (std::vector<Span>{Span::Test, Span::Eyes, Span::Fill, Span::Sort, Span::Fill}));
    EXPECT_EQ(probe.counts[Count::Seen], list.opaque.size());
    EXPECT_GT(probe.counts[Count::Tested], list.opaque.size());
    EXPECT_LT(probe.counts[Count::Tested], records.size() / 2) << "most are in boxes that are not seen";
    const auto &tested = probe.shares[Span::Test], &seen = probe.shares[Span::Fill];
    EXPECT_EQ(seen.size(), list.opaque.size());
    EXPECT_TRUE(std::ranges::includes(tested, seen));
    EXPECT_LT(tested.size(), records.size() / 2);
  }
}

}  // namespace
}  // namespace stadion
