#include "pipeline/cpu_draw/plain_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace stadion {
namespace {

using Float3 = std::array<float, 3>;

float dot(const Float3& a, const Float3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Of a point or a spot light.
float strengthOfLamp(const LightParameters& lamp, const Float3& placed, Float3& towards) {
  Float3 to{lamp.position[0] - placed[0], lamp.position[1] - placed[1], lamp.position[2] - placed[2]};
  const float squared = std::max(dot(to, to), 1e-12f), per = 1 / std::sqrt(squared);
  for (float& x : to) x *= per;
  const float fading = std::max(1 - squared * lamp.perRangeSquared, 0.0f);
  float strength = fading * fading;
  if (lamp.fallsOff) strength /= std::max(squared, 0.01f);
  if (lamp.kind == 2) {
    const float inside = std::clamp((dot(to, towards) - lamp.coneOuter) * lamp.perCone, 0.0f, 1.0f);
    strength *= inside * inside * (3 - 2 * inside);
  }
  towards = to;
  return strength;
}

}  // namespace

Float3 plainLight(const SceneParameters& scene, const Float3& placed, const Float3& normal) {
  Float3 light{scene.ambient[0], scene.ambient[1], scene.ambient[2]};
  for (int i = 0; i < scene.lights; ++i) {
    const LightParameters& lamp = scene.light[i];
    Float3 towards{lamp.towards[0], lamp.towards[1], lamp.towards[2]};
    const float strength = lamp.kind == 0 ? 1 : strengthOfLamp(lamp, placed, towards);
    const float arriving = strength * std::max(dot(normal, towards), 0.0f);
    for (std::size_t k = 0; k < 3; ++k) light[k] += lamp.colour[k] * arriving;
  }
  return light;
}

float clearnessAt(const SceneParameters& scene, float distance) {
  const float x = std::clamp(-1.442695f * distance * scene.perHaze, -60.0f, 0.0f);
  const float whole = std::floor(x), f = x - whole;
  const float p =
      1 + f * (0.693147f + f * (0.240227f + f * (0.0555041f + f * (0.0096181f + f * 0.0013395f))));
  return p * std::bit_cast<float>((static_cast<int>(whole) + 127) << 23);
}

}  // namespace stadion
