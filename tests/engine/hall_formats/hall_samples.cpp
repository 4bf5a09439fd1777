#include "tests/engine/hall_formats/hall_samples.h"

#include "engine/display/covered_rectangle.h"
#include "engine/display/lens_turn.h"
#include "engine/hall_formats/hall_builder.h"
#include "engine/maths/angles.h"

#include <fmt/format.h>

namespace stadion::hall_samples {
namespace {

WallEntry projectorNamed(const std::string& name, std::size_t screen) {
  WallEntry entry;
  entry.wall.name = name;
  entry.pixels = {40, 30};
  entry.projector = fillingProjector(screen, entry.pixels);
  return entry;
}

MeshScreen tentedMesh() {
  MeshScreen mesh;
  mesh.file = "tent.obj";
  mesh.points = {{-1, 3, 0}, {1, 3, 0}, {0, 3.5, 2}, {-1, 3.25, 2.125}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

void addProjectors(WallFile& hall) {
  WallEntry lens = projectorNamed("lens", 1);
  lens.projector->image = LensImage{{{0.1, -0.2, 2}, rotationOf({0.1, -0.2, 0.05})}, 1.25, 1.1, {0.1, -0.4}};
  lens.projector->eye = Eye::Left;
  lens.projector->light = {{2.2, 2.25, 2.3}, {0.9, 1, 0.95}, 0.002};
  WallEntry fisheye = projectorNamed("fisheye", 2);
  fisheye.projector->image = FisheyeImage{{{0, 0, 1}, rotationOf({0, kPi / 2 - 0.1, 0})}, 3};
  WallEntry pins = projectorNamed("pins", 0);
  pins.projector->image = PinnedImage{{Vec2(0.01, 0.02), Vec2(0.98, 0), Vec2(1, 0.97), Vec2(0, 1)}};
  pins.projector->blend.computed = false;
  pins.projector->blend.alpha = LightMap{2, 3, 3, std::vector<std::uint16_t>(18, 40000), 2.2};
  pins.projector->blend.beta = LightMap{2, 2, 1, {0, 1, 65535, 300}, 2.2};
  WallEntry measured = projectorNamed("measured", 3);
  measured.projector->image = MeasuredImage{
      "old.pfm", 2, 2, {{-0.5, 3.0625, 1.5}, {0.25, 3.125, 1.25}, {-0.5, 3, 0.5}, {0.5, 3, 0.25}}};
  WallEntry wall;
  wall.wall = wallOfEdges({-2, 0, 0}, {0, 4, 0}, {0, 0, 3});
  wall.wall.name = "flat";
  wall.pixels = {64, 48};
  for (WallEntry* entry : {&lens, &fisheye, &pins, &measured, &wall}) hall.walls.push_back(*entry);
}

}  // namespace

WallFile fullHall() {
  WallFile hall;
  hall.file = "full.walls";
  Screen plane, cylinder, dome, mesh;
  plane.name = "plane";
  Wall rectangle = wallOfEdges({-1, 2, 0.5}, {2, 0, 0}, {0, 0, 1.5});
  rectangle.name = plane.name;
  plane.surface = rectangle;
  cylinder.name = "cylinder";
  cylinder.surface = CylinderScreen{{0, 0, 0}, 3, -1.5, 1.5, 0, 4};
  dome.name = "dome";
  dome.surface = SphereScreen{{0, 0, 1}, 5, -kPi, kPi, 0, kPi / 2, 0.1};
  mesh.name = "mesh";
  mesh.surface = tentedMesh();
  hall.screens = {plane, cylinder, dome, mesh};
  addProjectors(hall);
  hall.visitor = {{0.1, 0.2, 1.6}, 0.5};
  hall.eyeSeparation = 0.065;
  hall.depth.near = 0.2;
  placeRectangles(hall);
  return hall;
}

std::string said(const Diagnostics& out) {
  std::string all;
  for (const Diagnostic& d : out.all())
    all += fmt::format("{}: {}: {}\n", d.where.line,
                       d.severity == Severity::Error     ? "error"
                       : d.severity == Severity::Warning ? "warning"
                                                         : "note",
                       d.message);
  return all;
}

std::string mpcdiXml(const std::string& profile, const std::string& inRegion, bool alpha) {
  return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<MPCDI profile="{}" level="1" date="2020-01-01 00:00:00" version="1.0">
  <display>
    <buffer id="canvas" Xresolution="80" Yresolution="30">
      <region id="one" Xresolution="40" Yresolution="30" x="0.5" y="0" xsize="0.5" ysize="1">{}</region>
    </buffer>
  </display>
  <files>
    <fileset region="one">
      <geometryWarpFile><path>warp.pfm</path><geometricUnit>cm</geometricUnit>
        <originof3DData>floorCenter</originof3DData><interpolation>linear</interpolation></geometryWarpFile>
      {}
    </fileset>
  </files>
</MPCDI>
)",
                     profile, inRegion,
                     alpha ? "<alphaMap><path>alpha.png</path><componentDepth>1</componentDepth>"
                             "<bitDepth>8</bitDepth><gammaEmbedded>2.2</gammaEmbedded></alphaMap>"
                           : "");
}

}  // namespace stadion::hall_samples
