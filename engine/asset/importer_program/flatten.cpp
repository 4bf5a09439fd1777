#include "engine/asset/importer_program/geometry.h"
#include "engine/asset/importer_program/materials.h"

#include "engine/asset/mesh_checks.h"
#include "engine/maths/srgb.h"

#include <algorithm>
#include <cmath>

namespace stadion::importer {
namespace {

constexpr double kFarthest = 1e7;  // [m] beyond that single precision has lost the metre

bool usable(const std::array<float, 3>& p) {
  return std::all_of(p.begin(), p.end(),
                     [](float c) { return std::abs(c) <= static_cast<float>(kFarthest); });
}

Affine toAffine(const aiMatrix4x4& m) {
  Affine X;
  X.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  return X;
}

std::uint8_t byteOf(float c) {
  const float value = std::isfinite(c) ? std::clamp(c, 0.0f, 1.0f) : 1.0f;
  return static_cast<std::uint8_t>(std::lround(value * 255.0f));
}

std::uint8_t colourByte(float c, bool linear) {
  return byteOf(linear && c > 0 ? static_cast<float>(srgbFromLinear(double{c})) : c);
}

std::array<float, 3> turnedNormal(const aiVector3D& n, const Mat3& cofactors) {
  const Vec3 turned = cofactors * Vec3(n.x, n.y, n.z);
  const double length = turned.norm();
  if (!std::isfinite(length) || !(length > 1e-30)) return {0, 0, 0};
  const Vec3 unit = turned / length;
  return {static_cast<float>(unit.x()), static_cast<float>(unit.y()), static_cast<float>(unit.z())};
}

class Flattener {
public:
  Flattener(const aiScene& scene, const FlattenOptions& options) : scene_(scene), options_(options) {}

  void visit(const aiNode& node, const Affine& X_parent, std::uint32_t depth) {
    if (depth > options_.nodeDepth)
      throw Refusal("nests its nodes deeper than " + std::to_string(options_.nodeDepth));
    const Affine X = X_parent * toAffine(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      if (node.mMeshes[i] < scene_.mNumMeshes && scene_.mMeshes[node.mMeshes[i]])
        append(*scene_.mMeshes[node.mMeshes[i]], X);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
      if (node.mChildren[i]) visit(*node.mChildren[i], X, depth + 1);
  }

  Flat flat;

private:
  void append(const aiMesh& mesh, const Affine& X) {
    if (!(mesh.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON)) || !mesh.mVertices)
      return;
    if (flat.vertices.size() + mesh.mNumVertices > options_.limits.vertices)
      throw Refusal("has more than " + std::to_string(options_.limits.vertices) + " vertices");
    if (flat.triangles.size() + mesh.mNumFaces > options_.limits.triangles)
      throw Refusal("has more than " + std::to_string(options_.limits.triangles) + " triangles");
    const auto first = static_cast<std::uint32_t>(flat.vertices.size());
    appendVertices(mesh, X);
    const bool mirrored = X.linear().determinant() < 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<std::uint32_t, 3> corner{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
      for (auto& c : corner) {
        if (c >= mesh.mNumVertices) throw Refusal("has a triangle with a vertex that does not exist");
        c += first;
      }
      if (mirrored) std::swap(corner[1], corner[2]);
      flat.triangles.push_back({corner, mesh.mMaterialIndex});
    }
  }

  void appendVertices(const aiMesh& mesh, const Affine& X) {
    const Mat3 m = X.linear();
    Mat3 cofactors;  // of the linear part: turns normals, without dividing by the determinant
    for (int c = 0; c < 3; ++c) cofactors.col(c) = m.col((c + 1) % 3).cross(m.col((c + 2) % 3));
    if (m.determinant() < 0) cofactors = -cofactors;
    const bool normals = options_.keepNormals && mesh.mNormals;
    const bool uvs = mesh.mTextureCoords[0] != nullptr, colours = mesh.mColors[0] != nullptr;
    flat.hasUvs |= uvs;
    flat.hasColours |= colours;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      FlatVertex v;
      const Vec3 p = X * Vec3(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
      for (int k = 0; k < 3; ++k) v.position[k] = static_cast<float>(p[k]) + 0.0f;  // + 0 makes -0 equal to 0
      if (normals) v.normal = turnedNormal(mesh.mNormals[i], cofactors);
      if (uvs) v.uv = uv(mesh.mTextureCoords[0][i]);
      if (colours) {
        const aiColor4D& c = mesh.mColors[0][i];
        v.colour = {colourByte(c.r, options_.linearColours), colourByte(c.g, options_.linearColours),
                    colourByte(c.b, options_.linearColours), byteOf(c.a)};
      }
      flat.vertices.push_back(v);
    }
  }

  // assimp counts v from the bottom of the picture, Stadion from the top, as the rows lie.
  static std::array<float, 2> uv(const aiVector3D& t) {
    if (!(std::abs(t.x) < 1e6f) || !(std::abs(t.y) < 1e6f)) return {0, 0};
    return {t.x, 1.0f - t.y};
  }

  const aiScene& scene_;
  const FlattenOptions& options_;
};

enum class Fault { None, NotFinite, Collapsed, Sliver };

Vec3 vec(const std::array<float, 3>& p) {
  return {p[0], p[1], p[2]};
}

Fault faultOf(const Flat& flat, const FlatTriangle& t) {
  const auto& a = flat.vertices[t.corner[0]].position;
  const auto& b = flat.vertices[t.corner[1]].position;
  const auto& c = flat.vertices[t.corner[2]].position;
  if (!usable(a) || !usable(b) || !usable(c)) return Fault::NotFinite;
  if (a == b || b == c || c == a) return Fault::Collapsed;
  const Vec3 ab = vec(b) - vec(a), ac = vec(c) - vec(a);
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ab - ac).squaredNorm()});
  return ab.cross(ac).norm() > 1e-7 * longest ? Fault::None : Fault::Sliver;
}

bool closedSurface(const Flat& flat, const std::vector<Fault>& faults) {
  Mesh shape;
  for (const FlatVertex& v : flat.vertices) shape.positions.push_back(v.position);
  for (std::size_t i = 0; i < flat.triangles.size(); ++i)
    if (faults[i] == Fault::None || faults[i] == Fault::Sliver)
      shape.indices.insert(shape.indices.end(), flat.triangles[i].corner.begin(),
                           flat.triangles[i].corner.end());
  return closed(shape);
}

}  // namespace

Flat flatten(const aiScene& scene, const FlattenOptions& options) {
  Flattener flattener(scene, options);
  if (scene.mRootNode) flattener.visit(*scene.mRootNode, options.toShow, 0);
  return std::move(flattener.flat);
}

DroppedTriangles dropBadTriangles(Flat& flat) {
  DroppedTriangles dropped;
  std::vector<Fault> faults;
  bool slivers = false, notFinite = false;
  for (const FlatTriangle& t : flat.triangles) {
    faults.push_back(faultOf(flat, t));
    slivers |= faults.back() == Fault::Sliver;
    notFinite |= faults.back() == Fault::NotFinite;
  }
  const bool keepSlivers = slivers && !notFinite && closedSurface(flat, faults);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < flat.triangles.size(); ++i) {
    dropped.notFinite += faults[i] == Fault::NotFinite;
    const bool keep = faults[i] == Fault::None || (faults[i] == Fault::Sliver && keepSlivers);
    dropped.degenerate += !keep && faults[i] != Fault::NotFinite;
    if (keep) flat.triangles[kept++] = flat.triangles[i];
  }
  flat.triangles.resize(kept);
  return dropped;
}

}  // namespace stadion::importer
