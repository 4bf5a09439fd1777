// The head's newest pose in place of App's, just before a frame is drawn, and what Cull has to find for it.
#include "pipeline/loop/head_latch.h"

#include "engine/maths/functions.h"
#include "pipeline/loop/swap_forecast.h"
#include "tests/pipeline/cull/cull_room.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion {
namespace {

using std::chrono::milliseconds;
using TimePoint = HeadLatch::TimePoint;

/// A head that is where the test puts it.
class Head final : public InputDevice {
public:
  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds, InputSample&) override {}
  std::optional<HeadNow> headSoon(Nanoseconds ahead) override {
    asked.push_back(ahead);
    return now;
  }

  std::optional<HeadNow> now;
  std::vector<Nanoseconds> asked;
};

constexpr HeadReach kReach{0.1, 0.3};

/// Of the frame that began then, as Cull fills it from that head.
DrawList listFrom(const Pose& X_RH, const WallViews& view, int frame = 1) {
  DrawList list;
  list.ticket.began = TimePoint(milliseconds(1000 * frame));
  list.ticket.presentation.eyeSeparation = 0.07;
  list.viewer.set({Vec3(100, -20, 3), det::fromEuler(0, 0, 0.7)}, X_RH);
  place(list.viewer, view, {0.07}).setUp(list);
  return list;
}

/// Where a point of World is in the picture of an eye.
Vec4 inPicture(const DrawList& list, std::size_t eye, const Vec3& p_W) {
  const Vec3 p = p_W - list.origin;
  return list.views[eye].projection * (list.views[eye].view * Vec4(p.x(), p.y(), p.z(), 1));
}

bool sameEyes(const DrawList& a, const DrawList& b) {
  bool same = a.viewCount == b.viewCount && a.origin == b.origin;
  for (std::size_t eye = 0; eye < 2; ++eye)
    same =
        same && a.views[eye].view == b.views[eye].view && a.views[eye].projection == b.views[eye].projection;
  return same;
}

TEST(HeadLatch, AWallIsDrawnAsIfItHadBeenCulledFromTheNewestHead) {
  const std::vector<WallViews> views = test::boxRoom(1.5, {0.1, 60});
  const Pose sampled{Vec3(0.2, 0.1, 0.3), det::fromEuler(0.1, 0, 0.5)};
  const Pose newest{Vec3(0.25, 0.13, 0.28), det::fromEuler(0.05, 0.1, 0.6)};
  Head head;
  head.now = HeadNow{newest, 12345};
  for (const WallViews& view : views) {
    HeadLatch latch(head, kReach);
    DrawList list = listFrom(sampled, view);
    const DrawList culled = listFrom(newest, view);
    latch.latch(view, {}, list);
    EXPECT_EQ(list.ticket.posed, TimePoint(std::chrono::nanoseconds(12345)));
    test::Random random(5);
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = list.viewer.rig().p + random.within(30);
      for (const std::size_t eye : {0u, 1u})
        EXPECT_NEAR((inPicture(list, eye, p) - inPicture(culled, eye, p)).norm(), 0, 1e-9);
    }
    EXPECT_EQ(latch.counts().latched, 1u);
    EXPECT_EQ(latch.counts().beyond, 0u);
  }
}

TEST(HeadLatch, NothingChangesWithoutNewerDataOrIfTheHeadHasNotMoved) {
  const WallViews view = test::boxRoom(1.5, {0.1, 60})[0];
  const Pose sampled{Vec3(0.2, 0.1, 0.3), det::fromEuler(0.1, 0, 0.5)};
  Head head;
  HeadLatch latch(head, kReach);
  DrawList list = listFrom(sampled, view);
  list.ticket.posed = TimePoint(milliseconds(5));
  latch.latch(view, {}, list);
  EXPECT_TRUE(sameEyes(list, listFrom(sampled, view)));
  EXPECT_EQ(list.ticket.posed, TimePoint(milliseconds(5)));
  EXPECT_EQ(latch.counts().latched, 0u);
  head.now = HeadNow{list.viewer.head(), 7};
  list.ticket.began += milliseconds(1);
  latch.latch(view, {}, list);
  EXPECT_TRUE(sameEyes(list, listFrom(sampled, view)));
  EXPECT_EQ(list.ticket.posed, TimePoint(std::chrono::nanoseconds(7)));
  head.now = HeadNow{{Vec3(NAN, 0, 0), Quat::Identity()}, 8};
  list.ticket.began += milliseconds(1);
  latch.latch(view, {}, list);
  EXPECT_TRUE(sameEyes(list, listFrom(sampled, view)));
}

TEST(HeadLatch, AHeadThatHasGoneTooFarIsDrawnFromTheEdgeOfTheReachAndCounted) {
  const WallViews view = test::boxRoom(1.5, {0.1, 60})[0];
  Head head;
  head.now = HeadNow{{Vec3(0.5, 0, 0), det::expRotation(Vec3(0, 0, -1.2))}, 1};
  HeadLatch latch(head, kReach);
  DrawList list = listFrom({}, view);
  latch.latch(view, {}, list);
  EXPECT_NEAR((list.viewer.head().p - Vec3(kReach.metres, 0, 0)).norm(), 0, 1e-12);
  const Quat edge = det::expRotation(Vec3(0, 0, -kReach.radians));
  EXPECT_NEAR(list.viewer.head().q.angularDistance(edge), 0, 1e-7);
  EXPECT_EQ(latch.counts().beyond, 1u);
  EXPECT_NEAR(latch.counts().farthest, 0.5, 1e-12);
  EXPECT_NEAR(latch.counts().widest, 1.2, 1e-12);
}

TEST(HeadLatch, AllWallsOfAFrameAreDrawnFromOneHeadAndTheNextFrameFromAYoungerOne) {
  const std::vector<WallViews> views = test::boxRoom(1.5, {0.1, 60});
  Head head;
  HeadLatch latch(head, kReach);
  for (int frame = 1; frame <= 3; ++frame)
    for (std::size_t wall = 0; wall < views.size(); ++wall) {
      head.now = HeadNow{{Vec3(0.01 * frame + 0.001 * static_cast<double>(wall), 0, 0), Quat::Identity()}, 1};
      DrawList list = listFrom({}, views[wall], frame);
      latch.latch(views[wall], {}, list);
      EXPECT_NEAR(list.viewer.head().p.x(), 0.01 * frame, 1e-15) << "of the first wall";
    }
  EXPECT_EQ(latch.counts().latched, 3u);
  EXPECT_EQ(head.asked.size(), 3u);
}

TEST(HeadLatch, TheHeadIsAskedForWhereItWillBeWhenPicturesAreSeenAndNeverForThePast) {
  const WallViews view = test::boxRoom(1.5, {0.1, 60})[0];
  Head head;
  HeadLatch latch(head, kReach);
  DrawList list = listFrom({}, view, 1), next = listFrom({}, view, 2);
  latch.latch(view, std::chrono::steady_clock::now() + std::chrono::hours(1), list);
  latch.latch(view, std::chrono::steady_clock::now() - std::chrono::hours(1), next);
  ASSERT_EQ(head.asked.size(), 2u);
  EXPECT_GT(head.asked[0], 3'500'000'000'000);
  EXPECT_LE(head.asked[0], 3'600'000'000'000);
  EXPECT_EQ(head.asked[1], 0);
}

TEST(HeadLatch, ExchangedEyesStayExchangedAndCamerasAreNoHead) {
  WallViews view = test::boxRoom(1.5, {0.1, 60})[0];
  Head head;
  head.now = HeadNow{{Vec3(0.05, 0, 0), Quat::Identity()}, 1};
  HeadLatch latch(head, kReach);
  DrawList plain = listFrom({}, view), exchanged = plain;
  exchanged.ticket.presentation.swapEyes = true;
  latch.latch(view, {}, plain), latch.latch(view, {}, exchanged);
  EXPECT_EQ(plain.views[0].view, exchanged.views[1].view);
  EXPECT_EQ(plain.views[1].view, exchanged.views[0].view);
  struct Blind final : FreeCamera {
    std::optional<CameraView> view() const override { return {}; }
    void addTo(std::vector<InstanceRecord>&, const ViewerRecord&) const override {}
  } blind;
  view.camera = &blind;
  DrawList outside = listFrom({}, view);
  const DrawList before = outside;
  latch.latch(view, {}, outside);
  EXPECT_TRUE(sameEyes(outside, before));
}

/// A head anywhere within the reach, as often at its edge as inside.
Pose movedWithin(const HeadReach& reach, const Pose& from, test::Random& random) {
  const auto share = [&] { return random.below(2) ? 1.0 : random.from(0, 1); };
  const Vec3 way = random.within(1).normalized(), axis = random.within(1).normalized();
  return {from.p + share() * reach.metres * way,
          (det::expRotation(share() * reach.radians * axis) * from.q).normalized()};
}

// The property that late latch stands on: whatever an eye sees from anywhere within the reach has been found.
TEST(HeadReach, CullFindsWhatIsSeenFromAnywhereWithin) {
  test::Random random(23);
  std::size_t seenFromThere = 0, onlyFromThere = 0;
  for (int round = 0; round < 200; ++round) {
    const double half = random.from(0.5, 3);
    const HeadReach reach{random.from(0, 0.2), random.from(0, 0.6)};
    std::vector<WallViews> views = test::boxRoom(half, {0.1, random.sizeFrom(10, 500)}), bare = views;
    for (WallViews& view : views) view.reach = reach;
    test::Frames f;
    const Vec3 rig = random.within(50);
    f.viewer.set({rig, random.turned()}, test::headIn(half, random));
    std::vector<InstanceRecord> records;
    const double spread = random.sizeFrom(0.2, 1.5) * views[0].depth.far;
    for (int i = 0; i < 400; ++i)
      records.push_back(test::thing(rig + random.within(spread), random.sizeFrom(1e-3, 2)));
    ChangeSet c;
    c.chunks = {{f.state.arena().add(records), true}};
    RoomCull room(views), narrow(bare);
    const SlotView state = f.publish(c);
    const RoomCull::Visibility seen = room.visibleIn(state), seenBefore = narrow.visibleIn(state);
    for (int move = 0; move < 8; ++move) {
      ViewerRecord there = f.viewer;
      there.set(there.rig(), movedWithin(reach, f.viewer.head(), random));
      for (std::size_t wall = 0; wall < views.size(); ++wall) {
        std::vector<const InstanceRecord*> found = seen.on(wall).records;
        std::vector<const InstanceRecord*> before = seenBefore.on(wall).records;
        std::ranges::sort(found), std::ranges::sort(before);
        for (const double side : {-1.0, 1.0}) {  // each eye by itself, without any margin
          WallViews one = bare[wall];
          one.views[0].from = ViewPoint::Middle, one.views.pop_back();
          ViewerRecord eye = there;
          const Pose X_RH = there.head();
          eye.set(there.rig(), {X_RH * Vec3(0.5 * side * bare[wall].eyeSeparation, 0, 0), X_RH.q});
          const PlacedViews placed = place(eye, one, {});
          const ConvexVolume volume = placed.volume(0, 1);
          for (const InstanceRecord& r : state.chunk(1).records) {
            const Vec3 centre = Vec3(r.centre[0], r.centre[1], r.centre[2]) - placed.origin;
            const auto inside = [&] {
              return volume.contains(centre + 0.999 * r.radius * random.within(1).normalized());
            };
            if (!volume.contains(centre) && !inside() && !inside()) continue;
            ++seenFromThere;
            onlyFromThere += !std::ranges::binary_search(before, &r);
            ASSERT_TRUE(std::ranges::binary_search(found, &r)) << "wall " << wall << ", round " << round;
          }
        }
      }
    }
  }
  EXPECT_GT(seenFromThere, 50'000u);
  EXPECT_GT(onlyFromThere, 200u) << "else the reach is not what was tested";
}

TEST(HeadReach, NoReachIsNoMargin) {
  const WallViews view = test::boxRoom(1.5, {0.1, 60})[0];
  EXPECT_EQ(place({}, view, {}).margin, 0);
  EXPECT_EQ(HeadReach{}.ofEyes(0.064), 0);
  EXPECT_NEAR((HeadReach{0.1, 0.5}.ofEyes(0.064)), 0.116, 1e-5);
}

TEST(SwapForecast, IsTheMiddleOfTheLastFramesSoThatOneLateFrameChangesNothing) {
  SwapForecast forecast;
  EXPECT_EQ(forecast.expected(), 0);
  for (int i = 0; i < 40; ++i) forecast.note(milliseconds(i % 9 == 8 ? 500 : 30));
  EXPECT_EQ(forecast.expected(), 30'000'000);
  for (int i = 0; i < 8; ++i) forecast.note(milliseconds(50));
  EXPECT_EQ(forecast.expected(), 50'000'000);
}

}  // namespace
}  // namespace stadion
