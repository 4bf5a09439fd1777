/// Late frames have a cause, and the last ones are kept whatever happens.

#include "profiling/black_box.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("black-box-" + std::to_string(::getpid()));
  Folder() { fs::create_directory(path); }
  ~Folder() { fs::remove_all(path); }
  std::string file() const { return (path / "last.frames").string(); }
};

FrameFacts facts(float period) {
  FrameFacts f;
  f.frame = 7, f.period = period, f.budget = 16.7f, f.walls = 2;
  f.app.ms = f.app.processor = 2;
  for (StageFacts& s : f.cull) s.ms = s.processor = 1;
  for (StageFacts& s : f.draw) s.ms = 8;
  return f;
}

Cause causeOf(FrameFacts f) {
  judge(f);
  return f.cause;
}

TEST(FrameVerdict, AFrameInTimeHasNone) {
  EXPECT_EQ(causeOf(facts(17)), Cause::None);
  FrameFacts unpaced = facts(500);
  unpaced.budget = 0;
  EXPECT_EQ(causeOf(unpaced), Cause::None);
}

TEST(FrameVerdict, TheStageThatTookLongIsNamedWithItsWall) {
  FrameFacts f = facts(60);
  f.draw[1].ms = 50;
  judge(f);
  EXPECT_EQ(f.cause, Cause::Draw);
  EXPECT_EQ(f.wall, 1U);
  const std::vector<std::string> walls{"front", "floor"};
  EXPECT_EQ(toText(f, walls), "frame 7 came after 60.0 ms (16.7): Draw of wall floor took 50.0 ms");
  f = facts(60), f.cull[0].ms = f.cull[0].processor = 40;
  EXPECT_EQ(causeOf(f), Cause::Cull);
  f = facts(60), f.app.ms = f.app.processor = 40;
  EXPECT_EQ(causeOf(f), Cause::App);
}

TEST(FrameVerdict, WhatTheStageWaitedForIsTheCause) {
  FrameFacts f = facts(60);
  f.app.ms = 50, f.app.switches = 3;
  EXPECT_EQ(causeOf(f), Cause::Preempted);
  f.app.faults = 4000;
  EXPECT_EQ(causeOf(f), Cause::PageFaults);
  f.app.loading = 45;
  EXPECT_EQ(causeOf(f), Cause::Loading);
  f = facts(60), f.draw[0].turn = 40, f.draw[1].ms = 39;
  judge(f);
  EXPECT_EQ(f.cause, Cause::Turn);
  EXPECT_EQ(f.wall, 0U);
  EXPECT_EQ(f.holder, 1U);
  EXPECT_EQ(causeOf(facts(60)), Cause::Unknown) << "no stage took long";
}

TEST(FrameVerdict, ADrawWithoutProcessorsIsPreempted) {
  FrameFacts f = facts(60);
  f.draw[1].ms = 50, f.draw[1].delayed = 35;
  judge(f);
  EXPECT_EQ(f.cause, Cause::Preempted);
  const std::vector<std::string> walls{"front", "floor"};
  EXPECT_EQ(toText(f, walls),
            "frame 7 came after 60.0 ms (16.7): Draw of wall floor took 50.0 ms, 35.0 of them "
            "without a processor, which others had");
  f.draw[1].delayed = 5;
  EXPECT_EQ(causeOf(f), Cause::Draw);
}

TEST(FrameVerdict, OfALateDrawWhoHasMostToDrawIsNamed) {
  FrameFacts f = facts(60);
  f.draw[1].ms = 50;
  copyText("playfield kick.evs:32", f.drawn);
  judge(f);
  const std::vector<std::string> walls{"front", "floor"};
  EXPECT_NE(toText(f, walls).find("; most there is to draw of playfield kick.evs:32"), std::string::npos);
}

class Played {
public:
  explicit Played(const std::string& file) {
    auto made =
        BlackBox::create({file, 60, {"front"}, [this](const std::string& t) { told.push_back(t); }}, names);
    if (made) box = std::move(made.value());
    log = std::make_unique<FrameLog>(std::vector<SpanReader*>{box.get()},
                                     FrameLogOptions{.samples = false, .from = 0});
  }
  /// A frame at 60 Hz, in which a node takes so long.
  void frame(std::uint64_t n, std::chrono::milliseconds stall = {}) {
    {
      const SpanScope app(log.get(), Span::App, n, kNoWall);
      const SpanScope node(log.get(), Span::Simulate, NodeRef{1, 4});
      const auto end = ProfileClock::now() + stall;
      while (ProfileClock::now() < end) {
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const SpanScope swap(log.get(), Span::Swap, n, kNoWall);
  }
  std::vector<std::string> told;
  NodeNames names;
  std::unique_ptr<BlackBox> box;
  std::unique_ptr<FrameLog> log;
};

TEST(ThreadsBlackBox, AStallIsNamedAtOnceAndKept) {
  const Folder folder;
  Played show(folder.file());
  ASSERT_TRUE(show.box);
  for (std::uint64_t n = 0; n < 6; ++n) show.frame(n, std::chrono::milliseconds(n == 3 ? 60 : 0));
  show.log->finish();
  ASSERT_FALSE(show.told.empty());
  EXPECT_NE(show.told[0].find("frame 3 "), std::string::npos) << show.told[0];
  const auto kept = BlackBox::read(folder.file());
  ASSERT_TRUE(kept);
  ASSERT_EQ(kept.value().frames.size(), 6U);
  const Cause cause = kept.value().frames[3].cause;
  EXPECT_TRUE(cause == Cause::App || cause == Cause::Preempted) << "others may have been at work, too";
  EXPECT_EQ(kept.value().frames[3].stage, Span::App);
  EXPECT_EQ(kept.value().frames[3].dearest(), (NodeRef{1, 4}));
  EXPECT_GT(kept.value().frames[3].nodeMs, 55);
}

TEST(BlackBox, OnlyTheLastFramesAreKept) {
  const Folder folder;
  NodeNames names;
  auto box = BlackBox::create({folder.file(), 60, {"front"}, {}}, names);
  ASSERT_TRUE(box);
  SpanRecord swap;
  swap.what = Span::Swap;
  for (swap.frame = 0; swap.frame < 1000; ++swap.frame) {
    swap.ended += std::chrono::milliseconds(16);
    box.value()->take(0, swap);
  }
  const auto kept = BlackBox::read(folder.file());
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept.value().frames.size(), BlackBox::kFrames);
  EXPECT_EQ(kept.value().frames.front().frame, 400U);
  EXPECT_EQ(kept.value().frames.back().frame, 999U);
  box.value().reset();
  EXPECT_FALSE(fs::exists(folder.file())) << "no frame was late, so nobody needs it";
}

TEST(BlackBox, WhatIsNoneIsRefused) {
  const Folder folder;
  EXPECT_FALSE(BlackBox::read(folder.file()));
  std::ofstream(folder.file()) << "stadion frames1 and rubbish";
  const auto wrong = BlackBox::read(folder.file());
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("holds no frames"), std::string::npos);
  NodeNames names;
  EXPECT_FALSE(BlackBox::create({(folder.path / "not/there").string(), 60, {}, {}}, names));
}

}  // namespace
}  // namespace stadion
