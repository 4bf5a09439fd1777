#include "show/simulation/simulation_pictures.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/maths/srgb.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace stadion {
namespace {

constexpr std::uint32_t kAround = 1024, kUpright = 512;  ///< of the directions [pixels]
constexpr std::uint32_t kPlan = 800;                     ///< of the plan, at most [pixels]

void paintPixel(Picture& picture, std::uint32_t x, std::uint32_t y, const Vec3& light) {
  for (int c = 0; c < 3; ++c)
    picture.at(x, y)[c] =
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(srgbFromLinear(light[c]), 0.0, 1.0)));
}

Picture darkPicture(std::uint32_t width, std::uint32_t height) {
  Picture picture(width, height, 0);
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
  return picture;
}

Vec3 colourOf(std::size_t projector) {
  const double turn = 2 * kPi * 0.6180339887498949 * static_cast<double>(projector);
  return {0.5 + 0.4 * det::cos(turn), 0.5 + 0.4 * det::cos(turn - 2 * kPi / 3),
          0.5 + 0.4 * det::cos(turn + 2 * kPi / 3)};
}

}  // namespace

SimulationPictures::SimulationPictures() : cells_(std::size_t{kAround} * kUpright) {}

void SimulationPictures::add(const SeenPixel& pixel) {
  const double across = det::atan2(pixel.direction.x(), pixel.direction.y()) / (2 * kPi) + 0.5;
  const double down = 0.5 - det::asin(pixel.direction.z()) / kPi;
  const auto x = std::min(static_cast<std::uint32_t>(across * kAround), kAround - 1);
  const auto y = std::min(static_cast<std::uint32_t>(down * kUpright), kUpright - 1);
  Cell& cell = cells_[std::size_t{y} * kAround + x];
  cell.light += pixel.light;
  cell.count += 1;
  cell.error = std::max(cell.error, pixel.error);
  spots_.push_back({pixel.point, pixel.projector});
}

Picture SimulationPictures::inside() const {
  Picture picture = darkPicture(kAround, kUpright);
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (cells_[i].count > 0)
      paintPixel(picture, static_cast<std::uint32_t>(i % kAround), static_cast<std::uint32_t>(i / kAround),
                 cells_[i].light / cells_[i].count);
  return picture;
}

Picture SimulationPictures::errors() const {
  Picture picture = darkPicture(kAround, kUpright);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].count == 0) continue;
    const double e = std::min(1.0, cells_[i].error);
    paintPixel(picture, static_cast<std::uint32_t>(i % kAround), static_cast<std::uint32_t>(i / kAround),
               e < 0 ? Vec3(0.1, 0.1, 0.1) : Vec3(e, 0.6 * (1 - e), 0.05));
  }
  return picture;
}

Picture SimulationPictures::above() const {
  Aabb bounds;
  for (const Spot& spot : spots_) bounds.include(spot.point);
  if (spots_.empty()) return darkPicture(1, 1);
  const Vec3 extent = bounds.hi - bounds.lo;
  const double scale = (kPlan - 1) / std::max({extent.x(), extent.y(), 1e-3});
  Picture picture = darkPicture(static_cast<std::uint32_t>(extent.x() * scale) + 1,
                                static_cast<std::uint32_t>(extent.y() * scale) + 1);
  for (const Spot& spot : spots_)
    paintPixel(
        picture,
        std::min(static_cast<std::uint32_t>((spot.point.x() - bounds.lo.x()) * scale), picture.width - 1),
        std::min(static_cast<std::uint32_t>((bounds.hi.y() - spot.point.y()) * scale), picture.height - 1),
        colourOf(spot.projector));
  return picture;
}

std::optional<Diagnostic> SimulationPictures::write(const std::string& folder) const {
  std::error_code none;
  std::filesystem::create_directories(folder, none);
  if (auto wrong = writePng(folder + "/inside.png", inside())) return wrong;
  if (auto wrong = writePng(folder + "/errors.png", errors())) return wrong;
  return writePng(folder + "/above.png", above());
}

}  // namespace stadion
