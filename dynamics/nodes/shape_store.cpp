#include "dynamics/nodes/shape_store.h"

#include "engine/maths/angles.h"

#include <algorithm>

namespace stadion {
namespace {

/// Empty = auto.
ShapeKind shapeKindOf(const std::string& word) {
  if (word == "sphere") return ShapeKind::Ball;
  if (word == "box") return ShapeKind::Box;
  if (word == "capsule") return ShapeKind::Capsule;
  if (word == "cylinder") return ShapeKind::Cylinder;
  if (word == "convex") return ShapeKind::Convex;
  if (word == "plane") return ShapeKind::Plane;
  if (word == "mesh") return ShapeKind::Mesh;
  return ShapeKind::Auto;
}

double dragAreaOf(const Shape& shape, const Mesh& mesh) {
  constexpr double ballCoefficient = 0.47;
  if (const auto* ball = std::get_if<BallShape>(&shape))
    return ballCoefficient * kPi * ball->radius * ball->radius;
  double surface = 0;
  const auto corner = [&](std::size_t i) {
    const auto& p = mesh.positions[mesh.indices[i]];
    return Vec3(p[0], p[1], p[2]);
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    surface += 0.5 * (corner(i + 1) - corner(i)).cross(corner(i + 2) - corner(i)).norm();
  return surface / 4;
}

Result<MassProperties> filled(const Shape& shape, const Mesh& mesh) {
  if (const auto* ball = std::get_if<BallShape>(&shape)) return massOfSphere(ball->centre, ball->radius, 1);
  if (const auto* box = std::get_if<BoxShape>(&shape)) return massOfBox(box->pose, box->half, 1);
  return massOfMesh(mesh, 1);
}

}  // namespace

Mesh scaled(const Mesh& mesh, const Eigen::Vector3f& scale) {
  Mesh m;
  m.positions = mesh.positions;
  m.indices = mesh.indices;
  m.name = mesh.name;
  for (auto& p : m.positions)
    for (std::size_t i = 0; i < 3; ++i) p[i] *= scale[static_cast<int>(i)];
  for (const auto& p : m.positions) m.bounds.include(Vec3(p[0], p[1], p[2]));
  const Vec3 s = scale.cast<double>();
  m.sphere = {mesh.sphere.centre.cwiseProduct(s), mesh.sphere.radius * s.maxCoeff()};
  return m;
}

Result<SharedFit> ShapeStore::fit(const Mesh& mesh, const Appearance& appearance, const Vec3& scale) {
  const Eigen::Vector3f s = scale.cast<float>();
  const Key key{appearance.mesh, s.x(), s.y(), s.z(), appearance.shape, appearance.tolerance};
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = known_.find(key); at != known_.end())
      if (SharedFit fit = at->second.lock()) return fit;
  }
  const Mesh own = scaled(mesh, s);
  auto choice = chooseShape(own, shapeKindOf(appearance.shape), appearance.tolerance);
  if (!choice) return choice.error();
  auto mass = filled(choice.value().shape, own);
  const double dragArea = dragAreaOf(choice.value().shape, own);
  const auto fit = std::make_shared<const FittedShape>(
      FittedShape{s.cast<double>(), std::move(choice.value()), std::move(mass), dragArea});

  const std::lock_guard lock(mutex_);
  known_[key] = fit;
  if (known_.size() >= pruneAt_) {
    std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
    pruneAt_ = std::max<std::size_t>(64, 2 * known_.size());
  }
  return SharedFit(fit);
}

}  // namespace stadion
