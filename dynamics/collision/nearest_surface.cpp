#include "dynamics/collision/nearest_surface.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// A unit vector along v, or `other` if v is nothing.
Vec3 along(const Vec3& v, double length, const Vec3& other) {
  return length > 0 ? Vec3(v / length) : other;
}

}  // namespace

NearestSurface nearestSurface(const CapsuleShape& s, const Vec3& x) {
  const Vec3 l = s.pose.q.conjugate() * (x - s.pose.p), q(0, 0, std::clamp(l.z(), -s.half, s.half)),
             d = l - q;
  const double n = d.norm();
  const Vec3 out = along(d, n, Vec3::UnitX());
  return {n - s.radius, s.pose * Vec3(q + s.radius * out), s.pose.q * out, false};
}

NearestSurface nearestSurface(const CylinderShape& s, const Vec3& x) {
  const Vec3 l = s.pose.q.conjugate() * (x - s.pose.p);
  const double rho = std::sqrt(l.x() * l.x() + l.y() * l.y()), up = l.z() < 0 ? -1 : 1;
  const Vec3 radial = along(Vec3(l.x(), l.y(), 0), rho, Vec3::UnitX());
  const double side = rho - s.radius, cap = std::fabs(l.z()) - s.half;
  Vec3 q, n;
  double d;
  if (side <= 0 && (cap > 0 || cap >= side)) {  // over a cap, or inside and nearer to it
    q = {l.x(), l.y(), up * s.half};
    n = {0, 0, up};
    d = cap;
  } else if (cap <= 0) {
    q = s.radius * radial + Vec3(0, 0, l.z());
    n = radial;
    d = side;
  } else {  // off the rim
    q = s.radius * radial + Vec3(0, 0, up * s.half);
    d = (l - q).norm();
    n = (l - q) / d;
  }
  return {d, s.pose * q, s.pose.q * n, side <= 0 && n.z() != 0};
}

NearestSurface nearestSurface(const ConvexShape& s, const Vec3& x) {
  const ConvexShape::Face* highest = &s.faces.front();
  double height = -1e300;
  for (const ConvexShape::Face& f : s.faces)
    if (const double h = f.normal.dot(x) - f.offset; h > height) {
      height = h;
      highest = &f;
    }
  if (height <= 0) return {height, x - height * highest->normal, highest->normal, true};
  // A face is nearest if x is in the prism over it; else some edge of a face that sees x is.
  NearestSurface best;
  best.distance = 1e300;
  for (const ConvexShape::Face& f : s.faces) {
    const double h = f.normal.dot(x) - f.offset;
    if (h <= 0 || h >= best.distance) continue;
    bool over = true;
    for (std::uint32_t k = 0; k < f.count; ++k) {
      const Vec3 &a = s.points[s.loops[f.first + k]], &b = s.points[s.loops[f.first + (k + 1) % f.count]];
      const Vec3 e = b - a;
      if (f.normal.cross(e).dot(x - a) >= 0) continue;
      over = false;
      const Vec3 q = a + std::clamp((x - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e;
      if (const double d = (x - q).norm(); d < best.distance) best = {d, q, (x - q) / d, false};
    }
    if (over) best = {h, x - h * f.normal, f.normal, true};
  }
  return best;
}

}  // namespace stadion
