#include "engine/asset/importer_program/environment/import_environment.h"

#include "engine/asset/format.h"
#include "engine/asset/importer_program/environment/radiance_picture.h"
#include "engine/asset/importer_program/source/source_scene.h"

#include <fmt/format.h>

namespace stadion::importer {

Mesh importEnvironment(const std::string& path, std::span<const std::uint8_t> file,
                       ModelInventory& inventory) {
  const auto format = radianceFormatOf(path);
  if (!format) throw Refusal("is no picture of surroundings; use " + radianceFormats());
  RadianceMap map = *format == RadianceFormat::Hdr ? readRadianceHdr(file) : readExr(file);
  inventory.add(ContentUse::Used, fmt::format("surroundings of {} x {} pixels", map.width, map.height));
  Mesh mesh;
  mesh.materials.emplace_back();
  mesh.environment = std::make_shared<const EnvironmentLight>(environmentLight(std::move(map)));
  return mesh;
}

}  // namespace stadion::importer
