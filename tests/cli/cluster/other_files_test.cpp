/// Hosts of a cluster whose scripts, models or settings differ.

#include "tests/cli/cluster/two_live_hosts.h"
#include "tests/programs/desk.h"

#include <gtest/gtest.h>
#include <lo/lo.h>

#include <csignal>
#include <regex>
#include <unistd.h>

namespace stadion {
namespace {

TEST(ProgramCluster, WhereAScriptLiesIsEachMachinesAffair) {
  const TestFolder ours, theirs;
  const TwoLive two;
  const std::string script = fileContent(kKick);
  const std::vector<std::string> play{"--input", "none", "--rate", "60", "--pace", "lock", "--seconds", "2"};
  const auto floor = two.startWith(theirs.write("kick.evs", script), "floor", play);
  const auto front = two.startWith(ours.write("kick.evs", script), "front", play);
  EXPECT_EQ(front->status(), 0) << front->err();
  EXPECT_EQ(floor->status(), 0) << floor->err();
  EXPECT_FALSE(has(front->err(), "differs")) << front->err();
}

TEST(ProgramCluster, AScriptThatIsSavedIsComparedForTheNextGroup) {
  const TestFolder ours, theirs;
  const TwoLive two;
  const std::string script = fileContent(kKick), port = std::to_string(freePort());
  const lo_address desk = lo_address_new("127.0.0.1", port.c_str());
  const std::string file = ours.write("kick.evs", script);
  const auto floor = two.startWith(theirs.write("kick.evs", script), "floor", {"--input", "none"});
  const auto front = two.startWith(file, "front", {"--input", "none", "--osc", port});
  ASSERT_TRUE(front->says("playing until Ctrl-C")) << front->err();
  ASSERT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
  ours.write("kick.evs", script + "# saved\n");
  lo_send(desk, "/stadion/next-group", "i", 1);
  EXPECT_EQ(floor->status(), 4) << floor->err();
  EXPECT_TRUE(has(floor->err(), "front plays another script")) << floor->err();
  lo_address_free(desk);
  EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
}

TEST(ProgramCluster, ABitOfABodyThatHasNotMovedYetIsFoundInTime) {
  const TwoLive two;
  const std::vector<std::string> play{"--rate", "60", "--pace", "lock", "--seconds", "3"};
  std::vector<std::string> planted = play;
  planted.insert(planted.end(), {"--plant-difference", "5"});
  const auto floor = two.start("floor", planted);
  const auto front = two.start("front", play);
  EXPECT_EQ(front->status(), 0) << front->err();
  std::smatch since;
  const std::string told = front->err();
  ASSERT_TRUE(std::regex_search(told, since, std::regex("floor differs from ours since frame ([0-9]+)")))
      << told;
  EXPECT_LE(std::stoi(since[1]), 65);
  EXPECT_TRUE(has(told, "ball (") && has(told, "), path.c is ")) << told;
}

TEST(ProgramCluster, OtherModelsAreNamedAndNotPlayed) {
  const TestFolder ours, theirs;
  const char* const triangle = "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
  ours.write("thing.obj", triangle), theirs.write("thing.obj", std::string("v 0 0 2\n") + triangle);
  const TwoLive two("object( file=thing.obj, position=\"0, 3, 1\" )\nobject( name=named, file=thing.obj )\n");
  const std::vector<std::string> play{"--input", "none", "--rate", "60", "--pace", "lock", "--seconds", "4"};
  const auto with = [&](const TestFolder& assets) {
    std::vector<std::string> words = play;
    words.insert(words.end(), {"--asset-root", assets.path()});
    return words;
  };
  const auto floor = two.start("floor", with(theirs));
  const auto front = two.start("front", with(ours));
  EXPECT_EQ(floor->status(), 4) << floor->err();
  EXPECT_TRUE(has(floor->err(), "put the same files on all machines")) << floor->err();
  EXPECT_TRUE(has(floor->err(), "the scene, files is ")) << floor->err();
  EXPECT_EQ(front->status(), 0) << front->err();
  EXPECT_TRUE(has(front->err(), "the scene of floor differs from ours")) << front->err();
}

/// Two copies of a show, of which one has another model, or a sub-scene with a node more.
class OtherFiles {
public:
  OtherFiles() {
    for (const TestFolder* folder : {&ours_, &models_, &scenes_}) {
      folder->write("show.evs", kShow);
      folder->write("thing.obj", std::string(folder == &models_ ? "v 0 0 -1\n" : "v 0 0 0\n") + kRest);
      folder->write("sub.evs", std::string("object( name=one, file=thing.obj )\n") +
                                   (folder == &scenes_ ? "object( name=two, file=thing.obj )\n" : ""));
    }
  }
  std::string ours() const { return ours_.path() / "show.evs"; }
  std::vector<std::string> others() const {
    return {models_.path() / "show.evs", scenes_.path() / "show.evs"};
  }
  static std::vector<std::string> play(const std::string& seconds) {
    return {"--input", "none", "--rate", "60", "--pace", "lock", "--seconds", seconds};
  }

private:
  static constexpr const char* kShow =
      "dynobject( name=ball, file=thing.obj, position=\"0, 3, 1\", density=1 )\n"
      "scene( name=sub, file=sub.evs )\n";
  static constexpr const char* kRest = "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  TestFolder ours_, models_, scenes_;
};

TEST(ProgramCluster, ALateHostWithOtherModelsOrSubScenesMayComeAgain) {
  const OtherFiles files;
  const TwoLive two;
  const auto front = two.startWith(files.ours(), "front", OtherFiles::play("600"));
  {
    const auto floor = two.startWith(files.ours(), "floor", OtherFiles::play("600"));
    EXPECT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
    EXPECT_EQ(TwoLive::endOf(*floor), 130) << floor->err();
  }
  for (const std::string& other : files.others()) {
    const auto floor = two.startWith(other, "floor", OtherFiles::play("600"));
    EXPECT_EQ(floor->status(), 4) << floor->err();
    EXPECT_TRUE(has(floor->err(), "that front has loaded are others than ours; put the same files on all"))
        << floor->err();
  }
  EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
}

TEST(ProgramCluster, ALeaderThatComesBackWithOtherFilesRestartsTheShow) {
  const OtherFiles files;
  for (const std::string& other : files.others()) {
    const TwoLive two;
    auto front = two.startWith(files.ours(), "front", OtherFiles::play("600"));
    const auto floor = two.startWith(files.ours(), "floor", OtherFiles::play("600"));
    EXPECT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
    ASSERT_EQ(kill(front->pid(), SIGKILL), 0);
    EXPECT_EQ(front->status(), 128 + SIGKILL) << front->err();
    front = two.startWith(other, "front", OtherFiles::play("600"));
    EXPECT_TRUE(front->says("the show goes on after frame")) << front->err();
    EXPECT_TRUE(front->says("differ from ours: the show restarts")) << front->err();
    EXPECT_TRUE(front->says("the scene of floor differs from ours")) << front->err() << floor->err();
    EXPECT_EQ(floor->status(), 4) << floor->err();
    EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
  }
}

TEST(ProgramCluster, WhereFilesOrDeadlinesDifferTheFollowerSaysWhichAndEnds) {
  const TestFolder folder;
  const auto file = [&](const std::string& name, const std::string& more) {
    return folder.write(name, "walls cave4\npartition files" + std::to_string(getpid()) + "\n" + more);
  };
  const std::string nodes = "node front front left right\nnode floor floor\n";
  const std::string lead = file("lead.cluster", nodes);
  RunningProgram front({{stadionPath(), "run", kKick, "--cluster", lead, "--node", "front", "--gl", "none"}});
  for (const std::string& other :
       {file("deadline.cluster", nodes + "deadline 2\n"), file("hash.cluster", nodes + "hash-every 7\n"),
        file("order.cluster", "lead front\nnode floor floor\nnode front front left right\n")}) {
    const ProgramResult r =
        stadionProgram({"run", kKick, "--cluster", other, "--node", "floor", "--gl", "none"});
    EXPECT_EQ(r.status, 4) << other << r.err;
    EXPECT_TRUE(has(r.err, "front has another cluster file; put the same file on all machines")) << r.err;
  }
}

}  // namespace
}  // namespace stadion
