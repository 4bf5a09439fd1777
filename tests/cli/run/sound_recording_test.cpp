/// `run --out` in a hall with loudspeakers: the sound of the show as a file.

#include "tests/programs/program.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace stadion {
namespace {

constexpr const char* kWall =
    "wall front  lower-left -1.5 1.5 0   lower-right 1.5 1.5 0   upper-left -1.5 1.5 3\n";

struct RecordedRun {
  RecordedRun() {
    show = folder.write("moving.evs",
                        "path( name=way, target=ball, key=\"0, -4, 3, 1\", key=\"0.3, 4, 3, 1\" )\n"
                        "object( name=ball, file=football.3ds, position=\"-4, 3, 1\" )\n"
                        "sound( name=hum, file=wind.wav, parent=ball, range=30, loop=on )\n"
                        "sound( name=bang, file=thud.wav, position=\"2, 3, 1\", range=20 )\n");
    silent = folder.write("silent.evs", "object( file=football.3ds, position=\"-4, 3, 1\" )\n");
    hall = folder.write("hall.walls", std::string(kWall) + "loudspeaker left -1.4 1.4 1.7\n"
                                                           "loudspeaker right 1.4 1.4 1.7\n"
                                                           "loudspeaker back 0 -2 1.7\n");
    plain = folder.write("plain.walls", kWall);
  }
  /// The folder with its results.
  std::filesystem::path run(const std::string& what, const std::string& walls,
                            std::vector<std::string> more) const {
    const std::filesystem::path out = folder.path() / "out";
    std::vector<std::string> words{"run",      what,    "--asset-root", assetFolder(), "--walls",  walls,
                                   "--frames", "24",    "--size",       "32x24",       "--stereo", "off",
                                   "--look",   "plain", "--renderer",   "cpu",         "--out",    out};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 0) << r.err;
    return out;
  }
  TestFolder folder;
  std::string show, silent, hall, plain;
};

TEST(ProgramSoundRecording, HasTheSameSamplesInAllModes) {
  const RecordedRun r;
  const std::string first = fileContent(r.run(r.show, r.hall, {"--mode", "sequential"}) / "sound.wav");
  // 24 frames at 60 Hz: 23 steps of 800 samples, in three channels of three bytes.
  EXPECT_EQ(first.size(), 104 + 23 * 800 * 3 * 3U);
  EXPECT_EQ(fileContent(r.run(r.show, r.hall, {"--mode", "pipelined"}) / "sound.wav"), first);
}

TEST(ProgramSoundRecording, IsLeftOutWithoutLoudspeakersSoundsOrTheWish) {
  const RecordedRun r;
  EXPECT_FALSE(std::filesystem::exists(r.run(r.show, r.plain, {}) / "sound.wav"));
  EXPECT_FALSE(std::filesystem::exists(r.run(r.silent, r.hall, {}) / "sound.wav"));
  EXPECT_FALSE(std::filesystem::exists(r.run(r.show, r.hall, {"--no-sound"}) / "sound.wav"));
}

}  // namespace
}  // namespace stadion
