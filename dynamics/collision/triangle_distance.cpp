#include "dynamics/collision/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// Where the segment p p+d passes through the triangle.
bool pierces(const Vec3& p, const Vec3& d, const Triangle& t, Vec3& at) {
  const double h0 = t.normal.dot(p - t.v[0]), h1 = t.normal.dot(p + d - t.v[0]);
  if ((h0 > 0) == (h1 > 0)) return false;
  at = p + d * (h0 / (h0 - h1));
  for (std::size_t i = 0; i < 3; ++i)
    if (t.normal.cross(t.v[(i + 1) % 3] - t.v[i]).dot(at - t.v[i]) < 0) return false;
  return true;
}

}  // namespace

NearestPoints nearestOfSegments(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e) {
  const Vec3 w = p - q;
  const double a = d.squaredNorm(), b = d.dot(e), c = e.squaredNorm(), f = d.dot(w), g = e.dot(w);
  const double det = a * c - b * b;
  double s = det > 1e-14 * a * c ? std::clamp((b * g - c * f) / det, 0.0, 1.0) : 0;
  double t = c > 0 ? (b * s + g) / c : 0;
  if (t < 0) {
    t = 0;
    s = a > 0 ? std::clamp(-f / a, 0.0, 1.0) : 0;
  } else if (t > 1) {
    t = 1;
    s = a > 0 ? std::clamp((b - f) / a, 0.0, 1.0) : 0;
  }
  NearestPoints n;
  n.a = p + s * d;
  n.b = q + t * e;
  n.distance = (n.a - n.b).norm();
  return n;
}

NearestPoints nearestOfTriangles(const Triangle& a, const Triangle& b) {
  NearestPoints best;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 d = a.v[(i + 1) % 3] - a.v[i], e = b.v[(i + 1) % 3] - b.v[i];
    Vec3 at;
    if (pierces(a.v[i], d, b, at) || pierces(b.v[i], e, a, at)) return {0, at, at};
    for (std::size_t j = 0; j < 3; ++j) {
      const NearestPoints n = nearestOfSegments(a.v[i], d, b.v[j], b.v[(j + 1) % 3] - b.v[j]);
      if (n.distance < best.distance) best = n;
    }
    const Vec3 q = closestPoint(b, a.v[i]).point, r = closestPoint(a, b.v[i]).point;
    if (const double n = (a.v[i] - q).norm(); n < best.distance) best = {n, a.v[i], q};
    if (const double n = (b.v[i] - r).norm(); n < best.distance) best = {n, r, b.v[i]};
  }
  return best;
}

}  // namespace stadion
