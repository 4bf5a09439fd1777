#include "engine/asset/importer_program/materials.h"

#include "engine/asset/importer_program/jail.h"
#include "engine/asset/importer_program/picture.h"
#include "engine/maths/srgb.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>

namespace stadion::importer {
namespace {

float bounded(float value, float low, float high, float otherwise) {
  return std::isfinite(value) ? std::clamp(value, low, high) : otherwise;
}

/// Alpha as glTF means it: ignored, cut at a threshold, or blended.
struct AlphaUse {
  enum Mode { Opaque, Mask, Blend } mode = Blend;
  float cutoff = 0.5f;
};

AlphaUse alphaUse(const aiMaterial& from, const FormatInfo& format) {
  AlphaUse use;
  if (format.format != ModelFormat::Gltf) return use;
  aiString mode;
  from.Get(AI_MATKEY_GLTF_ALPHAMODE, mode);
  from.Get(AI_MATKEY_GLTF_ALPHACUTOFF, use.cutoff);
  use.cutoff = bounded(use.cutoff, 0, kMostAlphaCutoff, 0.5f);
  if (mode == aiString("MASK"))
    use.mode = AlphaUse::Mask;
  else if (mode != aiString("BLEND"))
    use.mode = AlphaUse::Opaque;
  return use;
}

void applyAlpha(const AlphaUse& use, Texture& texture) {
  if (use.mode != AlphaUse::Opaque) return;
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4) texture.rgba[i] = 255;
}

std::uint8_t leastAlpha(const Texture& texture) {
  std::uint8_t least = 255;
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4) least = std::min(least, texture.rgba[i]);
  return least;
}

class Pictures {
public:
  Pictures(const aiScene& scene, const PictureSource& source, Mesh& mesh, std::vector<std::string>& notes)
      : scene_(scene), source_(source), mesh_(mesh), notes_(notes), budget_(source.limits.textureBytes) {}

  /// Index into the mesh's textures, -1 if it cannot be had; each is read once.
  std::int32_t get(const std::string& name, const AlphaUse& use) {
    const std::string key = name + '\n' + std::to_string(use.mode) + ' ' + std::to_string(use.cutoff);
    const auto known = known_.find(key);
    if (known != known_.end()) return known->second;
    Texture texture;
    texture.name = name;
    std::string why;
    std::int32_t index = -1;
    if (mesh_.textures.size() >= source_.limits.textures)
      why = "is one picture too many";
    else if (read(name, texture, why)) {
      applyAlpha(use, texture);
      index = static_cast<std::int32_t>(mesh_.textures.size());
      mesh_.textures.push_back(std::move(texture));
    }
    if (index < 0) notes_.push_back("the texture \"" + name + "\" " + why);
    return known_[key] = index;
  }

private:
  bool read(const std::string& name, Texture& texture, std::string& why) {
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(name.c_str()))
      return unpack(*embedded, texture, why);
    if (name.starts_with('*')) {
      why = "is not in the file";
      return false;
    }
    auto bytes = readBeneath(source_.root, source_.folder + name, source_.fileBytes, &why);
    if (!bytes) return false;
    return decodePicture(*bytes, source_.limits, budget_, texture, why);
  }

  bool unpack(const aiTexture& from, Texture& texture, std::string& why) {
    if (!from.pcData) {
      why = "is empty";
      return false;
    }
    if (from.mHeight == 0)
      return decodePicture({reinterpret_cast<const std::uint8_t*>(from.pcData), from.mWidth}, source_.limits,
                           budget_, texture, why);
    const std::uint64_t pixels = std::uint64_t{from.mWidth} * from.mHeight;
    if (from.mWidth > source_.limits.textureSide || from.mHeight > source_.limits.textureSide ||
        pixels * 4 > budget_) {
      why = "is too large";
      return false;
    }
    budget_ -= pixels * 4;
    texture.width = from.mWidth;
    texture.height = from.mHeight;
    for (std::uint64_t i = 0; i < pixels; ++i) {
      const aiTexel& t = from.pcData[i];
      texture.rgba.insert(texture.rgba.end(), {t.r, t.g, t.b, t.a});
    }
    return true;
  }

  const aiScene& scene_;
  const PictureSource& source_;
  Mesh& mesh_;
  std::vector<std::string>& notes_;
  std::uint64_t budget_;
  std::map<std::string, std::int32_t> known_;
};

std::optional<std::string> texturePath(const aiMaterial& from, std::initializer_list<aiTextureType> types) {
  for (const aiTextureType type : types) {
    aiString path;
    if (from.GetTexture(type, 0, &path) == aiReturn_SUCCESS && path.length > 0)
      return std::string(path.C_Str());
  }
  return std::nullopt;
}

void readColours(const aiMaterial& from, const FormatInfo& format, Material& to) {
  const auto channel = [&](float c) {
    const float value = bounded(c, 0, 1, 0);
    return format.linearColours ? value : static_cast<float>(linearFromSrgb(double{value}));
  };
  aiColor4D colour(1, 1, 1, 1);
  bool known = format.linearColours && from.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS;
  if (!known) known = from.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS;
  if (known) to.baseColour = {channel(colour.r), channel(colour.g), channel(colour.b), 1};
  float opacity = format.format == ModelFormat::Gltf ? colour.a : 1;
  from.Get(AI_MATKEY_OPACITY, opacity);
  to.baseColour[3] = bounded(opacity, 0, 1, 1);
  aiColor3D glow(0, 0, 0);
  from.Get(AI_MATKEY_COLOR_EMISSIVE, glow);
  to.emissive = {channel(glow.r), channel(glow.g), channel(glow.b)};
}

void readSurface(const aiMaterial& from, const FormatInfo& format, Material& to) {
  float shininess = 0, roughness = to.roughness, metallic = 0;
  if (format.format == ModelFormat::Gltf) {
    from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness);
    from.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
  } else if (from.Get(AI_MATKEY_SHININESS, shininess) == aiReturn_SUCCESS && shininess > 0) {
    roughness = std::sqrt(2.0f / (shininess + 2.0f));  // the Blinn-Phong lobe of the same width
  }
  to.roughness = bounded(roughness, 0, 1, 0.7f);
  to.metallic = bounded(metallic, 0, 1, 0);
}

/// Expects that the rest of `to` has been read. If the file does not state the number of sides, transparent
/// surfaces have two: the walls of a glass room are visible from within, and the far ones from outside.
void readSides(const aiMaterial& from, Material& to) {
  int twoSided = 0;
  const bool known = from.Get(AI_MATKEY_TWOSIDED, twoSided) == aiReturn_SUCCESS;
  to.doubleSided = known ? twoSided != 0 : to.transparent();
}

/// A cutoff below all alpha values cuts nothing out: the surface is opaque, and is drawn as fast as any
/// other.
void readMask(float cutoff, std::uint8_t leastOfTexture, bool alphaOfVertices, Material& to) {
  const float least = to.baseColour[3] * static_cast<float>(leastOfTexture) / 255;
  if (alphaOfVertices ? cutoff > 0 : least < cutoff)
    to.alphaCutoff = cutoff;
  else {
    to.baseColour[3] = 1;
    to.textureHasAlpha = false;
  }
}

/// A surface with a missing emissive texture does not emit. Formats other than glTF omit the factor if there
/// is a texture: it is white then.
void readGlow(const aiMaterial& from, const FormatInfo& format, Pictures& pictures, Material& to) {
  const auto path = texturePath(from, {aiTextureType_EMISSIVE, aiTextureType_EMISSION_COLOR});
  if (!path) return;
  constexpr std::array<float, 3> kDark{0, 0, 0};
  if (to.emissive == kDark && format.format != ModelFormat::Gltf) to.emissive = {1, 1, 1};
  if (to.emissive == kDark) return;
  to.emissiveTexture = pictures.get(*path, {AlphaUse::Opaque, 0});
  if (to.emissiveTexture < 0) to.emissive = kDark;
}

Material readMaterial(const aiMaterial& from, const FormatInfo& format, bool alphaOfVertices,
                      Pictures& pictures, Mesh& mesh) {
  Material to;
  aiString name;
  if (from.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) to.name = name.C_Str();
  readColours(from, format, to);
  readSurface(from, format, to);
  const AlphaUse use = alphaUse(from, format);
  if (use.mode == AlphaUse::Opaque) to.baseColour[3] = 1;
  if (const auto path = texturePath(from, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}))
    to.texture = pictures.get(*path, use);
  const std::uint8_t least =
      to.texture >= 0 ? leastAlpha(mesh.textures[static_cast<std::size_t>(to.texture)]) : 255;
  to.textureHasAlpha = least < 255;
  if (use.mode == AlphaUse::Mask) readMask(use.cutoff, least, alphaOfVertices, to);
  readGlow(from, format, pictures, to);
  readSides(from, to);
  return to;
}

}  // namespace

void readMaterials(const aiScene& scene, const FormatInfo& format, const PictureSource& pictures,
                   bool alphaOfVertices, Mesh& mesh, std::vector<std::string>& notes) {
  Pictures source(scene, pictures, mesh, notes);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i)
    mesh.materials.push_back(scene.mMaterials[i]
                                 ? readMaterial(*scene.mMaterials[i], format, alphaOfVertices, source, mesh)
                                 : Material{});
  if (mesh.materials.empty()) mesh.materials.emplace_back();
}

}  // namespace stadion::importer
