#include "bench/city_show.h"

#include "engine/base/atomic_file.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace stadion::bench {
namespace {

constexpr double kStreet = 4;  ///< from tower to tower [m]
constexpr double kFar = 260;   ///< what is seen [m]
constexpr const char* kTower = "v -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\nv 0 0 3\n"
                               "f 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\nf 1 2 3 4\n";

constexpr const char* kWalls =
    "unit m\neye-separation 0.065\nnear 0.1\nfar {}\n"
    "wall front lower-left -1.5 1.5 0 lower-right 1.5 1.5 0 upper-left -1.5 1.5 3\n"
    "wall left lower-left -1.5 -1.5 0 lower-right -1.5 1.5 0 upper-left -1.5 -1.5 3\n"
    "wall right lower-left 1.5 1.5 0 lower-right 1.5 -1.5 0 upper-left 1.5 1.5 3\n"
    "wall floor lower-left -1.5 -1.5 0 lower-right 1.5 -1.5 0 upper-left -1.5 1.5 0\n";

std::string cityText(const CityShow& show) {
  std::string text = "light( direction=\"-0.4, 0.5, -0.8\", shadows=off )\nrig()\n";
  text.reserve(70 * show.still);
  const auto out = std::back_inserter(text);
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(show.still))));
  for (std::size_t i = 0; i < show.still; ++i) {
    const auto along = [&](std::size_t n) {
      return kStreet * (static_cast<double>(n) - 0.5 * static_cast<double>(side));
    };
    fmt::format_to(out, "object( file=tower.obj, position=\"{:.1f}, {:.1f}, 0\" )\n", along(i % side),
                   along(i / side) + 0.5 * kStreet);
  }
  for (std::size_t i = 0; i < show.moving; ++i)
    fmt::format_to(out, "object( name=balloon_{0}, file=tower.obj, position=\"{1}, {2}, 8\" )\n", i,
                   static_cast<double>(i % 10) - 5, 10 + static_cast<double>(i / 10));
  if (show.moving == 0) return text;
  text += "sway( amplitude=\"0.3, 0.3, 0.5\", frequency=\"0.2, 0.3, 0.15\", phasestep=25, "
          "angularvelocity=\"0, 0, 10\"";
  for (std::size_t i = 0; i < show.moving; ++i) fmt::format_to(out, ",\n  target=balloon_{}", i);
  return text + " )\n";
}

}  // namespace

std::string writeCity(const std::string& folder, const CityShow& show) {
  std::string wrong;
  const auto write = [&](const std::string& name, const std::string& text) {
    if (const auto why = writeFile(folder + "/" + name, text); why && wrong.empty()) wrong = format(*why);
  };
  write("tower.obj", kTower);
  write("city.walls", fmt::format(fmt::runtime(kWalls), kFar));
  write("city.evs", cityText(show));
  return wrong;
}

}  // namespace stadion::bench
