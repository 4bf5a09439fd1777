/// Figures look alike in every mode: threads, processes, pipelined or not, and after a frame rate's change the
/// picture at a show time is the same.

#include "tests/cli/run/played_pictures.h"
#include "tests/engine/asset/rigged_model.h"
#include "tests/programs/program.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace stadion {
namespace {

/// A show with figures in sun, one of them turning into the other clip.
class FigureShow {
public:
  FigureShow() {
    write("tube.glb", test::riggedTube().glb());
    write("square.glb", test::morphingSquare().glb());
    write("stroll.glb", test::strollingTube().glb());
    write("show.evs", R"(light( direction="-1, 2, -3" )
figure( name=left, file=tube.glb, clip=bend, position="-0.8, 4, 0",
        eventmessage="looped, right, play bend fade 0.3" )
figure( name=right, file=tube.glb, clip=lift, phase=0.1, speed=0.6, position="0.8, 4, 0" )
object( file=tube.glb, position="0, 6, 0" )
figure( file=square.glb, clip=swell, position="-1, 5, 0" )
figure( name=walker, file=stroll.glb, clip=stroll, root=lower, marker="stroll, 0.1, step", marker="bend, 0.5, bent",
        position="-0.3, 3, 0", scale="0.3, 0.3, 0.3", eventmessage="marker step, walker, layer bend weight 0.7 speed 2",
        eventmessage="marker bent, walker, unlayer bend fade 0.1" )
)");
  }

  /// Picture files by name.
  std::map<std::string, std::string> played(const std::vector<std::string>& how) const {
    return playedPictures(folder_.path() / "show.evs", how);
  }

private:
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
  }

  TestFolder folder_;
};

TEST(ProgramFigures, EveryModeDrawsTheSamePicturesAndEachFrameIsAnother) {
  const FigureShow show;
  const auto drawn = [&](std::vector<std::string> how) {
    how.insert(how.end(), {"--frames", "80", "--pictures", "all"});
    return show.played(how);
  };
  const auto sequential = drawn({"--mode", "sequential"});
  ASSERT_GT(sequential.size(), 80u);
  EXPECT_EQ(sequential, drawn({"--mode", "pipelined"}));
  EXPECT_EQ(sequential, drawn({"--mode", "pipelined", "--wall-workers", "process"}));
  std::map<std::string, int> seen;
  for (const auto& [name, bytes] : sequential) ++seen[bytes];
  EXPECT_GT(seen.size(), 150u);
}

TEST(ProgramFigures, ThePictureAtAShowTimeDoesNotDependOnTheRate) {
  const FigureShow show;
  std::vector<std::string> pictures;
  for (const int rate : {30, 60, 90}) {
    const int last = rate * 4 / 3;
    const auto drawn = show.played({"--rate", std::to_string(rate), "--frames", std::to_string(last + 1)});
    for (const auto& [name, bytes] : drawn)
      if (name.starts_with("screen-left")) pictures.push_back(bytes);
  }
  ASSERT_EQ(pictures.size(), 3u);
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_EQ(pictures[0], pictures[2]);
}

TEST(ProgramFigures, WrongClipsAndBonesAreErrorsThatListTheRightOnes) {
  const TestFolder folder;
  folder.write("tube.glb", test::riggedTube().glb());
  const auto checked = [&](const std::string& script) {
    const ProgramResult r = stadionProgram({"check", folder.write("show.evs", script)});
    return r.out + r.err;
  };
  EXPECT_TRUE(has(checked("figure( name=f, file=tube.glb, clip=run )"),
                  "error: \"tube.glb\" has no clip \"run\"; there are \"bend\", \"lift\""));
  EXPECT_TRUE(has(checked("figure( name=f, file=tube.glb, root=hips )"),
                  "error: \"tube.glb\" has no bone \"hips\"; there are \"tube\", \"lower\", \"upper\""));
  EXPECT_TRUE(has(checked("figure( file=tube.glb, marker=\"bend, 0.2, a\", marker=\"run, 0.2, b\" )"),
                  "show.evs:1:55: error: \"tube.glb\" has no clip \"run\"; there are \"bend\", \"lift\""));
  EXPECT_TRUE(has(checked("figure( file=tube.glb, marker=\"lift, 0.6, a\" )"),
                  "error: the clip \"lift\" is 0.5 s long"));
  EXPECT_TRUE(has(checked("figure( name=f, file=tube.glb, root=lower )\n"
                          "path( target=f, key=\"0, 0, 0, 0\", key=\"1, 1, 0, 0\" )"),
                  "warning: \"f\" is moved by its root bone, too"));
  const std::string figure = "figure( name=f, file=tube.glb )\n";
  EXPECT_TRUE(has(checked(figure + "bone( parent=f, bone=toe )"),
                  "error: the figure has no bone \"toe\"; there are \"tube\", \"lower\", \"upper\""));
  EXPECT_TRUE(has(checked(figure + "bone( bone=upper )"), "error: a bone needs parent=NAME"));
  EXPECT_TRUE(has(checked("object( name=f, file=tube.glb )\nbone( parent=f, bone=upper )"),
                  "error: a bone needs parent=NAME"));
  EXPECT_EQ(
      stadionProgram({"check", folder.write("show.evs", figure + "bone( parent=f, bone=upper )")}).status, 0);
}

TEST(ProgramFigures, CommandsThatNoClipCanCarryOutAreWarnedOf) {
  const TestFolder folder;
  folder.write("tube.glb", test::riggedTube().glb());
  const auto checked = [&](const std::string& command) {
    const ProgramResult r = stadionProgram(
        {"check", folder.write("show.evs", "figure( name=f, file=tube.glb )\n"
                                           "timer( name=t, period=1, eventmessage=\"timesup, f, " +
                                               command + ", latency=0.02\" )")});
    EXPECT_EQ(r.status, 0);
    return r.out + r.err;
  };
  const std::string place = "show.evs:2:52: warning: \"f\": ";
  EXPECT_TRUE(has(checked("play run"),
                  place + "\"run\" begins with no clip of its model; there are \"bend\", \"lift\""));
  EXPECT_TRUE(has(checked("layer"), place + "no clip is named; there are \"bend\", \"lift\""));
  EXPECT_TRUE(has(checked("layer bend weight 2"), place + "\"weight\" needs a number from 0 to 1 after it"));
  EXPECT_TRUE(
      has(checked("layer lift from 0.6"), place + "the clip is 0.5 s long, so it cannot begin at 0.6 s"));
  EXPECT_TRUE(has(checked("unlayer run"), place + "\"run\" begins with no clip"));
  EXPECT_TRUE(has(checked("pose bend"), place + "it needs a clip, and a time of it"));
  for (const char* right : {"play", "play bend fade 0.1", "layer bend weight 0.5", "unlayer",
                            "unlayer fade 1", "pose bend 0.1", "pause"})
    EXPECT_FALSE(has(checked(right), "warning")) << right;
}

}  // namespace
}  // namespace stadion
