/// Adjusting a hall: commands, undo, and what is written back.

#include "show/adjust/hall_adjuster.h"

#include "engine/base/plain_file.h"
#include "show/adjust/adjust_pictures.h"
#include "tests/fresh_folder.h"

#include <fstream>
#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr const char* kAdjusted =
    "# two projectors on one wall\n"
    "visitor 0 0 1.7 within 0.2\n"
    "screen front plane  lower-left -2 2 0.7  lower-right 2 2 0.7  upper-left -2 2 2.7\n"
    "projector left   screen front  pixels 200 160  pins 0 0  1.6 0  1.6 1  0 1   # pinned\n"
    "projector right  screen front  pixels 200 160  pins -0.6 0  1 0  1 1  -0.6 1\n"
    "projector round  screen front  pixels 100 100  at 0 0 1.7  turn 0 0  fisheye 90  eye right  no-blend\n"
    "wall side  lower-left 2 2 0.7  lower-right 2 -2 0.7  upper-left 2 2 2.7\n"
    "output side  rectangle 0 0 400 200\n";

class HallAdjusting : public testing::Test {
protected:
  void SetUp() override {
    path_ = (folder_.path() / "hall.walls").string();
    std::ofstream(path_) << kAdjusted;
    Diagnostics out;
    const auto hall = loadWalls(path_, "", out);
    ASSERT_TRUE(hall) << out.all()[0].message;
    auto opened = HallAdjuster::open(*hall);
    ASSERT_TRUE(opened) << opened.error().message;
    adjuster_.emplace(std::move(opened.value()));
  }

  AdjustOutcome say(const std::string& line) {
    const AdjustWords words = adjustCommandOf(line);
    EXPECT_TRUE(words.command) << words.problem;
    return words.command ? adjuster_->apply(*words.command) : AdjustOutcome{};
  }
  std::string content() const { return readPlainFile(path_, 1 << 20).value(); }

  FreshFolder folder_;
  std::string path_;
  std::optional<HallAdjuster> adjuster_;
};

TEST_F(HallAdjusting, PinsMoveByPixelsAndTheFileGetsTheirNumbersAlone) {
  EXPECT_EQ(adjuster_->state(), "left: pin 1 (upper left) at 0 0 (0.0 0.0 pixels)");
  EXPECT_EQ(say("right 10").changed, 0u);
  say("pin 3");
  say("up");
  say("left 0.5");
  EXPECT_EQ(adjuster_->state(),
            "left: pin 3 (lower right) at 1.5975 0.99375 (319.5 159.0 pixels); moved [not saved]");
  EXPECT_EQ(content(), kAdjusted) << "before it is saved";
  EXPECT_FALSE(say("save").refused);
  std::string expected = kAdjusted;
  const std::string before = "pins 0 0  1.6 0  1.6 1  0 1   # pinned";
  expected.replace(expected.find(before), before.size(),
                   "pins 0.05 0  1.6 0  1.5975 0.99375  0 1   # pinned");
  EXPECT_EQ(content(), expected);
  EXPECT_FALSE(adjuster_->unsaved());
  EXPECT_TRUE(say("quit").ended);
}

TEST_F(HallAdjusting, UndoAndRedoGoThroughAllChanges) {
  say("right 3");
  say("next");
  say("edge left");
  say("right 20");
  EXPECT_EQ(adjuster_->state(), "right: edge left at 0.1 (20.0 pixels); moved [not saved]");
  EXPECT_EQ(adjuster_->hall().walls[1].projector->blend.edges[0], 0.1);
  EXPECT_EQ(say("undo").changed, 1u);
  EXPECT_EQ(adjuster_->hall().walls[1].projector->blend.edges[0], 0);
  EXPECT_EQ(say("undo").changed, 0u);
  EXPECT_EQ(adjuster_->chosen(), 0u);
  EXPECT_FALSE(adjuster_->unsaved()) << "the text is that of the file again";
  EXPECT_TRUE(say("undo").refused);
  say("redo");
  say("redo");
  EXPECT_TRUE(say("redo").refused);
  say("save");
  EXPECT_NE(content().find("pins -0.6 0  1 0  1 1  -0.6 1  edge-left 0.1\n"), std::string::npos) << content();
  EXPECT_NE(content().find("pins 0.015 0  1.6 0"), std::string::npos) << content();
}

TEST_F(HallAdjusting, FlatWallsHaveTheCornersOfTheirOutput) {
  say("projector side");
  say("pin 2");
  say("left 4");
  EXPECT_TRUE(say("edge left").refused);
  say("save");
  EXPECT_NE(content().find("output side  rectangle 0 0 400 200  warp 0 0  0.99 0  1 1  0 1\n"),
            std::string::npos)
      << content();
  EXPECT_EQ((*adjuster_->hall().walls[3].output->shape.warp)[1], Vec2(0.99, 0));
  EXPECT_TRUE(say("projector round").refused) << "a fisheye has neither";
}

TEST_F(HallAdjusting, WhatMakesNoPictureIsRefused) {
  say("pin 1");
  EXPECT_TRUE(say("right 5000").refused);
  EXPECT_EQ((*adjuster_->pins())[0], Vec2(0, 0));
  say("edge top");
  EXPECT_TRUE(say("up").refused) << "it goes no farther";
  EXPECT_TRUE(say("left").refused);
  say("down 1000");
  EXPECT_EQ(adjuster_->hall().walls[0].projector->blend.edges[2], kMostEdge);
  EXPECT_FALSE(adjuster_->unsaved() && content() != kAdjusted);
}

TEST_F(HallAdjusting, AFileThatSomebodyElseChangedIsLeftAlone) {
  say("right 3");
  std::ofstream(path_) << kAdjusted << "# by hand\n";
  EXPECT_TRUE(say("save").refused);
  EXPECT_NE(adjuster_->state().find("has been changed by somebody else"), std::string::npos);
  EXPECT_EQ(content(), std::string(kAdjusted) + "# by hand\n");
  EXPECT_FALSE(say("quit").ended) << "changes are not saved";
  EXPECT_TRUE(say("quit").ended);
}

TEST_F(HallAdjusting, PicturesFollowAChangeAndThenThoseOfNeighbours) {
  auto pictures = AdjustPictures::create(adjuster_->hall(), HallPattern::Blend, false);
  ASSERT_TRUE(pictures) << pictures.error().message;
  say("projector round");
  const auto shown = [&](std::size_t entry) {
    return pictures.value()->pictures(*adjuster_, entry, 400, 200)[0];
  };
  const auto value = [&](std::size_t entry, std::uint32_t x) { return int(shown(entry).at(x, 20)[1]); };
  // The overlap is from 0.6 of the right one's picture to the left... both fade out at their own borders.
  const int left = value(0, 190), right = value(1, 10);
  EXPECT_LT(left, 100);
  EXPECT_LT(right, 100);
  say("projector right");
  say("edge left");
  const auto moved = say("right 40");
  ASSERT_EQ(moved.changed, 1u);
  pictures.value()->change(adjuster_->hall(), *moved.changed);
  EXPECT_EQ(pictures.value()->refresh(adjuster_->hall()), 1u) << "the changed one first";
  EXPECT_EQ(value(1, 10), 0) << "beyond the edge the neighbour gives the light";
  EXPECT_EQ(value(0, 190), left);
  EXPECT_TRUE(pictures.value()->refresh(adjuster_->hall()));
  while (pictures.value()->refresh(adjuster_->hall())) {
  }
  EXPECT_GT(value(0, 190), left);
}

TEST(AdjustCommand, WordsAndKeysMeanTheSame) {
  using Kind = AdjustCommand::Kind;
  const auto pressed = [](Key key, bool shift = false, bool control = false) {
    WindowEvent e;
    e.key = key;
    e.down = true;
    e.shift = shift;
    e.control = control;
    return adjustCommandOf(e);
  };
  EXPECT_EQ(pressed(Key::Left, true)->right, adjustCommandOf("left 10").command->right);
  EXPECT_EQ(pressed(Key::Down, false, true)->down, adjustCommandOf("down 0.1").command->down);
  EXPECT_EQ(pressed(static_cast<Key>('7'))->number, adjustCommandOf("edge right").command->number);
  EXPECT_EQ(pressed(static_cast<Key>('4'))->number, adjustCommandOf("pin 4").command->number);
  EXPECT_EQ(pressed(Key::Tab, true)->kind, Kind::Previous);
  EXPECT_EQ(pressed(static_cast<Key>('S'))->kind, adjustCommandOf("save").command->kind);
  EXPECT_FALSE(pressed(static_cast<Key>('X')));
  EXPECT_FALSE(adjustCommandOf("").command);
  EXPECT_EQ(adjustCommandOf("").problem, "");
  EXPECT_NE(adjustCommandOf("pin 5").problem, "");
  EXPECT_NE(adjustCommandOf("lift 3").problem, "");
  EXPECT_NE(adjustCommandOf("save now").problem, "");
}

}  // namespace
}  // namespace stadion
