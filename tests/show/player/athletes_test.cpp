/// The athletes of Olympia: what shows rely on when they let them throw.

#include "tests/show/player/played_show.h"

#include "engine/scene/placed_node.h"
#include "tests/programs/program.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <map>

namespace stadion {
namespace {

constexpr double kThrow = 0.5, kWait = 6, kEnd = 6.5;  // [s] when clips begin, and the end
constexpr double kClipAfter = 0.05;  // [s] the games start the clip so long after the athlete's turn
constexpr double kRate = 60;

struct Moment {
  double time = 0;                 ///< [s]
  std::map<std::string, Vec3> at;  ///< [m] where bones are
};

struct Athlete {
  double release = 0;         ///< [s] of the clip, as the game has it
  Vec3 place = Vec3::Zero();  ///< [m] of what he lets go, likewise
  std::vector<Moment> moments;
  int finished = 0;

  const Moment& near(double time) const { return moments.at(static_cast<std::size_t>(time * kRate + 0.5)); }
};

/// The line of a script that begins so, from there on.
std::string lineOf(const std::string& script, const std::string& begin) {
  const std::size_t at = script.find(begin);
  return at == std::string::npos ? "" : script.substr(at, script.find('\n', at) - at);
}

Moment momentOf(double time, Scene& scene) {
  Moment m;
  m.time = time;
  for (const char* name : {"pelvis", "head", "right_hand", "left_hand", "right_foot", "left_foot", "held"}) {
    const auto* node = dynamic_cast<const PlacedNode*>(scene.find(scene.tree().resolve(name, {1, 0})));
    if (node) m.at[name] = scene.placements().world(node->placement()).translation();
  }
  return m;
}

/// Plays `clip` from kThrow on, and "wait" from kWait on.
Athlete playAthlete(const std::string& name, const std::string& clip) {
  Athlete athlete;
  const std::string game = fileContent(STADION_SOURCE_DIR "/scripts/olympia/game_" + name + ".evs");
  const std::string rival = lineOf(game, "dynobject( name=rival"),
                    hides = lineOf(game, "timesup, held, hide,");
  Vec3& p = athlete.place;
  const std::size_t position = rival.find("position=\"");
  if (position == std::string::npos || hides.empty()) return athlete;
  std::sscanf(rival.c_str() + position, "position=\"%lf, %lf, %lf", &p.x(), &p.y(), &p.z());
  std::sscanf(hides.c_str(), "timesup, held, hide, %lf", &athlete.release);
  p.x() += 1.9;  // where he stands in the game
  athlete.release -= kClipAfter;
  std::string script = "figure( name=athlete, file=athlete_" + name + ".glb, clip=wait )\n";
  for (const char* bone : {"pelvis", "head", "right_hand", "left_hand", "right_foot", "left_foot"})
    script += std::string("bone( name=") + bone + ", parent=athlete, bone=" + bone + " )\n";
  const std::string held = lineOf(game, "object( name=held"), hand = lineOf(game, "bone( name=athletes_hand");
  script += name == "ball" ? "group( name=held, position=\"0, 0, 0.11\" )\n" : hand + "\n" + held + "\n";
  script += "timer( period=0.48, eventmessage=\"timesup, athlete, play " + clip +
            " fade 0.05 once, latency=0.02\" )\n"
            "timer( period=6, eventmessage=\"timesup, athlete, play wait\" )\n";
  const TestFolder folder;
  const auto player = openShow(folder.write("athlete.evs", script));
  if (!player) return athlete;
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene& scene) {
    athlete.moments.push_back(momentOf(toSeconds(now.time), player->scene()));
    for (const EventRecord& e : scene.events()) athlete.finished += e.event == Event("finished");
  };
  ShowStages stages(std::move(parts));
  play(stages, Mode::Sequential, 1, static_cast<std::uint64_t>(kEnd * kRate) + 1, kRate);
  return athlete;
}

/// How fast a foot slides at most while its sole is on the ground, after the clip has faded in. [m/s]
double slide(const Athlete& athlete) {
  double fastest = 0;
  for (std::size_t i = 1; i < athlete.moments.size(); ++i) {
    if (athlete.moments[i].time > kWait) break;
    if (athlete.moments[i - 1].time < kThrow + 0.06) continue;
    for (const char* foot : {"right_foot", "left_foot"}) {
      const Vec3 a = athlete.moments[i - 1].at.at(foot), b = athlete.moments[i].at.at(foot);
      EXPECT_GT(b.z(), 0.068) << foot << " in the ground at " << athlete.moments[i].time << " s";
      if (std::max(a.z(), b.z()) < 0.083) fastest = std::max(fastest, kRate * (b - a).norm());
    }
  }
  return fastest;
}

class Athletes : public testing::TestWithParam<const char*> {
protected:
  void SetUp() override {
    athlete_ = playAthlete(GetParam(), "throw");
    ASSERT_GT(athlete_.release, 1);
    ASSERT_GT(athlete_.moments.size(), kEnd * kRate);
    ASSERT_EQ(athlete_.moments[0].at.size(), 7u);
  }
  Athlete athlete_;
};

TEST_P(Athletes, LetGoWhereAndWhenTheirGamesSay) {
  const Vec3 held = athlete_.near(kThrow + athlete_.release).at.at("held");
  // Poses are told every thirtieth of a second, and a fast hand goes half a metre in it.
  EXPECT_LT((held - athlete_.place).norm(), 0.04) << held.transpose();
}

TEST_P(Athletes, DoNotSlideOnTheFootThatStands) {
  EXPECT_LT(slide(athlete_), 0.6) << "m/s, with the sole on the ground";
}

TEST_P(Athletes, StandStillAfterwardsAndAreBackWhenTheyWait) {
  EXPECT_EQ(athlete_.finished, 1) << "one event tells the end";
  const auto &first = athlete_.moments.front().at, &last = athlete_.moments.back().at;
  const auto& stood = athlete_.near(5.6).at;
  for (const auto& [name, p] : first) {
    EXPECT_LT((last.at(name) - p).norm(), 0.02) << name;  // he breathes and looks about
    EXPECT_LT((athlete_.near(5.5).at.at(name) - stood.at(name)).norm(), 0.01) << name;
  }
  EXPECT_GT((stood.at("pelvis") - first.at("pelvis")).norm(), 0.5) << "he had gone on";
}

TEST_P(Athletes, WalkBackToWhereTheyBegan) {
  const Athlete walking = playAthlete(GetParam(), "walk");
  ASSERT_GT(walking.moments.size(), kEnd * kRate);
  const auto &began = walking.near(kThrow + 0.1).at, &back = walking.near(kWait - 0.02).at;
  EXPECT_LT((began.at("pelvis") - athlete_.near(5.5).at.at("pelvis")).norm(), 0.05)
      << "from where he has thrown";
  for (const char* name : {"pelvis", "head", "right_foot", "left_foot"})
    EXPECT_LT((back.at(name) - walking.moments.front().at.at(name)).norm(), 0.08) << name;
  EXPECT_LT(slide(walking), 1.0) << "m/s, with the sole on the ground";
}

INSTANTIATE_TEST_SUITE_P(OfOlympia, Athletes, testing::Values("discus", "javelin", "ball"));

}  // namespace
}  // namespace stadion
