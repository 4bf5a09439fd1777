#include "dynamics/shapes/mesh_distance.h"

#include "dynamics/shapes/triangle_tree.h"

#include <exception>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace stadion {
namespace {

fcl::Transform3d toFcl(const Pose& X) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = X.q.toRotationMatrix();
  t.translation() = X.p;
  return t;
}

bool meets(const fcl::BVHModel<fcl::OBBRSSd>& a, const fcl::CollisionGeometryd& b, const Pose& X_AB) {
  try {
    fcl::CollisionResultd hit;
    fcl::collide(&a, fcl::Transform3d::Identity(), &b, toFcl(X_AB), fcl::CollisionRequestd(1, false), hit);
    return hit.isCollision();
  } catch (const std::exception&) {
    return true;
  }
}

}  // namespace

struct MeshHierarchy::Model {
  fcl::BVHModel<fcl::OBBRSSd> bvh;
  bool usable = false;
  std::uint32_t count = 0;
};

MeshHierarchy::MeshHierarchy(const std::vector<Triangle>& triangles) : model_(std::make_unique<Model>()) {
  if (triangles.empty()) return;
  try {
    model_->bvh.beginModel(static_cast<int>(triangles.size()), static_cast<int>(3 * triangles.size()));
    for (const Triangle& t : triangles) model_->bvh.addTriangle(t.v[0], t.v[1], t.v[2]);
    model_->bvh.endModel();
    model_->count = static_cast<std::uint32_t>(triangles.size());
    model_->usable = true;
  } catch (const std::exception&) {
    model_->usable = false;
  }
}

MeshHierarchy::~MeshHierarchy() = default;
MeshHierarchy::MeshHierarchy(MeshHierarchy&&) noexcept = default;
MeshHierarchy& MeshHierarchy::operator=(MeshHierarchy&&) noexcept = default;

std::optional<MeshHierarchy::Pair> MeshHierarchy::nearest(const MeshHierarchy& a, const Pose& X_WA,
                                                          const MeshHierarchy& b, const Pose& X_WB) {
  if (!a.model_->usable || !b.model_->usable || !X_WA.finite() || !X_WB.finite()) return {};
  const auto inRange = [&](std::intptr_t i, std::intptr_t j) {
    return i >= 0 && j >= 0 && i < a.model_->count && j < b.model_->count;
  };
  try {
    // Relative to A, so that far from the origin no digits are lost.
    const fcl::Transform3d at = fcl::Transform3d::Identity(), bt = toFcl(X_WA.inverse() * X_WB);
    fcl::CollisionRequestd ask(1, true);
    fcl::CollisionResultd hit;
    fcl::collide(&a.model_->bvh, at, &b.model_->bvh, bt, ask, hit);
    if (hit.isCollision() && hit.numContacts() > 0) {
      const auto& c = hit.getContact(0);
      if (inRange(c.b1, c.b2))
        return Pair{static_cast<std::uint32_t>(c.b1), static_cast<std::uint32_t>(c.b2), true};
    }
    fcl::DistanceRequestd far(true);
    fcl::DistanceResultd result;
    fcl::distance(&a.model_->bvh, at, &b.model_->bvh, bt, far, result);
    if (!inRange(result.b1, result.b2)) return {};
    return Pair{static_cast<std::uint32_t>(result.b1), static_cast<std::uint32_t>(result.b2), false};
  } catch (const std::exception&) {
    return {};
  }
}

bool MeshHierarchy::cross(const MeshHierarchy& a, const Pose& X_WA, const MeshHierarchy& b,
                          const Pose& X_WB) {
  if (!a.model_->usable || !b.model_->usable) return false;
  if (!X_WA.finite() || !X_WB.finite()) return true;
  return meets(a.model_->bvh, b.model_->bvh, X_WA.inverse() * X_WB);
}

bool MeshHierarchy::reaches(const Vec3& centre, double radius) const {
  if (!model_->usable) return false;
  if (!centre.allFinite()) return true;
  return meets(model_->bvh, fcl::Sphered(radius), {centre, Quat::Identity()});
}

}  // namespace stadion
