/// What studios see elsewhere: the same models with the same light and camera, drawn by three.js in Chromium.
/// three/render.mjs draws them.

#include "engine/environment/radiance_map.h"
#include "pipeline/picture/picture.h"
#include "tests/programs/program.h"
#include "tests/show/conformance/feature_models.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

// The eye is 4 m in front of the model; the wall is 1.6 m wide, 2 m from the eye.
constexpr const char* kEyeWall = R"(unit m
near 0.05
wall view  lower-left -0.8 2 0.9  lower-right 0.8 2 0.9  upper-left -0.8 2 2.5
)";
constexpr const char* kEyeScene = R"(rig( position="0, -4, -1.7" )
light( direction="-0.5, 1, -0.8", intensity=0.7, shadows=off )
sky( zenith="0.8546,0.8546,0.8546", horizon="0.8546,0.8546,0.8546", ground="0.8546,0.8546,0.8546",
     ambient="0.5,0.5,0.5" )
)";
// An intensity of 1 lights a white surface fully: three's irradiance is pi times it. sRGB 0.5 is 0.21404 in linear light.
// With this ground, light from below is as bright as from above. three.js blends in linear light in float pictures alone.
constexpr const char* kThree = " --size 128x128 --eye 0,0,4 --target 0,0,0 --fov 43.6028190 --aa 4"
                               " --background 0.8546,0.8546,0.8546 ";
constexpr const char* kThreeSun = "--sun 0.5,0.8,1,2.1991149 ";
// three.js sees the middle of a picture of surroundings at +x, which is to the right.
constexpr const char* kSurroundedScene = R"(rig( position="0, -4, -1.7" )
light( direction="0, 0, -1", initstate=off )
sky( zenith="0.8546,0.8546,0.8546", horizon="0.8546,0.8546,0.8546", ground="0.8546,0.8546,0.8546" )
environment( file=around.hdr, turn=-90, background=off )
tones( curve=clamp )
)";
/// Light from all sides that surfaces reflect as well, or for matt ones that they scatter.
constexpr const char *kMirrored = "--env 0.21404,0.21404,0.21404",
                     *kScattered = "--ambient 0.21404,0.21404,0.21404";

double linearOf(std::uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// In linear light, of 255; where the reference changes by more than a step within 3 x 3 pixels is an edge.
struct LightDifference {
  double mean = 0, worst = 0;
  std::size_t pixels = 0;  ///< that count
};

/// Linear light, RGB, rows from the top.
struct LightPicture {
  std::uint32_t width = 0, height = 0;
  std::vector<float> rgb;
  double at(std::uint32_t x, std::uint32_t y, std::size_t k) const {
    return std::min(double{rgb[(std::size_t{y} * width + x) * 3 + k]}, 1.0);
  }
};

/// A PFM: rows from the bottom, little-endian floats.
LightPicture readPfm(const std::string& path) {
  const std::string bytes = fileContent(path);
  LightPicture p;
  int used = 0;
  if (std::sscanf(bytes.c_str(), "PF %u %u -1.0%n", &p.width, &p.height, &used) != 2) return {};
  const std::size_t row = 3 * std::size_t{p.width};
  p.rgb.resize(row * p.height);
  const auto first = static_cast<std::size_t>(used) + 1;
  if (bytes.size() != first + p.rgb.size() * sizeof(float)) return {};
  for (std::size_t y = 0; y < p.height; ++y)
    std::memcpy(p.rgb.data() + row * y, bytes.data() + first + row * (p.height - 1 - y) * sizeof(float),
                row * sizeof(float));
  return p;
}

LightDifference lightDifferenceOf(const Picture& ours, const LightPicture& theirs) {
  constexpr double kEdge = 0.06;
  LightDifference d;
  double sum = 0;
  for (std::uint32_t y = 1; y + 1 < theirs.height; ++y)
    for (std::uint32_t x = 1; x + 1 < theirs.width; ++x) {
      bool edge = false;
      double error = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        double low = 1, high = 0;
        for (std::uint32_t j = y - 1; j <= y + 1; ++j)
          for (std::uint32_t i = x - 1; i <= x + 1; ++i)
            low = std::min(low, theirs.at(i, j, k)), high = std::max(high, theirs.at(i, j, k));
        edge = edge || high - low > kEdge;
        error = std::max(error, std::fabs(linearOf(ours.at(x, y)[k]) - theirs.at(x, y, k)));
      }
      if (edge) continue;
      ++d.pixels;
      sum += error;
      d.worst = std::max(d.worst, error);
    }
  d.mean = 255 * sum / static_cast<double>(std::max<std::size_t>(d.pixels, 1));
  d.worst *= 255;
  return d;
}

/// Three wide lobes of light in dim surroundings; nothing is brighter than 1.
std::array<double, 3> lobesAt(const std::array<double, 3>& d) {
  struct Lobe {
    std::array<double, 3> way, colour;
    double narrow;
  };
  static constexpr std::array kLobes{Lobe{{0.48, -0.6, 0.64}, {0.75, 0.7, 0.55}, 4},
                                     Lobe{{-0.8, 0.0, 0.6}, {0.2, 0.45, 0.7}, 3},
                                     Lobe{{0.0, 0.6, -0.8}, {0.4, 0.25, 0.1}, 2}};
  std::array<double, 3> light{0.12, 0.13, 0.15};
  for (const Lobe& lobe : kLobes) {
    const double cosine = lobe.way[0] * d[0] + lobe.way[1] * d[1] + lobe.way[2] * d[2];
    for (std::size_t c = 0; c < 3; ++c) light[c] += lobe.colour[c] * std::exp(lobe.narrow * (cosine - 1));
  }
  return light;
}

/// A Radiance picture of the lobes, pixel by pixel.
std::string surroundingsHdr() {
  constexpr std::uint32_t kRows = 256;
  std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(kRows) + " +X " +
                     std::to_string(2 * kRows) + "\n";
  for (std::uint32_t y = 0; y < kRows; ++y)
    for (std::uint32_t x = 0; x < 2 * kRows; ++x) {
      const auto light = lobesAt(equirectangularDirection((x + 0.5) / (2 * kRows), (y + 0.5) / kRows));
      int exponent = 0;
      std::frexp(std::max({light[0], light[1], light[2]}), &exponent);
      for (const double c : light)
        file += static_cast<char>(std::min(std::lround(std::ldexp(c, 8 - exponent)), 255L));
      file += static_cast<char>(exponent + 128);
    }
  return file;
}

class ProgramFullThree : public testing::Test {
protected:
  void SetUp() override {
    if (!fullRuns()) GTEST_SKIP() << "needs node, three.js and Chromium; runs with --full";
    const fs::path modules = fs::path(STADION_BINARY_DIR) / "three";
    fs::create_directories(modules);
    fs::copy(source() / "package.json", modules / "package.json", fs::copy_options::overwrite_existing);
    if (!fs::exists(modules / "node_modules/three/build/three.module.js")) {
      const ProgramResult got =
          runProgram({{"npm", "install", "--no-audit", "--no-fund", "--prefix", modules.string()}});
      ASSERT_EQ(got.status, 0) << got.out << got.err;
    }
    modules_ = (modules / "node_modules").string();
  }

  static fs::path source() { return STADION_SOURCE_DIR "/tests/show/conformance/three"; }

  /// The options of three.js for a model's light.
  using LightOptions = std::function<std::string(const test::FeatureModel&)>;

  /// Draws all models by three.js.
  void drawReference(const std::vector<test::FeatureModel>& models, const LightOptions& light) const {
    std::ofstream list(at("list.txt"));
    for (const test::FeatureModel& m : models) {
      std::ofstream(at(m.name + ".glb"), std::ios::binary) << m.model.glb();
      list << at(m.name + ".glb") << " " << at(m.name + "-three.png") << " --float " << at(m.name + ".pfm")
           << kThree << light(m);
      if (!m.clip.empty()) list << " --clip " << m.clip << " --time " << m.time;
      list << "\n";
    }
    list.close();
    ProgramRun run{{"node", (source() / "render.mjs").string(), "--batch", at("list.txt")}};
    run.environment = {"THREE_MODULES=" + modules_};
    const ProgramResult drawn = runProgram(run);
    ASSERT_EQ(drawn.status, 0) << drawn.out << drawn.err;
  }

  Picture draw(const test::FeatureModel& m, const char* scene) const {
    std::ofstream(at("eye.walls")) << kEyeWall;
    std::ofstream show(at(m.name + ".evs"));
    show << scene;
    if (m.clip.empty())
      show << "object( file=" << m.name << ".glb )\n";
    else
      show << "figure( file=" << m.name << ".glb, clip=" << m.clip << ", phase=" << m.time << " )\n";
    show.close();
    const ProgramResult r = stadionProgram({"run", at(m.name + ".evs"), "--walls", at("eye.walls"), "--size",
                                            "128x128", "--stereo", "off", "--samples", "4", "--frames", "1",
                                            "--input", "none", "--out", at(m.name)});
    EXPECT_EQ(r.status, 0) << r.err;
    const auto picture = readPng((fs::path(at(m.name)) / "view-left-000000.png").string());
    EXPECT_TRUE(picture) << m.name;
    return picture ? picture.value() : Picture();
  }

  /// Compares ours with theirs, which are drawn.
  void compareAll(const std::vector<test::FeatureModel>& models, const char* scene) const {
    std::string table;
    for (const test::FeatureModel& m : models) {
      const LightPicture theirs = readPfm(at(m.name + ".pfm"));
      const Picture ours = draw(m, scene);
      ASSERT_TRUE(theirs.width > 0 && ours.width == theirs.width && ours.height == theirs.height) << m.name;
      const LightDifference d = lightDifferenceOf(ours, theirs);
      EXPECT_GT(d.pixels, 8000U) << m.name;
      EXPECT_LT(d.mean, m.mean) << m.name;
      EXPECT_LT(d.worst, m.worst) << m.name;
      char row[120];
      std::snprintf(row, sizeof row, "%-34s mean %6.3f  worst %6.2f  pixels %zu\n", m.name.c_str(), d.mean,
                    d.worst, d.pixels);
      table += row;
    }
    std::printf("%s", table.c_str());
  }

  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }

  TestFolder folder_;
  std::string modules_;
};

/// Matt surfaces differ by at most 1 level: highlights that ours have and theirs are told not to have.
TEST_F(ProgramFullThree, DrawsEachFeatureAlike) {
  const std::vector<test::FeatureModel> models = test::featureModels();
  EXPECT_GE(models.size(), 60U);
  drawReference(models, [](const test::FeatureModel& m) {
    return kThreeSun + std::string(m.reflects ? kMirrored : kScattered);
  });
  compareAll(models, kEyeScene);
}

TEST_F(ProgramFullThree, DrawsSurroundingsAlike) {
  const std::vector<test::FeatureModel> models = test::surroundedBalls();
  EXPECT_EQ(models.size(), 12U);
  std::ofstream(at("around.hdr"), std::ios::binary) << surroundingsHdr();
  drawReference(models, [&](const test::FeatureModel&) { return "--env-map " + at("around.hdr"); });
  compareAll(models, kSurroundedScene);
}

}  // namespace
}  // namespace stadion
