#include "engine/base/plain_file.h"
#include "engine/display/covered_rectangle.h"
#include "engine/display/lens_turn.h"
#include "engine/display/screen_coverage.h"
#include "engine/display/unfolding.h"
#include "engine/display/wall_file.h"
#include "engine/display/wall_lint.h"
#include "engine/maths/angles.h"
#include "tests/fresh_folder.h"
#include "tests/mutations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

namespace stadion {
namespace {

namespace fs = std::filesystem;

const std::string kWallsFolder = std::string(STADION_SOURCE_DIR) + "/walls";
const fs::path kHallCorpus = fs::path(STADION_SOURCE_DIR) / "tests/corpus/halls";
const std::string kFrontScreen =
    "screen front plane  lower-left -2 3 0  lower-right 2 3 0  upper-left -2 3 2.5\n";

std::string hallFileContent(const fs::path& path) {
  const auto text = readPlainFile(path.string(), 1 << 20);
  return text ? text.value() : std::string();
}

std::string linesOf(const Diagnostics& findings) {
  std::string all;
  for (const Diagnostic& d : findings.all())
    all += std::to_string(d.where.line) + ":" + std::to_string(d.where.column) +
           (d.severity == Severity::Error ? ": error: " : ": warning: ") + d.message + "\n";
  return all;
}

WallFile hallOf(const std::string& text) {
  Diagnostics out;
  auto hall = parseWalls(text, "t.walls", out);
  EXPECT_TRUE(hall) << linesOf(out);
  return hall ? std::move(*hall) : WallFile{};
}

std::string findingsOf(const std::string& text) {
  Diagnostics out;
  if (const auto hall = parseWalls(text, "t.walls", out)) lintWalls(*hall, out);
  return linesOf(out);
}

constexpr std::pair<const char*, std::size_t> kShippedHalls[] = {{"cave-blended", 8}, {"powerwall-2x3", 12},
                                                                 {"cylinder-180", 3}, {"cylinder-360", 8},
                                                                 {"dome-5", 5},       {"irregular-4", 4}};

TEST(Hall, ThatShipsIsFreeOfFindings) {
  for (const auto& [name, count] : kShippedHalls) {
    Diagnostics out;
    const auto hall = loadWalls(name, kWallsFolder, out);
    ASSERT_TRUE(hall) << name << linesOf(out);
    EXPECT_EQ(linesOf(out), "") << name;
    EXPECT_EQ(hall->walls.size(), count) << name;
    EXPECT_EQ(unfold(hall->walls, 640, 480).size(), count) << name;
    EXPECT_FALSE(floorPlan(*hall).empty()) << name;
  }
}

/// Returns the largest share of a projector's area on the screen that one other lights too.
double largestOverlap(const WallFile& hall, std::size_t screen, Eye eye) {
  const ScreenSurface surface(hall.screens[screen]);
  const std::vector<Vec3> samples = samplesOf(hall.screens[screen]);
  std::vector<std::vector<bool>> lit;
  for (const WallEntry& e : hall.walls) {
    if (e.projector->screen != screen || (e.projector->eye && e.projector->eye != eye)) continue;
    const LightTest test(*e.projector, surface);
    auto& own = lit.emplace_back();
    for (const Vec3& p : samples) own.push_back(test.lights(p));
  }
  double largest = 0;
  for (std::size_t a = 0; a < lit.size(); ++a)
    for (std::size_t b = 0; b < lit.size(); ++b) {
      if (a == b) continue;
      std::size_t both = 0;
      for (std::size_t i = 0; i < samples.size(); ++i) both += lit[a][i] && lit[b][i] ? 1 : 0;
      const double share = static_cast<double>(both) / static_cast<double>(std::ranges::count(lit[a], true));
      largest = std::max(largest, share);
    }
  return largest;
}

TEST(Hall, ThatShipsHasOverlapsForBlending) {
  for (const auto& [name, count] : kShippedHalls) {
    Diagnostics out;
    const auto hall = loadWalls(name, kWallsFolder, out);
    ASSERT_TRUE(hall);
    for (std::size_t screen = 0; screen < hall->screens.size(); ++screen)
      for (const Eye eye : kEyes) {
        const double found = largestOverlap(*hall, screen, eye);
        if (std::getenv("STADION_SHOW_OVERLAPS")) std::printf("%s %s %.3f\n", name, eyeName(eye), found);
        EXPECT_GE(found, 0.1) << name;
        EXPECT_LE(found, 0.2) << name;
      }
  }
}

TEST(Hall, WithMistakesGetsTheListedFindings) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(kHallCorpus)) {
    if (entry.path().extension() != ".walls") continue;
    ++files;
    const std::string found = findingsOf(hallFileContent(entry.path()));
    fs::path golden = entry.path();
    golden.replace_extension(".expected");
    // STADION_WRITE_EXPECTED=1 updates the listings; read them before they are committed.
    if (std::getenv("STADION_WRITE_EXPECTED")) std::ofstream(golden) << found;
    EXPECT_EQ(found, hallFileContent(golden)) << entry.path();
    EXPECT_FALSE(found.empty()) << entry.path();
  }
  EXPECT_GE(files, 9u);
}

TEST(Hall, HasScreensInTheUnitOfTheFileAndAnglesInRadians) {
  const WallFile hall =
      hallOf("unit cm\npixels 640 480\nvisitor 10 20 150 within 50\n"
             "projector p screen b at 0 0 100 turn 90 0 fisheye 180\n"
             "screen a cylinder centre 0 0 10 radius 300 azimuth -90 45 height 50 250\n"
             "screen b sphere centre 0 0 0 radius 400 azimuth -180 180 elevation -10 90 tilt 20\n");
  ASSERT_EQ(hall.screens.size(), 2u);
  const auto& cylinder = std::get<CylinderScreen>(hall.screens[0].surface);
  EXPECT_EQ(cylinder.centre, Vec3(0, 0, 0.1));
  EXPECT_EQ(cylinder.radius, 3);
  EXPECT_NEAR(cylinder.right, kPi / 4, 1e-15);
  EXPECT_EQ(cylinder.top, 2.5);
  EXPECT_NEAR(std::get<SphereScreen>(hall.screens[1].surface).tilt, 20 * kDegree, 1e-15);
  EXPECT_EQ(hall.visitor.eye, Vec3(0.1, 0.2, 1.5));
  EXPECT_EQ(hall.visitor.reach, 0.5);
  EXPECT_EQ(hall.walls[0].projector->screen, 1u) << "screens may stand below";
  EXPECT_EQ(hall.walls[0].projector->height, 480u);
}

TEST(Hall, WrittenAsTextReadsBackToTheSameValues) {
  const std::string text =
      "unit mm\nvisitor 1 2 1500 within 700\n"
      "screen front plane lower-left -2000 3000 0 lower-right 2000 3000 0 upper-left -2000 3000 2500\n"
      "screen round cylinder centre 0 0 100 radius 3000 azimuth -91 47 height 500 2500\n"
      "screen dome sphere centre 0 0 0 radius 4000 azimuth -180 180 elevation -10 90 tilt 20\n"
      "wall w lower-left -2000 3000 0 lower-right 2000 3000 0 upper-left -2000 3000 2500\n"
      "projector a screen front pixels 640 480 eye left card 2 at 0 0 1000 look-at 100 3000 900 roll 3 throw "
      "1.1 "
      "shift 0.1 -0.2 display-gamma 2.2 2.1 2 white 0.9 1 0.8 black 0.001 no-blend mask m.png\n"
      "projector b screen dome pixels 640 640 at 0 0 1000 turn 0 90 roll 40 fisheye 170\n"
      "projector c screen front pixels 640 480 pins 0.1 0  1 0.1  0.9 1  0 0.9\n"
      "output a monitor 2 rotate 90\n";
  const WallFile hall = hallOf(text), back = hallOf(formatWalls(hall));
  ASSERT_EQ(back.screens.size(), 3u);
  ASSERT_EQ(back.walls.size(), 4u);
  EXPECT_EQ(back.visitor.eye, hall.visitor.eye);
  const auto &c1 = std::get<CylinderScreen>(hall.screens[1].surface),
             &c2 = std::get<CylinderScreen>(back.screens[1].surface);
  EXPECT_EQ(c1.centre, c2.centre);
  EXPECT_NEAR(c1.left, c2.left, 1e-15);
  const Projector &a1 = *hall.walls[1].projector, &a2 = *back.walls[1].projector;
  const auto &l1 = std::get<LensImage>(a1.image), &l2 = std::get<LensImage>(a2.image);
  EXPECT_EQ(l1.X_RP.p, l2.X_RP.p);
  EXPECT_LE((l1.X_RP.q.toRotationMatrix() - l2.X_RP.q.toRotationMatrix()).norm(), 1e-14);
  EXPECT_EQ(l1.shift, l2.shift);
  EXPECT_EQ(a1.eye, a2.eye);
  EXPECT_EQ(a1.light.gamma, a2.light.gamma);
  EXPECT_EQ(a1.light.white, a2.light.white);
  EXPECT_EQ(a1.light.black, a2.light.black);
  EXPECT_FALSE(a2.blend.computed);
  EXPECT_EQ(a2.blend.mask, "m.png");
  EXPECT_EQ(back.walls[1].card, 2u);
  ASSERT_TRUE(back.walls[1].output);
  const auto &f1 = std::get<FisheyeImage>(hall.walls[2].projector->image),
             &f2 = std::get<FisheyeImage>(back.walls[2].projector->image);
  EXPECT_LE((f1.X_RP.q.toRotationMatrix() - f2.X_RP.q.toRotationMatrix()).norm(), 1e-14);
  EXPECT_EQ(std::get<PinnedImage>(hall.walls[3].projector->image).pins,
            std::get<PinnedImage>(back.walls[3].projector->image).pins);
}

TEST(Hall, OfMeasuredFilesIsWrittenInTheUnitOfTheFiles) {
  const WallFile hall = hallOf("unit mm\nscreen rock mesh file rock.obj\n"
                               "projector a screen rock pixels 64 48 warp a.pfm\n");
  const std::string text = formatWalls(hall);
  EXPECT_TRUE(text.starts_with("unit mm\neye-separation 64\n")) << text;
  const WallFile back = hallOf(text);
  EXPECT_EQ(back.metresPerUnit, 0.001);
  EXPECT_EQ(std::get<MeshScreen>(back.screens[0].surface).file, "rock.obj");
  EXPECT_EQ(std::get<MeasuredImage>(back.walls[0].projector->image).file, "a.pfm");
}

TEST(Hall, ReadsTheFilesBesideItAndNamesThoseThatAreMissing) {
  const FreshFolder folder;
  const std::string wallFile = (folder.path() / "h.walls").string();
  std::ofstream(wallFile) << "unit cm\nscreen rock mesh file rock.obj\n"
                             "projector a screen rock pixels 64 48 at 0 0 100 look-at 0 300 100 throw 1\n";
  Diagnostics missing;
  EXPECT_FALSE(loadWalls(wallFile, kWallsFolder, missing));
  EXPECT_NE(linesOf(missing).find("2:8: error: " + (folder.path() / "rock.obj").string() +
                                  ": cannot be read: No such file"),
            std::string::npos)
      << linesOf(missing);
  std::ofstream(folder.path() / "rock.obj")
      << "v -100 300 0\nv 100 300 0\nv 100 300 200\nv -100 300 200\nf 1 2 3 4\n";
  Diagnostics out;
  const auto hall = loadWalls(wallFile, kWallsFolder, out);
  ASSERT_TRUE(hall) << linesOf(out);
  EXPECT_EQ(linesOf(out), "");
  EXPECT_EQ(std::get<MeshScreen>(hall->screens[0].surface).triangles.size(), 2u);
  EXPECT_NEAR(basis(hall->walls[0].wall).width, 2, 0.2);
  EXPECT_GT(basis(hall->walls[0].wall).normal.dot(hall->visitor.eye - hall->walls[0].wall.centre()), 0);
}

TEST(Hall, MayHaveManyProjectorsAndTooManyAreOneError) {
  std::string text = kFrontScreen + "pixels 64 48\n";
  for (int i = 0; i < 1000; ++i)
    text += "projector p" + std::to_string(i) + " screen front at 0 0 1.25 look-at 0 3 1.25 throw 0.7\n";
  EXPECT_EQ(findingsOf(text),
            "259:1: error: a file has at most 256 walls and projectors; delete this line and "
            "those after it\n");
  std::string screens;
  for (int i = 0; i < 1000; ++i) screens += "screen s" + std::to_string(i) + " mesh file a.obj\n";
  EXPECT_EQ(findingsOf(screens),
            "257:1: error: a file has at most 256 screens; delete this line and those after it\n");
}

TEST(Hall, MayMixWallsAndProjectors) {
  EXPECT_EQ(findingsOf(kFrontScreen +
                       "wall left lower-left -2 -1 0 lower-right -2 3 0 upper-left -2 -1 2.5\n"
                       "projector p screen front pixels 1920 1200 at 0 0 1.25 look-at 0 3 1.25 throw 0.74\n"),
            "");
}

TEST(Hall, OfAProjectorOnAPlaneHasTheRectangleThatItLights) {
  // 3 m away a throw ratio of 1 makes a picture of 3 m by 1.5 m; the screen ends 0.5 m right of its middle.
  const WallFile hall = hallOf("screen s plane lower-left -2 3 0 lower-right 0.5 3 0 upper-left -2 3 4\n"
                               "projector p screen s pixels 200 100 at 0 0 1 look-at 0 3 1 throw 1\n");
  const Wall& wall = hall.walls[0].wall;
  EXPECT_LE((wall.lowerLeft - Vec3(-1.5, 3, 0.25)).norm(), 1e-12);
  EXPECT_LE((wall.upperRight() - Vec3(0.5, 3, 1.75)).norm(), 1e-12);
  EXPECT_EQ(wall.name, "p");
}

TEST(Hall, OfAProjectorOnACylinderHasARectangleThatFacesTheVisitor) {
  const WallFile hall = hallOf("screen s cylinder centre 0 0 0 radius 3 azimuth -180 180 height 0 3\n"
                               "projector p screen s pixels 200 100 at 0 0 1.5 turn 90 0 throw 1\n");
  const WallBasis b = basis(hall.walls[0].wall);
  EXPECT_GT(b.normal.dot(Vec3(-1, 0, 0)), 0.999);
  EXPECT_GT(b.up.z(), 0.999);
  EXPECT_NEAR(b.width, 2 * 3 * 0.5 / std::sqrt(1.25), 1e-3);
}

TEST(Hall, ThatIsMutatedNeverCrashes) {
  const auto [count, start] = test::mutations(3000);
  std::mt19937 random(static_cast<std::uint32_t>(42 + start));
  std::vector<std::string> seeds;
  for (const auto& [name, projectors] : kShippedHalls)
    seeds.push_back(hallFileContent(kWallsFolder + "/" + name + ".walls"));
  for (const auto& entry : fs::directory_iterator(kHallCorpus))
    seeds.push_back(hallFileContent(entry.path()));
  static const std::vector<std::string> kWords{"nan",       "1e308",       "-0",      "0",       "360",
                                               "throw",     "fisheye 360", "\n",      "#",       "mesh",
                                               "turn 0 90", "pins",        "unit mm", "eye left"};
  for (int i = 0; i < count; ++i) {
    std::string text = seeds[random() % seeds.size()];
    for (unsigned k = 1 + random() % 3; k > 0; --k) {
      const std::size_t at = random() % (text.size() + 1);
      switch (random() % 4) {
      case 0: text.insert(at, " " + kWords[random() % kWords.size()] + " "); break;
      case 1: text.erase(at, random() % 12); break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random());
        break;
      default: text.insert(at, text.substr(random() % (text.size() + 1), random() % 60));
      }
    }
    Diagnostics out;
    const auto hall = parseWalls(text, "t.walls", out);
    ASSERT_EQ(hall.has_value(), !out.hasErrors());
    if (!hall) continue;
    Diagnostics none;
    const auto again = parseWalls(formatWalls(*hall), "t.walls", none);
    ASSERT_TRUE(again) << linesOf(none) << formatWalls(*hall);
    if (i % 10 > 0) continue;  // coverage takes longer
    lintWalls(*hall, out);
    if (out.hasErrors()) continue;
    EXPECT_FALSE(floorPlan(*hall).empty());
    for (const WallEntry& e : hall->walls)
      ASSERT_TRUE(projectionMatrix(eyeFrustum(e.wall, kStandingEye, hall->depth)).allFinite()) << text;
  }
}

TEST(LensTurn, TurnsRightUpAndClockwise) {
  const auto seen = [](double yaw, double pitch, double roll, const Vec3& p) -> Vec3 {
    return rotationOf({yaw * kDegree, pitch * kDegree, roll * kDegree}) * p;
  };
  EXPECT_LE((seen(90, 0, 0, Vec3(0, 1, 0)) - Vec3(1, 0, 0)).norm(), 1e-15) << "to the right";
  EXPECT_LE((seen(0, 90, 0, Vec3(0, 1, 0)) - Vec3(0, 0, 1)).norm(), 1e-15) << "up";
  EXPECT_LE((seen(0, 90, 0, Vec3(0, 0, 1)) - Vec3(0, -1, 0)).norm(), 1e-15);
  EXPECT_LE((seen(0, 0, 90, Vec3(0, 0, 1)) - Vec3(1, 0, 0)).norm(), 1e-15) << "clockwise: up goes right";
  for (const LensTurn& turn : {LensTurn{0.3, -0.4, 0.5}, LensTurn{-2, 1.2, -3}, LensTurn{0, kPi / 2, 1}}) {
    const LensTurn back = turnOf(rotationOf(turn));
    EXPECT_NEAR(back.yaw, turn.yaw, 1e-12);
    EXPECT_NEAR(back.pitch, turn.pitch, 1e-12);
    EXPECT_NEAR(back.roll, turn.roll, 1e-12);
  }
}

TEST(FloorPlan, ShowsScreensAndProjectors) {
  const WallFile hall =
      hallOf("screen s cylinder centre 0 0 0 radius 3 azimuth -90 90 height 0 3\n"
             "projector left screen s pixels 200 100 at -1 0 1.5 turn -30 0 throw 1\n"
             "projector right screen s pixels 200 100 eye right at 1 0 1.5 turn 30 0 throw 1\n");
  const std::string plan = floorPlan(hall, 31);
  EXPECT_TRUE(plan.starts_with(R"(          ###########
      #####         #####
    ###                 ###
   ##                     ##
  ##                       ##
 ##                         ##
 #                           #
 #        1    @    2        #
)")) << plan;
  EXPECT_NE(plan.find(" for the right eye, 200 x 100 pixels, at 1.00 0.00 1.50"), plan.npos) << plan;
}

}  // namespace
}  // namespace stadion
