#include "engine/display/wall_lint.h"

#include "engine/display/wall_facing.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kLargest = 50;            ///< width or height of a believable wall [m]
constexpr double kSmallest = 0.05;         ///< [m]
constexpr double kSquareWarning = 3.5e-4;  ///< sine of the deviation from a right angle (0.02 degrees)
constexpr double kSquareError = 8.7e-3;    ///< (0.5 degrees)
constexpr double kClosed = 1e-3;           ///< edges this near are closed [m]
constexpr double kMeant = 0.15;            ///< edges within this part of their length are meant to meet
constexpr double kRoundoff = 1e-9;         ///< [m]

/// A number as a person would write it in a wall file.
std::string length(double metres) {
  const double rounded = std::round(metres * 1e4) / 1e4;
  return fmt::format("{}", rounded == 0 ? 0.0 : rounded);
}

std::string point(const Vec3& p, double metresPerUnit) {
  return fmt::format("{} {} {}", length(p.x() / metresPerUnit), length(p.y() / metresPerUnit),
                     length(p.z() / metresPerUnit));
}

/// "4.2 mm" or "1.25 m".
std::string distance(double metres) {
  if (metres < 0.1) return fmt::format("{:.3g} mm", metres * 1e3);
  return metres < 100 ? fmt::format("{:.3g} m", metres) : fmt::format("{:.0f} m", metres);
}

class Linter {
public:
  /// `noun` is what messages call an entry.
  Linter(const WallFile& walls, const char* noun, Diagnostics& out) : walls_(walls), noun_(noun), out_(out) {}

  /// Checks each entry by itself. False after an error.
  bool rectangles() {
    bool sound = true;
    for (const WallEntry& e : walls_.walls) sound = area(e) && size(e) && square(e) && sound;
    return sound;
  }

  void room() {
    const std::vector<Facing> all = facingOf(walls_.walls, kStandingEye);
    for (std::size_t i = 0; i < all.size(); ++i) facing(walls_.walls[i], all[i]);
    for (std::size_t i = 0; i < walls_.walls.size(); ++i)
      for (std::size_t j = i + 1; j < walls_.walls.size(); ++j) pair(walls_.walls[i], walls_.walls[j]);
  }

private:
  void error(const WallEntry& e, std::string message) {
    out_.error({walls_.file, e.line, e.column}, std::move(message), e.excerpt);
  }
  void warning(const WallEntry& e, std::string message) {
    out_.warning({walls_.file, e.line, e.column}, std::move(message), e.excerpt);
  }
  std::string nameOf(const WallEntry& e) const { return fmt::format("{} \"{}\"", noun_, e.wall.name); }
  std::string inUnit(const Vec3& p) const { return point(p, walls_.metresPerUnit); }

  bool area(const WallEntry& e) {
    const Vec3 lower = e.wall.lowerRight - e.wall.lowerLeft, left = e.wall.upperLeft - e.wall.lowerLeft;
    const char* what = lower.norm() < kRoundoff  ? "lower-left and lower-right are the same point"
                       : left.norm() < kRoundoff ? "lower-left and upper-left are the same point"
                       : lower.cross(left).norm() < 1e-6 * lower.norm() * left.norm()
                           ? "its three corners lie on one line"
                           : nullptr;
    if (what) error(e, fmt::format("{} has no area: {}; measure its corners again", nameOf(e), what));
    return !what;
  }

  bool size(const WallEntry& e) {
    const WallBasis b = basis(e.wall);
    const double large = std::max(b.width, b.height), small = std::min(b.width, b.height);
    const std::string is = fmt::format("{} is {} by {}", nameOf(e), distance(b.width), distance(b.height));
    if (large > kLargest) {
      const char* unit = large > 500 ? "mm" : "cm";
      const bool stated = walls_.metresPerUnit != 1;
      error(e, fmt::format("{}; if the file is in {} put the line \"unit {}\" {}", is,
                           large > 500 ? "millimetres" : "centimetres", unit,
                           stated ? "in the place of its unit" : fmt::format("above the first {}", noun_)));
      return false;
    }
    if (small >= kSmallest) return true;
    error(e, fmt::format("{}; {}", is,
                         walls_.metresPerUnit < 1 ? "if the file is in metres put \"unit m\" in the "
                                                    "place of its unit"
                                                  : "measure its corners again"));
    return false;
  }

  bool square(const WallEntry& e) {
    const WallBasis b = basis(e.wall);
    const Vec3 left = e.wall.upperLeft - e.wall.lowerLeft;
    const double sine = left.dot(b.right) / left.norm();
    if (std::fabs(sine) <= kSquareWarning) return true;
    const double degrees = 90 - det::asin(sine) * (180 / kPi);
    const Vec3 mended = e.wall.lowerLeft + left.norm() * b.up;
    const std::string message = fmt::format(
        "{} is no rectangle: the angle at lower-left is {:.2f} degrees; a square corner has upper-left {}",
        nameOf(e), degrees, inUnit(mended));
    if (std::fabs(sine) <= kSquareError) {
      warning(e, message);
      return true;
    }
    error(e, message);
    return false;
  }

  /// The wall's distance from p, positive if the wall faces it.
  static double inFront(const Wall& wall, const Vec3& p) {
    return basis(wall).normal.dot(p - wall.lowerLeft);
  }

  void facing(const WallEntry& e, Facing how) {
    if (how == Facing::Away) return facesAway(e);
    if (how == Facing::Unsure) return mayFaceAway(e);
    const double toEye = inFront(e.wall, kStandingEye);
    if (toEye < kMinEyeDistance)
      warning(e,
              fmt::format(
                  "the eye of a visitor at 0 0 1.7 (metres) is {} wall \"{}\"; put the rig's origin on the "
                  "floor inside the room, or move the wall by {}",
                  toEye < 0 ? "behind" : "in the plane of", e.wall.name,
                  inUnit(-(1 - toEye) * basis(e.wall).normal)));
  }

  /// The corners as seen from the wall's other side.
  std::string mirrored(const WallEntry& e) const {
    return fmt::format("lower-left {}  lower-right {}  upper-left {}", inUnit(e.wall.lowerRight),
                       inUnit(e.wall.lowerLeft), inUnit(e.wall.upperRight()));
  }

  void facesAway(const WallEntry& e) {
    error(e, fmt::format("wall \"{}\" faces away from the room; seen from inside its corners are {}",
                         e.wall.name, mirrored(e)));
  }

  void mayFaceAway(const WallEntry& e) {
    warning(e, fmt::format("no place is in front of every wall, and wall \"{}\" may face away; if so, its "
                           "corners are {}",
                           e.wall.name, mirrored(e)));
  }

  struct Edge {
    const char* name;
    Vec3 a, b;
  };
  static std::array<Edge, 4> edges(const Wall& w) {
    return {{{"lower", w.lowerLeft, w.lowerRight},
             {"right", w.lowerRight, w.upperRight()},
             {"upper", w.upperLeft, w.upperRight()},
             {"left", w.lowerLeft, w.upperLeft}}};
  }

  /// How far apart the ends of two edges are at most, whichever way they run.
  static double gap(const Edge& e, const Edge& f) {
    return std::min(std::max((e.a - f.a).norm(), (e.b - f.b).norm()),
                    std::max((e.a - f.b).norm(), (e.b - f.a).norm()));
  }

  void pair(const WallEntry& one, const WallEntry& two) {
    const auto e1 = edges(one.wall), e2 = edges(two.wall);
    double best = 1e300;
    const Edge *at1 = nullptr, *at2 = nullptr;
    std::size_t closed = 0;
    for (const Edge& e : e1)
      for (const Edge& f : e2) {
        const double apart = gap(e, f);
        closed += apart <= kClosed ? 1 : 0;
        if (apart < best) {
          best = apart;
          at1 = &e;
          at2 = &f;
        }
      }
    if (closed >= 3)
      return error(two, fmt::format("wall \"{}\" lies on wall \"{}\" of line {}; leave one of them out",
                                    two.wall.name, one.wall.name, one.line));
    if (best <= kClosed || best > kMeant * std::max((at1->b - at1->a).norm(), (at2->b - at2->a).norm()))
      return;
    warning(two, fmt::format(
                     "the {} edge of wall \"{}\" and the {} edge of wall \"{}\" (line {}) do not meet, they "
                     "are {} apart; \"{}\" has this edge from {} to {}",
                     at2->name, two.wall.name, at1->name, one.wall.name, one.line, distance(best),
                     one.wall.name, inUnit(at1->a), inUnit(at1->b)));
  }

  const WallFile& walls_;
  const char* noun_;
  Diagnostics& out_;
};

WallFile emptyLike(const WallFile& walls) {
  WallFile like;
  like.file = walls.file;
  like.metresPerUnit = walls.metresPerUnit;
  return like;
}

/// The walls that fill their pictures. Projectors overlap by intent, and panoramas are nowhere.
WallFile flatWalls(const WallFile& walls) {
  WallFile flat = emptyLike(walls);
  for (const WallEntry& e : walls.walls)
    if (e.isFlat()) flat.walls.push_back(e);
  return flat;
}

WallFile planeScreens(const WallFile& walls) {
  WallFile planes = emptyLike(walls);
  for (const Screen& s : walls.screens)
    if (const auto* plane = std::get_if<Wall>(&s.surface)) {
      WallEntry& e = planes.walls.emplace_back();
      e.wall = *plane;
      e.wall.name = s.name;
      e.line = s.line;
      e.column = s.column;
      e.excerpt = s.excerpt;
    }
  return planes;
}

}  // namespace

void lintWalls(const WallFile& walls, Diagnostics& out) {
  const WallFile flat = flatWalls(walls), planes = planeScreens(walls);
  Linter ofWalls(flat, "wall", out);
  // The rest would only repeat, in other words, that a wall is no rectangle or ten times too large.
  const bool sound = ofWalls.rectangles(), soundScreens = Linter(planes, "screen", out).rectangles();
  if (sound && !flat.walls.empty()) ofWalls.room();
  if (sound && soundScreens) lintHall(walls, out);
}

}  // namespace stadion
