#include "dynamics/shapes/convex_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

double signOf(double x) {
  return x < 0 ? -1 : 1;
}

/// Up to four faces of a hull that look most along d, best first.
int facesAlong(const ConvexShape& hull, const Vec3& d, std::array<std::uint32_t, 4>& best) {
  std::array<double, 4> score;
  int n = 0;
  hull.eachFaceTowards(d, [&](std::uint32_t i) {
    const double s = hull.faces[i].normal.dot(d);
    int at = n;
    while (at > 0 && score[static_cast<std::size_t>(at - 1)] < s) --at;
    if (at == 4) return;
    n = std::min(n + 1, 4);
    for (int k = n - 1; k > at; --k) {
      const auto to = static_cast<std::size_t>(k);
      score[to] = score[to - 1];
      best[to] = best[to - 1];
    }
    score[static_cast<std::size_t>(at)] = s;
    best[static_cast<std::size_t>(at)] = i;
  });
  return n;
}

Feature hullFeature(const ConvexCore& c, const Vec3& d) {
  std::array<std::uint32_t, 4> best{};
  facesAlong(*c.hull, c.R.transpose() * d, best);
  const ConvexShape::Face& face = c.hull->faces[best[0]];
  Feature f;
  f.normal = c.R * face.normal;
  // A rim of more corners than fit is thinned out evenly.
  const std::uint32_t n = std::min<std::uint32_t>(face.count, Feature::kMost);
  for (std::uint32_t i = 0; i < n; ++i)
    f.add(c.p + c.R * c.hull->points[c.hull->loops[face.first + i * face.count / n]]);
  return f;
}

Feature cylinderFeature(const ConvexCore& c, const Vec3& d, bool around) {
  Feature f;
  const Vec3 l = c.R.transpose() * d;
  const double across = std::sqrt(l.x() * l.x() + l.y() * l.y());
  const Vec2 out = across > 1e-9 * std::fabs(l.z()) ? Vec2(l.head<2>() / across) : Vec2(1, 0);
  if (std::fabs(l.z()) < across) {  // the barrel: a line
    const Vec3 side = c.R * Vec3(out.x() * c.half.x(), out.y() * c.half.x(), 0);
    f.add(c.p + side + c.R.col(2) * c.half.z()), f.add(c.p + side - c.R.col(2) * c.half.z());
    return f;
  }
  static constexpr int kRim = 16;
  static constexpr double kCos = 0.92387953251128674, kSin = 0.38268343236508977;  // of 2 pi / 16
  static constexpr double kWiden = 1.0195911582083184;                             // 1 / cos(pi / 16)
  const double z = signOf(l.z()) * c.half.z(), r = c.half.x() * (around ? kWiden : 1.0);
  Vec2 u = around ? Vec2(1, 0) : out;
  for (int i = 0; i < kRim; ++i) {
    if (around || i % 2 == 0) f.add(c.p + c.R * Vec3(r * u.x(), r * u.y(), z));
    u = Vec2(kCos * u.x() - signOf(z) * kSin * u.y(), signOf(z) * kSin * u.x() + kCos * u.y());
  }
  f.normal = c.R.col(2) * signOf(z);
  return f;
}

}  // namespace

// Called thousands of times for a contact: the products must be inlined, whatever else the unit has.
[[gnu::flatten]] Vec3 ConvexCore::support(const Vec3& d) const {
  switch (kind) {
  case Kind::Point: return p;
  case Kind::Segment: return p + R.col(2) * (R.col(2).dot(d) < 0 ? -half.z() : half.z());
  case Kind::Box: {
    const Vec3 l = R.transpose() * d;
    return p + R * Vec3(l.x() < 0 ? -half.x() : half.x(), l.y() < 0 ? -half.y() : half.y(),
                        l.z() < 0 ? -half.z() : half.z());
  }
  case Kind::Cylinder: {
    const Vec3 l = R.transpose() * d;
    const double n = std::sqrt(l.x() * l.x() + l.y() * l.y()), z = l.z() < 0 ? -half.z() : half.z();
    if (!(n > 1e-15 * std::fabs(l.z()))) return p + R.col(2) * z;
    return p + R * Vec3(l.x() * (half.x() / n), l.y() * (half.x() / n), z);
  }
  case Kind::Hull: {
    const Vec3 l = R.transpose() * d;
    const Vec3& far = hull->points[hull->farthest(l)];
    return p + R * (shrink == 1 ? far : Vec3(hull->centre + shrink * (far - hull->centre)));
  }
  case Kind::Triangle: {
    const double a = d.dot(v[0]), b = d.dot(v[1]), c = d.dot(v[2]);
    return a >= b && a >= c ? v[0] : b >= c ? v[1] : v[2];
  }
  }
  return p;
}

bool ConvexCore::holds(const Vec3& x, double margin) const {
  const Vec3 l = R.transpose() * (x - p);
  switch (kind) {
  case Kind::Box: return ((half - l.cwiseAbs()).array() >= -margin).all();
  case Kind::Cylinder: {
    const double r = half.x() + margin;
    return std::fabs(l.z()) <= half.z() + margin && l.x() * l.x() + l.y() * l.y() <= r * r;
  }
  case Kind::Hull:
    return std::ranges::all_of(
        hull->faces, [&](const ConvexShape::Face& f) { return f.normal.dot(l) <= f.offset + margin; });
  case Kind::Triangle:
    if (std::fabs(normal.dot(x - v[0])) > margin) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 e = v[(i + 1) % 3] - v[i];
      if (normal.cross(e).dot(x - v[i]) < -margin * e.norm()) return false;
    }
    return true;
  case Kind::Point:
  case Kind::Segment: return false;
  }
  return false;
}

Vec3 ConvexCore::middle() const {
  if (kind == Kind::Hull) return p + R * hull->centre;
  if (kind == Kind::Triangle) return (v[0] + v[1] + v[2]) / 3;
  return p;
}

ConvexCore ConvexCore::moved(const Vec3& by) const {
  ConvexCore c = *this;
  c.p += by;
  if (kind == Kind::Triangle)
    for (Vec3& x : c.v) x += by;
  return c;
}

double ConvexCore::thickness() const {
  switch (kind) {
  case Kind::Box: return half.minCoeff();
  case Kind::Cylinder: return std::min(half.x(), half.z());
  case Kind::Hull: return hull->inside;
  default: return 0;
  }
}

ConvexCore ConvexCore::eroded(double depth) const {
  ConvexCore c = *this;
  if (kind == Kind::Box) {
    c.half = (half.array() - depth).max(0.05 * half.array());
  } else if (kind == Kind::Cylinder) {
    c.half.x() = std::max(half.x() - depth, 0.05 * half.x());
    c.half.z() = std::max(half.z() - depth, 0.05 * half.z());
  } else if (kind == Kind::Hull && hull->inside > 0) {
    c.shrink = shrink * std::max(0.05, 1 - depth / hull->inside);
  }
  return c;
}

bool isConvex(const Shape& shape) {
  if (std::holds_alternative<MeshShape>(shape)) return false;
  const auto* plane = std::get_if<PlaneShape>(&shape);
  return !plane || plane->bounded();
}

bool coreOf(const Shape& shape, const Pose& X, ConvexCore& c) {
  struct Visitor {
    const Pose& X_RN;
    ConvexCore& c;
    void put(const Pose& local) const {
      c.R = (X_RN.q * local.q).toRotationMatrix();
      c.p = X_RN * local.p;
    }
    bool operator()(const BallShape& s) const {
      c.kind = ConvexCore::Kind::Point;
      c.p = X_RN * s.centre;
      c.radius = s.radius;
      return true;
    }
    bool operator()(const BoxShape& s) const {
      c.kind = ConvexCore::Kind::Box;
      c.half = s.half;
      put(s.pose);
      return true;
    }
    bool operator()(const CapsuleShape& s) const {
      c.kind = ConvexCore::Kind::Segment;
      c.half = {0, 0, s.half};
      c.radius = s.radius;
      put(s.pose);
      return true;
    }
    bool operator()(const CylinderShape& s) const {
      c.kind = ConvexCore::Kind::Cylinder;
      c.half = {s.radius, s.radius, s.half};
      put(s.pose);
      return true;
    }
    bool operator()(const ConvexShape& s) const {
      c.kind = ConvexCore::Kind::Hull;
      c.hull = &s;
      put(Pose{});
      return true;
    }
    bool operator()(const PlaneShape& s) const {
      if (!s.bounded()) return false;
      c.kind = ConvexCore::Kind::Box;
      c.half = {s.half.x(), s.half.y(), 0};
      put(s.pose);
      return true;
    }
    bool operator()(const MeshShape&) const { return false; }
  };
  return std::visit(Visitor{X, c}, shape);
}

ConvexCore coreOf(const Triangle& t, const Pose& X) {
  ConvexCore c;
  c.kind = ConvexCore::Kind::Triangle;
  const Mat3 R = X.q.toRotationMatrix();
  for (std::size_t i = 0; i < 3; ++i) c.v[i] = R * t.v[i] + X.p;
  c.normal = R * t.normal;
  return c;
}

Feature featureTowards(const ConvexCore& c, const Vec3& d, bool around) {
  Feature f;
  switch (c.kind) {
  case ConvexCore::Kind::Point: f.add(c.p); break;
  case ConvexCore::Kind::Segment:
    f.add(c.p + c.R.col(2) * c.half.z()), f.add(c.p - c.R.col(2) * c.half.z());
    break;
  case ConvexCore::Kind::Box: {
    const Vec3 l = c.R.transpose() * d;
    int k = 0;
    l.cwiseAbs().maxCoeff(&k);
    const int u = (k + 1) % 3, w = (k + 2) % 3;
    const double s = signOf(l[k]);
    for (const auto& [su, sw] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
      Vec3 x;
      x[k] = s * c.half[k];
      x[u] = s * su * c.half[u];
      x[w] = sw * c.half[w];
      f.add(c.p + c.R * x);
    }
    f.normal = c.R.col(k) * s;
    break;
  }
  case ConvexCore::Kind::Cylinder: return cylinderFeature(c, d, around);
  case ConvexCore::Kind::Hull: return hullFeature(c, d);
  case ConvexCore::Kind::Triangle: {
    const bool up = c.normal.dot(d) >= 0;
    f.add(c.v[0]), f.add(c.v[up ? 1 : 2]), f.add(c.v[up ? 2 : 1]);
    f.normal = up ? c.normal : Vec3(-c.normal);
    break;
  }
  }
  return f;
}

bool pointed(const ConvexCore& c, const Vec3& n, double even) {
  const Vec3 l = c.R.transpose() * n;
  switch (c.kind) {
  case ConvexCore::Kind::Point: return true;
  case ConvexCore::Kind::Segment: return std::fabs(l.z()) * c.half.z() > even;
  case ConvexCore::Kind::Box: return l.cwiseAbs().cwiseProduct(c.half).minCoeff() > even;
  case ConvexCore::Kind::Cylinder:
    return l.head<2>().norm() * c.half.x() > even && std::fabs(l.z()) * c.half.z() > even;
  default: return false;
  }
}

Directions directionsNear(const ConvexCore& c, const Vec3& d, const Vec3& x) {
  Directions out;
  switch (c.kind) {
  case ConvexCore::Kind::Point: break;
  case ConvexCore::Kind::Segment: out.edge(c.R.col(2)); break;
  case ConvexCore::Kind::Box:
    for (int i = 0; i < 3; ++i) {
      out.face(c.R.col(i));
      out.edge(c.R.col(i));
    }
    break;
  case ConvexCore::Kind::Cylinder: {
    out.face(c.R.col(2));
    out.edge(c.R.col(2));
    const Vec3 tangent = c.R.col(2).cross(x - c.p);
    if (tangent.norm() > 1e-6 * c.half.x()) out.edge(tangent.normalized());
    break;
  }
  case ConvexCore::Kind::Hull: {
    std::array<std::uint32_t, 4> best{};
    const int n = facesAlong(*c.hull, c.R.transpose() * d, best);
    for (int i = 0; i < n; ++i) {
      const ConvexShape::Face& face = c.hull->faces[best[static_cast<std::size_t>(i)]];
      out.face(c.R * face.normal);
      for (std::uint32_t k = 0; k < face.count; ++k) {
        const Vec3 a = c.p + c.R * c.hull->points[c.hull->loops[face.first + k]],
                   b = c.p + c.R * c.hull->points[c.hull->loops[face.first + (k + 1) % face.count]];
        const Vec3 e = b - a;
        const double s = std::clamp((x - a).dot(e) / e.squaredNorm(), 0.0, 1.0);
        if ((a + s * e - x).norm() < 0.02 * c.hull->reach) out.edge(e.normalized());
      }
    }
    break;
  }
  case ConvexCore::Kind::Triangle:
    out.face(c.normal);
    for (std::size_t i = 0; i < 3; ++i) out.edge((c.v[(i + 1) % 3] - c.v[i]).normalized());
    break;
  }
  return out;
}

}  // namespace stadion
