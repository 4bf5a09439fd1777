#include "engine/asset/importer_program/import_model.h"

#include "engine/asset/importer_program/assimp/assimp_reader.h"
#include "engine/asset/importer_program/environment/import_environment.h"
#include "engine/asset/importer_program/gltf/gltf_reader.h"
#include "engine/asset/importer_program/mesh/figure_joints.h"
#include "engine/asset/importer_program/mesh/geometry.h"
#include "engine/asset/importer_program/mesh/lights_and_cameras.h"
#include "engine/asset/importer_program/mesh/materials.h"
#include "engine/asset/importer_program/mesh/tangents.h"
#include "engine/asset/importer_program/source/contents.h"
#include "engine/asset/importer_program/source/model_files.h"
#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>

namespace stadion::importer {
namespace {

/// By material, whether vertices with it have an alpha below 1.
std::vector<bool> alphaOfVertices(const Flat& flat, std::size_t materials) {
  std::vector<bool> below(materials, false);
  for (const FlatTriangle& t : flat.triangles)
    for (const std::uint32_t c : t.corner)
      if (flat.vertices[c].colour[3] != 255 && t.material < materials) below[t.material] = true;
  return below;
}

void addDropped(const DroppedTriangles& dropped, ModelInventory& inventory) {
  if (dropped.notFinite)
    inventory.add(ContentUse::LeftOut, counted(dropped.notFinite, "triangle with a corner that is no number",
                                               "triangles with a corner that is no number"));
  if (dropped.degenerate)
    inventory.add(ContentUse::LeftOut,
                  counted(dropped.degenerate, "triangle without area", "triangles without area"));
}

std::vector<std::uint8_t> contentOf(const Request& request) {
  std::string why;
  auto file = readBeneath(request.root.get(), request.path, request.head.fileBytes, &why);
  if (!file) throw Refusal(why);
  if (file->empty()) throw Refusal("is empty");
  return std::move(*file);
}

SourceScene readScene(const Request& request) {
  const FormatInfo* format = formatOf(request.path);
  if (!format) throw Refusal("is not in a format for shows; use " + allowedFormats());
  const std::vector<std::uint8_t> file = contentOf(request);
  return format->format == ModelFormat::Gltf ? readGltf(request, file)
                                             : readWithAssimp(request, *format, file);
}

bool isFigure(const SourceScene& scene, ModelForm form) {
  return form == ModelForm::Figure ||
         (form == ModelForm::Either && !(scene.skins.empty() && scene.clips.empty()));
}

Flat flattenFigure(const SourceScene& scene, const FlattenLimits& limits, ImportedModel& result) {
  const FigureJoints joints(scene, limits.mesh.skeleton);
  result.mesh.skeleton = std::make_shared<const Skeleton>(joints.skeleton(result.inventory));
  return flattenFigure(scene, joints, limits);
}

PictureSource picturesOf(const Request& request) {
  return {request.root.get(), request.path.substr(0, request.path.rfind('/') + 1), request.head.fileBytes,
          request.head.mesh};
}

ImportedModel environmentOf(const Request& request) {
  ImportedModel result;
  result.mesh = importEnvironment(request.path, contentOf(request), result.inventory);
  return result;
}

}  // namespace

ImportedModel importModel(const Request& request) {
  if (request.head.form == ModelForm::Environment) return environmentOf(request);
  const SourceScene scene = readScene(request);
  ImportedModel result;
  const bool figure = isFigure(scene, request.head.form);
  takeInventory(scene, figure, result.inventory);
  const FlattenLimits limits{request.head.nodeDepth, request.head.mesh};
  const NodeChoice choice(scene, figure ? NodeSelection{} : request.nodes);
  Flat flat = figure ? flattenFigure(scene, limits, result) : flatten(scene, choice, limits);
  result.mesh.place = choice.place();
  readLightsAndCameras(scene, choice, limits.mesh, result.mesh, result.inventory);
  const DroppedTriangles dropped = dropBadTriangles(flat);
  addDropped(dropped, result.inventory);
  if (flat.triangles.empty() && !choice.hasGaps())
    throw Refusal(dropped.notFinite ? "holds no triangles with finite corners" : "holds no triangles");
  readMaterials(scene, picturesOf(request), alphaOfVertices(flat, scene.materials.size()), result.mesh,
                result.inventory);
  makeNormals(flat);
  makeTangents(result.mesh.materials, flat);
  turnMirrored(flat);
  joinInto(flat, result.mesh);
  return result;
}

}  // namespace stadion::importer
