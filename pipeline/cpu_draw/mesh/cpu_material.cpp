#include "pipeline/cpu_draw/mesh/cpu_material.h"

#include "pipeline/gl/finite.h"

#include <algorithm>

namespace stadion {
namespace {

template <std::size_t kCount>
void copyFirst(const Float4& from, float (&to)[kCount]) {
  std::copy_n(from.begin(), kCount, to);
}

LightParameters lightParameters(const LightBlock& from) {
  LightParameters to{};
  copyFirst(from.position, to.position);
  copyFirst(from.direction, to.towards);
  copyFirst(from.colour, to.colour);
  to.perRangeSquared = from.position[3];
  to.kind = static_cast<int>(from.direction[3]);
  to.coneOuter = from.cone[0];
  to.perCone = from.cone[1];
  to.fallsOff = from.cone[2] > 0.5f;
  return to;
}

TextureWrap wrapOf(WrapMode mode) {
  if (mode == WrapMode::Mirror) return TextureWrap::Mirror;
  return mode == WrapMode::Clamp ? TextureWrap::Clamp : TextureWrap::Repeat;
}

}  // namespace

void setUse(const MaterialMap& map, TextureParameters& to) {
  to.wrapU = wrapOf(map.sampler.wrapU);
  to.wrapV = wrapOf(map.sampler.wrapV);
  to.magnifiesNearest = map.sampler.magnifiesNearest;
  to.minifiesNearest = map.sampler.minifiesNearest;
  to.mipmaps = static_cast<int>(map.sampler.mipmaps);
  to.unusual = map.sampler != Sampler{};
  to.coordinates = map.secondUvs;
  std::ranges::transform(map.uvTransform, to.transform, finite);
}

MaterialParameters materialParameters(const Material& material, Look look) {
  const MaterialBlock block = fillMaterial(material, look);
  MaterialParameters to{};
  copyFirst(block.baseColour, to.baseColour);
  copyFirst(block.emissive, to.emissive);
  to.roughness = block.emissive[3];
  to.metallic = block.finish[0];
  to.alphaCutoff = material.masked() ? block.finish[1] : 0;
  to.normalScale = block.finish[2];
  to.occlusionStrength = block.finish[3];
  to.unlit = material.unlit;
  to.doubleSided = material.doubleSided;
  return to;
}

EnvironmentParameters environmentParameters(const EnvironmentRecord& record, const EnvironmentLight& light,
                                            bool maps) {
  const EnvironmentBlock block = fillEnvironment(record, light);
  EnvironmentParameters to{};
  for (std::size_t i = 0; i < block.harmonics.size(); ++i) copyFirst(block.harmonics[i], to.harmonics[i]);
  to.turnCos = block.turn[0];
  to.turnSin = block.turn[1];
  to.intensity = block.turn[2];
  if (maps) to.texels = light.texels.data();
  static_assert(EnvironmentParameters::kMaps == int{EnvironmentLight::kMaps});
  for (std::size_t i = 0; i < EnvironmentLight::kMaps; ++i) {
    to.first[i] = static_cast<int>(light.firstOf(i));
    to.side[i] = static_cast<int>(EnvironmentLight::kSides[i]);
  }
  to.pictureSide = static_cast<int>(block.turn[3]);
  if (to.pictureSide > 0) to.picture = light.texels.data();
  return to;
}

SceneParameters sceneParameters(const SceneBlock& block) {
  SceneParameters to{};
  copyFirst(block.zenith, to.zenith);
  copyFirst(block.horizon, to.horizon);
  copyFirst(block.ground, to.ground);
  copyFirst(block.ambient, to.ambient);
  copyFirst(block.sunDirection, to.sunDirection);
  copyFirst(block.sunColour, to.sunColour);
  to.perHaze = block.ambient[3];
  to.sunShare = block.sunDirection[3];
  to.lights = block.lightCount[0];
  to.shadowed = block.lightCount[1];
  to.curve = block.lightCount[2];
  to.exposure = block.zenith[3];
  to.toned = to.curve != 0 || to.exposure != 1;
  std::ranges::transform(block.lights, to.light, lightParameters);
  to.steep =
      std::any_of(to.light, to.light + to.lights, [](const LightParameters& l) { return l.fallsOff != 0; });
  return to;
}

}  // namespace stadion
