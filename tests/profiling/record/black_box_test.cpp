/// Late frames have a cause, and the last ones are kept whatever happens.

#include "profiling/record/black_box.h"
#include "profiling/record/black_box_folder.h"
#include "tests/fresh_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = makeFreshFolder();
  ~Folder() { fs::remove_all(path); }
  std::string file() const { return (path / "last.frames").string(); }
};

FrameFacts facts(float period, std::size_t walls = 2) {
  FrameFacts f(walls);
  f.frame = 7, f.period = period, f.budget = 16.7f;
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
  f.app.ms = 50, f.app.delayed = 45;
  EXPECT_EQ(causeOf(f), Cause::Preempted);
  f.app.delayed = 0, f.app.faults = 4000;
  EXPECT_EQ(causeOf(f), Cause::PageFaults);
  f.app.loading = 45;
  EXPECT_EQ(causeOf(f), Cause::Loading);
  f = facts(60), f.draw[0].turn = 40, f.draw[1].ms = 39;
  judge(f);
  EXPECT_EQ(f.cause, Cause::Turn);
  EXPECT_EQ(f.wall, 0U);
  EXPECT_EQ(f.holder, 1U);
  FrameFacts idle = facts(60);
  for (StageFacts& s : idle.draw) s.ms = 1;
  EXPECT_EQ(causeOf(idle), Cause::Unknown) << "no stage took long";
}

/// 60 ms after the one before, though its stages, one after the other, took 4 ms.
FrameFacts shortStages() {
  FrameFacts f = facts(60);
  f.sinceApp = f.budget, f.tick = 10, f.appFrame = f.frame;
  f.app.at = 56, f.swap.at = 60;
  for (StageFacts& s : f.cull) s.at = 58;
  for (StageFacts& s : f.draw) s.at = 59, s.ms = 1;
  return f;
}

std::string verdictOn(FrameFacts f) {
  judge(f);
  const std::string_view begin = "frame 7 came after 60.0 ms (16.7): ";
  const std::vector<std::string> walls{"front", "floor"};
  return std::string(nameOf(f.cause)) + ": " + toText(f, walls).substr(begin.size());
}

TEST(FrameVerdict, OfShortStagesTheOneThatBeganLateIsTheCause) {
  FrameFacts f = shortStages();
  f.sinceApp = 50;
  EXPECT_EQ(verdictOn(f),
            "follows a late frame: App had missed its tick for the frame before, and began 33.3 ms late");
  f.slot = 30;
  EXPECT_EQ(verdictOn(f), "follows a late frame: App waited 30.0 ms for earlier frames to be drawn");
  f.slot = 0, f.tick = 50;
  EXPECT_EQ(verdictOn(f), "woken late: the system woke App 33.3 ms after its tick");
  f = shortStages(), f.app.at = 15;
  EXPECT_EQ(verdictOn(f),
            "woken late: Cull of wall front was woken 41.0 ms after what it waited for was done");
  f.cull[0].at = f.cull[1].at = 17;
  EXPECT_EQ(verdictOn(f),
            "woken late: Draw of wall front was woken 41.0 ms after what it waited for was done");
  f.draw[0].at = 18, f.draw[1].at = 19;
  EXPECT_EQ(verdictOn(f), "woken late: Swap was woken 40.0 ms after what it waited for was done");
  f.swap.ms = 50;
  EXPECT_EQ(verdictOn(f), "Swap over: showing it took 50.0 ms");
}

TEST(FrameVerdict, WhatIsUnknownIsToldWithItsFigures) {
  EXPECT_EQ(verdictOn(shortStages()),
            "unknown: no stage took long, all together 6.0 ms; App began 16.7 ms after "
            "App before it, and 56.0 ms after the frame before was shown");
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

TEST(FrameVerdict, OfALateDrawTheNodeWithMostToDrawIsNamed) {
  FrameFacts f = facts(60);
  f.draw[1].ms = 50;
  copyText("playfield kick.evs:32", f.most);
  judge(f);
  const std::vector<std::string> walls{"front", "floor"};
  EXPECT_NE(toText(f, walls).find("; most there is to draw of playfield kick.evs:32"), std::string::npos);
}

TEST(FrameVerdict, OfALateCullTheNodeWithMostToCullIsNamed) {
  FrameFacts f = facts(60);
  f.cull[0].ms = f.cull[0].processor = 40;
  copyText("village kick.evs:32", f.most);
  judge(f);
  const std::vector<std::string> walls{"front", "floor"};
  EXPECT_EQ(toText(f, walls),
            "frame 7 came after 60.0 ms (16.7): Cull of wall front took 40.0 ms; most there "
            "is to cull of village kick.evs:32");
}

TEST(FrameVerdict, AppThatWaitsForAHelperIsOverAndNotPreempted) {
  FrameFacts f = facts(60);
  f.app.ms = 55, f.app.processor = 5, f.app.switches = 1, f.nodeMs = 50;
  copyText("game kick.evs:5", f.name);
  judge(f);
  EXPECT_EQ(f.cause, Cause::App);
  EXPECT_EQ(toText(f, {}),
            "frame 7 came after 60.0 ms (16.7): App took 55.0 ms; most expensive: game kick.evs:5, 50.0 ms");
  f.nodeMs = 0.01f;
  EXPECT_EQ(toText(f, {}), "frame 7 came after 60.0 ms (16.7): App took 55.0 ms") << "it is not its fault";
}

/// Whatever was under way when others got the processor took long by the clock.
TEST(FrameVerdict, ANodeIsNamedOnlyWhereAppTookLongByItself) {
  FrameFacts f = facts(60);
  f.app.ms = f.app.processor = 55, f.nodeMs = 50;
  copyText("game kick.evs:5", f.name);
  judge(f);
  EXPECT_EQ(f.cause, Cause::App);
  EXPECT_TRUE(nodeExplains(f));
  FrameFacts preempted = f, loading = f, faults = f, draw = f;
  preempted.app.processor = 5, preempted.app.delayed = 50;
  loading.app.loading = 50;
  faults.app.processor = 5, faults.app.faults = 900;
  draw.draw[1].ms = 70;
  for (FrameFacts* other : {&preempted, &loading, &faults, &draw}) {
    judge(*other);
    EXPECT_NE(other->cause, Cause::App);
    EXPECT_FALSE(nodeExplains(*other)) << nameOf(other->cause);
    EXPECT_EQ(toText(*other, {}).find("game"), std::string::npos) << toText(*other, {});
  }
}

TEST(FrameVerdict, AStageThatBeginsLateForWantOfAProcessorIsPreempted) {
  FrameFacts f = facts(60);
  for (StageFacts& s : f.draw) s.ms = 1;
  f.app.late = 40;
  judge(f);
  EXPECT_EQ(f.cause, Cause::Preempted);
  EXPECT_EQ(toText(f, {}), "frame 7 came after 60.0 ms (16.7): App began 40.0 ms late without a processor, "
                           "which others had");
  f.app.late = 0, f.swap.late = 40;
  EXPECT_EQ(causeOf(f), Cause::Preempted);
}

TEST(FrameVerdict, StagesThatFollowEachOtherCountTogether) {
  FrameFacts f = facts(33.3f, 4);
  f.sequential = 1;
  f.app.ms = f.app.processor = 6;
  for (std::uint32_t w = 0; w < 4; ++w) f.draw[w].ms = 5.5f;
  f.draw[2].ms = 5.6f;
  judge(f);
  EXPECT_EQ(f.cause, Cause::Draw);
  EXPECT_EQ(f.wall, 2U);
  const std::vector<std::string> walls{"front", "left", "right", "floor"};
  EXPECT_EQ(toText(f, walls),
            "frame 7 came after 33.3 ms (16.7): Draw of wall right took 5.6 ms, which with the "
            "other stages came to 32.1 ms");
  f.sequential = 0;
  for (StageFacts& s : f.draw) s.ms = 7;
  EXPECT_EQ(causeOf(f), Cause::Draw) << "they may share the processors";
}

TEST(FrameVerdict, AFrameIsNotLateForThatItsDrawingWasSampled) {
  FrameFacts f = facts(60);
  f.sampled = 1;
  f.draw[1].ms = 50;
  EXPECT_EQ(causeOf(f), Cause::None);
  f.app.ms = f.app.processor = 40;
  EXPECT_EQ(causeOf(f), Cause::App);
}

/// What a judge makes of spans that are made up.
struct Judged {
  NodeNames names;
  std::vector<FrameFacts> shown;
  FrameJudge judge{60, 1, names, [this](const FrameFacts& f) { shown.push_back(f); }};
  ProfileClock::time_point now{};

  void frame(std::uint64_t n, double draw, bool sampled = false) {
    SpanRecord r;
    r.frame = n, r.wall = 0, r.what = Span::Draw, r.took = draw, r.disturbed = sampled;
    judge.take(1, r);
    now += std::chrono::milliseconds(n == 0 ? 1000 : static_cast<int>(draw));
    r.what = Span::Swap, r.wall = kNoWall, r.took = 0.1, r.ended = now, r.disturbed = false;
    judge.take(1, r);
  }
};

TEST(FrameVerdict, OfASampledFrameAndTheNextDrawingIsNotTheCause) {
  Judged j;
  j.frame(0, 10), j.frame(1, 50, true), j.frame(2, 50), j.frame(3, 50);
  EXPECT_EQ(j.shown[1].cause, Cause::None);
  EXPECT_EQ(j.shown[2].cause, Cause::None);
  EXPECT_EQ(j.shown[3].cause, Cause::Draw);
}

/// Its thread's events may be read last, when many frames that came after it have begun.
TEST(FrameVerdict, AFrameThatIsOlderThanAllOthersIsJudged) {
  Judged j;
  SpanRecord r;
  r.what = Span::App, r.took = 1;
  for (r.frame = 1; r.frame <= 200; ++r.frame) j.judge.take(0, r);
  j.frame(0, 10);
  ASSERT_EQ(j.shown.size(), 1u);
  EXPECT_EQ(j.shown[0].frame, 0u);
}

TEST(FrameVerdict, WhatHeldUpAppInAFrameThatWasPassedOverHeldUpTheNextOneShown) {
  Judged j;
  j.frame(0, 10);
  SpanRecord app;
  app.what = Span::App, app.took = 0.1;
  for (app.frame = 1; app.frame < 4; ++app.frame) {
    app.began = j.now + std::chrono::milliseconds(40), app.use.late = app.frame == 1 ? 40 : 0;
    j.judge.take(0, app);
  }
  j.now += std::chrono::milliseconds(40);
  j.frame(3, 1);
  ASSERT_EQ(j.shown.size(), 2U);
  EXPECT_EQ(j.shown[1].cause, Cause::Preempted);
  const std::vector<std::string> walls{"front"};
  EXPECT_EQ(toText(j.shown[1], walls),
            "frame 3 came after 41.0 ms (16.7): App of frame 1, not shown, began 40.0 ms "
            "late without a processor, which others had");
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
  std::optional<Folder> folder;
  std::vector<std::string> told;
  // On a busy machine another frame may be late as well; then the next run may have a calm one.
  for (int attempt = 0; told.size() != 1 && attempt < 100; ++attempt) {
    folder.reset(), folder.emplace();
    Played show(folder->file());
    ASSERT_TRUE(show.box);
    for (std::uint64_t n = 0; n < 6; ++n) show.frame(n, std::chrono::milliseconds(n == 3 ? 60 : 0));
    show.log->finish();
    told = show.told;
  }
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("frame 3 "), std::string::npos) << told[0];
  const auto kept = BlackBox::read(folder->file());
  ASSERT_TRUE(kept);
  ASSERT_EQ(kept.value().frames.size(), 6U);
  const Cause cause = kept.value().frames[3].cause;
  EXPECT_TRUE(cause == Cause::App || cause == Cause::Preempted) << "others may have been at work, too";
  EXPECT_EQ(kept.value().frames[3].stage, Span::App);
  EXPECT_EQ(kept.value().frames[3].mostExpensive(), (NodeRef{1, 4}));
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
  EXPECT_FALSE(fs::exists(folder.file())) << "no frame was late, so it is not needed";
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

std::string contentOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(BlackBox, WhatIsSomethingElseIsLeftAsItIs) {
  const Folder folder;
  const NodeNames names;
  std::ofstream(folder.file()) << "the only copy of a thesis";
  const auto refused = BlackBox::create({folder.file(), 60, {"front"}, {}}, names);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("name a file that is not there yet"), std::string::npos);
  EXPECT_EQ(contentOf(folder.file()), "the only copy of a thesis");

  const std::string pipe = (folder.path / "pipe").string(), link = (folder.path / "link").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink(folder.file(), link);
  for (const std::string& other : {pipe, link, folder.path.string()}) {
    const auto wrong = BlackBox::create({other, 60, {"front"}, {}}, names);
    ASSERT_FALSE(wrong) << other;
    EXPECT_NE(wrong.error().message.find("no plain file"), std::string::npos) << wrong.error().message;
    EXPECT_TRUE(fs::exists(fs::symlink_status(other))) << other;
  }
  EXPECT_EQ(contentOf(folder.file()), "the only copy of a thesis");
  EXPECT_FALSE(BlackBox::read(pipe)) << "and the reader does not wait for it";
}

TEST(BlackBox, OnlyWhatItMadeGoesWithIt) {
  const Folder folder;
  const NodeNames names;
  std::ofstream(folder.file()).flush();
  ASSERT_TRUE(BlackBox::create({folder.file(), 60, {"front"}, {}}, names)) << "an empty file will do";
  EXPECT_TRUE(BlackBox::read(folder.file())) << "no frame was late, but it was there before";
  ASSERT_TRUE(BlackBox::create({folder.file(), 60, {"floor"}, {}}, names)) << "and so will an earlier run's";
  EXPECT_EQ(BlackBox::read(folder.file()).value().walls, std::vector<std::string>{"floor"});

  const std::string made = (folder.path / "made").string();
  {
    const auto box = BlackBox::create({made, 60, {}, {}}, names);
    ASSERT_TRUE(box);
    fs::rename(made, folder.path / "moved");
    std::ofstream(made) << "somebody else's";
  }
  EXPECT_EQ(contentOf(made), "somebody else's");
}

TEST(BlackBox, TwoRunsDoNotShareAFile) {
  const Folder folder;
  const NodeNames names;
  auto first = BlackBox::create({folder.file(), 60, {"front"}, {}}, names);
  ASSERT_TRUE(first);
  const auto second = BlackBox::create({folder.file(), 60, {"floor"}, {}}, names);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("another run"), std::string::npos) << second.error().message;
  EXPECT_EQ(BlackBox::read(folder.file()).value().walls, std::vector<std::string>{"front"});
  first.value().reset();
  EXPECT_TRUE(BlackBox::create({folder.file(), 60, {"floor"}, {}}, names));
}

std::size_t filesIn(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(BlackBoxFolder, TheNewestStayAndFilesOfOthersAreLeft) {
  const Folder folder;
  const NodeNames names;
  const BlackBoxFolder boxes(folder.path);
  const std::string under = (folder.path / "1999-a-run-that-goes-on.frames").string();
  const auto live = BlackBox::create({under, 60, {}, {}}, names);
  ASSERT_TRUE(live);
  std::ofstream(folder.path / "1998-thesis.frames") << "the only copy";
  std::ofstream(folder.path / "notes.txt") << "stadion frames3 and so on";
  for (std::size_t n = 0; n < BlackBoxFolder::kMost + 4; ++n) {
    const std::string file = boxes.newFile();
    EXPECT_FALSE(fs::exists(file));
    const auto box = BlackBox::create({file, 60, {}, {}}, names);
    ASSERT_TRUE(box);
    EXPECT_EQ(boxes.files().front(), file) << "the newest";
    box.value()->stay();
  }
  EXPECT_EQ(filesIn(folder.path), BlackBoxFolder::kMost + 3);
  EXPECT_TRUE(BlackBox::isWritten(under));
  EXPECT_FALSE(BlackBox::isWritten(boxes.files().front()));
  EXPECT_EQ(contentOf(folder.path / "1998-thesis.frames"), "the only copy");
}

TEST(BlackBox, ADamagedOneIsRefusedOrRead) {
  const Folder folder;
  {
    Played show(folder.file());
    ASSERT_TRUE(show.box);
    for (std::uint64_t n = 0; n < 3; ++n) show.frame(n, std::chrono::milliseconds(n == 1 ? 40 : 0));
    show.log->finish();
  }
  const std::string sound = contentOf(folder.file());
  ASSERT_TRUE(BlackBox::read(folder.file()));
  const std::string damaged = (folder.path / "damaged").string();
  std::size_t refused = 0;
  // The header, the names of walls and the first frames: there is nothing in the others.
  constexpr int kFlips[] = {0xff, 0x80, 0x01};
  for (std::size_t at = 0; at < 4096; at += at < 320 ? 1 : 3)
    for (const int flip : at < 320 ? std::vector<int>(kFlips, kFlips + 3) : std::vector{kFlips[at / 3 % 3]}) {
      std::string bytes = sound;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      std::ofstream(damaged, std::ios::binary)
          .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      const auto content = BlackBox::read(damaged);
      if (!content) {
        ++refused;
        EXPECT_FALSE(content.error().message.empty());
        continue;
      }
      ASSERT_LE(content.value().frames.size(), BlackBox::kFrames);
      for (const FrameFacts& f : content.value().frames) {
        const std::string text = toText(f, content.value().walls);
        EXPECT_LT(text.size(), 700U) << "byte " << at;
        EXPECT_EQ(std::ranges::count_if(text, [](char c) { return c >= 0 && c < 0x20; }), 0) << "byte " << at;
        EXPECT_EQ(text.find("nan"), std::string::npos) << "byte " << at;
      }
    }
  EXPECT_GT(refused, 100U);
  for (const std::size_t length : {std::size_t{0}, std::size_t{15}, std::size_t{17}, sound.size() - 1}) {
    std::ofstream(damaged, std::ios::binary).write(sound.data(), static_cast<std::streamsize>(length));
    EXPECT_FALSE(BlackBox::read(damaged)) << length;
  }
}

}  // namespace
}  // namespace stadion
