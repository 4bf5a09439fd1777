#pragma once
/// A triangle mesh as a show uses it: immutable, indexed, with materials, in metres and +Z up.
///
/// Frames   vertex coordinates are in the mesh's own frame N.
/// Threads  immutable after import: shared by App, every Cull and every Draw without locks.

#include "engine/figure/skeleton.h"
#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stadion {

/// A picture: 8-bit RGBA, rows from the top, colour in sRGB, alpha linear and not premultiplied.
struct Texture {
  std::uint32_t width = 0, height = 0;  ///< [pixels], at most 8192
  std::vector<std::uint8_t> rgba;       ///< (height x width x 4)
  std::string name;                     ///< source of the picture, for messages
};

constexpr float kMostAlphaCutoff = 2;  ///< beyond 1 nothing is left

struct Material {
  std::string name;
  std::array<float, 4> baseColour{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear RGB, alpha
  std::array<float, 3> emissive{0, 0, 0};                   ///< linear RGB
  float roughness = 0.7f;                                   ///< 0 mirror .. 1 matt
  float metallic = 0.0f;
  std::int32_t texture = -1;          ///< index into Mesh::textures, -1 = none
  std::int32_t emissiveTexture = -1;  ///< likewise; multiplies `emissive`, its alpha counts for nothing
  float alphaCutoff =
      0;  ///< 0 = nothing is cut out; else what has less alpha is not there, the rest is opaque
  bool doubleSided = false;
  bool textureHasAlpha = false;

  bool masked() const { return alphaCutoff > 0; }
  bool transparent() const { return !masked() && (baseColour[3] < 0.999f || textureHasAlpha); }
};

/// A run of triangles with one material.
struct Submesh {
  std::uint32_t firstIndex = 0;  ///< into Mesh::indices
  std::uint32_t indexCount = 0;  ///< a multiple of 3
  std::uint32_t material = 0;    ///< into Mesh::materials
};

/// A simplified surface of the mesh: fewer triangles with the same vertices.
struct MeshLevel {
  std::vector<std::uint32_t> indices;
  std::vector<Submesh> submeshes;  ///< parts of these indices; the materials are the mesh's
  double error = 0;                ///< how far it is from the full surface where it is farthest [m]
};

struct Mesh {
  std::vector<std::array<float, 3>> positions;  ///< [m], +Z up
  std::vector<std::array<float, 3>> normals;    ///< unit; same length as positions
  std::vector<std::array<float, 2>>
      uvs;  ///< (0,0) top left of the picture, u right, v down; same length, or empty
  std::vector<std::array<std::uint8_t, 4>>
      colours;  ///< per vertex: colour in sRGB, alpha linear; same length, or empty
  /// What carries each vertex of a figure; same length as positions, or empty.
  std::vector<VertexJoints> joints;
  std::vector<std::uint32_t> indices;  ///< triangles, counter-clockwise seen from outside
  std::vector<Submesh> submeshes;
  std::vector<Material> materials;  ///< never empty
  std::vector<Texture> textures;
  /// Bones and clips of a figure, whose positions are those in which it was bound; null: a mesh of fixed form.
  std::shared_ptr<const Skeleton> skeleton;
  /// Of a part of a model: from its coordinates N to those of the model. Without a scale.
  Affine place = Affine::Identity();
  Aabb bounds;             ///< [m] of a figure: in every pose
  Sphere sphere;           ///< [m] bounding sphere; of a figure: in every pose
  std::uint64_t hash = 0;  ///< hash of the content, which identifies the mesh
  std::string name;        ///< the file it came from
  /// Simplified surfaces, each with fewer triangles and a greater error than the one before.
  std::vector<MeshLevel> levels;
  bool standIn = false;  ///< drawn in place of an asset that could not be loaded

  /// Returns true if something of it is seen through.
  bool transparent() const {
    for (const Material& m : materials)
      if (m.transparent()) return true;
    return false;
  }
};

}  // namespace stadion
