#include "pipeline/target/monitor_rows.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr PixelRectangle kFirst{0, 0, 1920, 1080}, kRight{1920, 31, 1280, 720}, kAbove{0, -769, 1024, 769};

TEST(MonitorRows, AreCountedFromTheTopOfTheMonitor) {
  const std::vector<PixelRectangle> monitors{kFirst, kRight, kAbove};
  for (const std::int32_t y : {0, 1, 31, 400, 839}) {
    const auto on = [&](const PixelRectangle& m) {
      return partsOnMonitors({m.x, m.y + y, 320, 240}, monitors).front().firstRow;
    };
    EXPECT_EQ(on(kFirst), y);
    if (y + 240 <= 720) {
      EXPECT_EQ(on(kRight), y);
      EXPECT_EQ(on(kAbove), y);
    }
  }
}

TEST(MonitorRows, AWindowOnTwoMonitorsHasAPartOnEach) {
  const std::vector<PixelRectangle> monitors{kFirst, kRight};
  const auto parts = partsOnMonitors({1820, 100, 400, 50}, monitors);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0], (MonitorPart{{100, 0, 300, 50}, 69})) << "the larger one first";
  EXPECT_EQ(parts[1], (MonitorPart{{0, 0, 100, 50}, 100}));
}

TEST(MonitorRows, AWindowMayReachBeyondItsMonitor) {
  const std::vector<PixelRectangle> monitors{kRight};
  const auto parts = partsOnMonitors({1900, 20, 400, 50}, monitors);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0], (MonitorPart{{20, 11, 380, 39}, -11}));
}

TEST(MonitorRows, AWindowOnNoMonitorIsOnePart) {
  EXPECT_EQ(partsOnMonitors({5, 31, 40, 50}, {}).size(), 1U);
  EXPECT_EQ(partsOnMonitors({5, 31, 40, 50}, {}).front(), (MonitorPart{{0, 0, 40, 50}, 31}));
  const std::vector<PixelRectangle> far{{5000, 0, 100, 100}};
  EXPECT_EQ(partsOnMonitors({5, 31, 40, 50}, far).front().firstRow, 31);
}

TEST(MonitorRows, AScaledScreenHasRowsOfPixels) {
  const std::vector<PixelRectangle> monitors{{0, 0, 960, 540}};
  EXPECT_EQ(partsOnMonitors({0, 15, 100, 50}, monitors, 2).front(), (MonitorPart{{0, 0, 200, 100}, 30}));
  EXPECT_EQ(partsOnMonitors({0, 2, 100, 50}, monitors, 1.5).front(), (MonitorPart{{0, 0, 150, 75}, 3}));
}

}  // namespace
}  // namespace stadion
