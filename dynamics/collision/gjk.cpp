#include "dynamics/collision/gjk.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr int kMostSteps = 96;

struct SimplexVertex {
  Vec3 w = Vec3::Zero(), a = Vec3::Zero(), b = Vec3::Zero();
  double weight = 1;
};

struct Simplex {
  std::array<SimplexVertex, 4> at;
  int count = 0;

  SimplexVertex& operator[](int i) { return at[static_cast<std::size_t>(i)]; }
  const SimplexVertex& operator[](int i) const { return at[static_cast<std::size_t>(i)]; }
  Vec3 point() const {
    Vec3 x = Vec3::Zero();
    for (int i = 0; i < count; ++i) x += (*this)[i].weight * (*this)[i].w;
    return x;
  }
};

Simplex only(const SimplexVertex& a) {
  Simplex s;
  s.count = 1;
  s[0] = a;
  s[0].weight = 1;
  return s;
}

/// The part of a segment that is nearest to the origin.
Simplex nearest(const SimplexVertex& a, const SimplexVertex& b) {
  const Vec3 e = b.w - a.w;
  const double t = -a.w.dot(e), n = e.squaredNorm();
  if (!(t > 0)) return only(a);
  if (t >= n) return only(b);
  Simplex s;
  s.count = 2;
  s[0] = a;
  s[1] = b;
  s[1].weight = t / n;
  s[0].weight = 1 - s[1].weight;
  return s;
}

Simplex better(const Simplex& a, const Simplex& b) {
  return a.point().squaredNorm() <= b.point().squaredNorm() ? a : b;
}

/// Of a triangle; its regions as in Ericson, Real-Time Collision Detection, 2005, section 5.1.5.
Simplex nearest(const SimplexVertex& a, const SimplexVertex& b, const SimplexVertex& c) {
  const Vec3 n = (b.w - a.w).cross(c.w - a.w);
  const double u = n.dot(b.w.cross(c.w)), v = n.dot(c.w.cross(a.w)), w = n.dot(a.w.cross(b.w));
  const double sum = u + v + w;
  if (u > 0 && v > 0 && w > 0 && sum > 0) {
    Simplex s;
    s.count = 3;
    s[0] = a;
    s[1] = b;
    s[2] = c;
    s[0].weight = u / sum;
    s[1].weight = v / sum;
    s[2].weight = w / sum;
    return s;
  }
  return better(nearest(a, b), better(nearest(b, c), nearest(c, a)));
}

/// False if the origin is inside.
bool nearest(const Simplex& t, Simplex& out) {
  const auto beyond = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 n = (b - a).cross(c - a);
    return n.dot(a) * n.dot(d - a) >= 0;  // the origin is not on d's side of abc
  };
  const bool f0 = beyond(t[0].w, t[1].w, t[2].w, t[3].w), f1 = beyond(t[0].w, t[1].w, t[3].w, t[2].w),
             f2 = beyond(t[0].w, t[2].w, t[3].w, t[1].w), f3 = beyond(t[1].w, t[2].w, t[3].w, t[0].w);
  if (!f0 && !f1 && !f2 && !f3) return false;
  bool any = false;
  const auto offer = [&](const Simplex& s) { out = any ? better(out, s) : s, any = true; };
  if (f0) offer(nearest(t[0], t[1], t[2]));
  if (f1) offer(nearest(t[0], t[1], t[3]));
  if (f2) offer(nearest(t[0], t[2], t[3]));
  if (f3) offer(nearest(t[1], t[2], t[3]));
  return true;
}

}  // namespace

CoreDistance coreDistance(const ConvexCore& A, const ConvexCore& B, const Vec3& guess, double accuracy) {
  CoreDistance out;
  const auto vertex = [&](const Vec3& d) {
    SimplexVertex x;
    x.a = A.support(-d);
    x.b = B.support(d);
    x.w = x.a - x.b;
    return x;
  };
  Simplex s = only(vertex(guess));
  Vec3 v = s[0].w;
  double size = v.cwiseAbs().maxCoeff();
  for (; out.steps < kMostSteps; ++out.steps) {
    const double vv = v.squaredNorm();
    if (!(vv > 1e-30 * size * size)) return out;
    const SimplexVertex x = vertex(v);
    size = std::max(size, x.w.cwiseAbs().maxCoeff());
    const double room = vv - v.dot(x.w);  // upper less lower bound, times |v|
    if (room <= accuracy * vv || room <= 1e-16 * size * std::sqrt(vv)) break;
    bool known = false;
    for (int i = 0; i < s.count; ++i) known = known || s[i].w == x.w;
    if (known) break;
    Simplex next;
    if (s.count == 1) {
      next = nearest(s[0], x);
    } else if (s.count == 2) {
      next = nearest(s[0], s[1], x);
    } else {
      s.count = 4;
      s[3] = x;
      const bool outside = nearest(s, next);
      s.count = 3;
      if (!outside) return out;
    }
    const Vec3 nv = next.point();
    if (!(nv.squaredNorm() < vv)) break;  // rounding has the last word
    s = next;
    v = nv;
  }
  out.apart = true;
  out.distance = v.norm();
  out.normal = v / out.distance;
  for (int i = 0; i < s.count; ++i) {
    out.a += s[i].weight * s[i].a;
    out.b += s[i].weight * s[i].b;
  }
  return out;
}

}  // namespace stadion
