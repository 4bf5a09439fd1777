/// `stadion bench looks`: rows in; limits, table, JSON and plot out.

#include "bench/looks/looks_plot.h"
#include "bench/looks/looks_results.h"
#include "bench/looks/rungs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace stadion::bench {
namespace {

LooksRow rowOf(const char* wall, const char* rung, double ms, double mean) {
  return {.scene = "kick", .wall = wall, .rung = rung, .ms = ms, .leastMs = ms, .mean = mean};
}

/// The value of the limit whose text has these words; nothing if there is none.
std::optional<double> valueOf(const std::vector<LooksLimit>& limits, const char* words) {
  for (const LooksLimit& limit : limits)
    if (limit.what.find(words) != std::string::npos) return limit.value;
  return {};
}

TEST(LooksResults, CountWallsOnWhichTheDefaultIsFartherThanOpenGl) {
  const std::vector<LooksRow> rows{rowOf("front", "4", 20, 0.5), rowOf("front", "opengl", 300, 0.6),
                                   rowOf("right", "4", 20, 0.7), rowOf("right", "opengl", 300, 0.6)};
  const auto limits = limitsOf(rows);
  EXPECT_EQ(valueOf(limits, "farther than OpenGL (mean)"), 1);
  EXPECT_EQ(valueOf(limits, "farther than OpenGL (99 %)"), 0);
  EXPECT_FALSE(valueOf(limits, "(flicker)")) << "it was not measured";
}

TEST(LooksResults, EightSamplesMayCostTwiceTheDefault) {
  const auto limits = limitsOf({rowOf("front", "8", 39, 0.3), rowOf("front", "4", 20, 0.5)});
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_NEAR(*valueOf(limits, "8 samples: cost"), 1.95, 1e-9);
  EXPECT_NEAR(*valueOf(limits, "8 samples: mean error"), 0.6, 1e-9);
  EXPECT_TRUE(std::ranges::all_of(limits, &LooksLimit::met));
  for (const LooksLimit& l : limitsOf({rowOf("front", "8", 41, 0.45), rowOf("front", "4", 20, 0.5)}))
    EXPECT_FALSE(l.met()) << l.what;
}

TEST(LooksResults, TheFilledStadiumMayCostThreeTimesTheUsualOne) {
  const auto rowsOf = [](double filled) {
    LooksRow usual = rowOf("front", "4", 20, 0.5), full = rowOf("front", "4", filled, 0.5);
    usual.scene = "olympia-1";
    full.scene = "filled";
    return std::vector<LooksRow>{usual, full};
  };
  const auto limits = limitsOf(rowsOf(50));
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_NEAR(*valueOf(limits, "filled stadium"), 2.5, 1e-9);
  EXPECT_TRUE(limits[0].met());
  EXPECT_FALSE(limitsOf(rowsOf(61))[0].met());
}

TEST(LooksResults, NothingIsJudgedWithoutARowToCompareWith) {
  EXPECT_TRUE(limitsOf({rowOf("front", "4", 20, 0.5), rowOf("right", "8", 39, 0.3)}).empty());
}

TEST(LooksResults, WhatWasNotMeasuredIsADashAndNull) {
  const LooksRow row = rowOf("front", "4", 20, 0.5);
  EXPECT_TRUE(jsonOf(row)["butteraugli"].is_null());
  EXPECT_NE(lineOf(row).find(" -"), std::string::npos);
}

TEST(LooksResults, NamesOfRungsAreTheGrammarsWords) {
  std::vector<std::string> words, names;
  std::istringstream in{std::string(kRungNames)};
  for (std::string word; std::getline(in, word, '|');) words.push_back(word);
  for (const NamedRung& rung : allRungs()) names.emplace_back(rung.name);
  std::ranges::sort(words), std::ranges::sort(names);
  EXPECT_EQ(words, names);
}

TEST(LooksPlot, HasADotForEachRow) {
  const std::string svg =
      looksPlot({rowOf("front", "4", 20, 0.5), rowOf("front", "8", 30, 0.4), rowOf("right", "4", 20, 0)});
  EXPECT_TRUE(svg.starts_with("<svg "));
  std::size_t dots = 0;
  for (std::size_t at = 0; (at = svg.find("<circle", at)) != std::string::npos; ++at) ++dots;
  EXPECT_EQ(dots, 3u);
  EXPECT_NE(svg.find("kick, right"), std::string::npos);
}

}  // namespace
}  // namespace stadion::bench
