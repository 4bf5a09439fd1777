/// Painted objects look alike in every mode, cast shadows while they are opaque, and get the materials of their
/// files back.

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

/// An object and a figure before a ground. The timers' messages change their paint.
class PaintedShow {
public:
  explicit PaintedShow(const std::string& messages) {
    write("tube.glb", test::riggedTube().glb());
    write("ground.obj", "v -9 0 0\nv 9 0 0\nv 9 18 0\nv -9 18 0\nf 1 2 3 4\n");
    write("box.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n"
                     "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 4 3 7 8\nf 5 6 2 1\n");
    write("show.evs", R"(light( direction="-1, 2, -3" )
object( file=ground.obj, up=z )
object( name=box, file=box.obj, up=z, position="-1.2, 4, 0.2" )
figure( name=tube, file=tube.glb, clip=bend, position="0.8, 4, 0" )
)" + messages);
  }

  /// Picture files by name.
  std::map<std::string, std::string> played(const std::vector<std::string>& how) const {
    return playedPictures(folder_.path() / "show.evs", how);
  }
  std::string checked() const {
    const ProgramResult r = stadionProgram({"check", (folder_.path() / "show.evs").string()});
    return r.out + r.err;
  }

private:
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
  }

  TestFolder folder_;
};

const std::string kChanging = R"(timer( period=0.1, eventmessage="timesup, box, tint 1 0.3 0.2",
                                       eventmessage="timesup, tube, opacity 0.4, 0.1",
                                       eventmessage="timesup, tube, emit 0 0.4 0, 0.2",
                                       eventmessage="timesup, box, opacity 0.5, 0.2",
                                       eventmessage="timesup, box, opacity 0, 0.3",
                                       eventmessage="timesup, box, reset, 0.4" )
)";

TEST(ProgramPaints, EveryModeDrawsTheSamePictures) {
  const PaintedShow show(kChanging);
  for (const char* renderer : {"cpu", "gl"}) {
    const auto drawn = [&](std::vector<std::string> how) {
      how.insert(how.end(), {"--renderer", renderer, "--frames", "34", "--pictures", "all"});
      return show.played(how);
    };
    const auto sequential = drawn({"--mode", "sequential"});
    ASSERT_GT(sequential.size(), 34u);
    EXPECT_EQ(sequential, drawn({"--mode", "pipelined"})) << renderer;
    EXPECT_EQ(sequential, drawn({"--mode", "pipelined", "--wall-workers", "process"})) << renderer;
  }
}

TEST(ProgramPaints, TheMaterialsOfTheFileComeBack) {
  // All pictures at 0.4 s, when the messages have arrived.
  const auto at = [](const std::string& messages) {
    auto all = PaintedShow(messages).played({"--frames", "25"});
    all.erase("contact-sheet.png");
    return all;
  };
  const auto never = at("");
  ASSERT_FALSE(never.empty());
  const std::string first = R"(timer( period=0.1, eventmessage="timesup, box, )";
  const auto after = [&](const std::string& one, const std::string& two) {
    return at(first + one + "\", eventmessage=\"timesup, box, " + two + ", 0.1\" )");
  };
  EXPECT_EQ(after("opacity 0.3", "opacity 1"), never);
  EXPECT_EQ(after("opacity 0", "reset"), never);
  EXPECT_EQ(after("tint 1 0 0", "tint 1 1 1"), never);
  EXPECT_EQ(after("emit 1 0 0", "emit 0 0 0"), never);
  EXPECT_EQ(after("opacity 0", "opacity 0"), after("hide", "hide"));
  EXPECT_NE(after("opacity 0.3", "opacity 0.3"), never);
}

TEST(ProgramPaints, WrongColoursAreErrors) {
  const auto checked = [](const std::string& command) {
    return PaintedShow("timer( period=0.1, eventmessage=\"timesup, box, " + command + "\" )").checked();
  };
  EXPECT_EQ(checked("tint 1 0.5 0, 0.5").find("error: "), std::string::npos);
  EXPECT_TRUE(
      has(checked("tint 1 0"),
          "error: \"tint\" must be followed by red, green and blue, with blanks between them, not by 2 "
          "numbers"));
  EXPECT_TRUE(has(checked("opacity 2"), "error: \"opacity\" takes numbers from 0 to 1, not 2"));
  EXPECT_TRUE(has(checked("opacity"), "error: \"opacity\" must be followed by one number, not by nothing"));
}

}  // namespace
}  // namespace stadion
