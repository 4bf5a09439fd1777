/// The comparison of sequential and pipelined runs can fail: with the scene state's slots broken on purpose
/// it does.

#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include "engine/core/state_hash.h"
#include "pipeline/draw_list/list_filling.h"

#include <gtest/gtest.h>
#include <mutex>

namespace stadion {
namespace {

constexpr std::uint64_t kFrameCount = 120;
constexpr std::size_t kWalls = 4;

/// What one wall was given to draw, frame by frame: a hash of the whole list.
using Drawn = std::vector<std::vector<std::uint64_t>>;

std::uint64_t hashOf(const DrawList& list) {
  StateHash h(list.ticket.signature.frame);
  for (int k = 0; k < 3; ++k) h.add(list.origin[k]);
  for (const auto* items : {&list.opaque, &list.transparent})
    for (const DrawItem& item : *items) {
      for (const float m : item.model) h.add(static_cast<double>(m));
      h.add(item.owner);
    }
  return h.value();
}

/// The stages of a real show, with Draw replaced by taking notes.
class NotingStages final : public Stages {
public:
  NotingStages(ShowParts parts) : drawn(parts.walls.size()), show_(std::move(parts)) {}

  void app(const TimeSignature& now, std::size_t slot) override { show_.app(now, slot); }
  void cull(std::size_t wall, std::size_t slot, DrawList& list) override { show_.cull(wall, slot, list); }
  Failure openWall(std::size_t) override { return {}; }
  Failure draw(std::size_t wall, const DrawList& list) override {
    const bool whole = !list.filling || list.filling->isWhole();  // it may be filled still
    EXPECT_TRUE(whole);
    drawn[wall].push_back(hashOf(list));
    return {};
  }
  void closeWall(std::size_t) override {}
  Failure swap(const TimeSignature& now) override { return show_.swap(now); }

  Drawn drawn;

private:
  ShowStages show_;
};

Drawn drawnWith(Mode mode, std::size_t memories) {
  const auto player = openShow(testShow("bodies.evs"), "cave4");
  if (!player) return {};
  SceneState state(memories);
  const ShowParts own = player->parts(StereoLayout::Pair);
  // The same show, published into slots of our choice. (It has no static objects, whose chunk lies in its
  // own.)
  NotingStages stages(ShowParts{.scene = own.scene,
                                .state = state,
                                .meshes = own.meshes,
                                .input = own.input,
                                .walls = own.walls,
                                .observer = {}});
  FrameLoopOptions o;
  o.mode = mode, o.walls = kWalls, o.frames = kFrameCount;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  loop.run();
  return stages.drawn;
}

TEST(ThreadsSlotCount, ARealShowDrawsTheSameListsInBothModes) {
  const Drawn sequential = drawnWith(Mode::Sequential, kSlots);
  ASSERT_EQ(sequential.size(), kWalls);
  ASSERT_EQ(sequential[0].size(), kFrameCount);
  EXPECT_EQ(drawnWith(Mode::Pipelined, kSlots), sequential);
}

// Races by intention, so not under ThreadSanitizer.
TEST(ProgramSlotCount, TheComparisonNoticesTooFewSlots) {
  const Drawn sequential = drawnWith(Mode::Sequential, kSlots);
  EXPECT_NE(drawnWith(Mode::Pipelined, 1), sequential);
  EXPECT_NE(drawnWith(Mode::Pipelined, 2), sequential);
}

}  // namespace
}  // namespace stadion
