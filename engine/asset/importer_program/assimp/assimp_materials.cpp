#include "engine/asset/importer_program/assimp/assimp_scene.h"

#include "engine/maths/srgb.h"

#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace stadion::importer {
namespace {

float bounded(float value, float low, float high, float otherwise) {
  return std::isfinite(value) ? std::clamp(value, low, high) : otherwise;
}

/// Formats without a colour space are taken as sRGB.
float linearChannel(float c) {
  return static_cast<float>(linearFromSrgb(double{bounded(c, 0, 1, 0)}));
}

/// Maps that shows do not draw, by assimp's type.
constexpr std::pair<aiTextureType, const char*> kOtherMaps[]{
    {aiTextureType_SPECULAR, "specular map"},
    {aiTextureType_AMBIENT, "ambient map"},
    {aiTextureType_HEIGHT, "height map"},
    {aiTextureType_SHININESS, "shininess map"},
    {aiTextureType_DISPLACEMENT, "displacement map"},
    {aiTextureType_LIGHTMAP, "light map"},
    {aiTextureType_REFLECTION, "reflection map"},
    {aiTextureType_SHEEN, "sheen map"},
    {aiTextureType_CLEARCOAT, "clearcoat map"},
    {aiTextureType_TRANSMISSION, "transmission map"},
    {aiTextureType_UNKNOWN, "map of an unknown kind"}};

/// The images of assimp's materials, each once.
class AssimpImages {
public:
  AssimpImages(const aiScene& scene, const FormatInfo& format, SourceScene& to)
      : scene_(scene), format_(format), to_(to) {}

  std::int32_t add(const std::string& name) {
    const auto [at, isNew] = known_.try_emplace(name, static_cast<std::int32_t>(to_.images.size()));
    if (isNew) to_.images.push_back(imageOf(name));
    return at->second;
  }

private:
  SourceImage imageOf(const std::string& name) const {
    SourceImage image;
    image.name = name;
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(name.c_str()))
      unpack(*embedded, image);
    else if (!name.starts_with('*'))
      image.file = name;
    // FBX files often name pictures where they lay on the author's machine.
    if (format_.format == ModelFormat::Fbx)
      image.otherPlaces.push_back(name.substr(name.find_last_of("/\\") + 1));
    return image;
  }

  static void unpack(const aiTexture& from, SourceImage& image) {
    if (!from.pcData) return;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(from.pcData);
    if (from.mHeight == 0) {
      image.bytes.assign(bytes, bytes + from.mWidth);
      return;
    }
    image.width = from.mWidth;
    image.height = from.mHeight;
    const std::uint64_t pixels = std::uint64_t{from.mWidth} * from.mHeight;
    for (std::uint64_t i = 0; i < pixels; ++i) {
      const aiTexel& t = from.pcData[i];
      image.bytes.insert(image.bytes.end(), {t.r, t.g, t.b, t.a});
    }
  }

  const aiScene& scene_;
  const FormatInfo& format_;
  SourceScene& to_;
  std::map<std::string, std::int32_t> known_;
};

WrapMode wrapMode(int mode) {
  if (mode == aiTextureMapMode_Mirror) return WrapMode::Mirror;
  return mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? WrapMode::Clamp
                                                                          : WrapMode::Repeat;
}

class AssimpMaterial {
public:
  AssimpMaterial(const aiMaterial& from, const FormatInfo& format, AssimpImages& images)
      : from_(from), format_(format), images_(images) {}

  SourceMaterial read() {
    aiString name;
    if (from_.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) to_.name = name.C_Str();
    readColours();
    readRoughness();
    readMaps();
    int twoSided = 0;
    if (from_.Get(AI_MATKEY_TWOSIDED, twoSided) == aiReturn_SUCCESS) to_.doubleSided = twoSided != 0;
    return std::move(to_);
  }

private:
  void readColours() {
    aiColor4D colour(1, 1, 1, 1);
    if (from_.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS)
      to_.baseColour = {linearChannel(colour.r), linearChannel(colour.g), linearChannel(colour.b), 1};
    float opacity = 1;
    from_.Get(AI_MATKEY_OPACITY, opacity);
    to_.baseColour[3] = bounded(opacity, 0, 1, 1);
    aiColor3D glow(0, 0, 0);
    from_.Get(AI_MATKEY_COLOR_EMISSIVE, glow);
    to_.emissive = {linearChannel(glow.r), linearChannel(glow.g), linearChannel(glow.b)};
  }

  void readRoughness() {
    float shininess = 0, value = 0;
    if (from_.Get(AI_MATKEY_METALLIC_FACTOR, value) == aiReturn_SUCCESS)
      to_.metallic = bounded(value, 0, 1, 0);
    if (from_.Get(AI_MATKEY_ROUGHNESS_FACTOR, value) == aiReturn_SUCCESS) {
      to_.roughness = bounded(value, 0, 1, 0.7f);
      return;
    }
    if (from_.Get(AI_MATKEY_SHININESS, shininess) != aiReturn_SUCCESS || !(shininess > 0)) return;
    // the Blinn-Phong lobe of the same width
    to_.roughness = bounded(std::sqrt(2.0f / (shininess + 2.0f)), 0, 1, 0.7f);
  }

  bool states(const char* key, unsigned type, unsigned index) const {
    float value = 0;
    return from_.Get(key, type, index, value) == aiReturn_SUCCESS;
  }

  SourceTexture texture(aiTextureType type) {
    SourceTexture to;
    aiString path;
    if (from_.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0) return to;
    to.image = images_.add(path.C_Str());
    int set = 0, u = 0, v = 0;
    from_.Get(AI_MATKEY_UVWSRC(type, 0), set);
    from_.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), u);
    from_.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), v);
    to.uvSet = set > 0 ? static_cast<std::uint32_t>(set) : 0;
    to.sampler.wrapU = wrapMode(u);
    to.sampler.wrapV = wrapMode(v);
    return to;
  }

  void readMaps() {
    to_.baseMap = texture(aiTextureType_BASE_COLOR);
    if (!to_.baseMap.given()) to_.baseMap = texture(aiTextureType_DIFFUSE);
    to_.emissiveMap = texture(aiTextureType_EMISSIVE);
    if (!to_.emissiveMap.given()) to_.emissiveMap = texture(aiTextureType_EMISSION_COLOR);
    // The factor is white if the file omits it.
    if (to_.emissiveMap.given() && to_.emissive == Float3{0, 0, 0}) to_.emissive = {1, 1, 1};
    to_.normalMap = texture(aiTextureType_NORMALS);
    if (!to_.normalMap.given()) to_.normalMap = texture(aiTextureType_NORMAL_CAMERA);
    to_.occlusionMap = texture(aiTextureType_AMBIENT_OCCLUSION);
    to_.roughnessMap = texture(aiTextureType_DIFFUSE_ROUGHNESS);
    to_.metallicMap = texture(aiTextureType_METALNESS);
    if (to_.roughnessMap.given() && !states(AI_MATKEY_ROUGHNESS_FACTOR)) to_.roughness = 1;
    if (to_.metallicMap.given() && !states(AI_MATKEY_METALLIC_FACTOR)) to_.metallic = 1;
    const SourceTexture opacity = texture(aiTextureType_OPACITY);
    if (format_.format == ModelFormat::Obj)
      to_.opacityMap = opacity;
    else if (opacity.given() && opacity.image != to_.baseMap.image)
      to_.otherMaps.push_back({"opacity map", opacity});
    for (const auto& [type, name] : kOtherMaps)
      if (const SourceTexture map = texture(type); map.given()) to_.otherMaps.push_back({name, map});
  }

  const aiMaterial& from_;
  const FormatInfo& format_;
  AssimpImages& images_;
  SourceMaterial to_;
};

}  // namespace

void convertMaterials(const aiScene& scene, const FormatInfo& format, SourceScene& to) {
  AssimpImages images(scene, format, to);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i)
    to.materials.push_back(scene.mMaterials[i] ? AssimpMaterial(*scene.mMaterials[i], format, images).read()
                                               : SourceMaterial{});
}

}  // namespace stadion::importer
