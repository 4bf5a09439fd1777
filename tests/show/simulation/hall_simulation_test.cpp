#include "show/simulation/hall_simulation.h"

#include "engine/maths/angles.h"
#include "show/simulation/simulation_report.h"
#include "show/simulation/structured_light.h"
#include "tests/show/simulation/ideal_pictures.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace stadion {
namespace {

WallFile simulatedFile(const std::string& text) {
  Diagnostics out;
  auto hall = parseWalls(text, "t.walls", out);
  EXPECT_TRUE(hall) << (out.all().empty() ? "" : out.all()[0].message);
  return hall ? std::move(*hall) : WallFile{};
}

/// A picture of 3 m by 1.5 m on a wall 3 m before the visitor, 1 cm a pixel.
const std::string kOneProjector =
    "visitor 0 0 1.5 within 0.5\n"
    "screen front plane lower-left -1.5 3 0.75  lower-right 1.5 3 0.75  upper-left -1.5 3 2.25\n"
    "projector one screen front pixels 300 150 at 0 0 1.5 look-at 0 3 1.5 throw 1 display-gamma 2.2\n";

/// Two pictures of 1.8 m by 1.5 m side by side on the same wall; 0.6 m overlap.
const std::string kTwoProjectors =
    "visitor 0 0 1.5 within 0.5\n"
    "screen front plane lower-left -1.5 3 0.75  lower-right 1.5 3 0.75  upper-left -1.5 3 2.25\n"
    "projector left  screen front pixels 180 150 at -0.6 0 1.5 turn 0 0 throw 1.666666666667\n"
    "projector right screen front pixels 180 150 at 0.6 0 1.5 turn 0 0 throw 1.666666666667\n";

SimulationResult simulated(const WallFile& hall, SimulationSettings settings = {}, bool blends = true) {
  test::IdealPictures source(hall, blends);
  settings.every = 3;
  auto result = simulateHall(hall, source, settings);
  EXPECT_TRUE(result);
  return result ? std::move(result.value()) : SimulationResult{};
}

TEST(HallSimulation, FindsNoErrorInAnIdealPicture) {
  SimulationSettings settings;
  settings.heads = 2;
  const SimulationResult r = simulated(simulatedFile(kOneProjector), settings);
  EXPECT_GT(r.projectors[0].geometry.count, 9000u);
  EXPECT_LT(r.geometryMost(), 0.1) << "what 8-bit values leave";
  EXPECT_LE(r.luminanceMost(), r.stepsMost() + 1e-4);
  EXPECT_EQ(r.uncovered, 0u);
  EXPECT_EQ(r.tooBright, 0u);
  EXPECT_EQ(r.projectors[0].lost, 0u);
  EXPECT_EQ(r.suspect, "");
  // In the middle 1 cm at 3 m is 0.19 degrees.
  EXPECT_NEAR(1 / r.projectors[0].sparseness.most, 3 * kPi / 180 / 0.01, 0.3);
}

TEST(HallSimulation, FindsHowFarAMovedProjectorShiftsItsPixels) {
  // A move of 1 cm along the wall shifts the picture by one pixel of 1 cm.
  SimulationSettings settings;
  settings.faults.push_back({"one", Vec3(0.01, 0, 0), {}});
  const SimulationResult r = simulated(simulatedFile(kOneProjector), settings);
  EXPECT_NEAR(r.projectors[0].geometry.mean(), 1, 0.03);
  EXPECT_NEAR(r.geometryMost(), 1, 0.1);
  EXPECT_EQ(r.suspect, "one");
  // A move of 3 cm towards the wall makes the picture 1 % smaller: 1.5 pixels at its left and right edge.
  settings.faults[0].moved = Vec3(0, 0.03, 0);
  const SimulationResult nearer = simulated(simulatedFile(kOneProjector), settings);
  EXPECT_NEAR(nearer.geometryMost(), std::sqrt(1.5 * 1.5 + 0.75 * 0.75), 0.1);
}

TEST(HallSimulation, FindsAShiftOfManyPixelsWithoutMistakingWaves) {
  SimulationSettings settings;
  settings.faults.push_back({"one", Vec3(0.4, 0, 0), {}});
  const SimulationResult r = simulated(simulatedFile(kOneProjector), settings);
  EXPECT_GT(r.projectors[0].lost, 0u);
  EXPECT_NEAR(r.projectors[0].geometry.mean(), 40, 2);
}

TEST(HallSimulation, FindsTheLightOfAWrongGamma) {
  SimulationSettings settings;
  settings.faults.push_back({"one", {}, 2.5});
  const SimulationResult r = simulated(simulatedFile(kOneProjector), settings);
  // Of the levels, 50 % is the worst: 0.5^(2.5 / 2.2) = 0.4549.
  EXPECT_NEAR(r.luminanceMost(), 0.0451, 0.003);
  EXPECT_LT(r.geometryMost(), 1);
  EXPECT_EQ(r.suspect, "one");
  EXPECT_EQ(r.reason, "its light does not follow the curve that the wall file states");
}

TEST(HallSimulation, MeasuresOverlapsThatAreNotBlended) {
  const WallFile hall = simulatedFile(kTwoProjectors);
  const SimulationResult blended = simulated(hall), bare = simulated(hall, {}, false);
  EXPECT_EQ(blended.uncovered, 0u);
  EXPECT_EQ(blended.tooBright, 0u);
  ASSERT_EQ(blended.seams.size(), 1u);
  EXPECT_LT(blended.luminanceMost(), 0.01);
  EXPECT_NEAR(static_cast<double>(bare.tooBright) / static_cast<double>(bare.screenPoints), 0.6 / 3, 0.01);
  EXPECT_NEAR(bare.luminanceMost(), 1, 0.01);
}

TEST(HallSimulation, NamesTheProjectorThatStandsOut) {
  SimulationSettings settings;
  settings.faults.push_back({"right", Vec3(0.01, 0, 0), {}});
  const SimulationResult r = simulated(simulatedFile(kTwoProjectors), settings);
  EXPECT_EQ(r.suspect, "right");
  EXPECT_NEAR(r.projectors[1].geometry.mean(), 1, 0.05);
  EXPECT_LT(r.projectors[0].geometry.most, 0.3);
  settings.faults[0] = {"left", {}, 2.6};
  EXPECT_EQ(simulated(simulatedFile(kTwoProjectors), settings).suspect, "left");
}

TEST(HallSimulation, MeasuresThePartOfAScreenWithoutLight) {
  const SimulationResult r = simulated(simulatedFile(
      "screen front plane lower-left -1.5 3 0.75  lower-right 4.5 3 0.75  upper-left -1.5 3 2.25\n"
      "projector one screen front pixels 300 150 at 0 0 1.5 look-at 0 3 1.5 throw 1\n"));
  EXPECT_NEAR(r.uncoveredShare(), 0.5, 0.01);
}

TEST(HallSimulation, RefusesFaultsThatTheHallCannotHave) {
  const WallFile hall = simulatedFile(kOneProjector);
  test::IdealPictures source(hall);
  SimulationSettings settings;
  settings.faults.push_back({"two", Vec3(0, 0, 0), {}});
  const auto result = simulateHall(hall, source, settings);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "there is no projector \"two\" in the hall");
}

TEST(HallSimulation, ReportsItsFiguresAsTextAndJson) {
  const SimulationResult r = simulated(simulatedFile(kTwoProjectors));
  const nlohmann::ordered_json json = jsonOf(r);
  EXPECT_EQ(json["geometry_error_px_max"], r.geometryMost());
  EXPECT_EQ(json["luminance_error_max"], r.luminanceMost());
  EXPECT_EQ(json["uncovered_fraction"], 0);
  EXPECT_EQ(json["seams"][0]["projectors"][1], "right");
  EXPECT_NE(textOf(r).find("left + right"), std::string::npos) << textOf(r);
}

TEST(SimulatedProjector, OnTheAxisOfACylinderLightsTheAngleOfItsPixel) {
  const WallFile hall =
      simulatedFile("screen s cylinder centre 0.1 0.2 0  radius 3  azimuth -180 180  height 0 4\n"
                    "projector p screen s pixels 200 100 at 0.1 0.2 2  turn 40 0  throw 0.5\n");
  const SimulatedScreen screen(hall.screens[0]);
  const SimulatedProjector p(*hall.walls[0].projector, screen);
  for (const double x : {0.5, 37.5, 100.0, 180.5})
    for (const double y : {20.5, 50.0, 70.5}) {
      const double aside = std::atan((x - 100) / 100), azimuth = 40 * kDegree + aside;
      const double z = 2 + 3 * std::cos(aside) * (50 - y) / 100;
      const Vec3 expected(0.1 + 3 * std::sin(azimuth), 0.2 + 3 * std::cos(azimuth), z);
      const auto point = p.pointAt(x, y);
      ASSERT_TRUE(point);
      EXPECT_LE((*point - expected).norm(), 1e-9);
      const auto place = p.placeOf(expected);
      ASSERT_TRUE(place);
      EXPECT_LE((*place - Vec2(x, y)).norm(), 1e-6);
    }
}

TEST(SimulatedProjector, FindsThePixelOfAPointForAllImages) {
  const std::string plane = "screen s plane lower-left -2 3 0  lower-right 2 3 0  upper-left -2 3 2\n";
  WallFile measured = simulatedFile(plane + "projector p screen s pixels 200 100 warp a.pfm\n");
  MeasuredImage& image = std::get<MeasuredImage>(measured.walls[0].projector->image);
  image.columns = 5;
  image.rows = 4;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 5; ++column)
      image.points.emplace_back(-1.5 + 0.7 * column + 0.05 * row, 3,
                                1.8 - 0.5 * row + 0.03 * column * column);
  for (const WallFile& hall :
       {simulatedFile(
            plane + "projector p screen s pixels 200 100 at 0.5 0 1 turn 5 3 roll 4 throw 1 shift 0.1 0.2\n"),
        simulatedFile(plane + "projector p screen s pixels 200 100 at 0 0 1 turn 0 0 fisheye 120\n"),
        simulatedFile(plane + "projector p screen s pixels 200 100 pins 0.1 0.1  0.9 0  1 1  0 0.8\n"),
        measured}) {
    const SimulatedScreen screen(hall.screens[0]);
    const SimulatedProjector p(*hall.walls[0].projector, screen);
    int lit = 0;
    for (const double x : {30.5, 77.5, 100.5, 130.5})
      for (const double y : {25.5, 50.5, 70.5})
        if (const auto point = p.pointAt(x, y)) {
          ++lit;
          const auto place = p.placeOf(*point);
          ASSERT_TRUE(place);
          EXPECT_LE((*place - Vec2(x, y)).norm(), 1e-3);
        }
    EXPECT_GT(lit, 1);
  }
}

TEST(SimulatedScreen, OfAMeshIsMetLikeThePlaneThatItIs) {
  const WallFile hall =
      simulatedFile("screen flat plane lower-left -2 3 0  lower-right 2 3 0  upper-left -2 3 2\n"
                    "screen mesh mesh file a.obj\n"
                    "projector p screen flat pixels 200 100 at 0.5 0 1 turn 5 3 roll 4 throw 1\n");
  Screen mesh = hall.screens[1];
  mesh.surface =
      MeshScreen{"", {Vec3(-2, 3, 0), Vec3(2, 3, 0), Vec3(2, 3, 2), Vec3(-2, 3, 2)}, {{0, 1, 2}, {0, 2, 3}}};
  const SimulatedScreen one(hall.screens[0]), two(mesh);
  const SimulatedProjector p1(*hall.walls[0].projector, one), p2(*hall.walls[0].projector, two);
  for (double x = 0.5; x < 200; x += 9)
    for (double y = 0.5; y < 100; y += 7) {
      const auto a = p1.pointAt(x, y), b = p2.pointAt(x, y);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (a) {
        EXPECT_LE((*a - *b).norm(), 1e-9);
      }
    }
}

TEST(DirectionWave, IsReadFreeOfBrightness) {
  const PhaseColours colours;
  const DirectionWave wave(colours, 0, 10);
  for (const double seen : {-0.7, 0.01, 0.33})
    for (const double gain : {0.3, 1.0}) {
      const Vec3 direction = Vec3(seen, 1, 0).normalized();
      const auto& colour = colours.of(10 * direction.x());
      Vec3 light;
      for (int c = 0; c < 3; ++c)
        light[c] = gain * linearFromSrgb(colour[static_cast<std::size_t>(c)] / 255.0);
      const auto exact = wave.read(light, direction);
      EXPECT_NEAR(exact.error, 0, 2e-4);
      EXPECT_NEAR(exact.gain, gain, 0.02);
      const Vec3 other = Vec3(seen + 0.02, 1, 0).normalized();
      EXPECT_NEAR(wave.read(light, other).error, direction.x() - other.x(), 2e-4);
    }
}

TEST(HallSimulation, PlacesHeadsWithinTheVisitorsReach) {
  const VisitorPlace visitor{Vec3(1, 2, 1.6), 0.8};
  const auto heads = headsOf(visitor, 0.064, 50);
  ASSERT_EQ(heads.size(), 50u);
  EXPECT_EQ(heads[0].p, visitor.eye);
  double farthest = 0;
  for (const Pose& head : heads)
    for (const Eye eye : kEyes)
      farthest = std::max(farthest, (eyePosition(head, eye, 0.064) - visitor.eye).norm());
  EXPECT_LE(farthest, visitor.reach);
  EXPECT_GT(farthest, 0.6 * visitor.reach);
}

TEST(HallSimulation, OfFlatWallsIsAnError) {
  const WallFile flat = simulatedFile("wall a lower-left -1 1 0 lower-right 1 1 0 upper-left -1 1 2\n");
  test::IdealPictures source(flat, true);
  EXPECT_FALSE(simulateHall(flat, source, {}));
}

}  // namespace
}  // namespace stadion
