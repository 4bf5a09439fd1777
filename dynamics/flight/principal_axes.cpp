#include "dynamics/flight/principal_axes.h"

#include "dynamics/shapes/mass_properties.h"

#include <cmath>
#include <vector>

namespace stadion {
namespace {

Vec3 point(const Mesh& mesh, std::size_t i) {
  const auto& p = mesh.positions[i];
  return {p[0], p[1], p[2]};
}

/// Its component of greatest size is positive: one choice of two that does not depend on rounding.
Vec3 upward(const Vec3& axis) {
  Eigen::Index i = 0;
  axis.cwiseAbs().maxCoeff(&i);
  return axis[i] < 0 ? Vec3(-axis) : axis;
}

/// Axes of a covariance, the greatest variance first.
void setAxes(const Mat3& covariance, PrincipalAxes& a) {
  Vec3 rising;
  Quat q;
  principalAxes(covariance, rising, q);
  a.variance = rising.reverse().cwiseMax(0);
  Mat3 r;
  r.col(0) = upward(q * Vec3::UnitZ());
  r.col(2) = upward(q * Vec3::UnitX());
  r.col(1) = r.col(2).cross(r.col(0));
  a.q_NP = Quat(r).normalized();
}

/// Mean cube of the distance from the centre along each axis, over a triangle with corners in P.
Vec3 meanCube(const Vec3 (&v)[3]) {
  // Over a triangle, the mean of x^3 is (sum of all products of three corners, with repetition) / 10.
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      for (int k = j; k < 3; ++k) sum += v[i].cwiseProduct(v[j]).cwiseProduct(v[k]);
  return sum / 10;
}

}  // namespace

PrincipalAxes surfaceAxes(const Mesh& mesh) {
  double area = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  const Vec3 o = mesh.positions.empty() ? Vec3::Zero() : point(mesh, 0);
  const auto each = [&mesh](const auto& visit) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const Vec3 v[3] = {point(mesh, mesh.indices[i]), point(mesh, mesh.indices[i + 1]),
                         point(mesh, mesh.indices[i + 2])};
      visit(v, 0.5 * (v[1] - v[0]).cross(v[2] - v[0]).norm());
    }
  };
  each([&](const Vec3(&v)[3], double size) {
    area += size;
    first += size / 3 * (v[0] + v[1] + v[2] - 3 * o);
  });
  PrincipalAxes a;
  a.variance.setZero();
  if (!(area > 0)) return a;
  a.centre = o + first / area;
  each([&](const Vec3(&v)[3], double size) {
    const Vec3 d[3] = {v[0] - a.centre, v[1] - a.centre, v[2] - a.centre}, m = d[0] + d[1] + d[2];
    for (const Vec3& x : d) second += size / 12 * x * x.transpose();
    second += size / 12 * m * m.transpose();
  });
  setAxes(second / area, a);
  const Quat q_PN = a.q_NP.conjugate();
  each([&](const Vec3(&v)[3], double size) {
    const Vec3 d[3] = {q_PN * (v[0] - a.centre), q_PN * (v[1] - a.centre), q_PN * (v[2] - a.centre)};
    a.skewness += size / area * meanCube(d);
  });
  return a;
}

PrincipalAxes sampledAxes(const Mesh& mesh, std::size_t samples, std::uint64_t seed) {
  PrincipalAxes a;
  a.variance.setZero();
  if (mesh.positions.empty() || samples == 0) return a;
  std::vector<Vec3> drawn(samples);
  for (Vec3& p : drawn) {  // splitmix64
    std::uint64_t z = seed += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    z ^= z >> 31;
    p = point(mesh, z % mesh.positions.size());
    a.centre += p;
  }
  const double share = 1 / static_cast<double>(samples);
  a.centre *= share;
  Mat3 second = Mat3::Zero();
  for (const Vec3& p : drawn) second += share * (p - a.centre) * (p - a.centre).transpose();
  setAxes(second, a);
  for (const Vec3& p : drawn) {
    const Vec3 d = a.q_NP.conjugate() * (p - a.centre);
    a.skewness += share * d.cwiseProduct(d).cwiseProduct(d);
  }
  return a;
}

}  // namespace stadion
