/// With --guard, a stage that writes what it may only read ends the run, and is named with the node and
/// field.

#include "engine/base/worker_pool.h"
#include "engine/core/state_hash.h"
#include "pipeline/draw_list/list_filling.h"
#include "pipeline/platform/draw_pool.h"
#include "show/player/write_watching.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <gtest/gtest.h>

#include <barrier>
#include <csignal>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace stadion {
namespace {

/// The stages of a real show, which write where they may not.
class WritingStages final : public Stages {
public:
  using InSlot = std::function<void(const SlotView&)>;
  using InList = std::function<void(DrawList&)>;

  explicit WritingStages(ShowParts parts) : state_(parts.state), show_(std::move(parts)) {}

  InSlot whileCulling, whileDrawing;  ///< of wall 1, from frame 5 on
  InList whileDrawingList;
  std::vector<std::uint64_t> drawn;  ///< by frame: a hash of wall 1's list

  void app(const TimeSignature& now, std::size_t slot) override { show_.app(now, slot); }
  void cull(std::size_t wall, std::size_t slot, DrawList& list) override {
    show_.cull(wall, slot, list);
    if (isPlanted(wall, list) && whileCulling) whileCulling(state_.view(slot));
  }
  Failure openWall(std::size_t) override { return {}; }
  Failure draw(std::size_t wall, const DrawList& list) override {
    const bool whole = !list.filling || list.filling->isWhole();
    EXPECT_TRUE(whole);
    if (wall == 0) drawn.push_back(hashOfItems(list));
    // Any slot that App does not write: the newest may be written already.
    if (isPlanted(wall, list) && whileDrawing)
      for (std::size_t slot = 0; slot < kSlots; ++slot)
        if (const SlotView view = state_.view(slot); view.written > 0 && view.written % 2 == 0)
          return whileDrawing(view), kNoFailure;
    if (isPlanted(wall, list) && whileDrawingList) whileDrawingList(const_cast<DrawList&>(list));
    return {};
  }
  void closeWall(std::size_t) override {}
  Failure swap(const TimeSignature& now) override { return show_.swap(now); }

private:
  static bool isPlanted(std::size_t wall, const DrawList& list) {
    return wall == 0 && list.ticket.signature.frame >= 5;
  }
  static std::uint64_t hashOfItems(const DrawList& list) {
    StateHash h(list.ticket.signature.frame);
    for (const DrawItem& item : list.opaque) {
      for (const float m : item.model) h.add(static_cast<double>(m));
      h.add(item.owner);
    }
    return h.value();
  }

  SceneState& state_;
  ShowStages show_;
};

struct GuardedRun {
  Failure failure;
  std::vector<std::uint64_t> drawn;
};

GuardedRun guardedRun(Mode mode, bool guarded, const std::function<void(WritingStages&)>& plant = {}) {
  constexpr std::uint64_t kWatchedFrames = 60;
  const auto player = openShow(testShow("bodies.evs"), "cave4");
  if (!player) return {};
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = nullptr;
  FrameLoopOptions o;
  o.mode = mode, o.walls = parts.walls.size(), o.frames = kWatchedFrames;
  const auto watch = watchWrites(guarded, parts, o);
  WritingStages stages(std::move(parts));
  if (plant) plant(stages);
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  GuardedRun run{loop.run().failure, std::move(stages.drawn)};
  nameNode(run.failure, player->scene());
  return run;
}

/// Where a thing stands that a wall may show.
const InstanceRecord& someInstance(const SlotView& view) {
  for (const InstanceRecord& record : view.instances)
    if (record.radius > 0 && record.owner.valid()) return record;
  return view.instances[0];
}

void moveInSlot(const SlotView& view) {
  const_cast<InstanceRecord&>(someInstance(view)).model[3] += 1;
}

class WriteGuardTest : public testing::TestWithParam<Mode> {};

void expectWrongWrite(const GuardedRun& run, const std::string& stage, const std::string& what) {
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->kind, FailureKind::WrongWrite);
  const std::string& said = run.failure->message;
  EXPECT_EQ(said.find(stage + " of wall 1, frame "), 0U) << said;
  EXPECT_NE(said.find(": wrote to " + what + ", field \"model\", of "), std::string::npos) << said;
  EXPECT_NE(said.find("bodies.evs:"), std::string::npos) << said;
}

TEST_P(WriteGuardTest, NamesAWriteOfCullToASlot) {
  const auto run = guardedRun(GetParam(), true, [](WritingStages& s) { s.whileCulling = moveInSlot; });
  expectWrongWrite(run, "Cull", "the published scene");
}

TEST_P(WriteGuardTest, NamesAWriteOfDrawToASlot) {
  const auto run = guardedRun(GetParam(), true, [](WritingStages& s) { s.whileDrawing = moveInSlot; });
  expectWrongWrite(run, "Draw", "the published scene");
}

TEST_P(WriteGuardTest, NamesAWriteOfADrawPoolsThread) {
  DrawPool pool(2, DrawPool::Callers::Wait);
  const auto run = guardedRun(GetParam(), true, [&](WritingStages& s) {
    s.whileDrawing = [&](const SlotView& view) {
      pool.run(2, [&](std::size_t piece) {
        if (piece == 1) moveInSlot(view);
      });
    };
  });
  expectWrongWrite(run, "Draw", "the published scene");
}

TEST_P(WriteGuardTest, NamesAWriteOfAWorker) {
  WorkerPool pool(2);
  const auto run = guardedRun(GetParam(), true, [&](WritingStages& s) {
    s.whileCulling = [&](const SlotView& view) {
      const std::thread::id caller = std::this_thread::get_id();
      std::barrier both(2);  // each thread has a piece
      pool.run(2, [&](std::size_t) {
        both.arrive_and_wait();
        if (std::this_thread::get_id() != caller) moveInSlot(view);
      });
    };
  });
  expectWrongWrite(run, "Cull", "the published scene");
}

TEST_P(WriteGuardTest, NamesAWriteOfDrawToItsList) {
  const auto run = guardedRun(GetParam(), true, [](WritingStages& s) {
    s.whileDrawingList = [](DrawList& list) {
      if (!list.opaque.empty()) list.opaque.back().model[7] += 0.5F;
    };
  });
  expectWrongWrite(run, "Draw", "the wall's draw list");
}

TEST_P(WriteGuardTest, NamesWhatBelongsToNoNode) {
  const auto viewer = [](const SlotView& view) { const_cast<ViewerRecord*>(view.viewer)->stress = 2; };
  const auto slot = guardedRun(GetParam(), true, [&](WritingStages& s) { s.whileCulling = viewer; });
  ASSERT_TRUE(slot.failure);
  EXPECT_NE(slot.failure->message.find("the published scene, field \"viewer\""), std::string::npos)
      << slot.failure->message;
  const auto list = guardedRun(GetParam(), true, [](WritingStages& s) {
    s.whileDrawingList = [](DrawList& l) { l.sky.hazeDistance += 1; };
  });
  ASSERT_TRUE(list.failure);
  EXPECT_NE(list.failure->message.find("the wall's draw list, field \"sky\""), std::string::npos)
      << list.failure->message;
}

TEST_P(WriteGuardTest, NamesAWriteToAStaticObject) {
  const auto still = [](const SlotView& view) {
    for (const ChunkId id : view.chunks)
      if (const ChunkView chunk = view.chunk(id); !chunk.records.empty())
        const_cast<InstanceRecord&>(chunk.records[0]).flags ^= InstanceRecord::kShown;
  };
  const TestFolder folder;
  const auto player =
      openShow(folder.write("still.evs", "object( file=football.3ds, position=\"0, 5, 1\" )\n"), "cave4");
  ASSERT_TRUE(player);
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = nullptr;
  FrameLoopOptions o;
  o.mode = GetParam(), o.walls = parts.walls.size(), o.frames = 20;
  const auto watch = watchWrites(true, parts, o);
  WritingStages stages(std::move(parts));
  stages.whileCulling = still;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  const Failure failure = loop.run().failure;
  ASSERT_TRUE(failure);
  EXPECT_TRUE(failure->node.valid());
  EXPECT_NE(failure->message.find("field \"flags\""), std::string::npos) << failure->message;
}

TEST_P(WriteGuardTest, ChangesNothingInAShowThatWritesNowhereElse) {
  const GuardedRun guarded = guardedRun(GetParam(), true), plain = guardedRun(GetParam(), false);
  EXPECT_FALSE(guarded.failure) << guarded.failure->message;
  EXPECT_FALSE(guarded.drawn.empty());
  EXPECT_EQ(guarded.drawn, plain.drawn);
}

INSTANTIATE_TEST_SUITE_P(Modes, WriteGuardTest, testing::Values(Mode::Sequential, Mode::Pipelined),
                         [](const auto& mode) {
                           return mode.param == Mode::Sequential ? "sequential" : "pipelined";
                         });

TEST(ProgramWriteGuard, LeavesOtherFaultsToThemselves) {
  const auto player = openShow(testShow("bodies.evs"), "cave4");
  ASSERT_TRUE(player);
  const auto crash = [&] {
    ShowParts parts = player->parts(StereoLayout::Pair);
    FrameLoopOptions o;
    const auto watch = watchWrites(true, parts, o);
    raise(SIGSEGV);
    raise(SIGSEGV);
  };
  EXPECT_EXIT(crash(), testing::KilledBySignal(SIGSEGV), "");
}

TEST(ProgramWriteGuard, EndsTheProcessIfAThreadThatRunsNoStageWrites) {
  const auto player = openShow(testShow("bodies.evs"), "cave4");
  ASSERT_TRUE(player);
  const auto write = [&] {
    ShowParts parts = player->parts(StereoLayout::Pair);
    FrameLoopOptions o;
    const auto watch = watchWrites(true, parts, o);
    parts.state.publish(0, ChangeSet{});
    const_cast<ViewerRecord*>(parts.state.view(0).viewer)->stress = 2;
  };
  EXPECT_EXIT(write(), testing::ExitedWithCode(WriteGuard::kOutsideStages),
              "the thread \".*\", which runs no stage, wrote");
}

}  // namespace
}  // namespace stadion
