#include "engine/asset/importer_program/assimp/assimp_scene.h"

#include "engine/asset/importer_program/source/name_list.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <map>
#include <string>

namespace stadion::importer {
namespace {

Float3 float3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

std::vector<Float3> float3s(const aiVector3D* from, std::size_t count) {
  std::vector<Float3> to;
  if (!from) return to;
  to.reserve(count);
  for (std::size_t i = 0; i < count; ++i) to.push_back(float3(from[i]));
  return to;
}

std::vector<Float2> textureCoordinates(const aiMesh& mesh, unsigned set) {
  std::vector<Float2> to;
  const aiVector3D* from = mesh.mTextureCoords[set];
  if (!from) return to;
  to.reserve(mesh.mNumVertices);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) to.push_back({from[i].x, from[i].y});
  return to;
}

std::vector<Float4> tangentsOf(const aiMesh& mesh) {
  std::vector<Float4> to;
  if (!mesh.mTangents || !mesh.mBitangents || !mesh.mNormals) return to;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& t = mesh.mTangents[i];
    to.push_back({t.x, t.y, t.z, (mesh.mNormals[i] ^ t) * mesh.mBitangents[i] < 0 ? -1.0f : 1.0f});
  }
  return to;
}

std::vector<Float4> coloursOf(const aiMesh& mesh) {
  std::vector<Float4> to;
  const aiColor4D* from = mesh.mColors[0];
  for (unsigned i = 0; from && i < mesh.mNumVertices; ++i)
    to.push_back({from[i].r, from[i].g, from[i].b, from[i].a});
  return to;
}

std::vector<std::string> furtherOf(const aiMesh& mesh) {
  std::vector<std::string> names;
  for (unsigned set = 2; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set)
    if (mesh.mTextureCoords[set]) names.push_back("texture coordinates " + std::to_string(set + 1));
  for (unsigned set = 1; set < AI_MAX_NUMBER_OF_COLOR_SETS; ++set)
    if (mesh.mColors[set]) names.push_back("vertex colours " + std::to_string(set + 1));
  return names;
}

void readTargets(const aiMesh& mesh, SourceMesh& to) {
  for (unsigned i = 0; i < mesh.mNumAnimMeshes; ++i) {
    const aiAnimMesh* from = mesh.mAnimMeshes[i];
    if (!from || from->mNumVertices != mesh.mNumVertices) continue;
    MorphTarget target;
    target.positions = float3s(from->mVertices, from->mNumVertices);
    for (std::size_t v = 0; v < target.positions.size(); ++v)  // assimp gives the sum
      for (int k = 0; k < 3; ++k) target.positions[v][k] -= to.primitives[0].positions[v][k];
    to.primitives[0].targets.push_back(std::move(target));
    to.targetNames.push_back(from->mName.C_Str());
  }
}

SourceMesh meshOf(const aiMesh* from) {
  SourceMesh to;
  if (!from || !from->mVertices) return to;
  to.name = from->mName.C_Str();
  if (!(from->mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON))) return to;
  SourcePrimitive part;
  part.positions = float3s(from->mVertices, from->mNumVertices);
  part.normals = float3s(from->mNormals, from->mNumVertices);
  part.tangents = tangentsOf(*from);
  for (unsigned set = 0; set < 2; ++set) part.uvs[set] = textureCoordinates(*from, set);
  part.colours = coloursOf(*from);
  part.furtherAttributes = furtherOf(*from);
  part.material = from->mMaterialIndex;
  for (unsigned i = 0; i < from->mNumFaces; ++i) {
    const aiFace& face = from->mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    for (unsigned k = 0; k < 3; ++k)
      if (face.mIndices[k] >= from->mNumVertices)
        throw Refusal("has a triangle with a vertex that does not exist");
    part.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  to.primitives.push_back(std::move(part));
  readTargets(*from, to);
  return to;
}

std::uint32_t addNode(const aiNode& from, std::int32_t parent, SourceScene& to) {
  const auto index = static_cast<std::uint32_t>(to.nodes.size());
  SourceNode node;
  node.name = from.mName.C_Str();
  node.X_PN = toAffine(from.mTransformation);
  node.parent = parent;
  for (unsigned i = 0; i < from.mNumMeshes; ++i)
    if (from.mMeshes[i] < to.meshes.size()) node.meshes.push_back(from.mMeshes[i]);
  to.nodes.push_back(std::move(node));
  for (unsigned i = 0; i < from.mNumChildren; ++i)
    if (from.mChildren[i]) {
      const std::uint32_t child = addNode(*from.mChildren[i], static_cast<std::int32_t>(index), to);
      to.nodes[index].children.push_back(child);
    }
  return index;
}

const char* kindOf(aiLightSourceType type) {
  switch (type) {
  case aiLightSource_DIRECTIONAL: return "directional";
  case aiLightSource_POINT: return "point";
  case aiLightSource_SPOT: return "spot";
  case aiLightSource_AREA: return "area";
  default: return "ambient";
  }
}

double verticalAngle(const aiCamera& camera) {
  const det::SinCos half = det::sincos(0.5 * std::clamp(double{camera.mHorizontalFOV}, 0.0, 3.1));
  const double aspect = camera.mAspect > 0 ? double{camera.mAspect} : 1;
  return 2 * det::atan2(half.sin, half.cos * aspect);
}

SourceLight lightOf(const aiLight& from) {
  SourceLight to;
  to.name = from.mName.C_Str();
  to.kind = kindOf(from.mType);
  to.colour = {from.mColorDiffuse.r, from.mColorDiffuse.g, from.mColorDiffuse.b};
  to.outerAngle = 0.5 * double{from.mAngleOuterCone};
  to.innerAngle = 0.5 * double{from.mAngleInnerCone};
  to.position = float3(from.mPosition);
  to.direction = float3(from.mDirection);
  return to;
}

/// assimp's cameras and lights have the names of their nodes.
void addCamerasAndLights(const aiScene& scene, SourceScene& to) {
  std::map<std::string, std::size_t> nodes;
  for (std::size_t i = 0; i < to.nodes.size(); ++i) nodes.try_emplace(to.nodes[i].name, i);
  for (unsigned i = 0; i < scene.mNumCameras; ++i) {
    const aiCamera& c = *scene.mCameras[i];
    if (const auto at = nodes.find(c.mName.C_Str()); at != nodes.end())
      to.nodes[at->second].camera = static_cast<std::int32_t>(i);
    to.cameras.push_back({c.mName.C_Str(), verticalAngle(c), double{c.mClipPlaneNear},
                          double{c.mClipPlaneFar}, float3(c.mPosition), float3(c.mLookAt)});
  }
  for (unsigned i = 0; i < scene.mNumLights; ++i) {
    to.lights.push_back(lightOf(*scene.mLights[i]));
    if (const auto at = nodes.find(to.lights.back().name); at != nodes.end())
      to.nodes[at->second].light = static_cast<std::int32_t>(i);
  }
  if (!to.lights.empty())
    to.notes.push_back({ContentUse::Approximated,
                        "brightness of " + counted(to.lights.size(), "light") +
                            ": the format has no unit for it, so the file's number counts as Stadion's"});
}

}  // namespace

Affine toAffine(const aiMatrix4x4& m) {
  Affine X;
  X.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  return X;
}

void convert(const aiScene& scene, const FormatInfo& format, SourceScene& to) {
  convertMaterials(scene, format, to);
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) to.meshes.push_back(meshOf(scene.mMeshes[i]));
  if (scene.mRootNode) to.roots.push_back(addNode(*scene.mRootNode, -1, to));
  convertMotion(scene, to);
  addCamerasAndLights(scene, to);
}

}  // namespace stadion::importer
