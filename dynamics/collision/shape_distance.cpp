#include "dynamics/collision/shape_distance.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include "dynamics/collision/nearest_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stadion {
namespace {

constexpr double kEverywhere = std::numeric_limits<double>::infinity();
/// Parts of a flat side's edge, of a circle, and of a quarter of one.
constexpr int kParts = 20, kAround = 64, kQuarter = 16;

/// A point of a shape's surface, and which way the surface looks there.
struct SurfacePoint {
  Vec3 point, normal;
};
using Samples = std::vector<SurfacePoint>;

/// The middles of the cells of the rectangle c + [-1, 1] u + [-1, 1] v.
void addRectangle(const Vec3& c, const Vec3& u, const Vec3& v, const Vec3& normal, Samples& out) {
  const auto at = [](int i) { return (2.0 * i + 1) / kParts - 1; };
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; j < kParts; ++j) out.push_back({c + at(i) * u + at(j) * v, normal});
}

Vec3 onCircle(int i, int parts) {
  const double a = 2 * kPi * (i + 0.5) / parts;
  return {det::cos(a), det::sin(a), 0};
}

/// The half of a ball on the side of `up` (1 or -1) along the pose's z.
void addDome(const Pose& X, double z, double radius, double up, Samples& out) {
  out.push_back({X * Vec3(0, 0, z + up * radius), X.q * Vec3(0, 0, up)});
  for (int i = 0; i < kQuarter; ++i) {
    const double a = 0.5 * kPi * (i + 0.5) / kQuarter;
    const int around = std::max(4, static_cast<int>(kAround * det::cos(a)));
    for (int j = 0; j < around; ++j) {
      const Vec3 n = det::cos(a) * onCircle(j, around) + Vec3(0, 0, up * det::sin(a));
      out.push_back({X * Vec3(radius * n + Vec3(0, 0, z)), X.q * n});
    }
  }
}

void addTube(const Pose& X, double radius, double half, Samples& out) {
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; j < kAround; ++j) {
      const Vec3 n = onCircle(j, kAround);
      out.push_back({X * Vec3(radius * n + Vec3(0, 0, half * ((2.0 * i + 1) / kParts - 1))), X.q * n});
    }
}

void addDisc(const Pose& X, double radius, double z, Samples& out) {
  out.push_back({X * Vec3(0, 0, z), X.q * Vec3(0, 0, z < 0 ? -1 : 1)});
  for (int i = 0; i < kQuarter; ++i) {
    const double r = radius * (i + 0.5) / kQuarter;
    const int around = std::max(4, kAround * (i + 1) / kQuarter);
    for (int j = 0; j < around; ++j)
      out.push_back({X * Vec3(r * onCircle(j, around) + Vec3(0, 0, z)), X.q * Vec3(0, 0, z < 0 ? -1 : 1)});
  }
}

void addTriangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal, double cell, Samples& out) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const int parts = std::clamp(static_cast<int>(std::ceil(longest / cell)), 1, kParts);
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j)
      out.push_back({a + (i + 1.0 / 3) / parts * (b - a) + (j + 1.0 / 3) / parts * (c - a), normal});
}

/// Points of the surface, its area [m2] and the volume that it encloses [m3].
struct SurveyResult {
  Samples points;
  double area = 0, volume = 0;
};

struct Survey {
  SurveyResult operator()(const BallShape& s) const {
    SurveyResult out{{}, 4 * kPi * s.radius * s.radius, 4 * kPi / 3 * s.radius * s.radius * s.radius};
    for (const double up : {-1.0, 1.0}) addDome({s.centre, Quat::Identity()}, 0, s.radius, up, out.points);
    return out;
  }
  SurveyResult operator()(const BoxShape& s) const {
    const Vec3& h = s.half;
    SurveyResult out{{}, 8 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x()), 8 * h.prod()};
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0}) {
        const auto axis = [&](int i) { return Vec3(s.pose.q * Vec3::Unit(i % 3)); };
        addRectangle(s.pose.p + side * h[k] * axis(k), h[(k + 1) % 3] * axis(k + 1),
                     h[(k + 2) % 3] * axis(k + 2), side * axis(k), out.points);
      }
    return out;
  }
  SurveyResult operator()(const CapsuleShape& s) const {
    const double r = s.radius;
    SurveyResult out{{}, 4 * kPi * r * (r + s.half), kPi * r * r * (4 * r / 3 + 2 * s.half)};
    addTube(s.pose, r, s.half, out.points);
    for (const double up : {-1.0, 1.0}) addDome(s.pose, up * s.half, r, up, out.points);
    return out;
  }
  SurveyResult operator()(const CylinderShape& s) const {
    const double r = s.radius;
    SurveyResult out{{}, 2 * kPi * r * (r + 2 * s.half), 2 * kPi * r * r * s.half};
    addTube(s.pose, r, s.half, out.points);
    for (const double up : {-1.0, 1.0}) addDisc(s.pose, r, up * s.half, out.points);
    return out;
  }
  SurveyResult operator()(const ConvexShape& s) const {
    SurveyResult out;
    for (const ConvexShape::Face& f : s.faces) {
      const auto corner = [&](std::uint32_t k) -> const Vec3& { return s.points[s.loops[f.first + k]]; };
      for (std::uint32_t k = 2; k < f.count; ++k) {
        const Vec3 &a = corner(0), &b = corner(k - 1), &c = corner(k);
        const double area = 0.5 * (b - a).cross(c - a).norm();
        out.area += area;
        out.volume += area * (f.offset - f.normal.dot(s.centre)) / 3;
        addTriangle(a, b, c, f.normal, s.reach / 8, out.points);
      }
    }
    return out;
  }
  SurveyResult operator()(const PlaneShape& s) const {
    SurveyResult out{{}, 4 * s.half.prod(), 0};
    addRectangle(s.pose.p, s.half.x() * (s.pose.q * Vec3::UnitX()), s.half.y() * (s.pose.q * Vec3::UnitY()),
                 s.normal(), out.points);
    return out;
  }
  SurveyResult operator()(const MeshShape&) const { return {}; }
};

/// How far a point is from the shape's surface, inside or out.
struct FromSurface {
  const Vec3& x;
  double operator()(const BallShape& s) const { return std::fabs((x - s.centre).norm() - s.radius); }
  double operator()(const BoxShape& s) const {
    const Vec3 over = (s.pose.q.conjugate() * (x - s.pose.p)).cwiseAbs() - s.half;
    return over.maxCoeff() <= 0 ? -over.maxCoeff() : over.cwiseMax(0.0).norm();
  }
  double operator()(const CapsuleShape& s) const { return std::fabs(nearestSurface(s, x).distance); }
  double operator()(const CylinderShape& s) const { return std::fabs(nearestSurface(s, x).distance); }
  double operator()(const ConvexShape& s) const { return std::fabs(nearestSurface(s, x).distance); }
  double operator()(const PlaneShape& s) const {
    const Vec3 l = s.pose.q.conjugate() * (x - s.pose.p);
    const Vec2 beside = (l.head<2>().cwiseAbs() - s.half).cwiseMax(0.0);
    return std::sqrt(beside.squaredNorm() + l.z() * l.z());
  }
  double operator()(const MeshShape&) const { return 0; }
};

/// From points all over the mesh's faces: of few faces, many of each.
double meshFromShape(const Shape& shape, const TriangleTree& tree, double limit) {
  double off = 0;
  const auto hold = [&](const Vec3& p) { off = std::max(off, std::visit(FromSurface{p}, shape)); };
  for (const Vec3& p : tree.corners()) hold(p);
  const double cell = 0.1 * (tree.bounds().hi - tree.bounds().lo).norm();
  const bool many = tree.triangles().size() > 2000;
  Samples inner;
  for (const Triangle& t : tree.triangles()) {
    if (off > limit) break;
    inner.clear();
    addTriangle(t.v[0], t.v[1], t.v[2], t.normal, many ? 1e300 : cell, inner);
    for (const SurfacePoint& s : inner) hold(s.point);
    for (std::size_t k = 0; k < 3; ++k) hold(0.5 * (t.v[k] + t.v[(k + 1) % 3]));
  }
  return off;
}

/// To the nearest face that looks about the same way; infinite beyond `limit`.
double toFaceLookingAlike(const TriangleTree& tree, const SurfacePoint& s, double limit) {
  ClosestPoint at;
  const std::int32_t nearest = tree.nearest(s.point, limit, at);
  if (nearest < 0) return kEverywhere;
  if (tree.triangles()[static_cast<std::size_t>(nearest)].normal.dot(s.normal) > 0)
    return (at.point - s.point).norm();
  double best = limit;
  bool found = false;
  tree.eachWithin(
      s.point, [&] { return best; },
      [&](std::uint32_t i) {
        const Triangle& t = tree.triangles()[i];
        if (!(t.normal.dot(s.normal) > 0)) return;
        const double d = (closestPoint(t, s.point).point - s.point).norm();
        if (d <= best) {
          best = d;
          found = true;
        }
      });
  return found ? best : kEverywhere;
}

double shapeFromMesh(const Samples& points, const TriangleTree& tree, double limit) {
  double off = 0;
  // What is far from everything that looks its way is as far off as the mesh is large.
  const double most = (tree.bounds().hi - tree.bounds().lo).norm();
  for (const SurfacePoint& s : points) {
    off = std::max(off, std::min(most, toFaceLookingAlike(tree, s, limit)));
    if (off > limit) break;
  }
  return off;
}

double volumeOf(const TriangleTree& tree) {
  const Vec3 c = tree.bounds().centre();
  double six = 0;
  for (const Triangle& t : tree.triangles()) six += (t.v[0] - c).dot((t.v[1] - c).cross(t.v[2] - c));
  return six / 6;
}

}  // namespace

double distanceBetween(const Shape& shape, const TriangleTree& tree, double limit) {
  const SurveyResult surface = std::visit(Survey{}, shape);
  double off = 0;
  if (tree.closed() && surface.volume > 0 && surface.area > 0)
    off = std::fabs(surface.volume - volumeOf(tree)) / surface.area;
  // Rounding of the mesh's numbers is no difference.
  if (off < 1e-7 * (tree.bounds().hi - tree.bounds().lo).norm()) off = 0;
  if (off <= limit) off = std::max(off, meshFromShape(shape, tree, limit));
  if (off <= limit) off = std::max(off, shapeFromMesh(surface.points, tree, limit));
  return off;
}

}  // namespace stadion
