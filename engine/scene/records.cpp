#include "engine/scene/records.h"

#include <algorithm>

namespace stadion {

InstanceRecord makeInstance(const Affine& X_WN, const Mesh& mesh, MeshId id, bool shown, NodeRef owner,
                            double lodFactor) {
  InstanceRecord r{};
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 4; ++col) r.model[4 * row + col] = X_WN.matrix()(row, col);
  const Vec3 centre = X_WN * mesh.sphere.centre;
  for (int i = 0; i < 3; ++i) r.centre[i] = centre[i];
  // The sphere grows by at most the Frobenius norm of the linear part, and exactly by the scale when that is
  // uniform.
  const double longest =
      std::max({X_WN.linear().col(0).norm(), X_WN.linear().col(1).norm(), X_WN.linear().col(2).norm()});
  const Mat3 gram = X_WN.linear().transpose() * X_WN.linear();
  const bool uniform = (gram - longest * longest * Mat3::Identity()).norm() < 1e-9 * longest * longest;
  const double growth = uniform ? longest : X_WN.linear().norm();
  // Rounding to float must not shrink the sphere.
  r.radius = static_cast<float>(mesh.sphere.radius * growth * (1 + 1e-6));
  r.mesh = id;
  r.flags = shown ? InstanceRecord::kShown : 0;
  if (std::any_of(mesh.materials.begin(), mesh.materials.end(),
                  [](const Material& m) { return m.transparent(); }))
    r.flags |= InstanceRecord::kTransparent;
  r.owner = owner;
  r.lodFactor = mesh.levels.empty() ? 0.0f : static_cast<float>(lodFactor);
  return r;
}

void ViewerRecord::set(const Pose& X_WR, const Pose& X_RH) {
  for (int i = 0; i < 3; ++i) rigPosition[i] = X_WR.p[i], headPosition[i] = X_RH.p[i];
  for (int i = 0; i < 4; ++i) rigOrientation[i] = X_WR.q.coeffs()[i], headOrientation[i] = X_RH.q.coeffs()[i];
}

void ChangeSet::clear() {
  instances.clear(), chunks.clear(), statics.clear(), lights.clear();
  lightsChanged = false;
}

}  // namespace stadion
