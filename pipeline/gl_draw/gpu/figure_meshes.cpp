#include "pipeline/gl_draw/gpu/figure_meshes.h"

#include <cstring>
#include <utility>

namespace stadion {

void FigureMeshes::begin(const DrawList& list) {
  constexpr std::uint64_t kKept = 200;  // lists; a figure may be out of sight for a while
  list_ = &list;
  ++lists_;
  std::erase_if(figures_, [&](const auto& entry) {
    return entry.second.usedIn + kKept < lists_ || !store_.holds(entry.second.id, entry.second.hash);
  });
}

const GlMesh* FigureMeshes::find(MeshId id, std::uint32_t figure) {
  const GlMesh* rest = meshes_.find(id);
  if (!rest || !list_ || figure == 0 || figure > list_->figures.size()) return rest;
  const Mesh* mesh = store_.find(id);
  if (!mesh || !mesh->skeleton) return rest;
  Held* own = held(id, *mesh, *rest, figure);
  if (!own) return rest;
  own->usedIn = lists_;
  const FigureRecord& playing = list_->figures[figure - 1];
  if (!own->isPosed || std::memcmp(&own->playing, &playing, sizeof playing) != 0) {
    own->playing = playing;
    pose(*mesh, *own);
  }
  return &own->gl;
}

FigureMeshes::Held* FigureMeshes::held(MeshId id, const Mesh& mesh, const GlMesh& rest,
                                       std::uint32_t figure) {
  const auto at = figures_.find(figure);
  if (at != figures_.end() && at->second.id == id && at->second.hash == mesh.hash) return &at->second;
  if (at != figures_.end()) figures_.erase(at);
  auto copy = meshes_.copyOf(mesh, rest);
  if (!copy) return nullptr;
  return &figures_.emplace(figure, Held{id, mesh.hash, std::move(*copy)}).first->second;
}

void FigureMeshes::pose(const Mesh& mesh, Held& figure) {
  pose_.set(*mesh.skeleton, figure.playing);
  vertices_.resize(mesh.positions.size());
  const SkinSource source =
      morphed_.apply({mesh.positions, mesh.normals, mesh.joints}, mesh.morphs, pose_.weights());
  skin(source, pose_.palette(), 0, vertices_);
  tangents_.resize(mesh.tangents.size());
  skinTangents(mesh.tangents, mesh.joints, pose_.palette(), 0, tangents_);
  meshes_.setVertices(mesh, {vertices_, tangents_}, figure.gl);
  figure.isPosed = true;
}

}  // namespace stadion
