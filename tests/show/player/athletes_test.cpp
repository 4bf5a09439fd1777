/// The athletes of Olympia: what shows rely on when they let them throw.

#include "tests/show/player/played_show.h"

#include "engine/scene/placed_node.h"
#include "tests/programs/program.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <map>

namespace stadion {
namespace {

constexpr double kGo = 0.5, kAgain = 6, kEnd = 6.5;  // [s] when he is told to begin and to go back
constexpr double kRate = 60;

struct Moment {
  double time = 0;                 ///< [s]
  std::map<std::string, Vec3> at;  ///< [m] where nodes are
};

struct Athlete {
  std::string script;
  double release = 0;         ///< [s] after go, as its script says
  Vec3 place = Vec3::Zero();  ///< [m] of what he lets go, likewise
  std::vector<Moment> moments;
  int finished = 0;

  const Moment& near(double time) const { return moments.at(static_cast<std::size_t>(time * kRate + 0.5)); }
};

Moment momentOf(double time, Scene& scene) {
  Moment m;
  m.time = time;
  for (const char* name : {"pelvis", "head", "right_hand", "left_hand", "right_foot", "left_foot", "held"}) {
    const auto* node = dynamic_cast<const PlacedNode*>(scene.find(scene.tree().resolve(name, {1, 0})));
    if (node) m.at[name] = scene.placements().world(node->placement()).translation();
  }
  return m;
}

Athlete playAthlete(const std::string& name) {
  Athlete athlete;
  athlete.script = fileContent(STADION_SOURCE_DIR "/scripts/olympia/athlete_" + name + ".evs");
  Vec3& p = athlete.place;
  const std::size_t said = athlete.script.find("s after `go"), there = athlete.script.find("It is then at (");
  if (said == std::string::npos || there == std::string::npos) return athlete;
  std::sscanf(athlete.script.c_str() + athlete.script.rfind('#', said), "# %lf", &athlete.release);
  std::sscanf(athlete.script.c_str() + there, "It is then at (%lf,%lf,%lf)", &p.x(), &p.y(), &p.z());
  const TestFolder folder;
  const auto player = openShow(folder.write(
      "athlete.evs", athlete.script +
                         "\ntimer( period=0.48, eventmessage=\"timesup, go, enable, latency=0.02\" )\n"
                         "timer( period=6, eventmessage=\"timesup, again, enable\" )\n"));
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

class Athletes : public testing::TestWithParam<const char*> {
protected:
  void SetUp() override {
    athlete_ = playAthlete(GetParam());
    ASSERT_GT(athlete_.release, 1);
    ASSERT_GT(athlete_.moments.size(), kEnd * kRate);
  }
  Athlete athlete_;
};

TEST_P(Athletes, LetGoWhereAndWhenTheirScriptsSay) {
  const Vec3 held = athlete_.near(kGo + athlete_.release).at.at("held");
  // Poses are told every thirtieth of a second, and a fast hand goes half a metre in it.
  EXPECT_LT((held - athlete_.place).norm(), 0.04) << held.transpose();
}

TEST_P(Athletes, DoNotSlideOnTheFootThatStands) {
  double fastest = 0;
  for (std::size_t i = 1; i < athlete_.moments.size(); ++i) {
    if (athlete_.moments[i].time > kAgain) break;
    for (const char* foot : {"right_foot", "left_foot"}) {
      const Vec3 a = athlete_.moments[i - 1].at.at(foot), b = athlete_.moments[i].at.at(foot);
      EXPECT_GT(b.z(), 0.07) << foot << " in the ground at " << athlete_.moments[i].time << " s";
      if (std::max(a.z(), b.z()) < 0.083) fastest = std::max(fastest, kRate * (b - a).norm());
    }
  }
  EXPECT_LT(fastest, 0.6) << "m/s, with the sole on the ground";
}

TEST_P(Athletes, StandStillAfterwardsAndAreBackWhenToldSo) {
  EXPECT_EQ(athlete_.finished, 1) << "one event tells the end";
  const auto &first = athlete_.moments.front().at, &last = athlete_.moments.back().at;
  const auto& stood = athlete_.near(5.6).at;
  for (const auto& [name, p] : first) {
    EXPECT_LT((last.at(name) - p).norm(), 0.02) << name;  // he breathes and looks about
    EXPECT_LT((athlete_.near(5.5).at.at(name) - stood.at(name)).norm(), 0.01) << name;
  }
  EXPECT_GT((stood.at("pelvis") - first.at("pelvis")).norm(), 0.5) << "he had gone on";
}

INSTANTIATE_TEST_SUITE_P(OfOlympia, Athletes, testing::Values("discus", "javelin", "ball"));

}  // namespace
}  // namespace stadion
