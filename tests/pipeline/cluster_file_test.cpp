/// Cluster files, and what is wrong in them.

#include "pipeline/cluster/cluster_file.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr const char* kFour = R"(# Four machines, a wall each
walls cave4
node front  front
node left   left
node right  right
node floor  floor
)";

std::string wrongIn(const std::string& text) {
  Diagnostics found;
  EXPECT_FALSE(parseCluster(text, "room.cluster", found));
  return found.all().empty() ? "" : format(found.all()[0]);
}

TEST(ClusterFile, FourMachinesNeedFiveLines) {
  Diagnostics found;
  const auto c = parseCluster(kFour, "room.cluster", found);
  ASSERT_TRUE(c) << format(found.all().at(0));
  EXPECT_EQ(c->walls, "cave4");
  EXPECT_EQ(c->names(), (std::vector<std::string>{"front", "left", "right", "floor"}));
  EXPECT_EQ(c->nodes[3].walls, (std::vector<std::string>{"floor"}));
  EXPECT_EQ(c->lead, 0U);
  EXPECT_EQ(c->interface, "") << "loopback: nobody else hears";
  EXPECT_EQ(c->partition, "stadion");
}

TEST(ClusterFile, WhatItMaySayIsTaken) {
  Diagnostics found;
  const auto c = parseCluster(
      "lead b\nnode a front left\nnode b\ninterface 10.1.2.3\ndomain 7\npartition olympia\ndeadline 0.2\n"
      "hash-every 5\nwalls powerwall\n",
      "x", found);
  ASSERT_TRUE(c) << format(found.all().at(0));
  EXPECT_EQ(c->lead, 1U);
  EXPECT_EQ(c->nodes[0].walls.size(), 2U);
  EXPECT_TRUE(c->nodes[1].walls.empty());
  EXPECT_EQ(c->interface, "10.1.2.3");
  EXPECT_EQ(c->domain, 7U);
  EXPECT_EQ(c->partition, "olympia");
  EXPECT_DOUBLE_EQ(c->deadline, 0.2);
  EXPECT_EQ(c->hashEvery, 5U);
}

TEST(ClusterFile, MistakesAreToldWithTheirPlaceAndTheFix) {
  EXPECT_EQ(wrongIn(""),
            "room.cluster: error: there is no node in the file; add a line such as: node front  front");
  EXPECT_NE(wrongIn("nod a front\n")
                .find("room.cluster:1:1: error: \"nod\" does not begin a statement; did you mean "
                      "\"node\"?"),
            std::string::npos)
      << wrongIn("nod a front\n");
  EXPECT_NE(wrongIn("node a front\nnode b front\n").find("2:8: error: \"front\" is shown by a already"),
            std::string::npos);
  EXPECT_NE(wrongIn("node a front\nnode a left\n").find("2:6: error: \"a\" is a node already"),
            std::string::npos);
  EXPECT_NE(wrongIn("node front front\nlead fromt\n")
                .find("2:6: error: \"fromt\" is no node; did you mean \"front\"?"),
            std::string::npos)
      << wrongIn("node front front\nlead fromt\n");
  EXPECT_NE(wrongIn("node a\ndomain 1\ndomain 2\n").find("is given twice"), std::string::npos);
  EXPECT_NE(wrongIn("node a\ndomain 231\n").find("2:8: error:"), std::string::npos);
  EXPECT_NE(wrongIn("node a\ndeadline 0\n").find("from 0.1 s to 60 s"), std::string::npos);
  EXPECT_NE(wrongIn("node\n").find("the node's name is missing"), std::string::npos);
  EXPECT_NE(wrongIn("node a\npartition\n").find("a name is missing"), std::string::npos);
  std::string many;
  for (int i = 0; i < 25; ++i) many += "node n" + std::to_string(i) + "\n";
  EXPECT_NE(wrongIn(many).find("25:1: error: there are more than 24 nodes"), std::string::npos);
}

TEST(ClusterFile, WallsThatTheRoomHasNotAndThoseThatNobodyShowsAreTold) {
  Diagnostics found;
  const auto c = parseCluster("node a front leff\n", "room.cluster", found);
  ASSERT_TRUE(c);
  checkWalls(*c, {"front", "left"}, found);
  ASSERT_EQ(found.all().size(), 2U);
  EXPECT_NE(found.all()[0].message.find("no wall \"leff\"; did you mean \"left\"?"), std::string::npos);
  EXPECT_EQ(found.all()[1].severity, Severity::Warning);
}

}  // namespace
}  // namespace stadion
