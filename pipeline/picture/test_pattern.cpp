#include "pipeline/picture/test_pattern.h"

#include "engine/display/wall_lint.h"
#include "engine/maths/angles.h"
#include "pipeline/picture/lettering.h"
#include "pipeline/picture/sketch.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

using Colour = Sketch::Colour;
constexpr Colour kGround{24, 26, 30}, kFine{70, 76, 84}, kMetre{130, 138, 148}, kBorder{255, 255, 255},
    kLeft{90, 170, 255}, kRight{255, 110, 90}, kOne{235, 235, 235}, kCube{255, 215, 60};
constexpr double kFineStep = 0.25;  ///< [m]
constexpr double kNear = 0.02;      ///< nearer parts are not drawn [m]

void drawGrid(Sketch& sketch, const WallBasis& wall) {
  const double perMetreX = sketch.width() / wall.width, perMetreY = sketch.height() / wall.height;
  for (const bool metre : {false, true}) {
    const double step = metre ? 1 : kFineStep;
    const Colour& colour = metre ? kMetre : kFine;
    const int thick = metre ? 3 : 1;
    for (double x = step; x < wall.width; x += step)
      sketch.line({x * perMetreX, 0}, {x * perMetreX, sketch.height()}, colour, thick);
    for (double y = step; y < wall.height; y += step)
      sketch.line({0, sketch.height() - y * perMetreY}, {sketch.width(), sketch.height() - y * perMetreY},
                  colour, thick);
  }
}

/// Draws a circle that is round on the wall, for any shape of pixels.
void drawCircle(Sketch& sketch, const WallBasis& wall) {
  constexpr int kParts = 180;
  const double radius = 0.45 * std::min(wall.width, wall.height);
  const auto at = [&](int i) {
    const double angle = 2 * kPi * i / kParts;
    return Vec2(sketch.width() * (0.5 + radius * std::cos(angle) / wall.width),
                sketch.height() * (0.5 + radius * std::sin(angle) / wall.height));
  };
  for (int i = 0; i < kParts; ++i) sketch.line(at(i), at(i + 1), kMetre, 1);
}

/// Returns the cube's lowest corner. The cube is in the middle of the room, so low that its edges appear on
/// floor and walls.
Vec3 cubeCorner(const WallFile& walls) {
  Aabb room;
  room.include(Vec3::Zero());
  for (const WallEntry& e : walls.walls)
    for (const Vec3& p : {e.wall.lowerLeft, e.wall.lowerRight, e.wall.upperLeft, e.wall.upperRight()})
      room.include(p);
  return {room.centre().x() - 0.5, room.centre().y() - 0.5, 0.5};
}

/// Draws an edge as the eye sees it on the wall.
void drawEdge(Sketch& sketch, const EyeFrustum& frustum, Vec3 a, Vec3 b) {
  a = frustum.X_ER * a;
  b = frustum.X_ER * b;
  if (a.z() > b.z()) std::swap(a, b);  // a is farther away
  if (a.z() > -kNear) return;
  if (b.z() > -kNear) b = a + (b - a) * ((-kNear - a.z()) / (b.z() - a.z()));
  const Mat4 projection = projectionMatrix(frustum);
  const auto onPicture = [&](const Vec3& p) {
    const Vec4 clip = projection * Vec4(p.x(), p.y(), p.z(), 1);
    return Vec2(0.5 * sketch.width() * (1 + clip.x() / clip.w()),
                0.5 * sketch.height() * (1 - clip.y() / clip.w()));
  };
  sketch.line(onPicture(a), onPicture(b), kCube, 2);
}

void drawCube(Sketch& sketch, const WallFile& walls, const Wall& wall, std::optional<Eye> eye) {
  const Pose X_RH{kStandingEye, Quat::Identity()};
  const Vec3 from = eyePosition(X_RH, eye.value_or(Eye::Left), eye ? walls.eyeSeparation : 0);
  const EyeFrustum frustum = eyeFrustum(wall, from, walls.depth);
  const Vec3 corner = cubeCorner(walls);
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      if (i >> axis & 1) continue;
      const Vec3 a = corner + Vec3(i & 1, i >> 1 & 1, i >> 2 & 1);
      drawEdge(sketch, frustum, a, a + Vec3::Unit(axis));
    }
}

void centred(Picture& picture, double y, const std::string& text, const Colour& colour, std::uint32_t scale) {
  const double width = static_cast<double>(text.size()) * kLetterWidth * scale;
  const double x = std::max(2.0, 0.5 * (picture.width - width));
  letter(picture, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(std::max(2.0, y)), text, colour,
         scale);
}

}  // namespace

Picture testPattern(const WallFile& walls, std::size_t index, std::optional<Eye> eye, std::uint32_t width,
                    std::uint32_t height) {
  const Wall& wall = walls.walls[index].wall;
  const WallBasis shape = basis(wall);
  Sketch sketch(width, height, kGround);
  drawGrid(sketch, shape);
  drawCircle(sketch, shape);
  drawCube(sketch, walls, wall, eye);
  sketch.border(kBorder);
  const Colour& ours = !eye ? kOne : *eye == Eye::Left ? kLeft : kRight;
  const std::uint32_t scale = std::max(1u, std::min(width, height) / 120);
  Picture& p = sketch.picture();
  centred(p, 0.25 * height, wall.name, ours, 2 * scale);
  if (eye) centred(p, 0.25 * height + 20.0 * scale, *eye == Eye::Left ? "L" : "R", ours, 4 * scale);
  letter(p, 4 * scale, 4 * scale, "upper left", kOne, scale);
  return sketch.take();
}

}  // namespace stadion
