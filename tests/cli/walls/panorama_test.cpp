/// Panoramas in a run: their pictures beside those of walls around the head, and beside those of another program.

#include "engine/maths/srgb.h"
#include "engine/panorama/panorama.h"
#include "pipeline/picture/picture.h"
#include "tests/programs/program.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <utility>

namespace stadion {
namespace {

constexpr std::uint32_t kSide = 128;  ///< of a wall [pixels]
constexpr const char* kAroundShow = "object( file=plane.3ds )\n"
                                    "object( file=football.3ds, position=\"0, 3, 1.5\", scale=6 )\n"
                                    "object( file=football.3ds, position=\"3, -1, 2\", scale=5 )\n"
                                    "object( file=football.3ds, position=\"-2, 0.5, 3.5\", scale=5 )\n"
                                    "object( file=football.3ds, position=\"0.5, -3, 0.5\", scale=4 )\n"
                                    "light( direction=\"-1, 2, -3\" )\n";

bool ffmpegIsThere() {
  return runProgram({{"sh", "-c", "command -v ffmpeg"}}).status == 0;
}

/// Six walls around the usual place of the head, in the order of a cube's sides.
std::string wallsAround() {
  std::string text;
  int number = 0;
  for (const CubeSide& side : cubeSides()) {
    const auto corner = [&](double s, double t) {
      const Vec3 p = Vec3(0, 0, 1.7) + side.normal + s * side.right + t * side.up;
      return fmt::format("{} {} {}", p.x(), p.y(), p.z());
    };
    text += fmt::format("wall w{}  lower-left {}  lower-right {}  upper-left {}  pixels {} {}\n", number++,
                        corner(-1, -1), corner(1, -1), corner(-1, 1), kSide, kSide);
  }
  return text;
}

Picture shownIn(const std::string& folder, const std::string& wall) {
  const auto picture = readPng(folder + "/" + wall + "-left-000000.png");
  EXPECT_TRUE(picture) << wall;
  return picture ? picture.value() : Picture();
}

/// The six walls as one picture of a cube.
Picture cubeOf(const std::string& folder) {
  Picture cube(3 * kSide, 2 * kSide);
  for (std::uint32_t i = 0; i < 6; ++i) {
    const Picture side = shownIn(folder, fmt::format("w{}", i));
    if (side.width != kSide) return {};
    for (std::uint32_t y = 0; y < kSide; ++y)
      std::copy_n(side.at(0, y), std::size_t{kSide} * 4, cube.at(i % 3 * kSide, i / 3 * kSide + y));
  }
  return cube;
}

/// The green value at a place of a picture, between its pixels.
double valueAt(const Picture& p, const Vec2& share) {
  const double x = std::clamp(share.x() * p.width - 0.5, 0.0, p.width - 1.001);
  const double y = std::clamp(share.y() * p.height - 0.5, 0.0, p.height - 1.001);
  const auto c = static_cast<std::uint32_t>(x), r = static_cast<std::uint32_t>(y);
  const auto light = [&](std::uint32_t i, std::uint32_t j) {
    return linearFromSrgb(p.at(c + i, r + j)[1] / 255.0);
  };
  const double s = x - c, t = y - r;
  return 255 * srgbFromLinear((1 - t) * ((1 - s) * light(0, 0) + s * light(1, 0)) +
                              t * ((1 - s) * light(0, 1) + s * light(1, 1)));
}

struct Difference {
  double mean = 0;
  std::size_t pixels = 0;
};

/// How far the panorama's pixels are from the cube's in their directions, if the panorama is shifted by some pixels.
Difference differenceFromCube(const Picture& shown, Panorama panorama, const Picture& cube, double right = 0,
                              double down = 0) {
  panorama.width = shown.width;
  panorama.height = shown.height;
  Panorama box;
  box.kind = PanoramaKind::Cube;
  Difference d;
  for (std::uint32_t y = 0; y < shown.height; ++y)
    for (std::uint32_t x = 0; x < shown.width; ++x) {
      const Vec2 place((x + right + 0.5) / shown.width, (y + down + 0.5) / shown.height);
      const auto direction = directionAt(panorama, place);
      if (!direction) continue;
      const Vec2 share = *shareOf(box, rotationOf(panorama) * *direction);
      // Between two sides of the cube no pixels are neighbours.
      const Vec2 inSide(std::fmod(3 * share.x(), 1), std::fmod(2 * share.y(), 1));
      if (inSide.minCoeff() < 1.0 / kSide || inSide.maxCoeff() > 1 - 1.0 / kSide) continue;
      d.mean += std::abs(shown.at(x, y)[1] - valueAt(cube, share));
      ++d.pixels;
    }
  d.mean /= static_cast<double>(std::max<std::size_t>(1, d.pixels));
  return d;
}

/// What remains are edges of objects, which both pictures sample in other places.
void expectInPlace(const Picture& shown, const Panorama& panorama, const Picture& cube) {
  const Difference inPlace = differenceFromCube(shown, panorama, cube);
  EXPECT_GT(inPlace.pixels, 20000u);
  EXPECT_LT(inPlace.mean, 2.5);
  for (const auto& [right, down] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
    const double shifted = differenceFromCube(shown, panorama, cube, right, down).mean;
    EXPECT_GT(shifted, 1.25 * inPlace.mean) << right << " " << down;
  }
}

TEST(ProgramPanorama, PicturesAreThoseOfWallsAroundTheHeadAndOfAnotherProgram) {
  const TestFolder folder;
  const std::string show = folder.write("around.evs", kAroundShow), out = folder.path() / "out";
  const std::string walls = folder.write(
      "around.walls", wallsAround() + fmt::format("panorama box cube  pixels {} {}\n", 3 * kSide, 2 * kSide) +
                          "panorama dome dome-master  pixels 200 200  tilt 20\n"
                          "panorama sphere equirectangular  pixels 320 160\n");
  const auto run = stadionProgram({"run", show, "--asset-root", assetFolder(), "--walls", walls, "--look",
                                   "plain", "--frames", "1", "--stereo", "off", "--out", out});
  ASSERT_EQ(run.status, 0) << run.err;
  const Picture cube = cubeOf(out), box = shownIn(out, "box");
  ASSERT_EQ(box.width, cube.width);
  std::size_t other = 0;
  for (std::size_t i = 0; i < box.rgba.size(); ++i)
    other += std::abs(int(box.rgba[i]) - int(cube.rgba[i])) > 1;
  EXPECT_LT(other, box.rgba.size() / 500) << "edges of objects are rounded in other coordinates";
  Panorama dome, sphere;
  dome.across = 3.14159265358979;
  dome.tilt = dome.across / 9;
  sphere.kind = PanoramaKind::Equirectangular;
  sphere.across = 2 * dome.across;
  sphere.upright = dome.across;
  expectInPlace(shownIn(out, "dome"), dome, cube);
  expectInPlace(shownIn(out, "sphere"), sphere, cube);

  const std::string turned = folder.path() / "turned.png";
  if (!ffmpegIsThere()) GTEST_SKIP() << "needs ffmpeg: apt-get install ffmpeg";
  ProgramRun ffmpeg;
  ffmpeg.words = {
      "ffmpeg", "-v", "error", "-i", out + "/box-left-000000.png", "-vf", "v360=c3x2:e:w=320:h=160", turned};
  const auto converted = runProgram(ffmpeg);
  ASSERT_EQ(converted.status, 0) << converted.err;
  const auto theirs = readPng(turned);
  ASSERT_TRUE(theirs);
  const Picture ours = shownIn(out, "sphere");
  ASSERT_EQ(theirs.value().rgba.size(), ours.rgba.size());
  double sum = 0;
  for (std::size_t i = 0; i < ours.rgba.size(); ++i)
    sum += std::abs(int(ours.rgba[i]) - int(theirs.value().rgba[i]));
  EXPECT_LT(sum / static_cast<double>(ours.rgba.size()), 2.5);
}

TEST(ProgramPanorama, ShipsAsWallFilesThatPlayInStereoWithAVideo) {
  const TestFolder folder;
  const std::string show = folder.write("around.evs", kAroundShow);
  for (const char* walls : {"dome-master", "equirectangular"}) {
    const std::string out = folder.path() / walls;
    EXPECT_NE(stadionProgram({"walls", walls}).out.find("pixels, from the head"), std::string::npos);
    const auto run = stadionProgram({"run", show, "--asset-root", assetFolder(), "--walls", walls, "--size",
                                     "128x128", "--look", "plain", "--frames", "2", "--video", "--out", out});
    EXPECT_EQ(run.status, 0) << run.err;
    std::set<std::string> kinds;
    for (const auto& file : std::filesystem::directory_iterator(out))
      kinds.insert(file.path().extension().string());
    EXPECT_TRUE(kinds.contains(".png")) << walls;
    EXPECT_EQ(kinds.contains(".mp4"), ffmpegIsThere()) << walls;
  }
  EXPECT_EQ(stadionProgram({"walls", "dome-master", "--write", folder.path() / "dome.mpcdi"}).status, 2);
}

}  // namespace
}  // namespace stadion
