/// A picture follows from its frame alone. A show that was restored from a snapshot, or has not drawn the
/// frames before, draws the same to the bit as one that has drawn them all. In the full look, with shadows,
/// levels of detail and haze.

#include "engine/core/state_fields.h"
#include "engine/scene/scene_snapshot.h"
#include "show/player/player.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// One after the other, as the sequential frame loop plays them.
class DrawnShow {
public:
  using State = std::shared_ptr<const std::vector<std::uint8_t>>;

  DrawnShow(const std::string& script, const std::string& input, GlProvider& provider,
            const State& state = {}) {
    ShowOptions options;
    options.script = script, options.input = input, options.walls = "cave4", options.size = "64x48";
    options.assetRoots = {assetFolder()}, options.state = state, options.appThreads = 1;
    Diagnostics findings;
    if (options.complete(findings)) player_ = Player::create(options, findings);
    printFindings(findings);
    if (!player_) return;
    ShowParts parts = player_->parts(StereoLayout::Off);
    parts.provider = &provider;
    walls_ = parts.walls.size();
    stages_.emplace(std::move(parts));
    for (std::size_t wall = 0; wall < walls_; ++wall) EXPECT_FALSE(stages_->openWall(wall));
  }
  ~DrawnShow() {
    for (std::size_t wall = 0; wall < walls_; ++wall) stages_->closeWall(wall);
  }
  explicit operator bool() const { return player_ != nullptr; }

  /// Of all walls, if it is drawn.
  std::uint64_t frame(std::uint64_t n, bool drawn) {
    const TimeSignature now = signatureAt(n, 60);
    const std::size_t slot = n % kSlots;
    stages_->app(now, slot);
    StateHash hash;
    for (std::size_t wall = 0; drawn && wall < walls_; ++wall) {
      list_.ticket.signature = now, list_.ticket.last = true;
      stages_->cull(wall, slot, list_);
      EXPECT_FALSE(stages_->draw(wall, list_));
      for (const Picture& p : stages_->lastPictures()[wall].eyes)
        hash.add(std::string_view(reinterpret_cast<const char*>(p.rgba.data()), p.rgba.size()));
    }
    return hash.value();
  }
  State save() {
    return std::make_shared<const std::vector<std::uint8_t>>(SceneSnapshot(player_->scene()).save());
  }

private:
  std::unique_ptr<Player> player_;
  std::optional<ShowStages> stages_;
  std::size_t walls_ = 0;
  DrawList list_;
};

struct HistoryCase {
  std::string name, script, input;
  std::uint64_t start, frames;  ///< drawn from `start` on; the shows before it are only simulated
};

class ProgramPictureHistory : public testing::TestWithParam<HistoryCase> {};

std::string shownHere(const std::string& name) {
  return std::string(STADION_SOURCE_DIR) + "/scripts/" + name;
}

/// The visitor walks far, so that shadow rings follow; a thing goes round; others stand still, or have done
/// so for long.
constexpr const char* kWalk = R"(
light( direction="-1, 2, -3" )
sky( haze=300 )
object( name=floor, file=plane.3ds )
object( name=near, file=football.3ds, position="1, 4, 1", scale="4,4,4" )
object( name=aside, file=football.3ds, position="-5, 9, 1", scale="6,6,6" )
object( name=far, file=football.3ds, position="6, 30, 2", scale="9,9,9" )
object( name=rover, file=football.3ds, position="0, 8, 1", scale="5,5,5" )
object( name=lost, file=football.3ds, position="2, 6, 1", scale="5,5,5" )
path( target=rover, key="0, 3, 8, 1", key="0.35, -3, 10, 1", key="0.7, 3, 8, 1", loop=on )
path( target=lost, key="0, 2, 6, 1", key="0.1, 2.5, 6, 1" )
)";
constexpr const char* kWalkInput = R"(stadion-input 1
key head 0    0  0   1.7
key head 1    0  9   1.7   turn 20 0 0  smooth
key head 2    3  2   1.7   turn 10 0 0  smooth
)";

TEST_P(ProgramPictureHistory, IsNotSeenAfterASnapshotNorWhereFramesWereNotDrawn) {
  HistoryCase c = GetParam();
  const TestFolder folder;
  if (c.script.empty())
    c.script = folder.write("walk.evs", kWalk), c.input = folder.write("walk.input", kWalkInput);
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider) << provider.error().message;
  DrawnShow always(c.script, c.input, *provider.value()), seldom(c.script, c.input, *provider.value());
  ASSERT_TRUE(always && seldom);
  std::vector<std::pair<std::uint64_t, std::unique_ptr<DrawnShow>>> restored;
  for (std::uint64_t n = 0; n < c.start + c.frames; ++n) {
    const bool drawn = n >= c.start && (n - c.start) % 7 == 0;
    const std::uint64_t expected = always.frame(n, n >= c.start);
    const std::uint64_t now = seldom.frame(n, drawn && (n / 7) % 3 == 0);
    if (drawn && (n / 7) % 3 == 0) {
      ASSERT_EQ(now, expected) << "frame " << n << ", after frames that were not drawn";
    }
    for (auto& [since, show] : restored) {
      const std::uint64_t again = show->frame(n, drawn);
      if (drawn) {
        ASSERT_EQ(again, expected) << "frame " << n << ", restored after frame " << since;
      }
    }
    if (n < c.start || (n - c.start) % (c.frames / 3) != 2) continue;
    restored.emplace_back(n,
                          std::make_unique<DrawnShow>(c.script, c.input, *provider.value(), always.save()));
    ASSERT_TRUE(*restored.back().second) << n;
  }
  EXPECT_GE(restored.size(), 3U);
}

std::string nameOf(const testing::TestParamInfo<HistoryCase>& show) {
  return show.param.name;
}

INSTANTIATE_TEST_SUITE_P(Program, ProgramPictureHistory,
                         testing::Values(HistoryCase{"kick", shownHere("kick.evs"), shownHere("kick.input"),
                                                     0, 48},
                                         HistoryCase{"crowd", shownHere("crowd.evs"), "none", 20, 30},
                                         HistoryCase{"walk", "", "", 0, 75}),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(
    ProgramFull, ProgramPictureHistory,
    testing::Values(HistoryCase{"kick", shownHere("kick.evs"), shownHere("kick.input"), 0, 240},
                    HistoryCase{"olympia", shownHere("olympia.evs"), shownHere("olympia.input"), 1100, 60},
                    HistoryCase{"crowd", shownHere("crowd.evs"), "none", 20, 60},
                    HistoryCase{"walk", "", "", 0, 120}),
    nameOf);

}  // namespace
}  // namespace stadion
