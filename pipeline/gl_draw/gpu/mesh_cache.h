#pragma once
/// The meshes that one context holds in GL objects.
///
/// Ownership  owns the GL objects, borrows the mesh store, which must outlive it.
/// Threads    the thread on which the context is current; its destructor too.
/// Errors     reports a mesh once that is missing, damaged or too large for the memory; it draws nothing.

#include "engine/asset/material.h"
#include "engine/asset/mesh_store.h"
#include "engine/base/diagnostic.h"
#include "engine/core/frame_probe.h"
#include "engine/figure/skinning.h"
#include "engine/published/paint.h"
#include "pipeline/gl/gl_object.h"
#include "pipeline/gl_draw/gpu/frame_data.h"
#include "pipeline/gl_draw/gpu/mesh_pages.h"
#include "pipeline/raster/small_object_rasterizer.h"
#include "pipeline/shader/look.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace stadion {

/// The textures of a material's maps, by MapKind; 0 = none. The plain look has those of colours alone.
using MapTextures = std::array<GLuint, kMapKinds>;
/// Binds those that are there.
void bindMaps(const GlTable& gl, const MapTextures& maps);

/// A picture as maps read it: once for each sampler, as colours or as numbers.
struct MapTexture {
  std::int32_t picture;  ///< index in Mesh::textures
  Sampler sampler;
  bool colours;
  GlTexture gl;
};

/// The parameters of one draw call of a mesh.
struct GlSubmesh {
  GLsizei indexCount;
  std::uintptr_t indexOffset;  ///< [bytes]
  GLintptr materialOffset;     ///< [bytes] into GlMesh::materials
  MapTextures maps;
  bool tangents;   ///< its mesh has tangents
  bool ownPlaces;  ///< a map has texture coordinates of its own
  bool unlit;
  bool transparent;
  bool masked;
  bool bothSides;                        ///< not culled: double-sided, or the mesh is open
  std::uint32_t material;                ///< index of the material in GlMesh::materials
  std::uint32_t firstVertex, endVertex;  ///< the submesh uses only these vertices

  /// Returns the first triangle of the submesh in the index buffer.
  std::uint32_t firstTriangle() const {
    return static_cast<std::uint32_t>(indexOffset / (3 * sizeof(std::uint32_t)));
  }
  std::uint32_t triangles() const { return static_cast<std::uint32_t>(indexCount) / 3; }
};

/// Which side of a part is seen, if the model matrix mirrors it or not.
inline TriangleCuller::Facing facingOf(const GlSubmesh& part, bool mirrored) {
  if (part.bothSides) return TriangleCuller::Facing::Both;
  return mirrored ? TriangleCuller::Facing::Clockwise : TriangleCuller::Facing::CounterClockwise;
}

struct GlMesh {
  MeshPlace place;
  GlBuffer materials;
  std::vector<MapTexture> textures;
  std::vector<GlSubmesh> parts;                ///< parts of the full surface
  std::vector<std::vector<GlSubmesh>> levels;  ///< parts of each simplified surface
  std::size_t transparentParts = 0;
  std::optional<CullerMesh> culler;  ///< all levels, as in the page's indices; where triangles are culled
  Aabb bounds;                       ///< [m]
  std::optional<MeshShading>
      shading;  ///< there, if it has neither pictures nor holes nor anything to see through
  std::optional<GlBuffer> paintedMaterials{};  ///< packed as those of a page; nothing: the page has them

  GLuint vertexArray() const { return place.page->vertexArray.name(); }
  GLuint indices() const { return place.page->indices.name(); }
  /// Returns the buffer of packed materials, and the number of a part's material in it.
  GLuint packedMaterials() const {
    return paintedMaterials ? paintedMaterials->name() : place.page->materials.name();
  }
  std::uint32_t packedMaterial(const GlSubmesh& part) const {
    return (paintedMaterials ? 0 : static_cast<std::uint32_t>(place.first.materials)) + part.material;
  }
  /// Returns the parts to draw at a level of detail. If the mesh has fewer levels, these are the parts of the
  /// coarsest one.
  const std::vector<GlSubmesh>& partsAt(std::uint32_t level) const {
    return level == 0 || levels.empty() ? parts : levels[std::min<std::size_t>(level, levels.size()) - 1];
  }
};

/// A mesh at the level at which it is drawn.
struct MeshParts {
  const GlMesh* gl;
  const std::vector<GlSubmesh>& parts;
  std::uint32_t triangles;
};
MeshParts partsOf(const GlMesh& mesh, std::uint32_t level);

/// Where vertex arrays find what; the shaders use the same numbers.
enum VertexAttribute : GLuint {
  kPosition,
  kNormal,
  kUv,
  kColour,
  kModelX,
  kModelY,
  kModelZ,
  kSecondUv,  ///< this and the next: only of meshes that have them
  kTangent
};

/// Points the model matrices of the bound vertex array at `instances`, from number `first` on.
void pointAtInstances(const GlTable& gl, const FrameData& instances, std::uint32_t first);

class MeshCache {
public:
  struct Layout {
    bool culled = false;       ///< meshes are kept for TriangleCuller, too; expects that they share no pages
    bool sharesPages = false;  ///< meshes share vertex and index buffers (mesh_pages.h)
  };
  MeshCache(const GlTable& gl, const MeshStore& meshes, Look look, Layout layout);

  /// The mesh, uploaded if this is its first use; nullptr if it cannot be drawn.
  const GlMesh* find(MeshId id);
  /// Returns another copy of a mesh, with vertices of its own and the textures of `original`, which must
  /// outlive it. Nothing if OpenGL has no memory for it.
  std::optional<GlMesh> copyOf(const Mesh& mesh, const GlMesh& original);
  /// Vertices in a pose; empty: as the mesh has them.
  struct MovedVertices {
    std::span<const SkinnedVertex> vertices;
    std::span<const std::array<float, 4>> tangents;  ///< empty if the mesh has none
  };
  /// Gives a copy other positions, normals and tangents.
  void setVertices(const Mesh& mesh, const MovedVertices& moved, const GlMesh& copy);
  /// Returns another copy of a mesh, in a paint, with the vertices, indices and textures of `original`. These
  /// textures must outlive it.
  GlMesh paintedCopyOf(const Mesh& mesh, const GlMesh& original, const PaintRecord& paint);
  /// Gives a painted copy another paint.
  void setPaint(const Mesh& mesh, const PaintRecord& paint, GlMesh& copy);
  /// Returns true if find() has it already, and uploads nothing.
  bool holds(MeshId id) const;
  /// Reports uploads to this probe from now on; null = none.
  void setProbe(FrameProbe* probe) { probe_ = probe; }
  /// Frees the GL objects of meshes that the store has freed since the last call.
  void freeUnused();

  std::size_t size() const { return meshes_.size(); }
  /// Returns the first problem since the last call, if there was one.
  std::optional<Diagnostic> takeProblem();

private:
  std::optional<GlMesh> upload(const Mesh& mesh);
  void uploadVertices(const Mesh& mesh, GlMesh& out);
  void describeVertices(bool rich) const;
  void writeVertices(const Mesh& mesh, const MeshPlace& place, const MovedVertices& moved);
  void uploadTextures(const Mesh& mesh, GlMesh& out);
  void uploadIndices(const Mesh& mesh, std::span<const std::uint32_t> all, GlMesh& out);
  void uploadMaterials(std::span<const Material> materials, GlMesh& out);
  void listParts(const Mesh& mesh, const std::vector<MapTexture>& textures, GlMesh& out) const;
  std::size_t materialStride() const;
  GlTexture uploadTexture(const Texture& texture, float alphaCutoff, const Sampler& sampler, bool colours);
  void setSampler(const Sampler& sampler) const;
  void report(std::string what);

  const GlTable& gl_;
  const MeshStore& store_;
  Look look_;  ///< colours are uploaded as it reckons with them
  bool culls_;
  MeshPages pages_, richPages_;  ///< rich: vertices with second texture coordinates and tangents
  struct Cached {
    std::uint64_t hash = 0;    ///< hash of the mesh's content: the store may use an id again
    std::optional<GlMesh> gl;  ///< empty: known not to be drawable
  };
  std::unordered_map<MeshId, Cached> meshes_;
  std::uint64_t freedCount_ = 0;  ///< MeshStore's count of freed meshes at the last freeUnused()
  GLint uniformAlignment_ = 256;
  bool anisotropy_ = false;
  FrameProbe* probe_ = nullptr;
  std::optional<Diagnostic> problem_;
};

}  // namespace stadion
