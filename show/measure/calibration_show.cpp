#include "show/measure/calibration_show.h"

#include "engine/base/atomic_file.h"
#include "engine/maths/angles.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace stadion {
namespace {

constexpr int kStones = 360, kSwaying = 36;
constexpr int kRings = 9, kSides = 14;  // 252 triangles

/// A ball with bumps, +Y up as models are.
std::string stoneText() {
  std::string text = "v 0 -0.5 0\n";
  const auto out = std::back_inserter(text);
  for (int ring = 1; ring <= kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      const double up = kPi * (double{1} * ring / (kRings + 1) - 0.5), round = 2 * kPi * side / kSides;
      const double radius = 0.5 + 0.07 * std::sin(3 * round) * std::cos(2 * up);
      fmt::format_to(out, "v {:.5f} {:.5f} {:.5f}\n", radius * std::cos(up) * std::cos(round),
                     radius * std::sin(up), radius * std::cos(up) * std::sin(round));
    }
  text += "v 0 0.5 0\n";
  const auto corner = [](int ring, int side) { return 2 + (ring - 1) * kSides + side % kSides; };
  const int top = corner(kRings + 1, 0);
  for (int side = 0; side < kSides; ++side) {
    fmt::format_to(out, "f 1 {} {}\n", corner(1, side), corner(1, side + 1));
    for (int ring = 1; ring < kRings; ++ring)
      fmt::format_to(out, "f {} {} {} {}\n", corner(ring, side), corner(ring + 1, side),
                     corner(ring + 1, side + 1), corner(ring, side + 1));
    fmt::format_to(out, "f {} {} {}\n", corner(kRings, side), top, corner(kRings, side + 1));
  }
  return text;
}

constexpr const char* kGround = "v -60 0 60\nv 60 0 60\nv 60 0 -60\nv -60 0 -60\nf 1 2 3 4\n";

/// Stones on a spiral whose turns lie evenly, so that no direction has more of them than another.
std::string scriptText() {
  std::string text = "light( direction=\"-0.4, 0.6, -0.8\" )\nrig()\nobject( file=ground.obj )\n";
  const auto out = std::back_inserter(text);
  const double golden = kPi * (3 - std::sqrt(5));
  for (int i = 0; i < kStones; ++i) {
    const double far = 2.5 + 1.1 * std::sqrt(i), round = golden * i;
    const bool sways = i % (kStones / kSwaying) == 0;
    fmt::format_to(out, "object( {}file=stone.obj, position=\"{:.3f}, {:.3f}, {:.3f}\" )\n",
                   sways ? fmt::format("name=stone_{}, ", i) : "", far * std::cos(round),
                   far * std::sin(round), 0.4 + 0.45 * (i % 7));
  }
  text += "sway( amplitude=\"0.2, 0.2, 0.2\", frequency=\"0.3, 0.2, 0.4\", phasestep=25";
  for (int i = 0; i < kStones; i += kStones / kSwaying) fmt::format_to(out, ",\n  target=stone_{}", i);
  return text + " )\n";
}

}  // namespace

std::string calibrationScript(const std::string& folder) {
  return folder + "/grove.evs";
}

std::string writeCalibrationShow(const std::string& folder) {
  std::string wrong;
  const auto write = [&](const std::string& file, const std::string& text) {
    if (const auto why = writeFile(file, text); why && wrong.empty()) wrong = format(*why);
  };
  write(folder + "/stone.obj", stoneText());
  write(folder + "/ground.obj", kGround);
  write(calibrationScript(folder), scriptText());
  return wrong;
}

}  // namespace stadion
