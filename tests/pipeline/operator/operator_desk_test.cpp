/// What the operator asks for while a show is being made anew.

#include "pipeline/operator/operator_desk.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

TEST(OperatorDesk, AnotherRequestForTheNextGroupBeforeItsFirstPictureMeansThatOne) {
  OperatorDesk desk(false, 0.064);
  int told = 0;
  desk.told = [&](std::uint64_t, const OperatorCommand&) { ++told; };
  const auto ask = [&](std::uint64_t frame) {
    desk.queue().post({OperatorAction::NextGroup});
    desk.beginFrame(frame);
  };
  for (int i = 0; i < 3; ++i) desk.queue().post({OperatorAction::NextGroup});
  desk.beginFrame(10);
  EXPECT_TRUE(desk.leaving());
  EXPECT_EQ(told, 1) << "three at once are one";
  desk.beginGroup();
  desk.awaitPicture();
  ask(0);
  EXPECT_FALSE(desk.leaving()) << "it has hardly begun";
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(desk.pictureSeen());
  EXPECT_FALSE(desk.pictureSeen()) << "only one is the first";
  ask(1);
  EXPECT_TRUE(desk.leaving());
  EXPECT_EQ(desk.groups(), 2u);
}

}  // namespace
}  // namespace stadion
