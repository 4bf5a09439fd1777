/// What a show's models look like on its walls, from file to picture: counted pixels in both looks, with
/// walls drawn by threads and by processes.
#include "pipeline/picture/picture.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

#include <span>

namespace stadion {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFront =
    "wall front lower-left -1.5 1.5 0 lower-right 1.5 1.5 0 upper-left -1.5 1.5 3\n";
constexpr const char* kOffAxis = "near 0.1\nfar 20000\nwall front lower-left -0.9 1.2 0.4 lower-right 1.6 "
                                 "1.2 0.4 upper-left -0.9 1.2 2.4\n";

/// Pixels of the last picture of the left eye.
struct ShownPixels {
  std::size_t red = 0, green = 0, bright = 0, all = 0;
};

ShownPixels shownOf(const std::string& script, const std::string& walls, const std::string& look,
                    const std::string& drawnBy, const std::string& size, const std::string& assets) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", script), file = folder.write("one.walls", walls);
  const std::string out = folder.path() / "out";
  const ProgramResult r = stadionProgram({"run",      show, "--asset-root",   assets,  "--walls",    file,
                                          "--look",   look, "--wall-workers", drawnBy, "--size",     size,
                                          "--frames", "2",  "--input",        "none",  "--pictures", "last",
                                          "--out",    out});
  EXPECT_EQ(r.status, 0) << r.err;
  ShownPixels found;
  for (const auto& entry : fs::directory_iterator(out)) {
    if (!entry.path().filename().string().starts_with("front-left")) continue;
    const auto picture = readPng(entry.path());
    EXPECT_TRUE(picture);
    if (!picture) continue;
    const auto& p = picture.value().rgba;
    for (std::size_t i = 0; i < p.size(); i += 4) {
      found.red += p[i] > p[i + 1] + 60 && p[i] > p[i + 2] + 60;
      found.green += p[i + 1] > p[i] + 60 && p[i + 1] > p[i + 2] + 60;
      found.bright += p[i] + p[i + 1] + p[i + 2] > 600;
      ++found.all;
    }
  }
  EXPECT_GT(found.all, 0u) << r.err;
  return found;
}

struct ShownBy {
  const char *look, *drawnBy, *size;
};
constexpr ShownBy kWays[] = {{"full", "thread", "96x72"},
                             {"plain", "process", "120x90"},
                             {"plain", "thread", "64x48"},
                             {"full", "process", "64x64"}};
/// Each look and threads and processes once: the first two of them, or the last two. All of them: 4.
using Ways = std::span<const ShownBy>;
const Ways kEachOnce = Ways(kWays).first(2), kEachOnceOtherwise = Ways(kWays).last(2), kAll = kWays;

std::string sheets(const TestFolder& folder, double distance, double gap) {
  for (const auto& [name, colour] : {std::pair("red", "1 0 0"), std::pair("green", "0 1 0")}) {
    folder.write(std::string(name) + ".mtl", std::string("newmtl a\nKd ") + colour + "\n");
    folder.write(std::string(name) + ".obj",
                 std::string("mtllib ") + name +
                     ".mtl\nv -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\n"
                     "usemtl a\nf 1 2 3 4\n");
  }
  const auto object = [](const char* file, double size, double y) {
    return "object( file=" + std::string(file) + ", up=y, scale=" + std::to_string(size) +
           ", position=\"0, " + std::to_string(y) + ", 1.7\", orientation=\"0,0,3\" )\n";
  };
  return "sky( ambient=\"1,1,1\" )\nlight( direction=\"0,1,0\", intensity=0.001 )\n" +
         object("green.obj", 0.98 * distance, distance + gap) + object("red.obj", distance, distance);
}

struct SheetsShown {
  double distance, gap;
  Ways ways;
};

void expectTheNearerOfTwoSheets(const std::vector<SheetsShown>& cases) {
  for (const auto& [distance, gap, ways] : cases)
    for (const ShownBy& by : ways) {
      const TestFolder folder;
      const std::string script = sheets(folder, distance, gap);
      const ShownPixels found =
          shownOf(script, distance > 900 ? kOffAxis : std::string("near 0.1\n") + kFront, by.look, by.drawnBy,
                  by.size, folder.path());
      EXPECT_EQ(found.green, 0u) << distance << " m, " << by.look << ", " << by.drawnBy;
      EXPECT_GT(found.red, found.all / 10) << distance << " m, " << by.look << ", " << by.drawnBy;
    }
}

TEST(ProgramSurfaces, TheNearerOfTwoSheetsIsSeenAtEveryDistance) {
  expectTheNearerOfTwoSheets({{1, 0.001, kEachOnce}, {800, 0.2, kEachOnceOtherwise}, {8000, 2, kEachOnce}});
}

TEST(ProgramFullSurfaces, TheNearerOfTwoSheetsIsSeenAtEveryDistanceInEveryWay) {
  expectTheNearerOfTwoSheets({{1, 0.001, kAll}, {800, 0.2, kAll}, {8000, 2, kAll}});
}

void expectCardsWithHoles(Ways ways) {
  for (const ShownBy& by : ways) {
    const ShownPixels found = shownOf(
        "sky( ambient=\"1,1,1\", zenith=\"0.2,0.2,0.8\", horizon=\"0.2,0.2,0.8\", ground=\"0.2,0.2,0.8\" )\n"
        "light( direction=\"0,1,0\" )\nobject( file=mask.gltf, position=\"0, 3, 0.7\" )\n",
        kFront, by.look, by.drawnBy, by.size, std::string(STADION_SOURCE_DIR) + "/tests/corpus/models");
    // The near one's solid half is an eighteenth of the picture, and the far one's is behind it.
    EXPECT_NEAR(double(found.red), double(found.all) / 18, double(found.all) / 200)
        << by.look << ", " << by.drawnBy;
    EXPECT_EQ(found.green, 0u) << by.look << ", " << by.drawnBy;
  }
}

TEST(ProgramSurfaces, CardsWithHolesHideAndAreSeenThrough) {
  expectCardsWithHoles(kEachOnce);
}

void expectOnlyTheLampToGlow(Ways ways) {
  for (const ShownBy& by : ways) {
    const ShownPixels found = shownOf(
        "sky( ambient=\"0.3,0.3,0.3\", zenith=\"0,0,0\", horizon=\"0,0,0\", ground=\"0,0,0\" )\n"
        "light( direction=\"0,1,-0.5\", shadows=off )\nobject( file=lamp.gltf, position=\"0, 3, 1.7\" )\n",
        kFront, by.look, by.drawnBy, by.size, std::string(STADION_SOURCE_DIR) + "/tests/corpus/models");
    // A sixteenth of the object, which is a ninth of the picture.
    EXPECT_NEAR(double(found.green), double(found.all) / 144, double(found.all) / 300)
        << by.look << ", " << by.drawnBy;
    EXPECT_EQ(found.bright, 0u) << by.look << ", " << by.drawnBy;
  }
}

TEST(ProgramSurfaces, OnlyTheLampOfAModelGlows) {
  expectOnlyTheLampToGlow(kEachOnceOtherwise);
}

TEST(ProgramFullSurfaces, CardsWithHolesAndLampsAreRightInEveryWay) {
  expectCardsWithHoles(kAll);
  expectOnlyTheLampToGlow(kAll);
}

}  // namespace
}  // namespace stadion
