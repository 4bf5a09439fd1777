#pragma once
/// The text of OBJ and MTL files, checked and mended before assimp reads it.
///
/// assimp overlooks numbers that begin with a point (`v .5 0 1`), names no place in its errors, and overlooks
/// the scale and offset of maps (`map_Kd -s 2 2 1 wood.png`).

#include "engine/asset/importer_program/source/source_scene.h"

#include <map>

namespace stadion::importer {

/// Returns the text with its numbers as assimp reads them; nothing if the text needs no change.
/// Throws Refusal, with line and column, if a vertex, a texture coordinate, a normal or a face is wrong.
std::optional<std::vector<std::uint8_t>> mendedObj(const std::vector<std::uint8_t>& file);

/// The names behind `mtllib`.
std::vector<std::string> materialLibraries(const std::vector<std::uint8_t>& file);

/// What an MTL file says of a map beside its name.
struct MapOptions {
  UvTransform transform;
  bool clamp = false;
};

/// What assimp does not tell of an OBJ file's materials.
struct ObjNotes {
  struct Missing {
    std::string file, why;
  };
  std::vector<Missing> missing;
  /// By the material's name, then by keyword ("map_Kd").
  std::map<std::string, std::map<std::string, MapOptions>> options;
  std::vector<std::string> otherOptions;  ///< "-mm of \"wood\"": options that are left out
};

/// Takes the options of maps out of an MTL file and into `notes`. Returns nothing if it has none.
std::optional<std::vector<std::uint8_t>> mendedMaterials(const std::vector<std::uint8_t>& file,
                                                         ObjNotes& notes);

/// Adds to a scene what assimp did not tell.
void apply(const ObjNotes& notes, SourceScene& scene);

}  // namespace stadion::importer
