#include "pipeline/cpu_draw/mesh/cpu_mesh.h"

#include "engine/maths/srgb.h"
#include "pipeline/cpu_draw/mesh/cpu_material.h"
#include "pipeline/gl/finite.h"
#include "pipeline/gl/problem.h"
#include "pipeline/gl_draw/gpu/surface_check.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace stadion {
namespace {

/// The alpha below which a texture leaves holes; 0 if it leaves none.
float cutoffOfTexture(const Mesh& mesh, std::size_t texture) {
  for (const Material& m : mesh.materials)
    if (m.masked() && m.texture == static_cast<std::int64_t>(texture) && m.baseColour[3] > 0)
      return m.alphaCutoff / m.baseColour[3];
  return 0;
}

}  // namespace

CpuMesh::CpuMesh(const Mesh& mesh, Look look) {
  copyVertices(mesh, look);
  for (std::size_t i = 0; i < mesh.textures.size(); ++i)
    textures_.push_back(std::make_unique<CpuTexture>(mesh.textures[i], cutoffOfTexture(mesh, i), look));
  makeMaterials(mesh, look);
  const bool open = !encloses(mesh);
  addLevel(mesh, mesh.indices, mesh.submeshes, open);
  for (const MeshLevel& level : mesh.levels) addLevel(mesh, level.indices, level.submeshes, open);
  for (auto* corners : {&a_, &b_, &c_}) corners->resize(corners->size() + kKernelPadding);
}

void CpuMesh::copyVertices(const Mesh& mesh, Look look) {
  const std::size_t count = mesh.positions.size();
  for (auto* axis : {&x_, &y_, &z_}) axis->resize(count + kKernelPadding);
  vertexCount_ = static_cast<std::uint32_t>(count);
  vertices_.resize(count * kVertexFloats);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& p = mesh.positions[i];
    float* v = vertices_.data() + i * kVertexFloats;
    for (std::size_t k = 0; k < 3; ++k) v[k] = finite(p[k]), v[3 + k] = finite(mesh.normals[i][k]);
    x_[i] = v[0];
    y_[i] = v[1];
    z_[i] = v[2];
    if (!mesh.uvs.empty()) v[6] = mesh.uvs[i][0], v[7] = mesh.uvs[i][1];
    for (std::size_t k = 0; k < 4; ++k) {
      const double c = mesh.colours.empty() ? 1 : mesh.colours[i][k] / 255.0;
      v[8 + k] = static_cast<float>(look == Look::Full && k < 3 ? linearFromSrgb(c) : c);
    }
  }
}

void CpuMesh::makeMaterials(const Mesh& mesh, Look look) {
  for (const Material& m : mesh.materials) {
    MaterialParameters& to = materials_.emplace_back(materialParameters(m, look));
    const auto of = [&](std::int32_t t) { return textures_[static_cast<std::size_t>(t)]->parameters(); };
    if (m.texture >= 0 && !mesh.uvs.empty()) to.base = of(m.texture);
    if (m.emissiveTexture >= 0) to.glow = of(m.emissiveTexture);
  }
}

void CpuMesh::addLevel(const Mesh& mesh, std::span<const std::uint32_t> indices,
                       std::span<const Submesh> parts, bool open) {
  std::vector<CpuPart>& level = levels_.emplace_back();
  for (const Submesh& part : parts) {
    const Material& m = mesh.materials[part.material];
    const auto first = static_cast<std::uint32_t>(a_.size());
    const auto own = indices.subspan(part.firstIndex, part.indexCount / 3 * 3);
    for (std::size_t i = 0; i < own.size(); i += 3)
      a_.push_back(static_cast<int>(own[i])), b_.push_back(static_cast<int>(own[i + 1])),
          c_.push_back(static_cast<int>(own[i + 2]));
    level.push_back({first, part.indexCount / 3, part.material, m.transparent(), m.masked(),
                     m.doubleSided || open, sectionsOf(first, part.indexCount / 3)});
  }
}

std::vector<MeshSection> CpuMesh::sectionsOf(std::uint32_t firstTriangle, std::uint32_t triangles) const {
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
      for (const int corner : triangle(s.firstTriangle + t)) {
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
  return levels_[std::min<std::size_t>(level, levels_.size() - 1)];
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
