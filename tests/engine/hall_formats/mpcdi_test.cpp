/// MPCDI files: what a round trip keeps, what each profile means, and what is refused or named.

#include "engine/display/screen_surface.h"
#include "engine/hall_formats/hall_text.h"
#include "engine/hall_formats/light_map_file.h"
#include "engine/hall_formats/mpcdi_reader.h"
#include "engine/hall_formats/mpcdi_writer.h"
#include "engine/hall_formats/zip_archive.h"
#include "tests/engine/hall_formats/hall_samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace stadion {
namespace {

using hall_samples::FakeFiles;
using hall_samples::fullHall;
using hall_samples::mpcdiXml;

std::optional<WallFile> mpcdiOf(const std::string& xml, const FakeFiles& files, std::string* all = nullptr) {
  Diagnostics out;
  auto hall = readMpcdiXml(xml, "t.mpcdi", files.reader(), out);
  if (all) *all = hall_samples::said(out);
  EXPECT_TRUE(hall || out.hasErrors());
  return hall;
}

std::string packed(const WallFile& hall, MpcdiVersion version = MpcdiVersion::One) {
  const auto bytes = formatMpcdi(hall, FakeFiles().reader(), {version, "2020-01-01 00:00:00"});
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes.value();
}

void expectSamePoints(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-6);
}

void expectSameScreens(const WallFile& a, const WallFile& b) {
  ASSERT_EQ(a.screens.size(), b.screens.size());
  EXPECT_EQ(std::get<Wall>(a.screens[0].surface).upperLeft, std::get<Wall>(b.screens[0].surface).upperLeft);
  const auto &c = std::get<CylinderScreen>(a.screens[1].surface),
             &d = std::get<CylinderScreen>(b.screens[1].surface);
  EXPECT_EQ(c.radius, d.radius);
  EXPECT_NEAR(c.left, d.left, 1e-12);
  const auto &e = std::get<SphereScreen>(a.screens[2].surface),
             &f = std::get<SphereScreen>(b.screens[2].surface);
  EXPECT_EQ(e.centre, f.centre);
  EXPECT_NEAR(e.tilt, f.tilt, 1e-12);
  const auto &m = std::get<MeshScreen>(a.screens[3].surface), &n = std::get<MeshScreen>(b.screens[3].surface);
  EXPECT_EQ(m.points, n.points);
  EXPECT_EQ(m.triangles, n.triangles);
}

void expectSameImage(const Projector& a, const Projector& b) {
  ASSERT_EQ(a.image.index(), b.image.index());
  if (const auto* lens = std::get_if<LensImage>(&a.image)) {
    const auto& other = std::get<LensImage>(b.image);
    EXPECT_LT((lens->X_RP.p - other.X_RP.p).norm(), 1e-12);
    EXPECT_LT(lens->X_RP.q.coeffs().cwiseAbs().maxCoeff() - other.X_RP.q.coeffs().cwiseAbs().maxCoeff(),
              1e-9);
    EXPECT_EQ(lens->throwRatio, other.throwRatio);
    EXPECT_EQ(lens->pixelAspect, other.pixelAspect);
    EXPECT_EQ(lens->shift, other.shift);
  }
  if (const auto* fisheye = std::get_if<FisheyeImage>(&a.image)) {
    EXPECT_NEAR(fisheye->angle, std::get<FisheyeImage>(b.image).angle, 1e-12);
  }
  if (const auto* pins = std::get_if<PinnedImage>(&a.image)) {
    EXPECT_EQ(pins->pins, std::get<PinnedImage>(b.image).pins);
  }
  if (const auto* measured = std::get_if<MeasuredImage>(&a.image))
    expectSamePoints(measured->points, std::get<MeasuredImage>(b.image).points);
}

TEST(Mpcdi, RoundTripLosesNothing) {
  for (const MpcdiVersion version : {MpcdiVersion::One, MpcdiVersion::Two}) {
    const WallFile hall = fullHall();
    Diagnostics out;
    const auto back = readMpcdi(packed(hall, version), "t.mpcdi", out);
    ASSERT_TRUE(back) << hall_samples::said(out);
    EXPECT_TRUE(out.all().empty()) << hall_samples::said(out);
    expectSameScreens(hall, *back);
    ASSERT_EQ(back->names(), hall.names());
    for (std::size_t i = 0; i < hall.walls.size(); ++i) {
      const WallEntry &a = hall.walls[i], &b = back->walls[i];
      ASSERT_EQ(a.projector.has_value(), b.projector.has_value());
      if (!a.projector) {
        EXPECT_EQ(a.wall.upperLeft, b.wall.upperLeft);
        continue;
      }
      expectSameImage(*a.projector, *b.projector);
      EXPECT_EQ(a.projector->eye, b.projector->eye);
      EXPECT_EQ(a.projector->light.gamma, b.projector->light.gamma);
      EXPECT_EQ(a.projector->light.white, b.projector->light.white);
      EXPECT_EQ(a.projector->light.black, b.projector->light.black);
      EXPECT_EQ(a.projector->blend.computed, b.projector->blend.computed);
      EXPECT_EQ(a.projector->blend.alpha, b.projector->blend.alpha);
      EXPECT_EQ(a.projector->blend.beta, b.projector->blend.beta);
    }
    EXPECT_EQ(back->visitor.eye, hall.visitor.eye);
    EXPECT_EQ(back->visitor.reach, hall.visitor.reach);
    EXPECT_EQ(back->eyeSeparation, hall.eyeSeparation);
    EXPECT_EQ(back->depth.near, hall.depth.near);
  }
}

TEST(Mpcdi, StandardsPartAloneGivesTheSamePixels) {
  WallFile hall = fullHall();
  std::map<std::string, std::string> files;
  const std::string bytes = packed(hall);
  auto archive = ZipArchive::open(bytes);
  ASSERT_TRUE(archive);
  for (const std::string& name : archive.value().names())
    files[name] = archive.value().file(name, 1 << 24).value();
  std::string& xml = files["mpcdi.xml"];
  xml.erase(xml.find("<extensionSet>"), xml.find("</extensionSet>") + 15 - xml.find("<extensionSet>"));
  std::string all;
  const auto back = mpcdiOf(xml, {files}, &all);
  ASSERT_TRUE(back) << all;
  EXPECT_EQ(back->walls.size(), hall.walls.size());
  for (const WallEntry& entry : back->walls) {
    const auto original = std::ranges::find_if(
        hall.walls, [&entry](const WallEntry& e) { return e.wall.name == entry.wall.name; });
    ASSERT_NE(original, hall.walls.end());
    ASSERT_TRUE(std::holds_alternative<MeasuredImage>(entry.projector->image));
    if (!original->projector) continue;
    const ScreenSurface before(hall.screens[original->projector->screen]);
    const PixelRays rays(*original->projector, before);
    const auto& image = std::get<MeasuredImage>(entry.projector->image);
    for (std::size_t i = 0; i < image.points.size(); ++i) {
      const Vec2 share((i % image.columns + 0.5) / image.columns, (i / image.columns + 0.5) / image.rows);
      const auto p = rays.pointLit(share);
      ASSERT_EQ(p.has_value(), image.points[i].allFinite()) << entry.wall.name;
      if (p) {
        EXPECT_LT((*p - image.points[i]).norm(), 2e-6) << entry.wall.name;
      }
    }
  }
}

TEST(Mpcdi, AChangedWarpCountsMoreThanTheExtension) {
  const std::string bytes = packed(fullHall());
  auto archive = ZipArchive::open(bytes);
  std::map<std::string, std::string> files;
  for (const std::string& name : archive.value().names())
    files[name] = archive.value().file(name, 1 << 24).value();
  files["measured.pfm"] = pointsAsPfm({{0, 1, 3}, {-1, 1, 3}, {0, 0, 3}, {-1, 0, 3}}, 2, 2);
  std::string all;
  const auto back = mpcdiOf(files["mpcdi.xml"], {files}, &all);
  ASSERT_TRUE(back) << all;
  EXPECT_NE(all.find("region \"measured\" was changed"), std::string::npos) << all;
  const auto& image = std::get<MeasuredImage>(back->walls.back().projector->image);
  EXPECT_EQ(image.columns, 2u);
}

TEST(Mpcdi, LensesAreWrittenAsShaderLampsAndReadByTheStandardAlone) {
  WallFile hall = fullHall();
  hall.walls.resize(1);
  hall.walls[0].projector->eye.reset();
  const std::string bytes = packed(hall, MpcdiVersion::Two);
  auto archive = ZipArchive::open(bytes);
  std::string xml = archive.value().file("mpcdi.xml", 1 << 20).value();
  EXPECT_NE(xml.find("profile=\"sl\""), std::string::npos);
  xml.erase(xml.find("<extensionSet>"), xml.find("</extensionSet>") + 15 - xml.find("<extensionSet>"));
  const std::size_t files = xml.find("<files>");
  xml.erase(files, xml.find("</files>") + 8 - files);
  std::string all;
  const auto back = mpcdiOf(xml, {}, &all);
  ASSERT_TRUE(back) << all;
  const auto& a = std::get<LensImage>(hall.walls[0].projector->image);
  const auto& b = std::get<LensImage>(back->walls[0].projector->image);
  EXPECT_LT((a.X_RP.p - b.X_RP.p).norm(), 1e-12);
  EXPECT_LT((a.X_RP.q.toRotationMatrix() - b.X_RP.q.toRotationMatrix()).norm(), 1e-9);
  EXPECT_NEAR(a.throwRatio, b.throwRatio, 1e-9);
  EXPECT_NEAR(a.pixelAspect, b.pixelAspect, 1e-9);
  EXPECT_LT((a.shift - b.shift).norm(), 1e-9);
  EXPECT_EQ(back->walls[0].projector->light.gamma[1], 2.2);
}

TEST(Mpcdi, MediaLieOnTheRegionsPartOfACanvas) {
  FakeFiles files;
  files.files["warp.pfm"] = pointsAsPfm({{0, 1, 0}, {1, 1, 0}, {0, 0, 0}, {1, 0, 0}}, 2, 2);
  files.files["alpha.png"] = lightMapAsPng({2, 2, 1, {0, 65535, 65535, 32896}, 1}).value();
  std::string all;
  const auto hall = mpcdiOf(mpcdiXml("2d", "", true), files, &all);
  ASSERT_TRUE(hall) << all;
  const Wall& canvas = std::get<Wall>(hall->screens[0].surface);
  EXPECT_NEAR((canvas.lowerRight - canvas.lowerLeft).norm() / (canvas.upperLeft - canvas.lowerLeft).norm(),
              80.0 / 30, 1e-12);
  const Projector& projector = *hall->walls[0].projector;
  const auto& image = std::get<MeasuredImage>(projector.image);
  EXPECT_LT((image.points[0] - 0.5 * (canvas.upperLeft + canvas.upperRight())).norm(), 1e-9);
  EXPECT_LT((image.points[3] - canvas.lowerRight).norm(), 1e-9);
  EXPECT_FALSE(projector.blend.computed);
  EXPECT_EQ(projector.blend.alpha->gamma, 2.2);
  EXPECT_EQ(projector.blend.alpha->values[3], 32896);
}

TEST(Mpcdi, SharesNeedNoErrorEstimate) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  FakeFiles files;
  files.files["warp.pfm"] = pointsAsPfm({{0, 1, none}, {1, 1, none}, {0, 0, none}, {none, none, 1}}, 2, 2);
  const auto hall = mpcdiOf(mpcdiXml("2d", ""), files);
  ASSERT_TRUE(hall);
  const auto& image = std::get<MeasuredImage>(hall->walls[0].projector->image);
  EXPECT_TRUE(image.points[0].allFinite());
  EXPECT_FALSE(image.points[3].allFinite());
}

TEST(Mpcdi, RowsFromTheTopAreSeenByTheMirroredPicture) {
  FakeFiles files;
  files.files["warp.pfm"] = pointsAsPfm({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 2, 2);
  std::string all;
  const auto hall = mpcdiOf(mpcdiXml("2d", ""), files, &all);
  ASSERT_TRUE(hall);
  EXPECT_NE(all.find("are read from the top"), std::string::npos) << all;
  const auto& image = std::get<MeasuredImage>(hall->walls[0].projector->image);
  EXPECT_GT(image.points[0].z(), image.points[2].z());
}

TEST(Mpcdi, PointsOfARoomAreInItsUnitAndAxes) {
  FakeFiles files;  // X left, Y up, Z forward: a wall 3 m before the middle of the floor
  files.files["warp.pfm"] =
      pointsAsPfm({{100, 200, 300}, {-100, 200, 300}, {100, 0, 300}, {-100, 0, 300}}, 2, 2);
  std::string all;
  const auto hall = mpcdiOf(mpcdiXml("a3", ""), files, &all);
  ASSERT_TRUE(hall) << all;
  EXPECT_EQ(all, "");
  const auto& image = std::get<MeasuredImage>(hall->walls[0].projector->image);
  EXPECT_LT((image.points[0] - Vec3(-1, 3, 2)).norm(), 1e-6);
  EXPECT_LT((image.points[3] - Vec3(1, 3, 0)).norm(), 1e-6);
  EXPECT_EQ(std::get<MeshScreen>(hall->screens[0].surface).triangles.size(), 2u);
}

TEST(Mpcdi, AFixedViewStandsSquareBeforeTheEye) {
  FakeFiles files;
  files.files["warp.pfm"] = pointsAsPfm({{0, 1, 0}, {1, 1, 0}, {0, 0, 0}, {1, 0, 0}}, 2, 2);
  const std::string frustum = "<frustum><yaw>90</yaw><pitch>0</pitch><roll>0</roll><rightAngle>45</"
                              "rightAngle><leftAngle>-45</leftAngle>"
                              "<upAngle>20</upAngle><downAngle>-10</downAngle></frustum>";
  const auto hall = mpcdiOf(mpcdiXml("3d", frustum), files);
  ASSERT_TRUE(hall);
  const auto& image = std::get<MeasuredImage>(hall->walls[0].projector->image);
  EXPECT_LT((image.points[0] - Vec3(2.5, 2.5, 1.7 + 2.5 * 0.36397023426620234)).norm(), 1e-6);
  EXPECT_LT((image.points[3] - Vec3(2.5, -2.5, 1.7 - 2.5 * 0.17632698070846498)).norm(), 1e-6);
}

TEST(Mpcdi, WhatIsNotUnderstoodIsNamedWithItsLine) {
  FakeFiles files;
  files.files["warp.pfm"] = pointsAsPfm({{0, 1, 0}, {1, 1, 0}, {0, 0, 0}, {1, 0, 0}}, 2, 2);
  std::string all;
  ASSERT_TRUE(mpcdiOf(mpcdiXml("2d", "<colour bright=\"1\"/>"), files, &all));
  EXPECT_NE(all.find("5: warning: /MPCDI/display/buffer/region/colour is not understood; it has no effect"),
            std::string::npos)
      << all;
}

TEST(Mpcdi, WrongFilesAreRefusedWithTheReason) {
  const FakeFiles none;
  const std::pair<std::string, const char*> kWrong[] = {
      {"<MPCDI", "this is not sound XML"},
      {"<x/>", "the element MPCDI is missing"},
      {"<MPCDI profile=\"4d\" version=\"1.0\"/>", "the profile \"4d\" is not known"},
      {mpcdiXml("2d", ""), "there is no file warp.pfm"},
      {mpcdiXml("3d", "<frustum><yaw>x</yaw></frustum>"), "yaw must be a number"}};
  for (const auto& [xml, why] : kWrong) {
    std::string all;
    EXPECT_FALSE(mpcdiOf(xml, none, &all));
    EXPECT_NE(all.find(why), std::string::npos) << all;
  }
  Diagnostics out;
  EXPECT_FALSE(readMpcdi("PK but no archive", "t.mpcdi", out));
  EXPECT_FALSE(readMpcdi(packArchive({{"other.xml", "<x/>"}}).value(), "t.mpcdi", out));
  EXPECT_EQ(out.errorCount(), 2u);
}

TEST(ZipArchive, RefusesWhatUnpacksToTooMuch) {
  const std::string bytes = packArchive({{"zeros", std::string(1 << 20, '\0')}}).value();
  EXPECT_LT(bytes.size(), 5000u);
  auto archive = ZipArchive::open(bytes);
  ASSERT_TRUE(archive);
  EXPECT_FALSE(archive.value().file("zeros", 1 << 19));
  const auto whole = archive.value().file("zeros", 1 << 20);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole.value().size(), std::size_t{1} << 20);
}

TEST(LightMapFile, KeepsAllBitsOfEightAndSixteen) {
  const LightMap fine{3, 2, 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 65535}, 1};
  const LightMap coarse{2, 2, 1, {0, 257, 514, 65535}, 1};
  for (const LightMap& map : {fine, coarse}) {
    const auto back = readLightMap(lightMapAsPng(map).value());
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back.value().map, map);
  }
  EXPECT_FALSE(readLightMap("no picture"));
  const std::string whole = lightMapAsPng(fine).value();
  EXPECT_FALSE(readLightMap(whole.substr(0, whole.size() / 2)));
}

}  // namespace
}  // namespace stadion
