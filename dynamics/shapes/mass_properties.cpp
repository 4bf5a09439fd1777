#include "dynamics/shapes/mass_properties.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

Vec3 vertex(const Mesh& m, std::uint32_t i) {
  const auto& p = m.positions[m.indices[i]];
  return {p[0], p[1], p[2]};
}

/// One Jacobi rotation that zeroes a(i, j).
void rotateAway(Mat3& a, Mat3& v, int i, int j) {
  if (a(i, j) == 0) return;
  const double theta = (a(j, j) - a(i, i)) / (2 * a(i, j));
  const double t = (theta >= 0 ? 1 : -1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  Mat3 r = Mat3::Identity();
  r(i, i) = r(j, j) = c;
  r(i, j) = s;
  r(j, i) = -s;
  a = r.transpose() * a * r;
  a(i, j) = a(j, i) = 0;
  v = v * r;
}

/// A rotation matrix as a quaternion, from its largest diagonal combination.
Quat quaternionOf(const Mat3& r) {
  return Quat(r).normalized();
}

}  // namespace

bool MassProperties::valid() const {
  return std::isfinite(mass) && mass > 0 && centre.allFinite() && axes.coeffs().allFinite() &&
         inertia.allFinite() && (inertia.array() > 0).all();
}

MassProperties MassProperties::withMass(double kg) const {
  MassProperties m = *this;
  m.inertia *= kg / mass;
  m.mass = kg;
  return m;
}

void principalAxes(const Mat3& symmetric, Vec3& moments, Quat& axes) {
  Mat3 a = 0.5 * (symmetric + symmetric.transpose()), v = Mat3::Identity();
  const double size = a.cwiseAbs().maxCoeff();
  for (int sweep = 0; sweep < 30; ++sweep) {
    const double off = std::max({std::fabs(a(0, 1)), std::fabs(a(0, 2)), std::fabs(a(1, 2))});
    if (!(off > 1e-15 * size)) break;
    rotateAway(a, v, 0, 1);
    rotateAway(a, v, 0, 2);
    rotateAway(a, v, 1, 2);
  }
  int order[3] = {0, 1, 2};
  const auto smaller = [&](int i, int j) { return a(i, i) < a(j, j); };
  std::stable_sort(order, order + 3, smaller);
  Mat3 r;
  for (int k = 0; k < 3; ++k) {
    moments[k] = a(order[k], order[k]);
    r.col(k) = v.col(order[k]);
  }
  if (r.determinant() < 0) r.col(2) = -r.col(2);
  axes = quaternionOf(r);
}

Result<VolumeIntegral> integrateVolume(const Mesh& mesh) {
  using R = Result<VolumeIntegral>;
  if (mesh.indices.size() < 12 || mesh.indices.size() % 3 != 0)
    return R::failure("has too few triangles to be solid");
  // Integrate about a point near the mesh, so that a mesh far from its origin loses no digits.
  Aabb box;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (mesh.indices[i] >= mesh.positions.size()) return R::failure("has an index out of range");
    const Vec3 p = vertex(mesh, static_cast<std::uint32_t>(i));
    if (!p.allFinite()) return R::failure("has a vertex that is not finite");
    box.include(p);
  }
  const Vec3 o = box.centre();
  double volume = 0, area = 0;
  Vec3 moment = Vec3::Zero(), vectorArea = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::uint32_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vec3 a = vertex(mesh, i) - o, b = vertex(mesh, i + 1) - o, c = vertex(mesh, i + 2) - o,
               s = a + b + c;
    const Vec3 n = (b - a).cross(c - a);
    const double det = a.dot(b.cross(c));
    vectorArea += n;
    area += n.norm();
    volume += det / 6;
    moment += det / 24 * s;
    second += det / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  const double extent = (box.hi - box.lo).norm();
  if (vectorArea.norm() > 1e-4 * area) return R::failure("is open: its faces do not enclose a volume");
  if (volume < 0) return R::failure("is turned inside out: its faces point inwards");
  if (!(volume > 1e-9 * extent * extent * extent)) return R::failure("encloses no volume");
  VolumeIntegral v;
  v.volume = volume;
  const Vec3 c = moment / volume;
  v.centre = o + c;
  const Mat3 e = second - volume * c * c.transpose();
  v.inertia = e.trace() * Mat3::Identity() - e;
  return v;
}

Result<MassProperties> massOfMesh(const Mesh& mesh, double density) {
  if (!(density > 0) || !std::isfinite(density))
    return Result<MassProperties>::failure("density must be positive");
  const auto v = integrateVolume(mesh);
  if (!v) return v.error();
  MassProperties m;
  m.mass = density * v.value().volume;
  m.centre = v.value().centre;
  principalAxes(density * v.value().inertia, m.inertia, m.axes);
  if (!m.valid())
    return Result<MassProperties>::failure("has no positive inertia: its faces cross each other");
  return m;
}

MassProperties massOfSphere(const Vec3& centre, double radius, double density) {
  MassProperties m;
  m.mass = density * 4.18879020478639098 * radius * radius * radius;  // 4 pi / 3
  m.centre = centre;
  m.inertia = Vec3::Constant(0.4 * m.mass * radius * radius);
  return m;
}

MassProperties massOfBox(const Pose& pose, const Vec3& half, double density) {
  MassProperties m;
  m.mass = density * 8 * half.prod();
  m.centre = pose.p;
  m.axes = pose.q;
  const Vec3 s = half.cwiseProduct(half);
  m.inertia = m.mass / 3 * Vec3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  return m;
}

}  // namespace stadion
