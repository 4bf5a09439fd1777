#pragma once
/// A triangle mesh as a show uses it: immutable, indexed, with materials, in metres and +Z up.
///
/// Frames   vertex coordinates are in the mesh's own frame N.
/// Threads  immutable after import: shared by App, every Cull and every Draw without locks.

#include "engine/asset/material.h"
#include "engine/environment/environment_light.h"
#include "engine/figure/morph.h"
#include "engine/figure/skeleton.h"
#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stadion {

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

/// A light that a model file holds, in the mesh's coordinates.
struct ModelLight {
  enum class Kind : std::uint32_t { Directional, Point, Spot };
  std::string name;
  Kind kind = Kind::Point;
  std::array<float, 3> position{0, 0, 0};    ///< [m]
  std::array<float, 3> direction{0, 0, -1};  ///< the way the light goes, unit
  std::array<float, 3> colour{1, 1,
                              1};  ///< linear, with the intensity: 1 lights a white surface fully, at 1 m
  float range = 0;                 ///< how far it reaches [m], 0 = without an end
  float innerAngle = 0, outerAngle = 0;  ///< half angles of a spot's cone [rad]
};

/// A camera that a model file holds, in the mesh's coordinates.
struct ModelCamera {
  std::string name;
  std::array<float, 3> position{0, 0, 0};   ///< [m]
  std::array<float, 3> direction{0, 1, 0};  ///< where it looks, unit
};

struct Mesh {
  std::vector<std::array<float, 3>> positions;  ///< [m], +Z up
  std::vector<std::array<float, 3>> normals;    ///< unit; same length as positions
  std::vector<std::array<float, 2>>
      uvs;  ///< (0,0) top left of the picture, u right, v down; same length, or empty
  /// For maps that lie otherwise on the surface (MaterialMap::secondUvs); same length, or empty.
  std::vector<std::array<float, 2>> secondUvs;
  /// Of normal maps: a unit vector along u, and the side of the bitangent, cross(normal, tangent) times 1 or -1,
  /// which is up in the picture. (0, 0, 0, 1) where the file has none: it follows from the texture coordinates.
  /// Same length, or empty.
  std::vector<std::array<float, 4>> tangents;
  std::vector<std::array<std::uint8_t, 4>>
      colours;  ///< per vertex: colour in sRGB, alpha linear; same length, or empty
  /// What carries each vertex of a figure; same length as positions, or empty.
  std::vector<VertexJoints> joints;
  std::vector<Morph> morphs;           ///< morph targets of a figure
  std::vector<std::uint32_t> indices;  ///< triangles, counter-clockwise seen from outside
  std::vector<Submesh> submeshes;
  std::vector<Material> materials;  ///< never empty
  std::vector<Texture> textures;
  /// Bones and clips of a figure, whose positions are those in which it was bound; null: a mesh of fixed form.
  std::shared_ptr<const Skeleton> skeleton;
  /// Of a part of a model: from its coordinates N to those of the model. Without a scale.
  Affine place = Affine::Identity();
  std::vector<ModelLight> lights;    ///< of a figure: where they are at rest
  std::vector<ModelCamera> cameras;  ///< likewise
  Aabb bounds;                       ///< [m] of a figure: in every pose
  Sphere sphere;                     ///< [m] bounding sphere; of a figure: in every pose
  std::uint64_t hash = 0;            ///< hash of the content, which identifies the mesh
  std::string name;                  ///< the file it came from
  /// Simplified surfaces, each with fewer triangles and a greater error than the one before.
  std::vector<MeshLevel> levels;
  /// Light from all around; null: it is a model. Such a mesh has no triangles.
  std::shared_ptr<const EnvironmentLight> environment;
  bool standIn = false;  ///< drawn in place of an asset that could not be loaded

  /// Returns true if something of it is seen through.
  bool transparent() const {
    for (const Material& m : materials)
      if (m.transparent()) return true;
    return false;
  }
};

/// Returns true if a material's map can be drawn on the mesh. An emissive map needs no texture coordinates.
inline bool isDrawn(const Mesh& mesh, const Material& material, std::size_t kind) {
  const MaterialMap& map = material.maps[kind];
  return map.given() && (kind == kEmissiveMap || !(map.secondUvs ? mesh.secondUvs : mesh.uvs).empty());
}

}  // namespace stadion
