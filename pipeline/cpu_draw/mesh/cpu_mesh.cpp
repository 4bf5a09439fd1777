#include "pipeline/cpu_draw/mesh/cpu_mesh.h"

#include "engine/figure/skinning.h"
#include "engine/maths/srgb.h"
#include "pipeline/cpu_draw/mesh/cpu_material.h"
#include "pipeline/gl/finite.h"
#include "pipeline/gl/problem.h"
#include "pipeline/surface/mesh_check.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace stadion {
namespace {

/// The alpha below which a texture leaves holes; 0 if it leaves none.
float cutoffOfTexture(const Mesh& mesh, std::size_t texture) {
  for (const Material& m : mesh.materials)
    if (m.masked() && m.maps[kBaseMap].texture == static_cast<std::int64_t>(texture) && m.baseColour[3] > 0)
      return m.alphaCutoff / m.baseColour[3];
  return 0;
}

/// By MapKind.
constexpr std::array kMaps{&MaterialParameters::base, &MaterialParameters::glow,
                           &MaterialParameters::metallicRoughness, &MaterialParameters::normal,
                           &MaterialParameters::occlusion};
static_assert(kMaps.size() == kMapKinds);

}  // namespace

class CpuMesh::Textures {
public:
  Textures(const Mesh& mesh, Look look, Surface& to) : mesh_(mesh), look_(look), to_(to) {}

  /// How the kernels read a map.
  TextureParameters read(const MaterialMap& map, bool colours) {
    TextureParameters p = textureOf(static_cast<std::size_t>(map.texture), colours).parameters();
    setUse(map, p);
    if (map.secondUvs && mesh_.secondUvs.empty()) p.coordinates = 0;
    return p;
  }

private:
  const CpuTexture& textureOf(std::size_t picture, bool colours) {
    const auto [at, isNew] = known_.try_emplace({picture, colours}, to_.textures.size());
    if (isNew)
      to_.textures.push_back(std::make_unique<CpuTexture>(mesh_.textures[picture],
                                                          colours ? cutoffOfTexture(mesh_, picture) : 0,
                                                          colours ? look_ : Look::Plain));
    return *to_.textures[at->second];
  }

  const Mesh& mesh_;
  Look look_;
  Surface& to_;
  std::map<std::pair<std::size_t, bool>, std::size_t> known_;
};

CpuMesh::CpuMesh(const Mesh& mesh, Look look) {
  copyVertices(mesh, look);
  copyExtras(mesh);
  Surface surface;
  makeMaterials(mesh, look, surface);
  const bool open = !isClosed(mesh);
  addLevel(mesh, mesh.indices, mesh.submeshes, open, surface);
  for (const MeshLevel& level : mesh.levels) addLevel(mesh, level.indices, level.submeshes, open, surface);
  for (auto* corners : {&surface.a, &surface.b, &surface.c})
    corners->resize(corners->size() + kKernelPadding);
  surface_ = std::make_shared<const Surface>(std::move(surface));
}

void CpuMesh::takePose(const Mesh& mesh, const FigurePose& pose) {
  constexpr std::size_t kBlock = 128;  // stays in the processor's cache
  posed_ = true;
  const std::span<const JointMatrix> palette = pose.palette();
  MorphedVertices morphed;
  const SkinSource source =
      morphed.apply({mesh.positions, mesh.normals, mesh.joints}, mesh.morphs, pose.weights());
  std::array<SkinnedVertex, kBlock> block;
  for (std::size_t first = 0; first < vertexCount_; first += kBlock) {
    const std::span<SkinnedVertex> some(block.data(), std::min(kBlock, vertexCount_ - first));
    skin(source, palette, first, some);
    for (std::size_t i = 0; i < some.size(); ++i) place(first + i, some[i].position, some[i].normal);
  }
  std::vector<std::array<float, 4>> tangents(mesh.tangents.size());
  skinTangents(mesh.tangents, mesh.joints, palette, 0, tangents);
  for (std::size_t i = 0; i < tangents.size(); ++i) setTangent(i, tangents[i]);
}

void CpuMesh::place(std::size_t vertex, const std::array<float, 3>& position,
                    const std::array<float, 3>& normal) {
  float* v = vertices_.data() + vertex * kVertexFloats;
  for (std::size_t k = 0; k < 3; ++k) v[k] = finite(position[k]), v[3 + k] = finite(normal[k]);
  x_[vertex] = v[0];
  y_[vertex] = v[1];
  z_[vertex] = v[2];
}

void CpuMesh::copyVertices(const Mesh& mesh, Look look) {
  const std::size_t count = mesh.positions.size();
  for (auto* axis : {&x_, &y_, &z_}) axis->resize(count + kKernelPadding);
  vertexCount_ = static_cast<std::uint32_t>(count);
  vertices_.resize(count * kVertexFloats);
  for (std::size_t i = 0; i < count; ++i) {
    place(i, mesh.positions[i], mesh.normals[i]);
    float* v = vertices_.data() + i * kVertexFloats;
    if (!mesh.uvs.empty()) v[6] = mesh.uvs[i][0], v[7] = mesh.uvs[i][1];
    for (std::size_t k = 0; k < 4; ++k) {
      const double c = mesh.colours.empty() ? 1 : mesh.colours[i][k] / 255.0;
      v[8 + k] = static_cast<float>(look == Look::Full && k < 3 ? linearFromSrgb(c) : c);
    }
  }
}

void CpuMesh::makeMaterials(const Mesh& mesh, Look look, Surface& surface) {
  Textures textures(mesh, look, surface);
  for (const Material& m : mesh.materials) {
    MaterialParameters& to = surface.materials.emplace_back(materialParameters(m, look));
    for (std::size_t kind = 0; kind < kMapKinds; ++kind)
      if (isDrawn(mesh, m, kind) && (look == Look::Full || holdsColours(kind)))
        to.*kMaps[kind] = textures.read(m.maps[kind], holdsColours(kind));
    to.mapped = to.metallicRoughness.texels || to.normal.texels || to.occlusion.texels;
    to.tangents = !mesh.tangents.empty();
  }
}

void CpuMesh::copyExtras(const Mesh& mesh) {
  if (mesh.secondUvs.empty() && mesh.tangents.empty()) return;
  extras_.resize(mesh.positions.size() * kExtraVertexFloats);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    float* v = extras_.data() + i * kExtraVertexFloats;
    if (!mesh.tangents.empty()) setTangent(i, mesh.tangents[i]);
    if (!mesh.secondUvs.empty()) v[4] = mesh.secondUvs[i][0], v[5] = mesh.secondUvs[i][1];
  }
}

void CpuMesh::setTangent(std::size_t vertex, const std::array<float, 4>& tangent) {
  std::ranges::transform(tangent, extras_.begin() + static_cast<std::ptrdiff_t>(vertex * kExtraVertexFloats),
                         finite);
}

void CpuMesh::addLevel(const Mesh& mesh, std::span<const std::uint32_t> indices,
                       std::span<const Submesh> parts, bool open, Surface& surface) const {
  std::vector<CpuPart>& level = surface.levels.emplace_back();
  for (const Submesh& part : parts) {
    const Material& m = mesh.materials[part.material];
    const auto first = static_cast<std::uint32_t>(surface.a.size());
    const auto own = indices.subspan(part.firstIndex, part.indexCount / 3 * 3);
    for (std::size_t i = 0; i < own.size(); i += 3)
      surface.a.push_back(static_cast<int>(own[i])), surface.b.push_back(static_cast<int>(own[i + 1])),
          surface.c.push_back(static_cast<int>(own[i + 2]));
    level.push_back({first, part.indexCount / 3, part.material, m.transparent(), m.masked(),
                     m.doubleSided || open, sectionsOf(surface, first, part.indexCount / 3)});
  }
}

std::vector<MeshSection> CpuMesh::sectionsOf(const Surface& surface, std::uint32_t firstTriangle,
                                             std::uint32_t triangles) const {
  constexpr std::uint32_t kTrianglesASection = 256;
  std::vector<MeshSection> sections;
  for (std::uint32_t done = 0; done < triangles; done += kTrianglesASection) {
    MeshSection s;
    s.firstTriangle = firstTriangle + done;
    s.triangles = std::min(triangles - done, kTrianglesASection);
    s.firstVertex = vertexCount_;
    s.low.fill(std::numeric_limits<float>::max());
    s.high.fill(std::numeric_limits<float>::lowest());
    for (std::uint32_t t = 0; t < s.triangles; ++t)
      for (const int corner :
           {surface.a[s.firstTriangle + t], surface.b[s.firstTriangle + t], surface.c[s.firstTriangle + t]}) {
        const std::array<float, 3> p = position(corner);
        s.firstVertex = std::min(s.firstVertex, static_cast<std::uint32_t>(corner));
        s.endVertex = std::max(s.endVertex, static_cast<std::uint32_t>(corner) + 1);
        for (std::size_t k = 0; k < 3; ++k)
          s.low[k] = std::min(s.low[k], p[k]), s.high[k] = std::max(s.high[k], p[k]);
      }
    sections.push_back(s);
  }
  return sections;
}

const std::vector<CpuPart>& CpuMesh::partsAt(std::uint32_t level) const {
  return surface_->levels[std::min<std::size_t>(level, surface_->levels.size() - 1)];
}

std::shared_ptr<const CpuMesh> CpuMeshCache::find(MeshId id) {
  const std::lock_guard lock(mutex_);
  auto at = meshes_.find(id);
  if (at == meshes_.end()) at = meshes_.emplace(id, made(id)).first;
  return at->second.mesh;
}

CpuMeshCache::Cached CpuMeshCache::made(MeshId id) {
  const Mesh* mesh = store_.find(id);
  if (!mesh) {
    report("mesh " + std::to_string(id) + " is to be drawn but no longer there");
    return {};
  }
  if (const std::string fault = drawingFault(*mesh); !fault.empty()) {
    report("\"" + mesh->name + "\" cannot be drawn: " + fault);
    return {mesh->hash, nullptr};
  }
  return {mesh->hash, std::make_shared<const CpuMesh>(*mesh, look_)};
}

void CpuMeshCache::freeUnused() {
  const std::lock_guard lock(mutex_);
  const std::uint64_t freed = store_.freedCount();
  if (freed == freedCount_) return;
  freedCount_ = freed;
  std::erase_if(meshes_, [this](const auto& entry) { return !store_.holds(entry.first, entry.second.hash); });
}

std::size_t CpuMeshCache::size() const {
  const std::lock_guard lock(mutex_);
  return meshes_.size();
}

std::optional<Diagnostic> CpuMeshCache::takeProblem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, std::nullopt);
}

void CpuMeshCache::report(std::string what) {
  if (!problem_) problem_ = problem(std::move(what));
}

}  // namespace stadion
