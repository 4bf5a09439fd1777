/// Keyboard and mouse as head and wand.

#include "pipeline/device/desk_visitor.h"

#include <cmath>
#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr Nanoseconds kFrame = 16'666'667;

/// Somebody at a desk whose samples are taken sixty times a second.
class Desk {
public:
  InputSample frames(int count) {
    InputSample sample;
    for (int i = 0; i < count; ++i, now_ += kFrame) visitor.sampleFrame(now_ - kFrame, now_, sample);
    return sample;
  }
  DeskVisitor visitor;

private:
  Nanoseconds now_ = kFrame;
};

Vec3 ahead(const InputSample& sample, std::size_t tracker) {
  return sample.trackers[tracker].X_RT.q * Vec3::UnitY();
}

constexpr std::size_t kHead = 0, kWand = 1;

TEST(DeskVisitor, AFrozenHeadStaysWhileTheHandGoesWhereTheEyesWould) {
  Desk desk;
  desk.frames(2);
  desk.visitor.freezeHead(true);
  desk.visitor.turn(1, 0);
  desk.visitor.setStep({0, 1, 0});
  const InputSample later = desk.frames(60);
  EXPECT_EQ(later.trackers[kHead].X_RT.p, Vec3(0, 0, 1.7));
  EXPECT_NEAR(ahead(later, kHead).x(), 0, 1e-12);
  EXPECT_GT(ahead(later, kWand).x(), 0.8);
}

TEST(DeskVisitor, AHeadThatIsLetGoEasesToWhereItHasBeenTurnedMeanwhile) {
  Desk desk;
  desk.frames(2);
  desk.visitor.freezeHead(true);
  desk.visitor.turn(1, 0);
  desk.frames(10);
  desk.visitor.freezeHead(false);
  double before = 0;
  for (int i = 0; i < 30; ++i) {
    const double now = ahead(desk.frames(1), kHead).x();
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 0.06) << "it does not jump";
    before = now;
  }
  EXPECT_NEAR(ahead(desk.frames(5), kHead).x(), std::sin(1.0), 1e-9);
}

TEST(DeskVisitor, LooksAboutWhileTheShowStandsStill) {
  Desk desk;
  desk.frames(2);
  desk.visitor.turn(0.5, 0);
  InputSample still;
  ASSERT_TRUE(desk.visitor.sampleNow(still));
  EXPECT_NEAR(ahead(still, kHead).x(), std::sin(0.5), 1e-9);
  desk.visitor.freezeHead(true);
  desk.visitor.turn(0.5, 0);
  desk.visitor.sampleNow(still);
  EXPECT_NEAR(ahead(still, kHead).x(), std::sin(0.5), 1e-9) << "unless it is frozen";
}

TEST(DeskVisitor, IsNoLongerFrozenWhenTheShowRestarts) {
  Desk desk;
  desk.frames(2);
  desk.visitor.freezeHead(true);
  desk.visitor.turn(0.5, 0);
  desk.visitor.restart();
  EXPECT_NEAR(ahead(desk.frames(1), kHead).x(), std::sin(0.5), 1e-9);
}

}  // namespace
}  // namespace stadion
