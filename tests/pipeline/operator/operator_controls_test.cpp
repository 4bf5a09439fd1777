/// Requests of the operator while the next show is created.

#include "pipeline/operator/operator_controls.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

TEST(OperatorControls, AnotherRequestForTheNextGroupBeforeItsFirstPictureMeansThatOne) {
  OperatorControls controls(false, 0.064);
  int told = 0;
  controls.told = [&](std::uint64_t, const OperatorCommand&) { ++told; };
  const auto ask = [&](std::uint64_t frame) {
    controls.queue().post({OperatorAction::NextGroup});
    controls.beginFrame(frame);
  };
  for (int i = 0; i < 3; ++i) controls.queue().post({OperatorAction::NextGroup});
  controls.beginFrame(10);
  EXPECT_TRUE(controls.leaving());
  EXPECT_EQ(told, 1) << "three at once are one";
  controls.beginGroup();
  controls.awaitPicture();
  ask(0);
  EXPECT_FALSE(controls.leaving()) << "it has hardly begun";
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(controls.pictureSeen());
  EXPECT_FALSE(controls.pictureSeen()) << "only one is the first";
  ask(1);
  EXPECT_TRUE(controls.leaving());
  EXPECT_EQ(controls.groups(), 2u);
}

}  // namespace
}  // namespace stadion
