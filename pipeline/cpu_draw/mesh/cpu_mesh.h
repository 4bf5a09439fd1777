#pragma once
/// The meshes of a show, in the layout that the CPU renderer draws.
///
/// Ownership  the cache borrows the mesh store, which must outlive it; it owns what it makes of the meshes.
///            A CpuMesh that a renderer holds stays valid after the store has freed the mesh.
/// A figure in a pose is a CpuMesh, too: it shares triangles, materials and textures with the figure at rest.
///
/// Threads    CpuMesh: immutable once others have it. CpuMeshCache: any; all walls share one.
/// Errors     reports a missing or damaged mesh once; such a mesh draws nothing.

#include "engine/asset/mesh_store.h"
#include "engine/base/diagnostic.h"
#include "engine/figure/figure_pose.h"
#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/mesh/cpu_texture.h"
#include "pipeline/cpu_draw/mesh/mesh_section.h"

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace stadion {

/// A run of triangles with one material.
struct CpuPart {
  std::uint32_t firstTriangle, triangles;
  std::uint32_t material;
  bool transparent, masked;
  bool bothSides;                     ///< double-sided, or the mesh is open
  std::vector<MeshSection> sections;  ///< all its triangles, in their order
};

class CpuMesh {
public:
  /// Expects a mesh without a drawingFault().
  CpuMesh(const Mesh& mesh, Look look);
  /// Puts a figure into a pose. `mesh` is the one that this object, or the one that it is a copy
  /// of, was made of; expects it to have a skeleton.
  void takePose(const Mesh& mesh, const FigurePose& pose);
  /// Returns true if its sections say nothing about where its triangles are.
  bool isPosed() const { return posed_; }

  std::uint32_t vertexCount() const { return vertexCount_; }
  MeshPositions positions() const { return {x_.data(), y_.data(), z_.data()}; }
  TriangleCorners corners() const { return {surface_->a.data(), surface_->b.data(), surface_->c.data()}; }
  /// Returns the parts to draw at a level of detail. If the mesh has fewer levels, these are the parts of the
  /// coarsest one.
  const std::vector<CpuPart>& partsAt(std::uint32_t level) const;
  const MaterialParameters& material(std::uint32_t i) const { return surface_->materials[i]; }
  /// kVertexFloats for each; colours as the look computes with them.
  const float* vertices() const { return vertices_.data(); }
  /// kExtraVertexFloats for each; null: the mesh has none.
  const float* extras() const { return extras_.empty() ? nullptr : extras_.data(); }
  std::array<float, 3> position(int i) const {
    const auto at = static_cast<std::size_t>(i);
    return {x_[at], y_[at], z_[at]};
  }
  std::array<int, 3> triangle(std::uint32_t t) const {
    return {surface_->a[t], surface_->b[t], surface_->c[t]};
  }

private:
  /// What does not change with the pose.
  struct Surface {
    std::vector<int> a, b, c;  ///< corners of the triangles of all levels
    std::vector<std::vector<CpuPart>> levels;
    std::vector<MaterialParameters> materials;
    std::vector<std::unique_ptr<const CpuTexture>> textures;
  };
  /// Of a picture: as colours and as numbers, made at their first use.
  class Textures;

  void copyVertices(const Mesh& mesh, Look look);
  void copyExtras(const Mesh& mesh);
  void setTangent(std::size_t vertex, const std::array<float, 4>& tangent);
  void place(std::size_t vertex, const std::array<float, 3>& position, const std::array<float, 3>& normal);
  void addLevel(const Mesh& mesh, std::span<const std::uint32_t> indices, std::span<const Submesh> parts,
                bool open, Surface& to) const;
  static void makeMaterials(const Mesh& mesh, Look look, Surface& to);
  std::vector<MeshSection> sectionsOf(const Surface& surface, std::uint32_t firstTriangle,
                                      std::uint32_t triangles) const;

  std::uint32_t vertexCount_;
  std::vector<float> x_, y_, z_, vertices_, extras_;
  std::shared_ptr<const Surface> surface_;
  bool posed_ = false;
};

class CpuMeshCache {
public:
  CpuMeshCache(const MeshStore& store, Look look) : store_(store), look_(look) {}

  /// The mesh, made ready at its first use; null if it cannot be drawn.
  std::shared_ptr<const CpuMesh> find(MeshId id);
  /// What it is made of; null if the store has freed it.
  const Mesh* source(MeshId id) const { return store_.find(id); }
  /// Forgets meshes that the store has freed.
  void freeUnused();
  std::size_t size() const;
  /// Returns the first problem since the last call, if there was one.
  std::optional<Diagnostic> takeProblem();

private:
  struct Cached {
    std::uint64_t hash = 0;  ///< hash of the mesh's content: the store may use an id again
    std::shared_ptr<const CpuMesh> mesh;
  };
  Cached made(MeshId id);
  void report(std::string what);

  const MeshStore& store_;
  Look look_;
  mutable std::mutex mutex_;
  std::unordered_map<MeshId, Cached> meshes_;
  std::uint64_t freedCount_ = 0;  ///< MeshStore's count of freed meshes at the last freeUnused()
  std::optional<Diagnostic> problem_;
};

}  // namespace stadion
