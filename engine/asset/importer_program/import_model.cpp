#include "engine/asset/importer_program/import_model.h"

#include "engine/asset/importer_program/geometry.h"
#include "engine/asset/importer_program/jail.h"
#include "engine/asset/importer_program/materials.h"
#include "engine/asset/importer_program/obj_text.h"

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <cstdlib>
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

Mat3 toZUp(UpAxis up) {
  Mat3 turn = Mat3::Identity();
  if (up == UpAxis::Y) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == UpAxis::X) turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return turn;
}

// The metres of <unit meter="..."> as assimp has already applied them, 1 if the file does not say.
double statedUnit(const std::vector<std::uint8_t>& file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  const auto tag = text.find("<unit");
  const auto attribute = tag == std::string_view::npos ? tag : text.substr(0, tag + 200).find("meter=", tag);
  if (attribute == std::string_view::npos || attribute + 8 > text.size()) return 1;
  const std::string number(text.substr(attribute + 7, 32));
  const double unit = std::strtod(number.c_str(), nullptr);
  return unit > 0 && std::isfinite(unit) ? unit : 1;
}

/// From what assimp hands out to metres and +Z up. assimp turns 3DS and COLLADA files to +Y up by itself.
Affine toShow(const FormatInfo& format, const RequestHead& head, const std::vector<std::uint8_t>& file) {
  const bool stated = head.up != 0;
  const UpAxis up = stated ? static_cast<UpAxis>(head.up - 1) : format.up;
  Mat3 turn = toZUp(up);
  if (format.format == ModelFormat::ThreeDs) turn = turn * toZUp(UpAxis::Y);
  double unit = head.unit > 0 ? head.unit : format.unit;
  if (format.format == ModelFormat::Collada && head.unit > 0) unit /= statedUnit(file);
  Affine X = Affine::Identity();
  X.linear() = unit * turn;
  return X;
}

// assimp's own steps trust the indices that its loaders made of the file, so they are looked at before.
void checkNode(const aiScene& scene, const aiNode& node, std::uint32_t depthLeft) {
  if (depthLeft == 0) throw Refusal("nests its nodes too deep");
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    if (node.mMeshes[i] >= scene.mNumMeshes) throw Refusal("has a node with a mesh that does not exist");
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    if (node.mChildren[i]) checkNode(scene, *node.mChildren[i], depthLeft - 1);
}

void checkScene(const aiScene& scene, const RequestHead& head) {
  if (!scene.mRootNode) throw Refusal("holds no scene");
  checkNode(scene, *scene.mRootNode, head.nodeDepth);
  bool faces = false;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh* mesh = scene.mMeshes[i];
    if (!mesh) throw Refusal("has a mesh without content");
    if (mesh->mNumVertices > head.mesh.vertices) throw Refusal("has too many vertices");
    for (unsigned f = 0; f < mesh->mNumFaces; ++f)
      for (unsigned k = 0; k < mesh->mFaces[f].mNumIndices; ++k)
        if (mesh->mFaces[f].mIndices[k] >= mesh->mNumVertices)
          throw Refusal("has a face with a vertex that does not exist");
    faces |= mesh->mNumFaces > 0;
  }
  if (!faces) throw Refusal("holds no triangles");
}

[[noreturn]] void refuse(const FormatInfo& format, const std::string& why) {
  if (why.find("bad_alloc") != std::string::npos || why.find("length_error") != std::string::npos)
    throw std::bad_alloc();
  if (why.find("No meshes remaining") != std::string::npos) throw Refusal("holds no triangles");
  throw Refusal("cannot be read as " + std::string(format.name) + (why.empty() ? "" : ": " + why));
}

const aiScene& readScene(Assimp::Importer& importer, const Request& request, const FormatInfo& format,
                         const std::vector<std::uint8_t>& file) {
  auto jail = std::make_unique<Jail>(request.root.get(), request.head.fileBytes);
  if (format.format == ModelFormat::Obj)
    if (auto mended = mendedObj(file)) jail->replace(request.path, std::move(*mended));
  importer.SetIOHandler(jail.release());  // assimp owns it
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, request.head.up != 0);
  keepOneLoader(importer, format);
  const aiScene* scene = importer.ReadFile(request.path, 0);
  if (!scene) refuse(format, importer.GetErrorString());
  checkScene(*scene, request.head);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
  if (!scene) refuse(format, importer.GetErrorString());
  return *scene;
}

// glTF 1.0 shares the extension; naming it beats "unknown format".
void refuseOldGltf(const FormatInfo& format, const std::vector<std::uint8_t>& file) {
  if (format.format != ModelFormat::Gltf) return;
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  const bool binary = text.starts_with("glTF") && text.size() > 4 && text[4] == 1;
  const auto asset = text.find("\"asset\"");
  const auto version = asset == std::string_view::npos ? asset : text.find("\"version\"", asset);
  const auto quote =
      version == std::string_view::npos ? version : text.find_first_of("\"0123456789", version + 9);
  const bool json =
      quote != std::string_view::npos && text.substr(quote, 3).find("1.") != std::string_view::npos;
  if (binary || json) throw Refusal("is glTF 1.0; convert it to glTF 2.0");
}

// 3DS files hold no normals, and those of STL files say nothing about smoothness.
bool givesNormals(ModelFormat format) {
  return format != ModelFormat::Stl && format != ModelFormat::ThreeDs;
}

std::string folderOf(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

bool seenThrough(const Flat& flat) {
  return std::ranges::any_of(flat.vertices, [](const FlatVertex& v) { return v.colour[3] != 255; });
}

std::string listed(const std::vector<std::string>& notes, const DroppedTriangles& dropped) {
  std::string text;
  for (const std::string& note : notes) text += note + '\n';
  if (dropped.notFinite)
    text += std::to_string(dropped.notFinite) + " triangles with a corner that is no number were left out\n";
  if (dropped.degenerate)
    text += std::to_string(dropped.degenerate) + " triangles without area were left out\n";
  return text;
}

}  // namespace

ImportedModel importModel(const Request& request) {
  const FormatInfo* format = formatOf(request.path);
  if (!format) throw Refusal("is not in a format for shows; use " + allowedFormats());
  std::string why;
  const auto file = readBeneath(request.root.get(), request.path, request.head.fileBytes, &why);
  if (!file) throw Refusal(why);
  if (file->empty()) throw Refusal("is empty");
  refuseOldGltf(*format, *file);

  Assimp::Importer importer;
  const aiScene& scene = readScene(importer, request, *format, *file);
  Flat flat = flatten(scene, {toShow(*format, request.head, *file), request.head.nodeDepth, request.head.mesh,
                              givesNormals(format->format), format->linearColours});
  const DroppedTriangles dropped = dropBadTriangles(flat);
  if (flat.triangles.empty())
    throw Refusal(dropped.notFinite ? "holds no triangles with finite corners" : "holds no triangles");
  ImportedModel result;
  std::vector<std::string> notes;
  readMaterials(scene, *format,
                {request.root.get(), folderOf(request.path), request.head.fileBytes, request.head.mesh},
                seenThrough(flat), result.mesh, notes);
  importer.FreeScene();
  makeNormals(flat);
  joinInto(flat, result.mesh);
  result.notes = listed(notes, dropped);
  return result;
}

}  // namespace stadion::importer
