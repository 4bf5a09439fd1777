#include "pipeline/cpu_draw/mesh/mesh_paints.h"

#include "pipeline/cpu_draw/mesh/cpu_material.h"
#include "pipeline/surface/painted_material.h"

#include <algorithm>
#include <iterator>

namespace stadion {

std::shared_ptr<const MeshPaint>
MeshPaints::find(const Mesh& mesh, const std::shared_ptr<const CpuMesh>& bare, const PaintRecord& paint) {
  const auto &t = paint.tint, &e = paint.emit;
  const std::lock_guard lock(mutex_);
  Held& held = paints_[{bare, {t[0], t[1], t[2], paint.opacity, e[0], e[1], e[2]}}];
  if (!held.paint) held.paint = made(mesh, *bare, paint);
  held.usedIn = frame_;
  return held.paint;
}

std::shared_ptr<const MeshPaint> MeshPaints::made(const Mesh& mesh, const CpuMesh& bare,
                                                  const PaintRecord& paint) const {
  auto made = std::make_shared<MeshPaint>();
  made->seeThrough = paint.isSeeThrough();
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const MaterialParameters by = materialParameters(painted(mesh.materials[i], paint), look_);
    MaterialParameters& to = made->materials.emplace_back(bare.material(static_cast<std::uint32_t>(i)));
    std::copy(std::begin(by.baseColour), std::end(by.baseColour), to.baseColour);
    std::copy(std::begin(by.emissive), std::end(by.emissive), to.emissive);
    to.alphaCutoff = by.alphaCutoff;
  }
  return made;
}

void MeshPaints::begin(std::uint64_t frame) {
  constexpr std::uint64_t kRestarted = 100;  // a show that restarts counts frames from 0
  const std::lock_guard lock(mutex_);
  if (frame <= frame_ && frame + kRestarted > frame_) return;
  frame_ = frame;
  std::erase_if(paints_, [&](const auto& entry) {
    return entry.second.usedIn + 1 < frame_ || entry.second.usedIn > frame_;
  });
}

std::size_t MeshPaints::size() const {
  const std::lock_guard lock(mutex_);
  return paints_.size();
}

}  // namespace stadion
