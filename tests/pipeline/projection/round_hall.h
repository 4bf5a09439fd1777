#pragma once
/// A hall with a round screen, for tests.

#include "engine/display/wall_file.h"
#include "engine/maths/functions.h"

#include <cstdint>
#include <string>

namespace stadion::test {

/// A visitor in the middle of a cylinder, and a ring of projectors that light it from above the visitor.
inline WallFile roundHall(std::uint32_t projectors, double halfAngle, double overlap) {
  WallFile hall;
  Screen screen;
  screen.name = "round";
  screen.surface = CylinderScreen{{0, 0, 0}, 3, -halfAngle, halfAngle, 0.4, 2.4};
  hall.screens.push_back(screen);
  hall.visitor = {{0, 0, 1.5}, 0.5};
  const double each = 2 * halfAngle / projectors;
  for (std::uint32_t i = 0; i < projectors; ++i) {
    const double azimuth = -halfAngle + (i + 0.5) * each, half = 0.5 * each * (1 + overlap);
    WallEntry entry;
    entry.wall.name = "p" + std::to_string(i + 1);
    Projector p;
    p.width = 640;
    p.height = 400;
    LensImage lens;
    lens.X_RP = {{0, 0, 1.4}, det::fromEuler(0, 0, -azimuth)};
    lens.throwRatio = 1 / (2 * det::tan(half));
    p.image = lens;
    entry.projector = p;
    hall.walls.push_back(entry);
  }
  return hall;
}

}  // namespace stadion::test
