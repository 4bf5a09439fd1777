#include "pipeline/cpu_draw/mesh/posed_meshes.h"

#include "engine/figure/figure_pose.h"

#include <algorithm>
#include <cstring>

namespace stadion {
namespace {

bool isSame(const FigureRecord& a, const FigureRecord& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// A show that restarts counts frames from 0.
constexpr std::uint64_t kRestarted = 100;

}  // namespace

/// A mesh comes back when its last user lets it go. The lock orders what that user read before the next pose is written.
class PosedMeshes::Spares : public std::enable_shared_from_this<Spares> {
public:
  std::shared_ptr<CpuMesh> take(const CpuMesh& rest) {
    std::unique_ptr<CpuMesh> mesh;
    {
      const std::lock_guard lock(mutex_);
      if (!meshes_.empty()) {
        mesh = std::move(meshes_.back());
        meshes_.pop_back();
      }
    }
    if (!mesh) mesh = std::make_unique<CpuMesh>(rest);
    return {mesh.release(), [to = weak_from_this()](CpuMesh* used) {
              std::unique_ptr<CpuMesh> back(used);
              if (const auto spares = to.lock()) spares->put(std::move(back));
            }};
  }

private:
  void put(std::unique_ptr<CpuMesh> mesh) {
    const std::lock_guard lock(mutex_);
    meshes_.push_back(std::move(mesh));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<CpuMesh>> meshes_;
};

std::pair<std::shared_ptr<PosedMeshes::Pose>, std::shared_ptr<PosedMeshes::Spares>>
PosedMeshes::poseOf(const std::shared_ptr<const CpuMesh>& rest, const FigureRecord& playing) {
  const std::lock_guard lock(mutex_);
  auto& [poses, spares] = figures_[rest];
  if (!spares) spares = std::make_shared<Spares>();
  auto at = std::ranges::find_if(poses, [&](const auto& pose) { return isSame(pose->playing, playing); });
  if (at == poses.end()) {
    at = poses.insert(poses.end(), std::make_shared<Pose>());
    (*at)->playing = playing;
  }
  (*at)->usedIn = frame_;
  return {*at, spares};
}

std::shared_ptr<const CpuMesh> PosedMeshes::find(const Mesh& mesh, const std::shared_ptr<const CpuMesh>& rest,
                                                 const FigureRecord& playing) {
  const auto [pose, spares] = poseOf(rest, playing);
  const std::lock_guard lock(pose->mutex);
  if (pose->mesh) return pose->mesh;
  FigurePose bones;
  bones.set(*mesh.skeleton, playing);
  std::shared_ptr<CpuMesh> made = spares->take(*rest);
  made->takePose(mesh, bones);
  pose->mesh = std::move(made);
  return pose->mesh;
}

void PosedMeshes::begin(std::uint64_t frame) {
  const std::lock_guard lock(mutex_);
  if (frame <= frame_ && frame + kRestarted > frame_) return;
  frame_ = frame;
  const auto isOld = [&](const std::shared_ptr<Pose>& pose) {
    return pose->usedIn + 1 < frame_ || pose->usedIn > frame_;
  };
  for (auto figure = figures_.begin(); figure != figures_.end();) {
    auto& poses = figure->second.poses;
    if (poses.empty()) {  // also since the frame before: the figure has gone
      figure = figures_.erase(figure);
      continue;
    }
    std::erase_if(poses, isOld);
    ++figure;
  }
}

std::size_t PosedMeshes::size() const {
  const std::lock_guard lock(mutex_);
  std::size_t count = 0;
  for (const auto& [rest, figure] : figures_) count += figure.poses.size();
  return count;
}

}  // namespace stadion
