#include "pipeline/picture/contact_sheet.h"
#include "pipeline/picture/lettering.h"
#include "pipeline/picture/linear_light.h"
#include "pipeline/picture/picture.h"
#include "pipeline/picture/stereo.h"
#include "tests/fresh_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own.
struct Scratch {
  fs::path folder = makeFreshFolder();
  ~Scratch() { fs::remove_all(folder); }
  std::string file(const char* name) const { return (folder / name).string(); }
  std::size_t count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
};

std::string bytesOf(const std::string& path) {
  std::ostringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  return all.str();
}

Picture noise(std::uint32_t w, std::uint32_t h, unsigned seed, bool opaque = true) {
  Picture p(w, h);
  std::mt19937 random(seed);
  for (std::uint8_t& b : p.rgba) b = static_cast<std::uint8_t>(random());
  for (std::size_t i = 3; opaque && i < p.rgba.size(); i += 4) p.rgba[i] = 255;
  return p;
}

TEST(Png, ComesBackToThePixelWithAndWithoutAlpha) {
  const Scratch scratch;
  for (const bool opaque : {true, false}) {
    const Picture p = noise(37, 21, 1, opaque);
    ASSERT_FALSE(writePng(scratch.file("a.png"), p));
    const auto back = readPng(scratch.file("a.png"));
    ASSERT_TRUE(back);
    EXPECT_EQ(back.value().width, 37u);
    EXPECT_EQ(back.value().height, 21u);
    EXPECT_EQ(back.value().rgba, p.rgba);
  }
  EXPECT_EQ(scratch.count(), 1u);  // no temporary file is left
}

TEST(Png, OfEqualPicturesHasEqualBytes) {
  const Scratch scratch;
  ASSERT_FALSE(writePng(scratch.file("a.png"), noise(64, 48, 2)));
  ASSERT_FALSE(writePng(scratch.file("b.png"), noise(64, 48, 2)));
  EXPECT_EQ(bytesOf(scratch.file("a.png")), bytesOf(scratch.file("b.png")));
}

TEST(Png, OnAFullDiskIsAnErrorAndLeavesTheDeviceAlone) {
  const auto problem = writePng("/dev/full", noise(300, 300, 3));
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->where.file, "/dev/full");
  EXPECT_NE(problem->message.find("No space left"), std::string::npos) << problem->message;
  struct stat status {};
  ASSERT_EQ(stat("/dev/full", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(Png, ThatCannotBeWrittenLeavesTheOldFile) {
  const Scratch scratch;
  ASSERT_FALSE(writePng(scratch.file("a.png"), noise(8, 8, 4)));
  const std::string before = bytesOf(scratch.file("a.png"));
  EXPECT_TRUE(writePng(scratch.file("a.png"), Picture()));
  EXPECT_EQ(bytesOf(scratch.file("a.png")), before);
  EXPECT_EQ(scratch.count(), 1u);
}

TEST(Png, IntoAMissingFolderOrOntoAFolderIsAnErrorThatNamesIt) {
  const Scratch scratch;
  const auto missing = writePng(scratch.file("none/a.png"), noise(8, 8, 5));
  ASSERT_TRUE(missing);
  EXPECT_NE(missing->message.find("No such file"), std::string::npos);
  const auto onFolder = writePng(scratch.folder.string(), noise(8, 8, 5));
  ASSERT_TRUE(onFolder);
  EXPECT_EQ(onFolder->message, "cannot be written: it is a folder");
}

TEST(Png, ThatIsNoneIsRefused) {
  const Scratch scratch;
  std::ofstream(scratch.file("a.png")) << "not a picture";
  EXPECT_FALSE(readPng(scratch.file("a.png")));
  EXPECT_FALSE(readPng(scratch.file("missing.png")));
  EXPECT_FALSE(readPng(scratch.folder.string()));
}

TEST(ImageHash, IsThePinnedXxh64OfThePixelsAndSeesOneBit) {
  Picture p(2, 1, 0);
  EXPECT_EQ(imageHash(p), 0x34c96acdcadb1bbbull);  // XXH64 of eight zero bytes, seed 0
  const std::uint64_t before = imageHash(p);
  p.rgba[7] ^= 1;
  EXPECT_NE(imageHash(p), before);
}

TEST(LinearLight, ComesBackToTheByteAndGrows) {
  for (int i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    EXPECT_EQ(srgbFromLinear(linearFromSrgb(byte)), byte);
    if (i > 0) {
      EXPECT_GT(linearFromSrgb(byte), linearFromSrgb(static_cast<std::uint8_t>(i - 1)));
    }
  }
  EXPECT_EQ(linearFromSrgb(255), kFullLight);
  EXPECT_EQ(srgbFromLinear(kFullLight + 5), 255);
  EXPECT_EQ(srgbFromLinear(kFullLight / 2), 188);  // half the light
}

TEST(Stereo, LaysTheEyesOutAsItsNameSays) {
  const Picture l = noise(6, 4, 6), r = noise(6, 4, 7);
  const Picture side = compose(StereoLayout::SideBySide, l, r);
  ASSERT_EQ(side.width, 12u);
  ASSERT_EQ(side.height, 4u);
  EXPECT_TRUE(std::equal(l.at(2, 3), l.at(2, 3) + 4, side.at(2, 3)));
  EXPECT_TRUE(std::equal(r.at(2, 3), r.at(2, 3) + 4, side.at(8, 3)));
  const Picture top = compose(StereoLayout::TopBottom, l, r);
  ASSERT_EQ(top.height, 8u);
  EXPECT_TRUE(std::equal(l.at(5, 0), l.at(5, 0) + 4, top.at(5, 0)));
  EXPECT_TRUE(std::equal(r.at(5, 0), r.at(5, 0) + 4, top.at(5, 4)));
  const Picture rows = compose(StereoLayout::Interlaced, l, r);
  EXPECT_TRUE(std::equal(l.at(0, 2), l.at(0, 2) + 24, rows.at(0, 2)));
  EXPECT_TRUE(std::equal(r.at(0, 3), r.at(0, 3) + 24, rows.at(0, 3)));
  EXPECT_EQ(compose(StereoLayout::Pair, l, r).rgba, l.rgba);
  EXPECT_EQ(compose(StereoLayout::Off, l, r).rgba, l.rgba);
}

TEST(Stereo, GivesTheAnaglyphsRedToTheLeftEyeAndTheRestToTheRight) {
  Picture l(2, 1, 0), r(2, 1, 0);
  l.rgba = {255, 255, 255, 255, 0, 255, 0, 255};
  r.rgba = {10, 20, 30, 255, 40, 50, 60, 255};
  const Picture a = compose(StereoLayout::Anaglyph, l, r);
  EXPECT_EQ(a.rgba, (std::vector<std::uint8_t>{255, 20, 30, 255, 220, 50, 60, 255}));
}

TEST(Stereo, RefusesEyesOfDifferentSize) {
  EXPECT_TRUE(compose(StereoLayout::SideBySide, Picture(2, 2), Picture(3, 2)).empty());
}

TEST(Stereo, KnowsItsNames) {
  for (const std::string& name : stereoLayoutNames()) {
    const auto layout = stereoLayout(name);
    ASSERT_TRUE(layout);
    EXPECT_EQ(stereoLayoutName(*layout), name);
  }
  EXPECT_EQ(stereoLayoutNames().size(), 6u);
  EXPECT_FALSE(stereoLayout("sidebyside"));
  EXPECT_EQ(eyeCount(StereoLayout::Off), 1u);
  EXPECT_EQ(eyeCount(StereoLayout::Anaglyph), 2u);
}

TEST(Resized, AveragesLightNotBytes) {
  Picture p(2, 2, 0);
  for (const auto& [x, y] : {std::pair(0u, 0u), std::pair(1u, 1u)})
    std::fill_n(p.at(x, y), 3, std::uint8_t(255));
  for (std::size_t i = 3; i < p.rgba.size(); i += 4) p.rgba[i] = 255;
  EXPECT_EQ(resized(p, 1, 1).rgba, (std::vector<std::uint8_t>{188, 188, 188, 255}));  // bytes would give 128
}

TEST(Resized, WeighsPixelsByTheAreaThatIsCovered) {
  // Three pixels become two: each takes one whole and half of the middle one.
  Picture p(3, 1);
  p.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255};
  const Picture q = resized(p, 2, 1);
  EXPECT_EQ(q.rgba[0], srgbFromLinear(2 * kFullLight / 3));
  EXPECT_EQ(q.rgba[1], srgbFromLinear(kFullLight / 3));
  EXPECT_EQ(q.rgba[2], 0);
  EXPECT_EQ(q.rgba[6], srgbFromLinear(2 * kFullLight / 3));
}

TEST(Resized, KeepsAFlatColourAtAnySize) {
  Picture p(97, 53);
  for (std::size_t i = 0; i < p.rgba.size(); i += 4) p.rgba[i] = 17, p.rgba[i + 1] = 130, p.rgba[i + 2] = 251;
  const Picture q = resized(p, 41, 29);
  for (std::size_t i = 0; i < q.rgba.size(); i += 4) {
    ASSERT_EQ(q.rgba[i], 17);
    ASSERT_EQ(q.rgba[i + 1], 130);
    ASSERT_EQ(q.rgba[i + 2], 251);
  }
}

TEST(Lettering, DrawsALetterAndStopsAtTheEdge) {
  Picture p(8, 8, 0);
  letter(p, 0, 0, "I", {255, 255, 255});
  EXPECT_EQ(p.at(1, 0)[0], 255);
  EXPECT_EQ(p.at(2, 3)[0], 255);
  EXPECT_EQ(p.at(0, 3)[0], 0);
  letter(p, 6, 6, "WWWW", {255, 255, 255}, 3);  // mostly outside
  letter(p, 100, 100, "W", {255, 255, 255});    // wholly outside
}

// A path that is read from a picture must be the path.
TEST(Lettering, SmallLettersAreNoCapitals) {
  for (char c = 'a'; c <= 'z'; ++c) {
    Picture small(6, 8, 0), capital(6, 8, 0), unknown(6, 8, 0);
    letter(small, 0, 0, std::string(1, c), {255, 255, 255});
    letter(capital, 0, 0, std::string(1, static_cast<char>(c - 'a' + 'A')), {255, 255, 255});
    letter(unknown, 0, 0, "?", {255, 255, 255});
    EXPECT_NE(imageHash(small), imageHash(capital)) << c;
    EXPECT_NE(imageHash(small), imageHash(unknown)) << c;
  }
}

TEST(ContactSheet, ShowsAWallInItsOwnProportions) {
  const Picture picture(800, 600);
  // 800 x 600 pixels on a square wall, on one that is twice as wide as it is high, on one as its pixels say.
  const std::vector<WallPictures> walls{
      {"a", &picture, nullptr, 1}, {"b", &picture, nullptr, 2}, {"c", &picture}};
  EXPECT_EQ(contactSheet(std::span(walls).subspan(0, 1), 0, 300).height, 6u + 300 + 12 + 6);
  EXPECT_EQ(contactSheet(std::span(walls).subspan(1, 1), 0, 300).height, 6u + 150 + 12 + 6);
  EXPECT_EQ(contactSheet(std::span(walls).subspan(2, 1), 0, 300).height, 6u + 225 + 12 + 6);
  // Neither side is enlarged.
  EXPECT_EQ(contactSheet(std::span(walls).subspan(0, 1), 0, 5000).width, 6u + 600 + 6);
}

TEST(ContactSheet, HasAColumnForEachWallAndARowForEachEye) {
  const Picture a = noise(800, 600, 8), b = noise(400, 600, 9);
  const WallPictures walls[] = {{"front", &a, &a}, {"left", &b, &b}, {"gone", nullptr, nullptr}};
  const Picture sheet = contactSheet(walls, 299, 160);
  EXPECT_EQ(sheet.width, 6u + 160 + 6 + 160 + 6 + 48 + 6);
  EXPECT_EQ(sheet.height, 6u + 2 * (240 + 12 + 6));
  const Picture small = resized(a, 160, 120);
  EXPECT_TRUE(std::equal(small.at(0, 50), small.at(0, 50) + 640, sheet.at(6, 6 + 12 + 50)));
  EXPECT_EQ(contactSheet(walls, 299, 160).rgba, sheet.rgba);
  const WallPictures mono[] = {{"front", &a, nullptr}};
  EXPECT_EQ(contactSheet(mono, 1, 160).height, 6u + (120 + 12 + 6));
  EXPECT_FALSE(contactSheet({}, 0).empty());
}

}  // namespace
}  // namespace stadion
