#include "engine/asset/importer_program/source/source_scene.h"

namespace stadion::importer {

std::array<const SourceTexture*, kMapKinds> drawnMaps(const SourceMaterial& m) {
  std::array<const SourceTexture*, kMapKinds> maps{};
  const auto set = [&](MapKind kind, const SourceTexture& map) {
    if (map.given()) maps[kind] = &map;
  };
  set(kBaseMap, m.baseMap);
  if (m.unlit) return maps;
  if (m.emissive != Float3{0, 0, 0}) set(kEmissiveMap, m.emissiveMap);
  for (const SourceTexture* map : {&m.metallicMap, &m.roughnessMap, &m.metallicRoughnessMap})
    set(kMetallicRoughnessMap, *map);
  set(kNormalMap, m.normalMap);
  set(kOcclusionMap, m.occlusionMap);
  return maps;
}

std::optional<UvSource> commonUvSource(const SourceMaterial& m) {
  std::optional<UvSource> common;
  for (const SourceTexture* map : drawnMaps(m)) {
    if (!map) continue;
    if (common && *common != uvSourceOf(*map)) return std::nullopt;
    common = uvSourceOf(*map);
  }
  return common ? common : UvSource{};
}

}  // namespace stadion::importer
