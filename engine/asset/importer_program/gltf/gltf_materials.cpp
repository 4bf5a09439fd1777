#include "engine/asset/importer_program/gltf/gltf_parts.h"

#include "engine/asset/importer_program/gltf/uri.h"
#include "engine/asset/importer_program/source/name_list.h"
#include "engine/asset/mesh.h"

#include <algorithm>
#include <cmath>

namespace stadion::importer {
namespace {

SourceImage gltfImage(GltfDocument& document, const GltfValue& value, std::size_t number) {
  SourceImage image;
  const std::string uri = value.text("uri");
  if (isDataUri(uri)) {
    auto bytes = dataOf(uri);
    if (!bytes) value.refuse("its data is not base64");
    image.bytes = std::move(*bytes);
  } else if (!uri.empty()) {
    image.file = percentDecoded(uri);
  } else if (const auto view = value.index("bufferView", document.viewCount())) {
    const GltfView from = document.view(*view);
    image.bytes.assign(from.bytes.begin(), from.bytes.end());
  }
  image.name = !nameOf(value).empty() ? nameOf(value)
               : !image.file.empty()  ? image.file
                                      : "image " + std::to_string(number);
  return image;
}

WrapMode gltfWrap(const GltfValue& sampler, const char* key) {
  const std::uint64_t mode = sampler.count(key, 10497);
  if (mode == 33071) return WrapMode::Clamp;
  return mode == 33648 ? WrapMode::Mirror : WrapMode::Repeat;
}

/// A file that states no filter gets the best one.
Sampler gltfSampler(const GltfValue& from) {
  constexpr std::uint64_t kNearest = 9728, kLinear = 9729, kNearestNearest = 9984, kLinearNearest = 9985,
                          kNearestBetween = 9986, kLinearBetween = 9987;
  const std::uint64_t least = from.count("minFilter", kLinearBetween);
  Sampler to;
  to.wrapU = gltfWrap(from, "wrapS");
  to.wrapV = gltfWrap(from, "wrapT");
  to.magnifiesNearest = from.count("magFilter", kLinear) == kNearest;
  to.minifiesNearest = least == kNearest || least == kNearestNearest || least == kNearestBetween;
  if (least == kNearest || least == kLinear) to.mipmaps = MipmapUse::None;
  if (least == kNearestNearest || least == kLinearNearest) to.mipmaps = MipmapUse::Nearest;
  return to;
}

float factor(float value, float otherwise = 1) {
  return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : otherwise;
}

class GltfMaterials {
public:
  GltfMaterials(GltfDocument& document, SourceScene& to)
      : document_(document), to_(to), textures_(document.root().objects("textures", "texture")),
        samplers_(document.root().objects("samplers", "sampler")) {}

  void read() {
    for (const GltfValue& image : document_.root().objects("images", "image"))
      to_.images.push_back(gltfImage(document_, image, to_.images.size()));
    for (const GltfValue& material : document_.root().objects("materials", "material"))
      to_.materials.push_back(materialOf(material));
    const GltfJson none = GltfJson::object();
    to_.materials.push_back(materialOf({none, {}}));
    to_.materials.back().name = "default";
  }

private:
  /// The picture of a texture: that of an extension if shows can read it.
  std::int32_t imageOf(const GltfValue& texture) const {
    const std::size_t images = to_.images.size();
    auto image = texture.extension("EXT_texture_webp").index("source", images);
    if (!image) image = texture.index("source", images);
    return image ? static_cast<std::int32_t>(*image) : -1;
  }

  SourceTexture texture(const GltfValue& owner, const char* key) {
    SourceTexture to;
    if (!owner.has(key)) return to;
    const GltfValue info = owner.object(key), moved = info.extension("KHR_texture_transform");
    const auto number = info.index("index", textures_.size());
    if (!number) return to;
    const GltfValue& from = textures_[*number];
    to.image = imageOf(from);
    if (!to.given()) noteWithoutPicture(from);
    to.uvSet = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(moved.count("texCoord", info.count("texCoord", 0)), 1000));
    to.transform = {moved.reals<2>("offset", {0, 0}), moved.reals<2>("scale", {1, 1}),
                    moved.real("rotation", 0)};
    if (!(std::abs(to.transform.rotation) < 1e6f)) to.transform.rotation = 0;
    to.strength = strengthOf(info, key);
    if (const auto sampler = from.index("sampler", samplers_.size()))
      to.sampler = gltfSampler(samplers_[*sampler]);
    return to;
  }

  /// The scale of a normal map or the strength of an occlusion map.
  float strengthOf(const GltfValue& info, const std::string& key) {
    if (key == "normalTexture")
      return bounded(info, "scale", {-kMostNormalScale, kMostNormalScale}, "the scale of the normal map");
    if (key != "occlusionTexture") return 1;
    return bounded(info, "strength", {0, 1}, "the strength of the occlusion map");
  }
  struct Limits {
    float least, most;
  };
  float bounded(const GltfValue& info, const char* key, const Limits& limits, const char* what) {
    const double value = info.number(key, 1), inside = std::clamp<double>(value, limits.least, limits.most);
    if (value == inside) return static_cast<float>(value);
    to_.notes.push_back({ContentUse::Approximated,
                         std::string(what) + " of " + info.place() + ": the nearest that can be is used"});
    return std::isfinite(value) ? static_cast<float>(inside) : 1;
  }

  void noteWithoutPicture(const GltfValue& texture) {
    to_.notes.push_back(
        {ContentUse::LeftOut, texture.place() + ": its picture is in no format that shows read"});
  }

  SourceMaterial materialOf(const GltfValue& from) {
    SourceMaterial to;
    to.name = nameOf(from);
    readSurface(from.object("pbrMetallicRoughness"), to);
    if (from.hasExtension("KHR_materials_pbrSpecularGlossiness"))
      readGlossiness(from.extension("KHR_materials_pbrSpecularGlossiness"), to);
    readEmission(from, to);
    readAlpha(from, to);
    to.normalMap = texture(from, "normalTexture");
    to.occlusionMap = texture(from, "occlusionTexture");
    to.doubleSided = from.flag("doubleSided", false);
    to.unlit = from.hasExtension("KHR_materials_unlit");
    readLayers(from, to);
    readOtherMaps(from, to);
    return to;
  }

  void readSurface(const GltfValue& from, SourceMaterial& to) {
    to.baseColour = from.reals<4>("baseColorFactor", {1, 1, 1, 1});
    for (float& c : to.baseColour) c = factor(c);
    to.roughness = factor(from.real("roughnessFactor", 1));
    to.metallic = factor(from.real("metallicFactor", 1));
    to.baseMap = texture(from, "baseColorTexture");
    to.metallicRoughnessMap = texture(from, "metallicRoughnessTexture");
  }

  void readGlossiness(const GltfValue& from, SourceMaterial& to) {
    to.specularGlossiness = true;
    to.baseColour = from.reals<4>("diffuseFactor", {1, 1, 1, 1});
    for (float& c : to.baseColour) c = factor(c);
    to.roughness = 1 - factor(from.real("glossinessFactor", 1));
    to.metallic = 0;
    to.baseMap = texture(from, "diffuseTexture");
    if (const SourceTexture map = texture(from, "specularGlossinessTexture"); map.given())
      to.otherMaps.push_back({"specular-glossiness map", map});
  }

  void readLayers(const GltfValue& from, SourceMaterial& to) {
    const GltfValue coat = from.extension("KHR_materials_clearcoat");
    to.clearcoat = factor(coat.real("clearcoatFactor", 0), 0);
    to.clearcoatRoughness = factor(coat.real("clearcoatRoughnessFactor", 0), 0);
    const GltfValue glass = from.extension("KHR_materials_transmission");
    to.transmission = factor(glass.real("transmissionFactor", 0), 0);
  }

  void readEmission(const GltfValue& from, SourceMaterial& to) {
    const float strength = from.extension("KHR_materials_emissive_strength").real("emissiveStrength", 1);
    to.emissive = from.reals<3>("emissiveFactor", {0, 0, 0});
    for (float& c : to.emissive) c = factor(c, 0) * std::clamp(strength, 0.0f, 1000.0f);
    to.emissiveMap = texture(from, "emissiveTexture");
  }

  static void readAlpha(const GltfValue& from, SourceMaterial& to) {
    const std::string mode = from.text("alphaMode");
    to.alphaMode = mode == "MASK" ? AlphaMode::Mask : mode == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
    to.alphaCutoff = std::clamp(from.real("alphaCutoff", 0.5f), 0.0f, kMostAlphaCutoff);
  }

  /// Maps of extensions: each is a member that ends in "Texture".
  void readOtherMaps(const GltfValue& from, SourceMaterial& to) {
    const GltfValue extensions = from.object("extensions");
    for (const std::string& name : extensions.keys()) {
      if (!name.starts_with("KHR_materials_") || name == "KHR_materials_pbrSpecularGlossiness") continue;
      const GltfValue extension = extensions.object(name.c_str());
      for (const std::string& key : extension.keys())
        if (key.ends_with("Texture"))
          if (const SourceTexture map = texture(extension, key.c_str()); map.given())
            to.otherMaps.push_back({"map " + inQuotes(key), map});
    }
  }

  GltfDocument& document_;
  SourceScene& to_;
  std::vector<GltfValue> textures_, samplers_;
};

}  // namespace

void readGltfMaterials(GltfDocument& document, SourceScene& to) {
  GltfMaterials(document, to).read();
}

}  // namespace stadion::importer
