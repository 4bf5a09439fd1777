#include "show/simulation/simulated_hall.h"

#include <algorithm>

namespace stadion {

SimulatedHall::SimulatedHall(WallFile hall, std::uint32_t every) : hall_(std::move(hall)) {
  for (const Screen& s : hall_.screens) screens_.push_back(std::make_unique<SimulatedScreen>(s));
  for (const WallEntry& e : hall_.walls) {
    projectors_.push_back(
        e.projector ? std::make_unique<SimulatedProjector>(*e.projector, *screens_[e.projector->screen])
                    : nullptr);
    if (!e.projector) continue;
    for (int c = 0; c < 3; ++c)
      white_[c] = std::min(white_[c], e.projector->light.white[static_cast<std::size_t>(c)]);
  }
  for (std::size_t i = 0; i < projectors_.size(); ++i)
    if (projectors_[i]) look(i, every);
}

bool SimulatedHall::serves(std::size_t entry, Eye eye) const {
  const auto& only = hall_.walls[entry].projector->eye;
  return !only || *only == eye;
}

void SimulatedHall::look(std::size_t entry, std::uint32_t every) {
  const SimulatedProjector& p = *projectors_[entry];
  LookedAtProjector all;
  all.entry = entry;
  for (std::uint32_t y = std::min(every / 2, p.height() - 1); y < p.height(); y += every)
    for (std::uint32_t x = std::min(every / 2, p.width() - 1); x < p.width(); x += every) {
      const auto at = [&](double dx, double dy) { return p.pointAt(x + 0.5 + dx, y + 0.5 + dy); };
      const auto point = at(0, 0), right = at(1, 0), left = at(-1, 0), below = at(0, 1), above = at(0, -1);
      if (!point || (!right && !left) || (!below && !above)) continue;
      LookedAtPixel pixel;
      pixel.x = x;
      pixel.y = y;
      pixel.point = *point;
      pixel.right = right ? *right : Vec3(2 * *point - *left);
      pixel.below = below ? *below : Vec3(2 * *point - *above);
      lookAround(entry, pixel, all.others);
      all.pixels.push_back(pixel);
    }
  looked_.push_back(std::move(all));
}

void SimulatedHall::lookAround(std::size_t entry, LookedAtPixel& pixel, std::vector<LightFrom>& others) {
  const SimulatedProjector& own = *projectors_[entry];
  const Projector& about = *hall_.walls[entry].projector;
  pixel.whole = pixel.x > 0 && pixel.y > 0 && pixel.x + 1 < own.width() && pixel.y + 1 < own.height();
  std::array<double, kEyes.size()> black{};
  for (std::size_t cell = 0; cell < 9; ++cell) {
    pixel.first[cell] = static_cast<std::uint32_t>(others.size());
    const double x = pixel.x + static_cast<double>(cell % 3) - 0.5;
    const double y = pixel.y + static_cast<double>(cell / 3) - 0.5;
    const auto point = pixel.whole ? own.pointAt(x, y) : std::nullopt;
    pixel.whole = point.has_value();
    if (!point) continue;
    black.fill(blackOf(entry));
    for (std::size_t i = 0; i < projectors_.size(); ++i) {
      if (i == entry || !projectors_[i] || hall_.walls[i].projector->screen != about.screen) continue;
      const auto& eye = hall_.walls[i].projector->eye;
      if (eye && about.eye && *eye != *about.eye) continue;
      const auto place = projectors_[i]->placeOf(*point);
      if (!place) continue;
      others.push_back(
          {static_cast<std::uint32_t>(i), static_cast<float>(place->x()), static_cast<float>(place->y())});
      for (const Eye e : kEyes)
        if (serves(i, e)) black[static_cast<std::size_t>(e)] += blackOf(i);
    }
    for (const Eye e : kEyes)
      if (serves(entry, e)) black_ = std::max(black_, black[static_cast<std::size_t>(e)]);
  }
  pixel.first[9] = static_cast<std::uint32_t>(others.size());
}

std::vector<LightFrom> SimulatedHall::lightAt(std::size_t screen, const Vec3& point, Eye eye) const {
  std::vector<LightFrom> all;
  for (std::size_t i = 0; i < projectors_.size(); ++i) {
    if (!projectors_[i] || hall_.walls[i].projector->screen != screen || !serves(i, eye)) continue;
    if (const auto place = projectors_[i]->placeOf(point))
      all.push_back(
          {static_cast<std::uint32_t>(i), static_cast<float>(place->x()), static_cast<float>(place->y())});
  }
  return all;
}

}  // namespace stadion
