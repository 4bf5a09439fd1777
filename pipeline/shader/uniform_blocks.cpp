#include "pipeline/shader/uniform_blocks.h"

#include "engine/maths/srgb.h"
#include "pipeline/gl/finite.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::array kBlockBindings{GlBinding{"View", kViewBinding}, GlBinding{"Scene", kSceneBinding},
                                    GlBinding{"Material", kMaterialBinding},
                                    GlBinding{"Shadow", kShadowBinding},
                                    GlBinding{"Environment", kEnvironmentBinding}};
constexpr std::array kTextureBindings{GlBinding{"baseTexture", kMapUnits[kBaseMap]},
                                      GlBinding{"shadowMap", kShadowUnit},
                                      GlBinding{"environmentMap", kEnvironmentUnit},
                                      GlBinding{"glowTexture", kMapUnits[kEmissiveMap]},
                                      GlBinding{"finishTexture", kMapUnits[kMetallicRoughnessMap]},
                                      GlBinding{"normalTexture", kMapUnits[kNormalMap]},
                                      GlBinding{"occlusionTexture", kMapUnits[kOcclusionMap]}};

constexpr float kLeastConeWidth = 1e-4f;  // so that a spot's edge never divides by zero
constexpr float kLeastRoughness = 0.08f;  // below it a highlight is smaller than a pixel and flickers

Float4 widen(const std::array<float, 3>& v, float w) {
  return {finite(v[0]), finite(v[1]), finite(v[2]), finite(w)};
}

/// Converts a colour to the space in which the look computes.
Float4 colour(const std::array<float, 3>& linear, float w, Look look) {
  Float4 out = widen(linear, w);
  if (look == Look::Plain)
    for (std::size_t i = 0; i < 3; ++i)
      out[i] = static_cast<float>(srgbFromLinear(std::max(0.0, double{out[i]})));
  return out;
}

Float4 reversed(const std::array<float, 3>& v, float w) {
  const float length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, 1, w};
  return {-v[0] / length, -v[1] / length, -v[2] / length, w};
}

std::array<float, 3> times(std::array<float, 3> linear, float factor) {
  for (float& c : linear) c *= factor;
  return linear;
}

/// The light of a matt face with this normal.
std::array<float, 3> mattLight(const EnvironmentLight& light, const std::array<float, 3>& n,
                               float intensity) {
  std::array<float, 3> out = light.matt(n);
  for (float& c : out) c = std::max(c * intensity, 0.0f);
  return out;
}

/// In the plain look, colours of the sky that stand for the picture behind everything.
void paintPlainSky(DrawSky& sky, const EnvironmentLight& light) {
  const float intensity = sky.environment.intensity;
  sky.zenith = mattLight(light, {0, 0, 1}, intensity);
  sky.ground = mattLight(light, {0, 0, -1}, intensity);
  sky.horizon = {0, 0, 0};
  for (const std::array<float, 3>& n : {std::array<float, 3>{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}})
    for (std::size_t c = 0; c < 3; ++c) sky.horizon[c] += 0.25f * mattLight(light, n, intensity)[c];
}

/// What lights and a sky become in the plain look, which has neither an exposure nor an environment of its own.
void makePlain(DrawSky& sky, std::vector<DrawLight>& lights, const EnvironmentLight* environment) {
  if (environment) {
    if (sky.environment.background != 0) paintPlainSky(sky, *environment);
    constexpr float kMean = 0.28209479f;
    sky.ambient = times(environment->harmonics[0], std::max(kMean * sky.environment.intensity, 0.0f));
  }
  for (auto* colour : {&sky.zenith, &sky.horizon, &sky.ground, &sky.ambient})
    *colour = times(*colour, sky.tones.exposure);
  for (DrawLight& light : lights) light.colour = times(light.colour, sky.tones.exposure);
}

LightBlock fillLight(const DrawLight& light, Look look) {
  LightBlock out;
  out.position = widen(light.position, light.range > 0 ? 1 / (light.range * light.range) : 0);
  out.direction = reversed(light.direction, static_cast<float>(light.kind));
  out.colour = colour(light.colour, 0, look);
  out.cone = {finite(light.cosOuter), 1 / std::max(light.cosInner - light.cosOuter, kLeastConeWidth),
              light.fallsOff ? 1.0f : 0.0f, 0};
  return out;
}

void placeSun(const std::vector<DrawLight>& lights, SceneBlock& out) {
  out.sunDirection = out.sunColour = {0, 0, 0, 0};
  const auto isSun = [](const DrawLight& l) { return l.kind == DrawLight::Kind::Directional; };
  const auto sun = std::find_if(lights.begin(), lights.end(), isSun);
  if (sun == lights.end()) return;
  const float brightest = std::max({sun->colour[0], sun->colour[1], sun->colour[2]});
  if (!(brightest > 0) || !std::isfinite(brightest)) return;
  out.sunDirection = reversed(sun->direction, 1);
  out.sunColour = {sun->colour[0] / brightest, sun->colour[1] / brightest, sun->colour[2] / brightest, 0};
}

/// A little lower, so that rounding in interpolation does not lose an alpha equal to the cutoff.
float cutoffOf(const Material& material) {
  constexpr float kRounding = 1.0f / 2048;
  const float cutoff = finite(material.alphaCutoff);
  return std::max(cutoff - kRounding, 0.5f * cutoff);
}

}  // namespace

GlBindings shaderBindings() {
  return {kBlockBindings, kTextureBindings};
}

void fillViewProjection(const Mat4& viewProjection, ClipDepth clip, ViewBlock& out) {
  Mat4 m = viewProjection;
  if (clip == ClipDepth::MinusOneToOne) m.row(2) = 2 * m.row(2) - m.row(3);
  for (int i = 0; i < 16; ++i)
    out.viewProjection[static_cast<std::size_t>(i)] = static_cast<float>(m(i % 4, i / 4));
  out.eye[3] = clip == ClipDepth::MinusOneToOne ? -1 : 0;
}

bool fillView(const DrawView& eye, ClipDepth clip, ViewBlock& out) {
  if (!eye.view.allFinite() || !eye.projection.allFinite()) return false;
  const Mat4 toWorld = eye.view.inverse();
  const Mat4 fromClip = eye.projection.inverse();
  if (!toWorld.allFinite() || !fromClip.allFinite()) return false;

  fillViewProjection(eye.projection * eye.view, clip, out);
  for (std::size_t i = 0; i < 3; ++i) out.eye[i] = static_cast<float>(toWorld(static_cast<int>(i), 3));

  // Points of the far plane depend linearly on the position on the screen, so the shader may interpolate.
  constexpr double corners[3][2] = {{-1, -1}, {3, -1}, {-1, 3}};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec4 far = fromClip * Vec4(corners[i][0], corners[i][1], 0, 1);
    if (!(std::abs(far.w()) > 0)) return false;
    const Vec3 inEye = far.head<3>() / far.w();
    const Vec3 ray = toWorld.topLeftCorner<3, 3>() * (inEye / std::abs(inEye.z()));
    if (!ray.allFinite()) return false;
    out.rays[i] = {static_cast<float>(ray.x()), static_cast<float>(ray.y()), static_cast<float>(ray.z()), 0};
  }
  return true;
}

SceneBlock fillScene(const DrawSky& from, const std::vector<DrawLight>& shining, Look look,
                     std::int32_t shadowed, const EnvironmentLight* environment) {
  SceneBlock out{};
  DrawSky sky = from;
  std::vector<DrawLight> changed;
  const bool changes = look == Look::Plain && (environment || sky.tones.exposure != 1);
  if (changes) makePlain(sky, changed = shining, environment);
  const std::vector<DrawLight>& lights = changes ? changed : shining;
  out.zenith = colour(sky.zenith, 0, look);
  out.horizon = colour(sky.horizon, 0, look);
  out.ground = colour(sky.ground, 0, look);
  out.ambient = colour(sky.ambient, sky.hazeDistance > 0 ? 1 / sky.hazeDistance : 0, look);
  placeSun(lights, out);
  const std::size_t count = std::min(lights.size(), DrawList::kMaxLights);
  out.lightCount = {static_cast<std::int32_t>(count), shadowed, static_cast<std::int32_t>(sky.tones.curve),
                    0};
  if (look == Look::Full) out.zenith[3] = finite(sky.tones.exposure);
  for (std::size_t i = 0; i < count; ++i) out.lights[i] = fillLight(lights[i], look);
  return out;
}

EnvironmentBlock fillEnvironment(const EnvironmentRecord& record, const EnvironmentLight& light) {
  constexpr std::array<float, 9> kFactors{0.28209479f, 0.48860251f, 0.48860251f, 0.48860251f, 1.09254843f,
                                          1.09254843f, 0.31539157f, 1.09254843f, 0.54627422f};
  EnvironmentBlock out{};
  const float intensity = std::max(finite(record.intensity), 0.0f);
  for (std::size_t i = 0; i < kFactors.size(); ++i)
    out.harmonics[i] = widen(times(light.harmonics[i], kFactors[i] * intensity), 0);
  out.turn = {finite(record.turnCos), finite(record.turnSin), intensity,
              record.background != 0 ? static_cast<float>(light.pictureSide) : 0.0f};
  return out;
}

MaterialBlock fillMaterial(const Material& material, Look look) {
  const auto& c = material.baseColour;
  const float normalScale = std::clamp(finite(material.normalScale), -kMostNormalScale, kMostNormalScale);
  MaterialBlock out{
      colour({c[0], c[1], c[2]}, c[3], look),
      colour(material.emissive, std::clamp(finite(material.roughness), kLeastRoughness, 1.0f), look),
      {std::clamp(finite(material.metallic), 0.0f, 1.0f), cutoffOf(material), normalScale,
       std::clamp(finite(material.occlusionStrength), 0.0f, 1.0f)},
      {}};
  for (std::size_t kind = 0; kind < kMapKinds; ++kind) {
    const auto& m = material.maps[kind].uvTransform;
    const float second = material.maps[kind].secondUvs ? 1.0f : 0.0f;
    out.places[2 * kind] = {finite(m[0]), finite(m[1]), finite(m[2]), second};
    out.places[2 * kind + 1] = {finite(m[3]), finite(m[4]), finite(m[5]), 0};
  }
  return out;
}

}  // namespace stadion
