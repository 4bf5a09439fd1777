#pragma once
/// The material of a surface, and the pictures that it reads. One description feeds the programs of OpenGL and
/// the kernels of the CPU renderer.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

/// A picture: 8-bit RGBA, rows from the top, colour in sRGB, alpha linear and not premultiplied.
struct Texture {
  std::uint32_t width = 0, height = 0;  ///< [pixels], at most 8192
  std::vector<std::uint8_t> rgba;       ///< (height x width x 4)
  std::string name;                     ///< source of the picture, for messages
};

/// How a picture continues beyond its edges.
enum class WrapMode : std::uint8_t { Repeat, Mirror, Clamp };

/// Which of its smaller levels a picture is read from, where it is reduced.
enum class MipmapUse : std::uint8_t {
  Between,  ///< from two, blended
  Nearest,  ///< from one
  None,     ///< always from the picture itself
};

/// How a material reads a picture.
struct Sampler {
  WrapMode wrapU = WrapMode::Repeat, wrapV = WrapMode::Repeat;
  bool magnifiesNearest = false;  ///< where it is enlarged, its pixels are squares
  bool minifiesNearest = false;   ///< where it is reduced, one pixel of a level is read instead of four
  MipmapUse mipmaps = MipmapUse::Between;
  bool operator==(const Sampler&) const = default;
};

/// The maps that a material may have. Of the first two, colours are sRGB; the others hold numbers.
enum MapKind : std::size_t {
  kBaseMap,               ///< multiplies the base colour and its alpha
  kEmissiveMap,           ///< multiplies `emissive`, its alpha counts for nothing
  kMetallicRoughnessMap,  ///< green multiplies the roughness, blue multiplies `metallic`
  kNormalMap,             ///< normals: red along u, green against v (up in the picture), blue outwards
  kOcclusionMap,          ///< red: the part of the light from around that arrives
  kMapKinds
};
constexpr bool holdsColours(std::size_t kind) {
  return kind <= kEmissiveMap;
}

/// A map: a picture, and how it lies on the surface.
struct MaterialMap {
  static constexpr std::array<float, 6> kIdentity{1, 0, 0, 0, 1, 0};

  std::int32_t texture = -1;  ///< index into Mesh::textures, -1 = none
  Sampler sampler;
  bool secondUvs = false;                       ///< reads Mesh::secondUvs instead of Mesh::uvs
  std::array<float, 6> uvTransform{kIdentity};  ///< (2 x 3), row major: applied to the coordinates

  bool given() const { return texture >= 0; }
  /// Returns true if it lies elsewhere than the mesh's first texture coordinates say.
  bool movesUvs() const { return secondUvs || uvTransform != kIdentity; }
  bool operator==(const MaterialMap&) const = default;
};

constexpr float kMostAlphaCutoff = 2;    ///< beyond 1 nothing is left
constexpr float kMostNormalScale = 100;  ///< of a normal map

struct Material {
  std::string name;
  std::array<float, 4> baseColour{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear RGB, alpha
  std::array<float, 3> emissive{0, 0, 0};                   ///< linear RGB
  float roughness = 0.7f;                                   ///< 0 mirror .. 1 matt
  float metallic = 0.0f;
  std::array<MaterialMap, kMapKinds> maps{};  ///< by MapKind
  float normalScale = 1;                      ///< strength of the normal map, which may be negative
  float occlusionStrength = 1;                ///< 0 .. 1
  float alphaCutoff =
      0;  ///< 0 = nothing is cut out; else what has less alpha is not there, the rest is opaque
  bool doubleSided = false;
  bool partlyTransparent = false;  ///< its texture or its vertices have an alpha below 1
  bool unlit = false;              ///< shows the base colour as it is: neither light nor emission

  bool masked() const { return alphaCutoff > 0; }
  bool transparent() const { return !masked() && (baseColour[3] < 0.999f || partlyTransparent); }
};

}  // namespace stadion
