#include "engine/published/records.h"

#include <algorithm>
#include <cmath>

namespace stadion {

double sphereScale(const Affine& X_WN) {
  const auto& X = X_WN.matrix();
  // It grows by at most the Frobenius norm of the linear part, and exactly by the scale when that is uniform:
  // when the columns are as long as each other and at right angles.
  const auto dot = [&X](int a, int b) { return X(0, a) * X(0, b) + X(1, a) * X(1, b) + X(2, a) * X(2, b); };
  const double xx = dot(0, 0), yy = dot(1, 1), zz = dot(2, 2), xy = dot(0, 1), yz = dot(1, 2), zx = dot(2, 0);
  const double most = std::max({xx, yy, zz});
  const double odd = (xx - most) * (xx - most) + (yy - most) * (yy - most) + (zz - most) * (zz - most) +
                     2 * (xy * xy + yz * yz + zx * zx);
  const double squared = odd < 1e-18 * most * most ? most : xx + yy + zz;
  return std::sqrt(squared);
}

void placeInstance(InstanceRecord& r, const Affine& X_WN, const Sphere& sphere_N) {
  std::array<double, 12> rows;
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(rows.data()) = X_WN.affine();
  placeInstance(r, rows, sphereScale(X_WN), sphere_N);
}

InstanceRecord makeInstance(const Affine& X_WN, const Mesh& mesh, MeshId id, bool shown, NodeRef owner,
                            double lodFactor) {
  InstanceRecord r{};
  placeInstance(r, X_WN, mesh.sphere);
  r.mesh = id;
  r.flags = (shown ? InstanceRecord::kShown : 0) | (mesh.transparent() ? InstanceRecord::kTransparent : 0);
  r.owner = owner;
  r.lodFactor = mesh.levels.empty() ? 0.0f : static_cast<float>(lodFactor);
  return r;
}

void ViewerRecord::set(const Pose& X_WR, const Pose& X_RH) {
  for (int i = 0; i < 3; ++i) {
    rigPosition[i] = X_WR.p[i];
    headPosition[i] = X_RH.p[i];
  }
  for (int i = 0; i < 4; ++i) {
    rigOrientation[i] = X_WR.q.coeffs()[i];
    headOrientation[i] = X_RH.q.coeffs()[i];
  }
}

void ChangeSet::clear() {
  instances.clear();
  chunks.clear();
  statics.clear();
  lights.clear();
  lightsChanged = false;
  figures.clear();
  figuresChanged = false;
  paints.clear();
  paintsChanged = false;
}

}  // namespace stadion
