/// A show that is put back from what was written down of it goes on as if nothing had been: the same hashes,
/// and the same to be drawn, frame by frame.

#include "engine/core/state_fields.h"
#include "engine/scene/scene_snapshot.h"
#include "pipeline/loop/frame_loop.h"
#include "show/player/player.h"
#include "tests/programs/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace stadion {
namespace {

struct Script {
  std::string file, input;
  std::uint64_t frames;
  double rate = 60;
};

std::unique_ptr<Player> openScript(const Script& script,
                                   std::shared_ptr<const std::vector<std::uint8_t>> state = {}) {
  ShowOptions options;
  options.script = script.file, options.walls = "desktop", options.size = "64x48";
  options.input = script.input, options.assetRoots = {assetFolder()};
  options.rate = script.rate, options.rateGiven = true, options.state = std::move(state);
  options.appThreads = 1;
  Diagnostics findings;
  std::unique_ptr<Player> player;
  if (options.complete(findings)) player = Player::create(options, findings);
  printFindings(findings);
  return player;
}

/// What is seen: every instance as it was published last, by what it shows and whose it is; the visitor, and
/// the rings in which shadows are drawn.
struct SavedRun {
  std::map<InstanceId, InstanceRecord> instances;
  ViewerRecord viewer;
  ShadowRecord shadows;

  void take(const ChangeSet& changes) {
    for (const ChangeSet::Instance& i : changes.instances) instances[i.id] = i.record;
    viewer = changes.viewer, shadows = changes.shadows;
  }
  /// Of what is there.
  std::uint64_t hash() const {
    StateHash h;
    for (const auto& [id, r] : instances) {
      if (r.radius < 0) continue;
      h.add(id), h.add(r.owner), h.add(r.mesh), h.add(r.flags), h.add(double{r.radius}),
          h.add(double{r.lodFactor});
      for (const double m : r.model) h.add(m);
      for (const double x : r.centre) h.add(x);
    }
    h.add(viewer.rig()), h.add(viewer.head()), h.add(viewer.stress);
    for (const auto& ring : shadows.centre)
      for (const double x : ring) h.add(x);
    return h.value();
  }
};

class Played {
public:
  Played(std::unique_ptr<Player> player, double rate)
      : player_(std::move(player)), parts_(player_->parts(StereoLayout::Off)), rate_(rate) {}

  void frame(std::uint64_t n) {
    const TimeSignature now = signatureAt(n, rate_);
    parts_.input.sampleFrame(now.time - now.step, now.time, input_);
    player_->scene().advance(now, input_, changes_, nullptr);
    parts_.freeUnshown(n);
    seen_.take(changes_);
  }
  /// Nothing has been simulated since it was put back.
  void asItStands(std::uint64_t n) {
    player_->scene().publishAsItStands(signatureAt(n, rate_), changes_);
    seen_.take(changes_);
  }
  Scene& scene() { return player_->scene(); }
  std::uint64_t seen() const { return seen_.hash(); }
  /// The events of the last frame.
  std::uint64_t told() {
    StateHash h;
    for (const EventRecord& e : scene().events()) h.add(e.node), h.add(e.event.name()), h.add(e.when);
    return h.value();
  }
  const SavedRun& all() const { return seen_; }

private:
  std::unique_ptr<Player> player_;
  ShowParts parts_;
  double rate_;
  InputSample input_;
  ChangeSet changes_;
  SavedRun seen_;
};

class SavedState : public testing::TestWithParam<Script> {};

TEST_P(SavedState, GoesOnAsIfNothingHadBeen) {
  const Script& script = GetParam();
  // It is put back so many times, and as many of these play beside it.
  const std::uint64_t kTimes = fullRuns() ? 20 : 10;
  const std::size_t kMostCopies = fullRuns() ? 6 : 3;
  struct Copy {
    std::uint64_t from;
    std::unique_ptr<Played> played;
  };
  auto player = openScript(script);
  ASSERT_TRUE(player);
  Played played(std::move(player), script.rate);
  std::vector<Copy> copies;
  for (std::uint64_t n = 0; n < script.frames; ++n) {
    played.frame(n);
    for (Copy& copy : copies) {
      copy.played->frame(n);
      ASSERT_EQ(copy.played->scene().stateHash(), played.scene().stateHash())
          << "in frame " << n << ", put back after frame " << copy.from;
      ASSERT_EQ(copy.played->told(), played.told())
          << "in frame " << n << ", put back after frame " << copy.from;
      ASSERT_EQ(copy.played->seen(), played.seen())
          << "in frame " << n << ", put back after frame " << copy.from;
    }
    if (n % (script.frames / kTimes) != 5) continue;
    if (copies.size() == kMostCopies) copies.erase(copies.begin());
    const auto state =
        std::make_shared<const std::vector<std::uint8_t>>(SceneSnapshot(played.scene()).save());
    auto copy = openScript(script, state);
    ASSERT_TRUE(copy) << "after frame " << n;
    EXPECT_EQ(copy->scene().stateHash(), played.scene().stateHash()) << "after frame " << n;
    const std::vector<std::uint8_t> again = SceneSnapshot(copy->scene()).save();
    EXPECT_EQ(again.size(), state->size()) << "after frame " << n;
    EXPECT_TRUE(again == *state) << "written down again after frame " << n << " it is something else";
    copies.push_back({n, std::make_unique<Played>(std::move(copy), script.rate)});
    if (copies.size() % 2 != 0) continue;
    copies.back().played->asItStands(n);
    EXPECT_EQ(copies.back().played->seen(), played.seen()) << "as it stands after frame " << n;
  }
  for (Copy& copy : copies)
    EXPECT_TRUE(SceneSnapshot(copy.played->scene()).save() == SceneSnapshot(played.scene()).save())
        << "put back after frame " << copy.from;
}

/// What has stood for long has nothing to make up for; what goes on does so every frame.
TEST(SavedStateOfADay, GoesOnWhateverIsOffOrFinishedOrRuns) {
  const TestFolder folder;
  const std::string file = folder.write("day.evs", R"(
forcelinear( name=gravity, direction="0, 0, -1" )
object( name=floor, file=plane.3ds )
dynobject( name=ball, file=football.3ds, position="0, 6, 3000", density=0.08, hook=gravity )
dynamics( name=sim, collider=floor, collidee=ball )
timer( name=early, period=0.5, repeat=off, eventmessage="timesup, sim, disable" )
timer( name=often, period=0.3, eventmessage="timesup, once, reset" )
light( name=lamp, direction="-1, 2, -3" )
object( name=stone, file=football.3ds, position="2, 3, 1" )
object( name=bird, file=football.3ds, position="4, 3, 1" )
object( name=leaf, file=football.3ds, position="5, 3, 1" )
path( name=once, target=stone, key="0, 2, 3, 1", loop=on )
path( name=there, target=stone, key="0, 2, 3, 1", key="0.05, 2, 4, 1", loop=on, initstate=off )
path( name=round, target=bird, key="0, 4, 3, 1", key="0.5, 4, 4, 1", loop=on )
path( name=short, target=leaf, key="0, 5, 3, 1", key="0.5, 5, 4, 1" )
sound( name=never, file=thud.wav, initstate=off )
sound( name=ringing, file=thud.wav, loop=on, initstate=off )
sound( name=heard, file=thud.wav )
sound( name=hum, file=thud.wav, loop=on )
)");
  const Script script{file, "none", 1};
  constexpr double rate = 0.1;  // frames of ten seconds
  constexpr std::uint64_t kDay = 8640;
  Played played(openScript(script), rate);
  for (std::uint64_t n = 0; n < kDay; ++n) played.frame(n);
  const auto state = std::make_shared<const std::vector<std::uint8_t>>(SceneSnapshot(played.scene()).save());
  auto copy = openScript(script, state);
  ASSERT_TRUE(copy);
  Played on(std::move(copy), rate);
  for (std::uint64_t n = kDay; n < kDay + 10; ++n) {
    played.frame(n), on.frame(n);
    EXPECT_EQ(on.scene().stateHash(), played.scene().stateHash()) << n;
  }
}

std::string ours(const std::string& name) {
  return std::string(STADION_SOURCE_DIR) + "/scripts/" + name;
}

INSTANTIATE_TEST_SUITE_P(
    Shows, SavedState,
    testing::Values(Script{ours("kick.evs"), ours("kick.input"), 480},
                    Script{ours("olympia.evs"), ours("olympia.input"), 900},
                    Script{ours("crowd.evs"), "none", 240}, Script{testShow("bodies.evs"), "none", 240},
                    Script{testShow("paper_impacts.evs"), "none", 240},
                    Script{testShow("moving.evs"), testShow("moving.input"), 240},
                    Script{testShow("joypad.evs"), testShow("joypad.input"), 240},
                    Script{testShow("desk.evs"), "none", 240}, Script{testShow("hold.evs"), "none", 240},
                    Script{testShow("stadium/stadium.evs"), "none", 240},
                    Script{STADION_SOURCE_DIR "/tests/corpus/field/expiry.evs", "none", 60}),
    [](const testing::TestParamInfo<Script>& script) {
      const std::string file = script.param.file.substr(script.param.file.rfind('/') + 1);
      return file.substr(0, file.find('.'));
    });

}  // namespace
}  // namespace stadion
