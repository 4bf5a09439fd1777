#pragma once
/// The shaders' source text (GLSL 3.30), and how light is computed in them.
///
/// Light        a white Lambert face square to a light of colour 1 has radiance 1: the factor pi of the light
///              and of the reflectance cancel. The highlight is GGX (Walter et al. 2007) with Smith's
///              shadowing in Schlick's form and Schlick's Fresnel term.
/// Ambient      a face looking up receives `ambient`, one looking down `ambient` x (0.3 + `ground`), others
///              in between in proportion to their normal's z.
/// Range        radiance up to 0.8 is shown as it is; above, it approaches 1 smoothly (softClip). A node `tones`
///              chooses an exposure and other curves (environment_text.h).
/// sRGB         opaque surfaces and the sky encode it themselves: once a pixel, not once a sample.
/// Haze         a surface at distance d keeps exp(-d / haze distance) of its colour. The rest is the colour
///              of the sky behind it, brighter towards the sun, so that distant surfaces fade into the
///              horizon.
/// Surroundings environment_text.h: an environment takes the place of Ambient.
/// Maps         roughness and metallic are factor times map. Occlusion dims the light from around alone. The
///              normal map's axes are the tangent, square to the interpolated normal, and a bitangent square to
///              both that points up in the picture. Without tangents of the file, the tangent is the triangle's
///              own, along u. A back shows the same relief, seen from behind.
/// Unlit        the base colour is shown as it is, with haze alone.
/// Shadows      of one directional light: four lookups of two by two texels in the finest ring of the shadow
///              maps there (shadow_maps.h). Beyond the last ring everything is lit.
///
/// The plain look (look.h) has shaders of its own: light at the vertices, in colours as they are stored.

#include "pipeline/shader/look.h"

#include <cstdint>
#include <string>

namespace stadion {

/// The use of the light that a surface program computes.
enum class SurfaceWrites : std::uint8_t {
  Picture,  ///< shown; encoded, in the full look
  Blended,  ///< blended, in a buffer that encodes sRGB itself
  Layers,   ///< stored, and sorted later (glass_layers.h)
};

/// Number of transparent layers that are blended exactly (glass_layers.h); a multiple of four.
constexpr int kExactLayers = 32;

/// What gives light from all around (environment_text.h).
enum class Surroundings : std::uint8_t { None, Harmonics, Maps };

/// The features of a surface program, so that none pays for unused ones. A software rasteriser runs every
/// line of a fragment shader for every block of pixels that a triangle touches, whatever the branches say.
struct SurfaceTraits {
  bool textured = false;
  bool localLights = false;  ///< there are point or spot lights
  bool shadowed = false;     ///< a light casts shadows
  bool hazy = false;         ///< there is haze
  SurfaceWrites writes = SurfaceWrites::Picture;
  bool masked = false;     ///< discards fragments with less alpha than the material's cutoff
  bool glowing = false;    ///< a texture says where it emits light
  bool finished = false;   ///< a texture has roughness and metallic
  bool bumpy = false;      ///< a texture has normals
  bool occluded = false;   ///< a texture says how much light from around arrives
  bool tangents = false;   ///< the mesh has tangents; only with `bumpy`
  bool ownPlaces = false;  ///< maps have texture coordinates of their own
  bool unlit = false;      ///< shows the base colour as it is
  Surroundings surroundings = Surroundings::None;  ///< what gives light from all around
  int tones = 0;                                   ///< ToneCurve + 1; 0: the soft curve without an exposure
  Look look = Look::Full;
  /// One of many draws of a call, each with a material of its own (indirect_draws.h). Only with Picture.
  bool indirect = false;
  /// The number of lights. Negative: any number, looked up for every vertex or pixel, which a software
  /// rasteriser does lane by lane.
  int lights = -1;

  /// Index among programs that differ in the mesh, in local lights, and in what they write; the first kUsual
  /// need neither a mask nor a map beyond the base colour.
  std::size_t index() const {
    return std::size_t{textured} | std::size_t{localLights} << 1 |
           std::size_t{writes != SurfaceWrites::Picture} << 2 | std::size_t{masked} << 3 |
           std::size_t{glowing} << 4 | std::size_t{writes == SurfaceWrites::Layers} << 5 |
           std::size_t{finished} << 6 | std::size_t{bumpy} << 7 | std::size_t{occluded} << 8 |
           std::size_t{tangents} << 9 | std::size_t{ownPlaces} << 10 | std::size_t{unlit} << 11;
  }
  static constexpr std::size_t kUsual = 8;
  /// Returns true if a picture is read.
  bool pictured() const { return textured || glowing || finished || bumpy || occluded; }
};

std::string surfaceVertexShader(const SurfaceTraits& traits);
std::string surfaceFragmentShader(const SurfaceTraits& traits);
/// Depth alone, as seen from the light. Of the traits only `masked` counts, and with it `textured` and
/// `ownPlaces`.
std::string shadowVertexShader(const SurfaceTraits& traits = {});
std::string shadowFragmentShader(const SurfaceTraits& traits = {});
/// Blends the stored layers; if the picture is multisampled, each sample by itself.
std::string layerBlendVertexShader();
std::string layerBlendFragmentShader(bool sampled);
std::string skyVertexShader();
/// `tones`: as in SurfaceTraits. `pictured`: the picture of an environment is seen; in the full look.
std::string skyFragmentShader(Look look, int tones = 0, bool pictured = false);

}  // namespace stadion
