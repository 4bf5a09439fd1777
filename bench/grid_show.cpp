#include "bench/grid_show.h"

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::size_t kColumns = 50;
constexpr double kStep = 0.8;  ///< [m]

}  // namespace

std::string gridScript(const GridShow& show) {
  std::string text = "rig( name=stand, position=\"0, -8, 0\" )\n"
                     "light( name=sun, direction=\"-0.4, 0.5, -0.8\", shadows=off )\n";
  const std::size_t objects = show.nodes - show.moving;
  for (std::size_t i = 0; i < objects; ++i) {
    const double x = static_cast<double>(i % kColumns) - kColumns / 2.0,
                 y = kStep * static_cast<double>(i / kColumns);
    if (i >= show.moving) {
      text += fmt::format(
          "object( name=pillar_{:04}, file=suites/pillar.obj, scale=0.4, position=\"{}, {:.1f}, 0\" )\n", i,
          x, y);
      continue;
    }
    const double up = 1 + 0.1 * static_cast<double>(i % 7);  // [s]
    text += fmt::format("path( name=lane_{0:04}, loop=on, key=\"0, {1}, {2:.1f}, 0\", key=\"{3:.1f}, {1}, "
                        "{2:.1f}, 0.3\", key=\"{4:.1f}, "
                        "{1}, {2:.1f}, 0\" )\nobject( name=rider_{0:04}, file=suites/pillar.obj, scale=0.4, "
                        "parent=lane_{0:04} )\n",
                        i, x, y, up, 2 * up);
  }
  return text;
}

}  // namespace stadion
