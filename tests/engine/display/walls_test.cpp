#include "engine/base/plain_file.h"
#include "engine/display/wall_file.h"
#include "engine/display/wall_lint.h"
#include "engine/plain_text/text_line.h"
#include "tests/fresh_folder.h"
#include "tests/mutations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

const std::string kShipped = std::string(STADION_SOURCE_DIR) + "/walls";
const fs::path kCorpus = fs::path(STADION_SOURCE_DIR) / "tests/corpus/walls";

std::string textOf(const fs::path& path) {
  const auto text = readPlainFile(path.string(), 1 << 20);
  return text ? text.value() : std::string();
}

/// Parses and lints, as loading does.
Diagnostics findingsIn(const std::string& text) {
  Diagnostics out;
  if (const auto walls = parseWalls(text, "t.walls", out)) lintWalls(*walls, out);
  return out;
}

/// One finding a line, in the order of the file's checks.
std::string listing(const Diagnostics& findings) {
  std::string all;
  for (const Diagnostic& d : findings.all()) {
    const char* severity = d.severity == Severity::Error     ? "error"
                           : d.severity == Severity::Warning ? "warning"
                                                             : "note";
    all += std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + severity + ": " +
           d.message + "\n";
  }
  return all;
}

TEST(Walls, ThatShipAreFreeOfFindingsAndFoundByName) {
  for (const auto& [name, count] : {std::pair("cave4", 4u), std::pair("cave6", 6u),
                                    std::pair("powerwall", 1u), std::pair("desktop", 1u)}) {
    Diagnostics out;
    const auto walls = loadWalls(name, kShipped, out);
    ASSERT_TRUE(walls) << name << listing(out);
    EXPECT_EQ(walls->walls.size(), count);
    EXPECT_TRUE(out.all().empty()) << listing(out);
    EXPECT_EQ(walls->eyeSeparation, 0.064);
    EXPECT_LE(std::ranges::count(textOf(kShipped + "/" + name + ".walls"), '\n'), 12);
  }
}

TEST(Walls, OfCave4StandWhereTheFileSays) {
  Diagnostics out;
  const auto walls = loadWalls("cave4", kShipped, out);
  ASSERT_TRUE(walls);
  EXPECT_EQ(walls->walls[0].wall.name, "front");
  EXPECT_EQ(walls->walls[3].wall.name, "floor");
  for (const WallEntry& e : walls->walls) {
    const WallBasis b = basis(e.wall);
    EXPECT_EQ(b.width, 3);
    EXPECT_EQ(b.height, 3);
    // The normal points to the middle of the room.
    EXPECT_NEAR(b.normal.dot(Vec3(0, 0, 1.5) - e.wall.centre()), 1.5, 1e-12) << e.wall.name;
  }
  const Affine X_SR = rigToWall(walls->walls[1].wall);
  EXPECT_LE((X_SR * Vec3(-1.5, 1.5, 3) - Vec3(3, 3, 0)).norm(), 1e-12);
}

TEST(Walls, MayComeInAnyUnitWithCommasAndComments) {
  for (const char* text :
       {"unit mm\nwall a lower-left -1500,1500,0 lower-right 1500,1500,0 upper-left -1500,1500,3000",
        "unit cm # as measured\nwall a upper-left -150 150 300 lower-left -150 150 0 lower-right +150 150 0#",
        "\xef\xbb\xbfwall a lower-left -1.5 1.5 0 lower-right 1.5 1.5 0 upper-left -1.5 1.5 3\r\n"}) {
    Diagnostics out;
    const auto walls = parseWalls(text, "t.walls", out);
    ASSERT_TRUE(walls) << listing(out);
    EXPECT_LE((walls->walls[0].wall.upperLeft - Vec3(-1.5, 1.5, 3)).norm(), 1e-12);
    EXPECT_LE((walls->walls[0].wall.lowerRight - Vec3(1.5, 1.5, 0)).norm(), 1e-12);
  }
}

TEST(Walls, TakeTheFilesPixelsUnlessTheyHaveTheirOwn) {
  Diagnostics out;
  const auto walls =
      parseWalls("wall a lower-left -1 2 0 lower-right 1 2 0 upper-left -1 2 2 pixels 1024 768\n"
                 "wall b lower-left 1 2 0 lower-right 3 2 0 upper-left 1 2 2\npixels 640 480\n",
                 "t.walls", out);
  ASSERT_TRUE(walls);
  EXPECT_EQ(walls->walls[0].pixels.width, 1024u);
  EXPECT_EQ(walls->walls[1].pixels.height, 480u);
}

TEST(Walls, WrittenAsTextReadBackToTheSameValues) {
  Diagnostics out;
  auto walls = loadWalls("cave6", kShipped, out);
  ASSERT_TRUE(walls);
  walls->walls[2].wall.upperLeft.x() = 1.0 / 3;
  walls->walls[0].pixels = {123, 45};
  walls->walls[1].card = 3;
  walls->depth = {0.07, 1e4};
  const auto back = parseWalls(formatWalls(*walls), "t.walls", out);
  ASSERT_TRUE(back) << listing(out);
  ASSERT_EQ(back->walls.size(), walls->walls.size());
  for (std::size_t i = 0; i < walls->walls.size(); ++i) {
    EXPECT_EQ(back->walls[i].wall.name, walls->walls[i].wall.name);
    EXPECT_EQ(back->walls[i].wall.lowerLeft, walls->walls[i].wall.lowerLeft);
    EXPECT_EQ(back->walls[i].wall.lowerRight, walls->walls[i].wall.lowerRight);
    EXPECT_EQ(back->walls[i].wall.upperLeft, walls->walls[i].wall.upperLeft);
    EXPECT_EQ(back->walls[i].pixels.width, walls->walls[i].pixels.width);
    EXPECT_EQ(back->walls[i].card, walls->walls[i].card);
  }
  EXPECT_EQ(back->depth.far, 1e4);
}

TEST(Walls, MayNameTheGraphicsCardThatDrawsThem) {
  const std::string wall = "wall a lower-left -1 2 0 lower-right 1 2 0 upper-left -1 2 2";
  Diagnostics out;
  const auto walls = parseWalls(wall + " card 1 pixels 64 48", "t.walls", out);
  ASSERT_TRUE(walls) << listing(out);
  EXPECT_EQ(walls->walls[0].card, 1u);
  EXPECT_FALSE(parseWalls(wall, "t.walls", out)->walls[0].card);
  for (const char* bad : {" card", " card -1", " card 64", " card 0.5", " card nvidia", " card 0 card 1"})
    EXPECT_TRUE(findingsIn(wall + bad).hasErrors()) << bad;
}

TEST(Walls, ThatAreWrongGetTheListedFindings) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(kCorpus)) {
    if (entry.path().extension() != ".walls") continue;
    ++files;
    const std::string found = listing(findingsIn(textOf(entry.path())));
    fs::path golden = entry.path();
    golden.replace_extension(".expected");
    // STADION_WRITE_EXPECTED=1 updates the listings; read them before they are committed.
    if (std::getenv("STADION_WRITE_EXPECTED")) std::ofstream(golden) << found;
    EXPECT_EQ(found, textOf(golden)) << entry.path();
    EXPECT_FALSE(found.empty()) << entry.path();
  }
  EXPECT_GE(files, 12u);
}

TEST(Walls, ThatStandBehindOneAnotherFaceTheRoom) {
  const std::string left =
      "wall left   lower-left -1.5 -1.5 0  lower-right -1.5 1.5 0  upper-left -1.5 -1.5 3\n";
  const std::string front =
      "wall front  lower-left -1.5 1.5 0  lower-right 1.5 1.5 0  upper-left -1.5 1.5 3\n";
  const std::string far = "wall far    lower-left -1.5 5 0  lower-right 1.5 5 0  upper-left -1.5 5 3\n";
  EXPECT_EQ(listing(findingsIn(far + front + left)), "") << "the mean of the centres is behind \"front\"";
  const std::string mirroredLeft =
      "wall left   lower-left -1.5 1.5 0  lower-right -1.5 -1.5 0  upper-left -1.5 1.5 3\n";
  const std::string found = listing(findingsIn(far + front + mirroredLeft));
  EXPECT_TRUE(found.starts_with("3:6: error: wall \"left\" faces away from the room")) << found;
  EXPECT_EQ(found.find("front"), std::string::npos) << found;
}

TEST(Walls, OfTwoBoothsDoNotAccuseEachOther) {
  std::string booths;
  for (const char* x : {"-10 ", "10 "}) {
    const double at = std::atof(x);
    const auto wall = [&](const char* name, double ax, double ay, double bx, double by) {
      const auto corner = [](double cx, double cy, int z) {
        return std::to_string(cx) + " " + std::to_string(cy) + " " + std::to_string(z);
      };
      booths += std::string("wall ") + name + (at > 0 ? "2" : "1") + " lower-left " + corner(at + ax, ay, 0) +
                " lower-right " + corner(at + bx, by, 0) + " upper-left " + corner(at + ax, ay, 3) + "\n";
    };
    wall("left", -1.5, -1.5, -1.5, 1.5), wall("front", -1.5, 1.5, 1.5, 1.5),
        wall("right", 1.5, 1.5, 1.5, -1.5);
  }
  const Diagnostics out = findingsIn(booths);
  EXPECT_FALSE(out.hasErrors()) << listing(out);
  EXPECT_EQ(out.all().size(), 2u) << listing(out) << "the eye is behind one wall of each booth";
}

TEST(Walls, ThatMayFaceAwayAreAWarning) {
  const std::string apart = "wall east lower-left 3 1 0  lower-right 3 -1 0  upper-left 3 1 2\n"
                            "wall west lower-left -3 1 0  lower-right -3 -1 0  upper-left -3 1 2\n";
  const std::string found = listing(findingsIn(apart));
  EXPECT_TRUE(
      found.starts_with("2:6: warning: no place is in front of every wall, and wall \"west\" may face "
                        "away; if so, its corners are lower-left -3 -1 0"))
      << found;
}

TEST(Walls, ThatDoNotExistAreNamedWithASuggestion) {
  Diagnostics out;
  EXPECT_FALSE(loadWalls("cvae4", kShipped, out));
  EXPECT_NE(listing(out).find("there are no walls named \"cvae4\"; did you mean \"cave4\"?"),
            std::string::npos)
      << listing(out);
  Diagnostics elsewhere;
  EXPECT_FALSE(loadWalls("./nowhere/x.walls", kShipped, elsewhere));
  EXPECT_NE(listing(elsewhere).find("cannot be read: No such file"), std::string::npos) << listing(elsewhere);
  EXPECT_EQ(elsewhere.all()[0].where.file, "./nowhere/x.walls");
  Diagnostics noFolder;
  EXPECT_FALSE(loadWalls("cave4", "/nonexistent", noFolder));
  EXPECT_TRUE(noFolder.hasErrors());
}

TEST(Walls, InAFolderOrDeviceInsteadOfAFileAreRefused) {
  for (const char* path : {"/tmp/", "/dev/zero"}) {
    Diagnostics out;
    EXPECT_FALSE(loadWalls(path, kShipped, out));
    EXPECT_TRUE(out.hasErrors());
  }
}

TEST(Walls, InAFolderThatMayNotBeReadAreAnError) {
  const fs::path folder = makeFreshFolder();
  std::ofstream(folder / "a.walls") << "unit m\n";
  chmod(folder.c_str(), 0);
  Diagnostics out;
  EXPECT_FALSE(loadWalls((folder / "a.walls").string(), kShipped, out));  // for root: no walls in it
  EXPECT_FALSE(loadWalls("a", folder.string(), out));
  EXPECT_TRUE(out.hasErrors());
  chmod(folder.c_str(), 0755);
  fs::remove_all(folder);
}

TEST(Walls, WithManyErrorsStopAfterTwenty) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "nonsense\n";
  const Diagnostics out = findingsIn(text);
  EXPECT_EQ(out.errorCount(), LineReader::kMaxErrors);
}

/// Changes a few bytes, words or lines of a text.
std::string mutated(std::string text, std::mt19937& random) {
  static const std::vector<std::string> kPieces{
      "nan",        "inf",        "-",   "1e308",    "-1e308",
      "1e-320",     "0",          "\0x", "\xff\xfe", "wall",
      "unit mm",    ",",          "#",   "\n",       "99999999999999999999",
      "lower-left", "pixels 1 1", "  "};
  for (unsigned k = 1 + random() % 3; k > 0; --k) {
    const std::size_t at = random() % (text.size() + 1);
    switch (random() % 5) {
    case 0: text.insert(at, kPieces[random() % kPieces.size()]); break;
    case 1: text.erase(at, random() % 12); break;
    case 2:
      if (at < text.size()) text[at] = static_cast<char>(random());
      break;
    case 3: text.insert(at, text.substr(random() % (text.size() + 1), random() % 60)); break;
    default: text.resize(at);
    }
  }
  return text;
}

/// A hall: walls in a ring about the visitor, seen from inside.
std::string ringOf(std::size_t count) {
  std::string text;
  const auto corner = [&](std::size_t i) {
    const double turn = 2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(count);
    const double away = 0.1 * static_cast<double>(count);  // so that walls are no narrower than 0.6 m
    return std::to_string(away * std::sin(turn)) + " " + std::to_string(away * std::cos(turn));
  };
  for (std::size_t i = 0; i < count; ++i)
    text += "wall w" + std::to_string(i) + "  lower-left " + corner(i) + " 0  lower-right " + corner(i + 1) +
            " 0  upper-left " + corner(i) + " 3\n";
  return text;
}

TEST(Walls, MayBeManyAndTooManyAreOneErrorAtTheFirstLineBeyond) {
  EXPECT_EQ(listing(findingsIn(ringOf(64))), "");
  EXPECT_EQ(listing(findingsIn(ringOf(WallFile::kMaxWalls))), "");
  EXPECT_EQ(listing(findingsIn(ringOf(10'000))),
            "257:1: error: a file has at most 256 walls; delete this line and those after it\n");
  std::string outputs = ringOf(3);
  for (int i = 0; i < 10'000; ++i) outputs += "output w" + std::to_string(i) + "  rotate 90\n";
  const std::string found = listing(findingsIn(outputs));
  EXPECT_EQ(found, "260:1: error: a file has at most 256 outputs; delete this line and those after it\n");
}

TEST(Walls, ThatAreMutatedNeverCrashAndWhatIsAcceptedDrawsFinitePictures) {
  const auto [count, start] = test::mutations(5000);
  std::mt19937 random(static_cast<std::uint32_t>(7 + start));
  std::vector<std::string> seeds{textOf(kShipped + "/cave4.walls"), textOf(kShipped + "/cave6.walls")};
  for (const auto& entry : fs::directory_iterator(kCorpus)) seeds.push_back(textOf(entry.path()));
  std::size_t good = 0;
  for (int i = 0; i < count; ++i) {
    // Every other one from a good file, or hardly any would get past the parser.
    const auto seed = static_cast<std::size_t>(i % 2 == 0 ? i / 2 % 2 : i) % seeds.size();
    const std::string text = mutated(seeds[seed], random);
    Diagnostics out;
    const auto walls = parseWalls(text, "t.walls", out);
    ASSERT_EQ(walls.has_value(), !out.hasErrors());
    for (const Diagnostic& d : out.all()) ASSERT_FALSE(format(d).empty());
    if (!walls) continue;
    Diagnostics lint;
    lintWalls(*walls, lint);
    if (lint.hasErrors()) continue;
    ++good;
    EXPECT_FALSE(floorPlan(*walls).empty());
    for (const WallEntry& e : walls->walls) {
      const EyeFrustum f = eyeFrustum(e.wall, kStandingEye, walls->depth);
      ASSERT_TRUE(projectionMatrix(f).allFinite()) << text;
      ASSERT_TRUE(f.X_ER.matrix().allFinite()) << text;
    }
  }
  EXPECT_GT(good, static_cast<std::size_t>(count / 100));
}

TEST(FloorPlan, ShowsTheWallsFromAbove) {
  Diagnostics out;
  const auto walls = loadWalls("cave4", kShipped, out);
  ASSERT_TRUE(walls);
  EXPECT_EQ(floorPlan(*walls, 24), R"( ###########1##########
 #                    #
 #                    #
 #                    #
 #                    #
 2      4   @         3
 #                    #
 #                    #
 #                    #
 #                    #
 #                    #
 #....................#

 |-------| 1 m   @ eye at 0 0 1.7   up the page is forward (+Y)

 1 front        3.00 x 3.00 m, faces back, middle at 0.00 1.50 1.50
 2 left         3.00 x 3.00 m, faces right, middle at -1.50 0.00 1.50
 3 right        3.00 x 3.00 m, faces left, middle at 1.50 0.00 1.50
 4 floor        3.00 x 3.00 m, faces up, middle at 0.00 0.00 0.00
)");
}

TEST(FloorPlan, TellsTheOutputsOfItsWalls) {
  Diagnostics out;
  const auto walls = parseWalls("wall one  lower-left -2 2 0.5  lower-right 1 2 0.5  upper-left -2 2 2.5\n"
                                "wall two  lower-left 1 2 0.5  lower-right 1 -1 0.5  upper-left 1 2 2.5\n"
                                "output two  monitor HDMI-1  rotate 90  flip-h\n",
                                "a.walls", out);
  ASSERT_TRUE(walls);
  const std::string plan = floorPlan(*walls);
  const std::size_t at = plan.find("   shown on"), end = plan.find('\n', at);
  ASSERT_NE(at, plan.npos) << plan;
  EXPECT_GT(at, plan.find(" 2 two")) << "beside its wall, and only there: " << plan;
  for (const char* word : {"HDMI-1", "rotate 90", "flip-h"})
    EXPECT_NE(plan.substr(at, end - at).find(word), plan.npos) << plan;
}

}  // namespace
}  // namespace stadion
