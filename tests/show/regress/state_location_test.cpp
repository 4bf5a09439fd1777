/// Where the states of two plays differ, by the fields that a baseline keeps.

#include "show/regress/state_location.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr const char* kKept = "@ball\nplace\t1 2 3\nspin\t4\n@part\nlevel\t1\n@part\nlevel\t2\n";

TEST(StateLocation, NamesTheFirstFieldThatDiffersWithItsPlaceInTheScript) {
  EXPECT_EQ(firstDifference("@ball\ta.evs:7\nplace\t1 2 3.5\nspin\t5\n", kKept),
            "ball (a.evs:7), place is 1 2 3.5 now, 1 2 3 before");
  EXPECT_EQ(firstDifference(kKept, kKept), "");
}

TEST(StateLocation, TakesAFieldThatIsMissingForZero) {
  const std::string now =
      "@ball\ta.evs:7\nplace\t1 2 3\nmore\t9\nspin\t4\n@part\nlevel\t1\n@part\nlevel\t2\n";
  EXPECT_EQ(firstDifference(now, kKept), "ball (a.evs:7), more is 9 now, 0 before");
  EXPECT_EQ(firstDifference(kKept, now), "ball (a.evs:7), more is 0 now, 9 before");
}

TEST(StateLocation, TellsNodesOfOnePathApart) {
  EXPECT_EQ(
      firstDifference("@ball\nplace\t1 2 3\nspin\t4\n@part\nlevel\t1\n@part\ta.evs:9\nlevel\t3\n", kKept),
      "part #2 (a.evs:9), level is 3 now, 2 before");
}

TEST(StateLocation, TakesNodesWithoutANameByTypeAndOrder) {
  const std::string kept = "@timer:3\non\t1\n@ball\nplace\t1\n@timer:9\non\t2\n";
  EXPECT_EQ(firstDifference(
                "@timer:4\ta.evs:4\non\t1\n@ball\ta.evs:5\nplace\t1\n@timer:12\ta.evs:12\non\t2\n", kept),
            "");
  EXPECT_EQ(firstDifference(
                "@timer:4\ta.evs:4\non\t1\n@ball\ta.evs:5\nplace\t1\n@timer:12\ta.evs:12\non\t3\n", kept),
            "timer:12 (a.evs:12), on is 3 now, 2 before");
}

TEST(StateLocation, ComparesAPartWithNothingWhereAnOlderBuildHasTheWhole) {
  EXPECT_EQ(firstDifference("@ball\nplace.axes\t#1\nplace.position\t1 2 3\nspin\t5\n",
                            "@ball\nplace\t#2\nspin\t4\n"),
            "ball, spin is 5 now, 4 before");
}

}  // namespace
}  // namespace stadion
