/// Cluster files, and what is wrong in them.

#include "pipeline/cluster/cluster_file.h"
#include "pipeline/cluster/interface_check.h"

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
  EXPECT_EQ(c->interface, "") << "loopback: no other machine hears";
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
  EXPECT_NE(wrongIn("node a\npartition\n").find("the partition's name is missing"), std::string::npos);
  std::string many;
  for (int i = 0; i < 25; ++i) many += "node n" + std::to_string(i) + "\n";
  EXPECT_NE(wrongIn(many).find("25:1: error: there are more than 24 nodes"), std::string::npos);
}

TEST(ClusterFile, WallsThatTheRoomLacksAndThoseThatNoHostShowsAreReportedWithTheirPlace) {
  const auto wrongWith = [](const std::string& text) {
    Diagnostics found;
    const auto c = parseCluster(text, "room.cluster", found);
    EXPECT_TRUE(c) << text;
    if (c) checkWalls(*c, {"front", "left"}, found);
    std::string all;
    for (const Diagnostic& d : found.all()) all += format(d) + "\n";
    return all;
  };
  EXPECT_EQ(wrongWith("node a front leff\nwalls cave4\n"),
            "room.cluster:1:14: error: cave4 has no wall \"leff\"; did you mean \"left\"?\n"
            "node a front leff\n"
            "             ^\n"
            "room.cluster:2:7: warning: no host shows the wall \"left\" of cave4\n"
            "walls cave4\n"
            "      ^\n");
  EXPECT_EQ(wrongWith("node a front\n"), "room.cluster: warning: no host shows the wall \"left\" of cave4\n")
      << "nothing in the file names the room";
}

TEST(ClusterFile, WallsThatThereAreNotAreToldWithTheirPlace) {
  const auto wrongWith = [](const std::string& text) {
    Diagnostics found;
    const auto c = parseCluster(text, "room.cluster", found);
    EXPECT_TRUE(c && !loadWallsOf(*c, STADION_SOURCE_DIR "/walls", found)) << text;
    return found.all().empty() ? "" : format(found.all()[0]);
  };
  EXPECT_EQ(wrongWith("node a front\nwalls cvae4\n"),
            "room.cluster:2:7: error: there are no walls named \"cvae4\"; did you mean \"cave4\"?\n"
            "walls cvae4\n"
            "      ^");
  EXPECT_EQ(wrongWith("node a front\nwalls ./nowhere.walls\n"),
            "./nowhere.walls: error: cannot be read: No such file or directory");
}

TEST(ClusterFile, AWallThatIsNamedTwiceIsPointedAt) {
  EXPECT_EQ(wrongIn("node a front left front\n"), "room.cluster:1:19: error: \"front\" is named twice\n"
                                                  "node a front left front\n"
                                                  "                  ^");
}

TEST(ClusterFile, WhatCannotBeANameIsToldInWordsAndBytesThatAreNoTextAreNotRepeated) {
  EXPECT_EQ(wrongIn("node a!\n").substr(0, 59),
            "room.cluster:1:6: error: \"a!\" is not a good name for a node")
      << wrongIn("node a!\n");
  EXPECT_EQ(
      wrongIn("\xff\xfe\x80x \xc3\n"),
      "room.cluster:1:1: error: \"??x\" does not begin a statement; known are node, walls, lead, interface, "
      "domain, partition, deadline, hash-every, on-difference\n"
      "??x ?\n"
      "^");
}

TEST(ClusterFile, AnInterfaceIsAnAddressOrANameThatNeedsNoQuoting) {
  for (const char* good : {"lo", "eth0:1", "br-1a2b.7", "en_x@if7", "255.255.255.255"}) {
    Diagnostics found;
    const auto c = parseCluster(std::string("node a\ninterface ") + good + "\n", "x", found);
    ASSERT_TRUE(c) << good;
    EXPECT_EQ(c->interface, good);
  }
  for (const char* bad : {"a\"b<c>", "a/b", "'", "&lt;", "abcdefghijklmnop"})
    EXPECT_NE(wrongIn(std::string("node a\ninterface ") + bad + "\n").find("2:11: error: \""),
              std::string::npos)
        << bad;
}

TEST(ClusterFile, AnInterfaceThatThisMachineHasNotIsToldWithThoseThatItHas) {
  const auto wrongWith = [](const std::string& text) {
    Diagnostics found;
    const auto c = parseCluster(text, "room.cluster", found);
    EXPECT_TRUE(c) << text;
    if (c) checkInterface(*c, found);
    return found.all().empty() ? "" : format(found.all()[0]);
  };
  const std::string why = wrongWith("node a\ninterface nosuch0\n");
  EXPECT_EQ(why.find("room.cluster:2:11: error: this machine has no network interface \"nosuch0\""), 0U)
      << why;
  EXPECT_NE(why.find("lo (127.0.0.1)"), std::string::npos) << why;
  EXPECT_NE(why.find("\ninterface nosuch0\n          ^"), std::string::npos) << why;
  EXPECT_EQ(wrongWith("node a\n"), "") << "all on one machine";
  EXPECT_EQ(wrongWith("node a\ninterface lo\n"), "");
  EXPECT_EQ(wrongWith("node a\ninterface 127.0.0.1\n"), "");
}

}  // namespace
}  // namespace stadion
