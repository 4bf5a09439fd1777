/// The ladder of pictures: each rung against a picture with 64 samples a pixel.

#include "engine/core/cost_budget.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using test::difference;
using test::drawnByCpu;
using test::Picture;

constexpr std::uint32_t kRungWidth = 160, kRungHeight = 120;

/// The rich list and its reference.
class PictureLadder : public testing::Test {
protected:
  static void SetUpTestSuite() {
    meshes_ = new MeshStore;
    list_ = new DrawList(test::richList(*meshes_, double{kRungWidth} / kRungHeight));
    reference_ = new Picture(test::referencePicture(*meshes_, *list_, kRungWidth, kRungHeight));
  }
  static void TearDownTestSuite() { delete reference_, delete list_, delete meshes_; }

  /// Mean difference from the reference [of 255].
  static double errorOf(const PictureRung& rung) {
    return difference(drawnByCpu(*meshes_, *list_, kRungWidth, kRungHeight, rung), *reference_).mean;
  }

  static MeshStore* meshes_;
  static DrawList* list_;
  static Picture* reference_;
};
MeshStore* PictureLadder::meshes_ = nullptr;
DrawList* PictureLadder::list_ = nullptr;
Picture* PictureLadder::reference_ = nullptr;

TEST_F(PictureLadder, MoreSamplesComeNearerToTheReference) {
  PictureRung rung;
  double before = 1e9;
  for (const int samples : {1, 2, 4, 8}) {
    rung.samples = samples;
    const double error = errorOf(rung);
    EXPECT_LT(error, before) << samples << " samples";
    before = error;
  }
}

TEST_F(PictureLadder, CheaperShadingCostsLittleAccuracy) {
  const double whole = errorOf({});
  PictureRung coarse, nearest, fourTaps;
  coarse.coarse = true, nearest.nearestLevel = true, fourTaps.shadowTaps = 4;
  for (const PictureRung& rung : {coarse, nearest, fourTaps}) EXPECT_LT(errorOf(rung), 2 * whole + 0.25);
}

TEST_F(PictureLadder, UnderStressHalfTheSamplesAreDrawnForEachQuarterOfAnOctave) {
  EXPECT_EQ(PictureRung{}.under(1), PictureRung{});
  EXPECT_EQ(PictureRung{.samples = 8}.under(stressOf(1)).samples, 4);
  EXPECT_EQ(PictureRung{.samples = 8}.under(stressOf(kMostStress)).samples, 1);
  EXPECT_TRUE(PictureRung{}.under(stressOf(1)).reflections);
  EXPECT_FALSE(PictureRung{.samples = 1}.under(stressOf(kMostStress)).reflections) << "harmonics are cheaper";
  for (const auto& [level, samples] : {std::pair{0U, 4}, {1U, 2}, {2U, 1}, {3U, 1}}) {
    DrawList list = *list_;
    list.viewer.stress = stressOf(level);
    PictureRung rung;
    rung.samples = samples;
    EXPECT_EQ(drawnByCpu(*meshes_, list, kRungWidth, kRungHeight),
              drawnByCpu(*meshes_, *list_, kRungWidth, kRungHeight, rung))
        << "level " << level;
  }
}

TEST_F(PictureLadder, EachRungDrawsAnotherPicture) {
  PictureRung coarse, nearest;
  coarse.coarse = true, nearest.nearestLevel = true;
  const Picture whole = drawnByCpu(*meshes_, *list_, kRungWidth, kRungHeight);
  for (const PictureRung& rung : {coarse, nearest})
    EXPECT_NE(drawnByCpu(*meshes_, *list_, kRungWidth, kRungHeight, rung), whole);
}

}  // namespace
}  // namespace stadion
