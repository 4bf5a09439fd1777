#include "engine/asset/importer_program/assimp/assimp_reader.h"

#include "engine/asset/importer_program/assimp/assimp_scene.h"
#include "engine/asset/importer_program/assimp/axes.h"
#include "engine/asset/importer_program/assimp/jail.h"
#include "engine/asset/importer_program/assimp/obj_text.h"
#include "engine/asset/importer_program/source/model_files.h"
#include "engine/asset/importer_program/source/name_list.h"

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>

#include <memory>
#include <new>
#include <string_view>

namespace stadion::importer {
namespace {

// Only the loader of this very format stays, so that no file reaches another by its content.
void keepOneLoader(Assimp::Importer& importer, const FormatInfo& format) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (std::string_view(importer.GetImporterInfo(i)->mName) == format.loader) continue;
    Assimp::BaseImporter* loader = importer.GetImporter(i);
    if (importer.UnregisterLoader(loader) == aiReturn_SUCCESS) delete loader;
  }
}

// assimp's own steps trust the indices that its loaders made of the file, so they are looked at before.
void checkNode(const aiScene& scene, const aiNode& node, std::uint32_t depthLeft) {
  const std::string name = "has, in node " + inQuotes(node.mName.C_Str()) + ", ";
  if (depthLeft == 0) throw Refusal("nests its nodes too deep");
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    if (node.mMeshes[i] >= scene.mNumMeshes) throw Refusal(name + "a mesh that does not exist");
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    if (node.mChildren[i]) checkNode(scene, *node.mChildren[i], depthLeft - 1);
}

void checkMesh(const aiMesh& mesh, const MeshLimits& limits) {
  const std::string name = "has, in mesh " + inQuotes(mesh.mName.C_Str()) + ", ";
  if (mesh.mNumVertices > limits.vertices) throw Refusal(name + "too many vertices");
  for (unsigned f = 0; f < mesh.mNumFaces; ++f)
    for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
      if (mesh.mFaces[f].mIndices[k] >= mesh.mNumVertices)
        throw Refusal(name + "a face with a vertex that does not exist");
}

void checkScene(const aiScene& scene, const RequestHead& head) {
  if (!scene.mRootNode) throw Refusal("holds no scene");
  checkNode(scene, *scene.mRootNode, head.nodeDepth);
  bool faces = false;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (!scene.mMeshes[i]) throw Refusal("has a mesh without content");
    checkMesh(*scene.mMeshes[i], head.mesh);
    faces |= scene.mMeshes[i]->mNumFaces > 0;
  }
  if (!faces) throw Refusal("holds no triangles");
}

[[noreturn]] void refuse(const FormatInfo& format, const std::string& why) {
  if (why.find("bad_alloc") != std::string::npos || why.find("length_error") != std::string::npos)
    throw std::bad_alloc();
  if (why.find("No meshes remaining") != std::string::npos) throw Refusal("holds no triangles");
  throw Refusal("cannot be read as " + std::string(format.name) + (why.empty() ? "" : ": " + why));
}

std::string folderOf(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

/// Gives assimp the text of an OBJ file and its libraries as it can read them.
void mendObj(const Request& request, const std::vector<std::uint8_t>& file, Jail& jail, ObjNotes& notes) {
  if (auto mended = mendedObj(file)) jail.replace(request.path, std::move(*mended));
  for (const std::string& name : materialLibraries(file)) {
    const std::string path = folderOf(request.path) + name;
    std::string why;
    const auto bytes = readBeneath(request.root.get(), path, request.head.fileBytes, &why);
    if (!bytes)
      notes.missing.push_back({name, why});
    else if (auto mended = mendedMaterials(*bytes, notes))
      jail.replace(path, std::move(*mended));
  }
}

// Points and lines are counted here, because the next step takes them out.
void countOthers(const aiScene& scene, SourceScene& to) {
  std::size_t points = 0, lines = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i)
    for (unsigned f = 0; f < scene.mMeshes[i]->mNumFaces; ++f) {
      points += scene.mMeshes[i]->mFaces[f].mNumIndices == 1;
      lines += scene.mMeshes[i]->mFaces[f].mNumIndices == 2;
    }
  if (lines > 0) to.notes.push_back({ContentUse::LeftOut, counted(lines, "line")});
  if (points > 0) to.notes.push_back({ContentUse::LeftOut, counted(points, "point")});
}

const aiScene& readScene(Assimp::Importer& importer, const Request& request, const FormatInfo& format,
                         std::unique_ptr<Jail> jail, SourceScene& to) {
  importer.SetIOHandler(jail.release());  // assimp owns it
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, request.head.up != 0);
  keepOneLoader(importer, format);
  const aiScene* scene = importer.ReadFile(request.path, 0);
  if (!scene) refuse(format, importer.GetErrorString());
  checkScene(*scene, request.head);
  countOthers(*scene, to);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
  if (!scene) refuse(format, importer.GetErrorString());
  return *scene;
}

// 3DS files hold no normals, and those of STL files say nothing about smoothness.
bool givesNormals(ModelFormat format) {
  return format != ModelFormat::Stl && format != ModelFormat::ThreeDs;
}

}  // namespace

SourceScene readWithAssimp(const Request& request, const FormatInfo& format,
                           const std::vector<std::uint8_t>& file) {
  auto jail = std::make_unique<Jail>(request.root.get(), request.head.fileBytes);
  ObjNotes notes;
  if (format.format == ModelFormat::Obj) mendObj(request, file, *jail, notes);
  SourceScene to;
  Assimp::Importer importer;
  const aiScene& scene = readScene(importer, request, format, std::move(jail), to);
  to.toShow = toShow(scene, format, request.head, file);
  to.keepNormals = givesNormals(format.format);
  convert(scene, format, to);
  apply(notes, to);
  return to;
}

}  // namespace stadion::importer
