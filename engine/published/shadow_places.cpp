#include "engine/published/shadow_places.h"

namespace stadion {

const ShadowRecord& ShadowPlaces::follow(const Vec3& p_WH) {
  constexpr double kStray = 0.25;  // of the reach
  for (std::size_t ring = 0; ring < kShadowRings; ++ring) {
    auto& centre = record_.centre[ring];
    const double away = (p_WH - Vec3(centre[0], centre[1], centre[2])).norm();
    if (placed_ && away <= kStray * kShadowReach[ring]) continue;
    for (int k = 0; k < 3; ++k) centre[k] = p_WH[k];
  }
  placed_ = true;
  return record_;
}

}  // namespace stadion
