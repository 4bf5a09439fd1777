#include "pipeline/cpu_draw/mesh/posed_meshes.h"

#include "engine/figure/figure_pose.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace stadion {
namespace {

bool isSame(const FigureRecord& a, const FigureRecord& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// A show that restarts counts frames from 0.
constexpr std::uint64_t kRestarted = 100;

}  // namespace

std::shared_ptr<PosedMeshes::Pose> PosedMeshes::poseOf(const std::shared_ptr<const CpuMesh>& rest,
                                                       const FigureRecord& playing) {
  const std::lock_guard lock(mutex_);
  Poses& poses = poses_[rest];
  auto at = std::ranges::find_if(poses, [&](const auto& pose) { return isSame(pose->playing, playing); });
  if (at == poses.end()) {
    at = poses.insert(poses.end(), std::make_shared<Pose>());
    (*at)->playing = playing;
  }
  (*at)->usedIn = frame_;
  return *at;
}

std::shared_ptr<CpuMesh> PosedMeshes::takeSpare(const std::shared_ptr<const CpuMesh>& rest) {
  const std::lock_guard lock(mutex_);
  auto& spare = spare_[rest];
  if (spare.empty()) return nullptr;
  std::shared_ptr<CpuMesh> mesh = std::move(spare.back());
  spare.pop_back();
  return mesh;
}

std::shared_ptr<const CpuMesh> PosedMeshes::find(const Mesh& mesh, const std::shared_ptr<const CpuMesh>& rest,
                                                 const FigureRecord& playing) {
  const std::shared_ptr<Pose> pose = poseOf(rest, playing);
  const std::lock_guard lock(pose->mutex);
  if (pose->mesh) return pose->mesh;
  FigurePose bones;
  bones.set(*mesh.skeleton, playing);
  std::shared_ptr<CpuMesh> made = takeSpare(rest);
  if (!made) made = std::make_shared<CpuMesh>(*rest);
  made->takePose(mesh, bones.palette());
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
  for (auto figure = poses_.begin(); figure != poses_.end();) {
    auto& [rest, poses] = *figure;
    if (poses.empty()) {  // also since the frame before: the figure has gone
      spare_.erase(rest);
      figure = poses_.erase(figure);
      continue;
    }
    // Nothing finds it any more, so its uses can only become fewer.
    for (const auto& pose : poses)
      if (isOld(pose) && pose.use_count() == 1 && pose->mesh.use_count() == 1)
        spare_[rest].push_back(std::move(pose->mesh));
    std::erase_if(poses, isOld);
    ++figure;
  }
  // What others have read of a mesh that they gave back comes before it is written again.
  std::atomic_thread_fence(std::memory_order_acquire);
}

std::size_t PosedMeshes::size() const {
  const std::lock_guard lock(mutex_);
  std::size_t count = 0;
  for (const auto& [rest, poses] : poses_) count += poses.size();
  return count;
}

}  // namespace stadion
