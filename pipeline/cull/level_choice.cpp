#include "pipeline/cull/level_choice.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kNearest = 0.05;         ///< of a head to a wall [m]: heads do not pass through it
constexpr double kNearestSurface = 1e-3;  ///< of an eye that is not the head's [m]

/// The smallest factor by which the matrix shortens anything: what is left of its determinant.
double leastScale(const Mat3& m, double most) {
  const double volume = std::abs(m.determinant());
  const bool uniform = std::abs(volume - most * most * most) <= 1e-4 * most * most * most;
  return uniform ? most : volume / (most * most);
}

}  // namespace

void LevelChoice::setViewer(const ViewerRecord& viewer) {
  viewer_ = &viewer;
  walls_.clear();
  known_.clear();
}

// Most shows have no levels: what only they need is made when the first one is met.
void LevelChoice::lookAtWalls() {
  const Pose X_WR = viewer_->rig(), X_RH = viewer_->head();
  head_ = X_WR * X_RH.p;
  for (const WallPixels& w : wallPixels_) {
    const WallBasis b = basis(w.wall);
    const Vec3 eye = w.around ? Vec3(Vec3::Zero()) : X_RH.p, from = w.at ? *w.at : X_RH.p;
    const double distance = std::max(std::abs(b.normal.dot(eye - w.wall.lowerLeft)), kNearest);
    const double pitch = std::min(b.width / w.width, b.height / w.height);
    Seen seen{w.at.has_value(), X_WR.q * Vec3(from - X_RH.p), X_WR.q * Vec3(-b.normal), distance / pitch, 0};
    for (const Vec3& corner : {w.wall.lowerLeft, w.wall.lowerRight, w.wall.upperLeft, w.wall.upperRight()})
      seen.mostAngle =
          std::max(seen.mostAngle, std::acos(std::clamp(distance / (corner - eye).norm(), 0.0, 1.0)));
    walls_.push_back(seen);
  }
}

const Mesh* LevelChoice::mesh(MeshId id) {
  const auto at = std::ranges::lower_bound(known_, id, {}, &std::pair<MeshId, const Mesh*>::first);
  if (at != known_.end() && at->first == id) return at->second;
  return known_.insert(at, {id, meshes_.find(id)})->second;
}

/// Returns how many pixels a radian has where the ball is seen; 0 if no wall shows it.
double LevelChoice::pixelsOf(const Vec3& centre, double radius) const {
  double most = 0;
  for (const Seen& wall : walls_) {
    const Vec3 away = centre - wall.from;
    const double distance = away.norm();
    double angle = wall.mostAngle;
    if (distance > radius) {
      const double middle = std::acos(std::clamp(wall.towards.dot(away) / distance, -1.0, 1.0));
      const double half = std::asin(radius / distance);
      if (middle - half > wall.mostAngle) continue;
      angle = std::min(middle + half, wall.mostAngle);
    }
    const double c = std::cos(angle);
    double pixels = wall.pixels / (c * c);
    // levelOf() measures distances from the head.
    if (wall.elsewhere) pixels *= centre.norm() / std::max(distance - radius, kNearestSurface);
    most = std::max(most, pixels);
  }
  return most;
}

std::uint32_t LevelChoice::levelOf(const InstanceRecord& r) {
  if (r.lodFactor == 0 || wallPixels_.empty()) return 0;
  const Mesh* m = mesh(r.mesh);
  if (!m || m->levels.empty() || !(m->sphere.radius > 0)) return 0;
  if (walls_.empty()) lookAtWalls();
  Affine X_WN;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 4; ++col) X_WN.matrix()(row, col) = r.model[4 * row + col];
  const double most = double{r.radius} / m->sphere.radius, least = leastScale(X_WN.linear(), most);
  if (!(least > 0)) return 0;
  const Vec3 head_N = X_WN.inverse() * head_;
  const Vec3 nearest = head_N.cwiseMax(m->bounds.lo).cwiseMin(m->bounds.hi);
  const double distance = (head_N - nearest).norm() * least * viewer_->stress * double{r.lodFactor};
  const double pixels =
      pixelsOf(Vec3(r.centre[0], r.centre[1], r.centre[2]) - head_, double{r.radius}) * most;
  std::uint32_t level = 0;
  while (level < m->levels.size() && m->levels[level].error * pixels <= kMostPixels * distance) ++level;
  return level;
}

}  // namespace stadion
