#include "engine/asset/importer_program/mesh/materials.h"

#include "engine/asset/importer_program/mesh/pictures.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion::importer {
namespace {

constexpr Float3 kDark{0, 0, 0};

std::uint8_t leastAlpha(const Texture& texture) {
  std::uint8_t least = 255;
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4) least = std::min(least, texture.rgba[i]);
  return least;
}

/// A cutoff below all alpha values cuts nothing out: the surface is opaque, and is drawn as fast as any
/// other.
void readMask(float cutoff, std::uint8_t leastOfTexture, bool alphaOfVertices, Material& to) {
  const float least = to.baseColour[3] * static_cast<float>(leastOfTexture) / 255;
  if (alphaOfVertices ? cutoff > 0 : least < cutoff)
    to.alphaCutoff = cutoff;
  else {
    to.baseColour[3] = 1;
    to.partlyTransparent = false;
  }
}

/// As rows of a matrix.
std::array<float, 6> matrixOf(const UvTransform& t) {
  const double cosine = det::cos(double{t.rotation}), sine = det::sin(double{t.rotation});
  const auto row = [&](double u, double v, float offset) {
    return std::array<float, 3>{static_cast<float>(u * double{t.scale[0]}),
                                static_cast<float>(v * double{t.scale[1]}), offset};
  };
  const auto x = row(cosine, sine, t.offset[0]), y = row(-sine, cosine, t.offset[1]);
  const std::array<float, 6> matrix{x[0], x[1], x[2], y[0], y[1], y[2]};
  const auto isUsable = [](float f) { return std::abs(f) < 1e6f; };
  return std::ranges::all_of(matrix, isUsable) ? matrix : MaterialMap::kIdentity;
}

/// `own`: the coordinates are the file's, so the map has its transform.
void readUse(const SourceTexture& from, bool own, MaterialMap& to) {
  to.sampler = from.sampler;
  if (!own) return;
  const UvSource source = uvSourceOf(from);
  to.secondUvs = source.set == 1;
  if (source.transform != UvTransform{}) to.uvTransform = matrixOf(source.transform);
}

/// Roughness and metallic maps of their own become one.
std::int32_t furtherMap(const SourceMaterial& from, std::size_t kind, const SourceTexture& map,
                        Pictures& pictures) {
  if (kind == kMetallicRoughnessMap && !from.metallicRoughnessMap.given())
    return pictures.getMetallicRoughness(from.roughnessMap.image, from.metallicMap.image);
  return pictures.get(map.image, AlphaUse::Ignored);
}

/// All but the base colour. A surface with a missing emissive texture does not emit.
void readFurtherMaps(const SourceMaterial& from, Pictures& pictures, Material& to) {
  const auto maps = drawnMaps(from);
  for (std::size_t kind = kBaseMap + 1; kind < kMapKinds; ++kind)
    if (maps[kind]) to.maps[kind].texture = furtherMap(from, kind, *maps[kind], pictures);
  const bool own = !commonUvSource(from);
  for (std::size_t kind = 0; kind < kMapKinds; ++kind)
    if (maps[kind] && to.maps[kind].given()) readUse(*maps[kind], own, to.maps[kind]);
  to.emissive = maps[kEmissiveMap] && !to.maps[kEmissiveMap].given() ? kDark : from.emissive;
  to.normalScale = from.normalMap.strength;
  to.occlusionStrength = from.occlusionMap.strength;
}

std::int32_t readBase(const SourceMaterial& from, Pictures& pictures) {
  const bool opaque = from.alphaMode == AlphaMode::Opaque;
  if (from.opacityMap.given() && from.opacityMap.image != from.baseMap.image && !opaque)
    return pictures.getWithOpacity(from.baseMap.image, from.opacityMap.image);
  if (!from.baseMap.given()) return -1;
  return pictures.get(from.baseMap.image, opaque ? AlphaUse::Ignored : AlphaUse::Kept);
}

/// A dielectric under a coat reflects as much as the coat does, but more widely: it gets the coat's roughness. A
/// metal keeps its own.
float roughnessUnderCoat(const SourceMaterial& from) {
  const float part = from.clearcoat * (1 - from.metallic);
  return from.roughness + part * (from.clearcoatRoughness - from.roughness);
}

/// Part of the alpha that glass keeps: some of it stays visible.
float alphaOfGlass(const SourceMaterial& from) {
  constexpr float kClearest = 0.9f;
  return 1 - kClearest * from.transmission * (1 - from.metallic);
}

Material readMaterial(const SourceMaterial& from, bool alphaOfVertices, Pictures& pictures, Mesh& mesh) {
  Material to;
  to.name = from.name;
  to.baseColour = from.baseColour;
  to.roughness = roughnessUnderCoat(from);
  to.metallic = from.metallic;
  if (from.alphaMode == AlphaMode::Opaque) to.baseColour[3] = 1;
  if (from.alphaMode != AlphaMode::Mask) to.baseColour[3] *= alphaOfGlass(from);
  to.unlit = from.unlit;
  const std::int32_t base = to.maps[kBaseMap].texture = readBase(from, pictures);
  const std::uint8_t least = base >= 0 ? leastAlpha(mesh.textures[static_cast<std::size_t>(base)]) : 255;
  to.partlyTransparent = least < 255 || (alphaOfVertices && from.alphaMode == AlphaMode::Blend);
  if (from.alphaMode == AlphaMode::Mask) readMask(from.alphaCutoff, least, alphaOfVertices, to);
  readFurtherMaps(from, pictures, to);
  // If the file does not state the number of sides, transparent surfaces have two: the walls of a glass room
  // are visible from within, and the far ones from outside.
  to.doubleSided = from.doubleSided.value_or(to.transparent());
  return to;
}

}  // namespace

void readMaterials(const SourceScene& scene, const PictureSource& source,
                   const std::vector<bool>& alphaOfVertices, Mesh& mesh, ModelInventory& inventory) {
  Pictures pictures(scene, source, mesh, inventory);
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    mesh.materials.push_back(
        readMaterial(scene.materials[i], i < alphaOfVertices.size() && alphaOfVertices[i], pictures, mesh));
  if (mesh.materials.empty()) mesh.materials.emplace_back();
}

}  // namespace stadion::importer
