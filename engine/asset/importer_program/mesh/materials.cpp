#include "engine/asset/importer_program/mesh/materials.h"

#include "engine/asset/importer_program/mesh/pictures.h"

#include <algorithm>

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
    to.textureHasAlpha = false;
  }
}

/// A surface with a missing emissive texture does not emit, and neither does one whose emissive map takes
/// other texture coordinates than its base colour.
void readGlow(const SourceMaterial& from, Pictures& pictures, Material& to) {
  to.emissive = from.emissive;
  if (!from.emissiveMap.given() || to.emissive == kDark) return;
  const UvSource own{from.emissiveMap.uvSet, from.emissiveMap.transform};
  to.emissiveTexture = own == uvSourceOf(from) ? pictures.get(from.emissiveMap.image, AlphaUse::Ignored) : -1;
  if (to.emissiveTexture < 0) to.emissive = kDark;
}

std::int32_t readBase(const SourceMaterial& from, Pictures& pictures) {
  const bool opaque = from.alphaMode == AlphaMode::Opaque;
  if (from.opacityMap.given() && from.opacityMap.image != from.baseMap.image && !opaque)
    return pictures.getWithOpacity(from.baseMap.image, from.opacityMap.image);
  if (!from.baseMap.given()) return -1;
  return pictures.get(from.baseMap.image, opaque ? AlphaUse::Ignored : AlphaUse::Kept);
}

Material readMaterial(const SourceMaterial& from, bool alphaOfVertices, Pictures& pictures, Mesh& mesh) {
  Material to;
  to.name = from.name;
  to.baseColour = from.baseColour;
  to.roughness = from.roughness;
  to.metallic = from.metallic;
  if (from.alphaMode == AlphaMode::Opaque) to.baseColour[3] = 1;
  to.texture = readBase(from, pictures);
  const std::uint8_t least =
      to.texture >= 0 ? leastAlpha(mesh.textures[static_cast<std::size_t>(to.texture)]) : 255;
  to.textureHasAlpha = least < 255;
  if (from.alphaMode == AlphaMode::Mask) readMask(from.alphaCutoff, least, alphaOfVertices, to);
  readGlow(from, pictures, to);
  // If the file does not state the number of sides, transparent surfaces have two: the walls of a glass room
  // are visible from within, and the far ones from outside.
  to.doubleSided = from.doubleSided.value_or(to.transparent());
  return to;
}

}  // namespace

void readMaterials(const SourceScene& scene, const PictureSource& source, bool alphaOfVertices, Mesh& mesh,
                   ModelInventory& inventory) {
  Pictures pictures(scene, source, mesh, inventory);
  for (const SourceMaterial& from : scene.materials)
    mesh.materials.push_back(readMaterial(from, alphaOfVertices, pictures, mesh));
  if (mesh.materials.empty()) mesh.materials.emplace_back();
}

}  // namespace stadion::importer
