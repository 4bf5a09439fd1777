#include "engine/display/output_reader.h"
#include "engine/display/wall_lint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kAspect = 0.5;  ///< a letter is about half as wide as it is high

/// A sheet of letters; (0, 0) is its top left corner.
class Sheet {
public:
  Sheet(int columns, int rows)
      : columns_(columns),
        lines_(static_cast<std::size_t>(rows), std::string(static_cast<std::size_t>(columns), ' ')) {}

  void put(int column, int row, char c) {
    if (column < 0 || row < 0 || column >= columns_ || row >= static_cast<int>(lines_.size())) return;
    lines_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = c;
  }

  std::string text() const {
    std::string all;
    for (std::string line : lines_) {
      line.erase(line.find_last_not_of(' ') + 1);
      all += line + '\n';
    }
    return all;
  }

private:
  int columns_;
  std::vector<std::string> lines_;
};

/// From rig space to the sheet.
struct Scale {
  Aabb bounds;
  double lettersPerMetre = 1;
  int column(double x) const {
    return 1 + static_cast<int>(std::lround((x - bounds.lo.x()) * lettersPerMetre));
  }
  int row(double y) const {
    return static_cast<int>(std::lround((bounds.hi.y() - y) * lettersPerMetre * kAspect));
  }
};

void line(Sheet& sheet, const Scale& scale, const Vec3& a, const Vec3& b, char c) {
  const int steps = 1 + 2 * std::max(std::abs(scale.column(b.x()) - scale.column(a.x())),
                                     std::abs(scale.row(b.y()) - scale.row(a.y())));
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = a + (b - a) * (static_cast<double>(i) / steps);
    sheet.put(scale.column(p.x()), scale.row(p.y()), c);
  }
}

/// Horizontal walls hide nothing: they are drawn first, dotted.
bool isLevel(const Wall& wall) {
  return std::fabs(basis(wall).normal.z()) > 0.99;
}

std::string facing(const Wall& wall) {
  const Vec3 n = basis(wall).normal;
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  static constexpr const char* kTowards[3][2] = {{"left", "right"}, {"back", "forward"}, {"down", "up"}};
  return fmt::format("faces {}", kTowards[axis][n[axis] > 0]);
}

}  // namespace

std::string floorPlan(const WallFile& walls, std::uint32_t columns) {
  Scale scale;
  scale.bounds.include(kStandingEye);
  for (const WallEntry& e : walls.walls)
    for (const Vec3& p : {e.wall.lowerLeft, e.wall.lowerRight, e.wall.upperLeft, e.wall.upperRight()})
      scale.bounds.include(p);
  const Vec3 extent = scale.bounds.hi - scale.bounds.lo;
  const int width = static_cast<int>(std::clamp(columns, 20u, 200u));
  scale.lettersPerMetre = (width - 3) / std::max({extent.x(), extent.y(), 1e-3});
  Sheet sheet(width, scale.row(scale.bounds.lo.y()) + 1);

  for (const bool level : {true, false})
    for (std::size_t i = 0; i < walls.walls.size(); ++i) {
      const Wall& w = walls.walls[i].wall;
      if (isLevel(w) != level) continue;
      const Vec3 corners[] = {w.lowerLeft, w.lowerRight, w.upperRight(), w.upperLeft};
      for (std::size_t k = 0; k < 4; ++k)
        line(sheet, scale, corners[k], corners[(k + 1) % 4], level ? '.' : '#');
    }
  sheet.put(scale.column(kStandingEye.x()), scale.row(kStandingEye.y()), '@');
  for (std::size_t i = 0; i < walls.walls.size(); ++i) {
    const Vec3 c = walls.walls[i].wall.centre();
    // Floor and ceiling share their middle with the visitor and with each other.
    const int aside = isLevel(walls.walls[i].wall) ? (c.z() < kStandingEye.z() ? -4 : 4) : 0;
    sheet.put(scale.column(c.x()) + aside, scale.row(c.y()), static_cast<char>('1' + i));
  }

  const int metre = std::max(1, static_cast<int>(std::lround(scale.lettersPerMetre)));
  const bool fits = metre <= width - 10;
  std::string text = sheet.text();
  text += fits ? fmt::format("\n |{}| 1 m", std::string(static_cast<std::size_t>(metre), '-'))
               : fmt::format("\n |{}| 0.1 m",
                             std::string(static_cast<std::size_t>(std::max(1, metre / 10)), '-'));
  text += "   @ eye at 0 0 1.7   up the page is forward (+Y)\n\n";
  for (std::size_t i = 0; i < walls.walls.size(); ++i) {
    const Wall& w = walls.walls[i].wall;
    const WallBasis b = basis(w);
    text += fmt::format(" {} {:<12} {:.2f} x {:.2f} m, {}, middle at {:.2f} {:.2f} {:.2f}\n", i + 1, w.name,
                        b.width, b.height, facing(w), w.centre().x(), w.centre().y(), w.centre().z());
    if (const auto& output = walls.walls[i].output)
      text += fmt::format("   shown on{}\n", formatOutput(*output));
  }
  return text;
}

}  // namespace stadion
