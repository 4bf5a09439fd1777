#include "pipeline/surface/environment_lights.h"

#include "engine/environment/radiance_map.h"

namespace stadion {

std::shared_ptr<const EnvironmentLight> EnvironmentLights::find(const DrawSky& sky) {
  if (sky.environment.lit == 0) return nullptr;
  const Mesh* picture = sky.environment.picture != kNoMesh ? store_.find(sky.environment.picture) : nullptr;
  if (picture && picture->environment) return picture->environment;
  const std::array<Radiance, 3> colours{sky.zenith, sky.horizon, sky.ground};
  const std::lock_guard lock(mutex_);
  if (!ofSky_ || colours_ != colours) {
    ofSky_ = std::make_shared<const EnvironmentLight>(skyLight(sky.zenith, sky.horizon, sky.ground));
    colours_ = colours;
  }
  return ofSky_;
}

}  // namespace stadion
