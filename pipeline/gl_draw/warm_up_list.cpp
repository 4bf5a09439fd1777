#include "pipeline/gl_draw/warm_up_list.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace stadion {
namespace {

constexpr float kDistance = 3, kRadius = 0.7f;  // [m]: large enough that none is left out as too small
constexpr std::size_t kMostMeshes = 1000;       // of what is not seen at once, so that no show waits for long

/// Where the eye looks, relative to the list's origin.
Vec3 placeBefore(const DrawView& eye) {
  const Eigen::Matrix3d turn = eye.view.topLeftCorner<3, 3>();
  const Vec3 at = -turn.transpose() * eye.view.topRightCorner<3, 1>();
  return at - static_cast<double>(kDistance) * turn.row(2).transpose();
}

DrawItem itemOf(MeshId id, const Mesh& mesh, const Vec3& place) {
  DrawItem item;
  const double radius = mesh.sphere.radius > 0 && std::isfinite(mesh.sphere.radius) ? mesh.sphere.radius : 1;
  const double scale = static_cast<double>(kRadius) / radius;
  const Vec3 centre = place - scale * mesh.sphere.centre;
  item.model = {};
  for (std::size_t row = 0; row < 3; ++row) {
    item.model[4 * row + row] = static_cast<float>(scale);
    item.model[4 * row + 3] = static_cast<float>(centre[static_cast<Eigen::Index>(row)]);
  }
  item.mesh = id;
  item.distance = kDistance;
  item.pixels = 10'000;
  item.level = static_cast<std::uint32_t>(mesh.levels.size());
  return item;
}

/// Items with a paint that is seen through. An opaque part needs other programs then.
void addFading(const MeshStore& meshes, std::span<const MeshId> fading, const Vec3& place, DrawList& list) {
  if (list.paints.size() >= kMostPaints) return;
  const std::set<MeshId> ids(fading.begin(), fading.end());
  std::size_t added = 0;
  for (const MeshId id : ids) {
    const Mesh* mesh = meshes.find(id);
    if (!mesh || mesh->indices.empty() || ++added > kMostMeshes) continue;
    if (added == 1) list.paints.push_back({.opacity = 0.5f});
    list.transparent.push_back(itemOf(id, *mesh, place));
    list.transparent.back().paint = static_cast<std::uint32_t>(list.paints.size());
  }
}

}  // namespace

DrawList warmUpList(const DrawList& first, const MeshStore& meshes, std::span<const MeshId> fading) {
  DrawList list = first;
  list.filling = nullptr;
  std::set<MeshId> seen;
  for (const auto* items : {&first.opaque, &first.transparent})
    for (const DrawItem& item : *items) seen.insert(item.mesh);
  const Vec3 place = placeBefore(first.views[0]);
  std::size_t added = 0;
  for (const MeshId id : meshes.used()) {
    const Mesh* mesh = seen.contains(id) ? nullptr : meshes.find(id);
    if (!mesh || mesh->indices.empty() || ++added > kMostMeshes) continue;
    (mesh->transparent() ? list.transparent : list.opaque).push_back(itemOf(id, *mesh, place));
  }
  addFading(meshes, fading, place, list);
  std::ranges::stable_sort(list.opaque, [](const DrawItem& a, const DrawItem& b) {
    return std::pair(a.mesh, a.level) < std::pair(b.mesh, b.level);
  });
  return list;
}

}  // namespace stadion
