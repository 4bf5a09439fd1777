/// Amplitude panning, against closed forms.

#include "pipeline/sound/speaker_panning.h"

#include "engine/maths/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stadion {
namespace {

Vec3 towards(double azimuth, double elevation = 0) {
  const double a = azimuth * kDegree, e = elevation * kDegree;
  return Vec3(std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e));
}

std::vector<Vec3> ringOf(int count, double first = 0, double elevation = 0) {
  std::vector<Vec3> all;
  for (int i = 0; i < count; ++i) all.push_back(towards(first + 360.0 * i / count, elevation));
  return all;
}

std::vector<Vec3> joined(std::vector<Vec3> a, const std::vector<Vec3>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<double> gainsAt(const SpeakerPanning& panning, const Vec3& place) {
  std::vector<double> gains(panning.size());
  panning.gainsOf(place, gains);
  return gains;
}

double energyOf(const std::vector<double>& gains) {
  double sum = 0;
  for (const double g : gains) sum += g * g;
  return sum;
}

/// Layouts of halls, by name.
const std::vector<std::pair<const char*, std::vector<Vec3>>>& layouts() {
  static const std::vector<std::pair<const char*, std::vector<Vec3>>> all{
      {"one", {towards(20)}},
      {"stereo", {towards(-30), towards(30)}},
      {"a narrow pair", {towards(-3), towards(3)}},
      {"one above the other", {towards(10, -20), towards(10, 25)}},
      {"5.0", {towards(-110), towards(-30), towards(0), towards(30), towards(110)}},
      {"eight around", ringOf(8)},
      {"corners of a cube", joined(ringOf(4, 45, 35.264), ringOf(4, 45, -35.264))},
      {"dome", joined(joined(ringOf(8), ringOf(6, 10, 40)), {towards(0, 90)})},
      {"two rings", joined(ringOf(4, 45), ringOf(4, 45, 45))},
      {"a front of six",
       {towards(-30, -10), towards(0, -10), towards(30, -10), towards(-30, 25), towards(0, 25),
        towards(30, 25)}},
      {"ceiling", joined(ringOf(4, 45, 60), {towards(0, 90)})}};
  return all;
}

TEST(SpeakerPanning, ASoundInTheDirectionOfALoudspeakerComesFromItAlone) {
  for (const auto& [name, directions] : layouts()) {
    const SpeakerPanning panning(directions);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (panning.isRing() && std::string(name) == "one above the other") continue;  // it has one azimuth
      const auto gains = gainsAt(panning, 3 * directions[i]);
      for (std::size_t s = 0; s < gains.size(); ++s) EXPECT_NEAR(gains[s], s == i ? 1 : 0, 1e-7) << name << i;
    }
  }
}

TEST(SpeakerPanning, BetweenTwoTheTangentLawHolds) {
  const SpeakerPanning panning({towards(-30), towards(30)});
  for (double azimuth = -29; azimuth < 30; azimuth += 1.5) {
    const auto g = gainsAt(panning, 2 * towards(azimuth));
    const double law = std::tan(azimuth * kDegree) / std::tan(30 * kDegree);
    EXPECT_NEAR((g[1] - g[0]) / (g[1] + g[0]), law, 1e-12) << azimuth;
  }
}

TEST(SpeakerPanning, InATriangleTheDirectionIsTheSumOfTheLoudspeakers) {
  const std::vector<Vec3> directions{Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                                     Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};
  const SpeakerPanning panning(directions);
  EXPECT_FALSE(panning.isRing());
  const Vec3 wanted = Vec3(1, 2, 3).normalized();
  const auto g = gainsAt(panning, 5 * wanted);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < g.size(); ++i) sum += g[i] * directions[i];
  EXPECT_LT((sum.normalized() - wanted).norm(), 1e-12);
  EXPECT_NEAR(g[1] + g[3] + g[5], 0, 1e-12);
}

TEST(SpeakerPanning, TheEnergyIsTheSameInEveryDirectionAndDistance) {
  std::mt19937 random(7);
  std::normal_distribution<double> any;
  for (const auto& [name, directions] : layouts()) {
    const SpeakerPanning panning(directions);
    for (int i = 0; i < 3000; ++i) {
      const auto gains = gainsAt(panning, Vec3(any(random), any(random), any(random)));
      EXPECT_NEAR(energyOf(gains), 1, 1e-6) << name;
      for (const double g : gains) EXPECT_GE(g, 0) << name;
    }
    for (const Vec3& special :
         {Vec3(0, 0, 0), Vec3(0, 0, 2), Vec3(0, 0, -2), Vec3(0, 0, 1e-9), Vec3(1e-300, 0, 0)})
      EXPECT_NEAR(energyOf(gainsAt(panning, special)), 1, 1e-6) << name;
    std::vector<double> gains(panning.size());
    panning.gainsAround(gains);
    EXPECT_NEAR(energyOf(gains), 1, 1e-12);
    for (const int side : {-1, 1}) {
      panning.gainsOfSide(side, gains);
      EXPECT_NEAR(energyOf(gains), 1, 1e-12) << name;
    }
  }
}

TEST(SpeakerPanning, NothingJumpsWhenASoundGoesAround) {
  for (const auto& [name, directions] : layouts()) {
    if (std::string(name) == "one above the other") continue;  // in its azimuth, either may play
    const SpeakerPanning panning(directions);
    for (const double elevation : {-85.0, -40.0, 0.0, 13.0, 40.0, 70.0, 89.0}) {
      auto before = gainsAt(panning, 2 * towards(0, elevation));
      double most = 0;
      for (double azimuth = 0.05; azimuth <= 360; azimuth += 0.05) {
        const auto now = gainsAt(panning, 2 * towards(azimuth, elevation));
        for (std::size_t s = 0; s < now.size(); ++s) most = std::max(most, std::fabs(now[s] - before[s]));
        before = now;
      }
      EXPECT_LT(most, 0.06) << name << " at " << elevation;
    }
  }
}

TEST(SpeakerPanning, WhatNoLoudspeakersEncloseComesFromTheNeighbours) {
  const SpeakerPanning stereo({towards(-30), towards(30)});
  const auto behind = gainsAt(stereo, 2 * towards(180));
  EXPECT_NEAR(behind[0], behind[1], 1e-9);
  const auto right = gainsAt(stereo, 2 * towards(80));
  EXPECT_GT(right[1], 2 * right[0]);
  const SpeakerPanning dome(joined(ringOf(8), {towards(0, 90)}));
  const auto below = gainsAt(dome, Vec3(0, 0, -2));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(below[i], std::sqrt(1.0 / 8), 1e-3);
  EXPECT_NEAR(below[8], 0, 1e-6);
}

TEST(SpeakerPanning, AStereoSoundWithoutAPlaceHasItsSides) {
  const SpeakerPanning panning({towards(-30), towards(0), towards(30)});
  std::vector<double> g(3);
  panning.gainsOfSide(-1, g);
  EXPECT_NEAR(g[0] * g[0], 2.0 / 3, 1e-12);
  EXPECT_NEAR(g[1] * g[1], 1.0 / 3, 1e-12);
  EXPECT_EQ(g[2], 0);
}

}  // namespace
}  // namespace stadion
