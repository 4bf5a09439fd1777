#include "dynamics/collision/shape_choice.h"

#include "dynamics/collision/nearest_surface.h"
#include "dynamics/collision/shape_distance.h"
#include "dynamics/shapes/mass_properties.h"
#include "dynamics/shapes/shape.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace stadion {
namespace {

/// Vertices of curved models lie on the shape; the facets between them may cut this many tolerances deeper.
constexpr double kFacets = 4, kRodFacets = 2;
/// A hull of more corners is no simpler than the mesh.
constexpr std::size_t kMostCorners = 128;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

std::vector<Vec3> usedVertices(const TriangleTree& tree) {
  std::vector<Vec3> points;
  for (const Triangle& t : tree.triangles()) points.insert(points.end(), t.v.begin(), t.v.end());
  return points;
}

ShapeChoice fitBall(const std::vector<Vec3>& points, const Aabb& box) {
  // Vertices of a faceted ball lie on it: take their common distance from the middle.
  const Vec3 c = box.centre();
  double lo = 1e300, hi = 0;
  for (const Vec3& p : points) {
    const double d = (p - c).norm();
    lo = std::min(lo, d);
    hi = std::max(hi, d);
  }
  const double r = 0.5 * (lo + hi);
  return {BallShape{c, r}, ShapeKind::Ball, std::max(hi - r, r - lo), {}};
}

Quat frameOf(const Vec3& z, const Vec3& xHint) {
  Mat3 r;
  r.col(2) = z.normalized();
  r.col(0) = (xHint - r.col(2) * r.col(2).dot(xHint)).normalized();
  r.col(1) = r.col(2).cross(r.col(0));
  return Quat(r).normalized();
}

/// Along the axes of the mesh's own faces: the largest face's normal and the largest one square to it.
ShapeChoice fitBox(const TriangleTree& tree, const std::vector<Vec3>& points) {
  const auto area = [](const Triangle& t) { return (t.v[1] - t.v[0]).cross(t.v[2] - t.v[0]).norm(); };
  const Triangle *first = &tree.triangles().front(), *second = nullptr;
  for (const Triangle& t : tree.triangles())
    if (area(t) > area(*first)) first = &t;
  for (const Triangle& t : tree.triangles())
    if (std::fabs(t.normal.dot(first->normal)) < 1e-3 && (!second || area(t) > area(*second))) second = &t;
  Quat q = Quat::Identity();
  const auto along = [](const Vec3& n) { return n.cwiseAbs().maxCoeff() > 1 - 1e-9; };
  if (second && !(along(first->normal) && along(second->normal))) q = frameOf(first->normal, second->normal);
  Aabb box;
  for (const Vec3& p : points) box.include(q.conjugate() * p);
  BoxShape shape{{q * box.centre(), q}, 0.5 * (box.hi - box.lo)};
  double deviation = 0;
  for (const Vec3& p : points) {
    // A vertex of a box is on its surface.
    const Vec3 l = (q.conjugate() * p - box.centre()).cwiseAbs();
    deviation = std::max(deviation, (shape.half - l).minCoeff());
  }
  // And every corner of the box is a vertex of the mesh.
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner =
        shape.pose * Vec3((i & 1 ? 1 : -1) * shape.half.x(), (i & 2 ? 1 : -1) * shape.half.y(),
                          (i & 4 ? 1 : -1) * shape.half.z());
    double nearest = 1e300;
    for (const Vec3& p : points) nearest = std::min(nearest, (p - corner).norm());
    deviation = std::max(deviation, nearest);
  }
  return {shape, ShapeKind::Box, deviation, {}};
}

/// A sheet in one plane that fills its bounding rectangle; its upper side is where its triangles face.
ShapeChoice fitPlane(const TriangleTree& tree, const std::vector<Vec3>& points) {
  const Triangle* largest = &tree.triangles().front();
  double best = 0, covered = 0;
  Vec3 sum = Vec3::Zero();
  for (const Triangle& t : tree.triangles()) {
    const Vec3 n = (t.v[1] - t.v[0]).cross(t.v[2] - t.v[0]);
    sum += n;
    covered += 0.5 * n.norm();
    if (n.norm() > best) {
      best = n.norm();
      largest = &t;
    }
  }
  Vec3 n = largest->normal;
  if (n.dot(sum) < 0) n = -n;
  const Vec3 hint = std::fabs(n.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Quat q = n.z() > 1 - 1e-12 ? Quat::Identity() : frameOf(n, hint);
  Aabb box;
  for (const Vec3& p : points) box.include(q.conjugate() * p);
  const Vec3 half = 0.5 * (box.hi - box.lo);
  PlaneShape shape{{q * box.centre(), q}, half.head<2>()};
  const double area = 4 * half.x() * half.y();
  // Twice-covered or holed sheets are not rectangles.
  const double gap = std::fabs(area - covered) > 1e-3 * area ? std::sqrt(std::fabs(area - covered)) : 0;
  return {shape, ShapeKind::Plane, std::max(half.z(), gap), {}};
}

template <class Round>
double vertexDistance(const std::vector<Vec3>& points, const Round& shape) {
  double off = 0;
  for (const Vec3& p : points) off = std::max(off, std::fabs(nearestSurface(shape, p).distance));
  return off;
}

/// The bounds of the points along and across an axis through `centre`.
struct Rod {
  Pose pose;
  double half, radius;  ///< half length of all; radius of the widest
};

Rod rodOf(const std::vector<Vec3>& points, const Vec3& centre, const Quat& q) {
  double lo = 1e300, hi = -1e300, wide = 0;
  for (const Vec3& p : points) {
    const Vec3 l = q.conjugate() * (p - centre);
    lo = std::min(lo, l.z());
    hi = std::max(hi, l.z());
    wide = std::max(wide, std::sqrt(l.x() * l.x() + l.y() * l.y()));
  }
  return {{centre + q * Vec3(0, 0, 0.5 * (lo + hi)), q}, 0.5 * (hi - lo), wide};
}

/// Axes that a round body may have: the model's own and those of its inertia.
std::vector<Quat> axesOf(const Mesh& mesh, const Aabb& box, Vec3& centre) {
  std::vector<Quat> axes;
  Mat3 r = Mat3::Identity();
  for (int k = 0; k < 3; ++k)
    axes.push_back(k == 2 ? Quat::Identity() : frameOf(Vec3::Unit(k), Vec3::Unit((k + 1) % 3)));
  centre = box.centre();
  if (const auto volume = integrateVolume(mesh)) {
    Vec3 moments;
    Quat q;
    principalAxes(volume.value().inertia, moments, q);
    r = q.toRotationMatrix();
    for (int k = 0; k < 3; ++k) axes.push_back(frameOf(r.col(k), r.col((k + 1) % 3)));
    centre = volume.value().centre;
  }
  return axes;
}

/// The best of the rods along the mesh's axes; `make` turns one into the shape.
template <class Make>
ShapeChoice fitRod(ShapeKind kind, const Mesh& mesh, const TriangleTree& tree,
                   const std::vector<Vec3>& points, Make make) {
  Vec3 centre;
  ShapeChoice best;
  best.kind = kind;
  best.deviation = 1e300;
  for (const Quat& q : axesOf(mesh, tree.bounds(), centre)) {
    const auto s = make(rodOf(points, centre, q));
    const double off = vertexDistance(points, s);
    if (off < best.deviation * (1 - 1e-9)) {
      best.shape = s;
      best.deviation = off;
    }
  }
  return best;
}

ShapeChoice fitCylinder(const Mesh& mesh, const TriangleTree& tree, const std::vector<Vec3>& points) {
  return fitRod(ShapeKind::Cylinder, mesh, tree, points, [](const Rod& r) {
    return CylinderShape{r.pose, r.radius, r.half};
  });
}

ShapeChoice fitCapsule(const Mesh& mesh, const TriangleTree& tree, const std::vector<Vec3>& points) {
  return fitRod(ShapeKind::Capsule, mesh, tree, points, [](const Rod& r) {
    return CapsuleShape{r.pose, r.radius, std::max(r.half - r.radius, 0.0)};
  });
}

/// Tries the shapes for a mesh, the simplest first.
class ShapeChooser {
public:
  ShapeChooser(const Mesh& mesh, TriangleTree tree, ShapeKind requested, double tolerance)
      : mesh_(mesh), tree_(std::move(tree)), points_(usedVertices(tree_)),
        size_(0.5 * (tree_.bounds().hi - tree_.bounds().lo).norm()), rounding_(1e-7 * size_),
        tolerance_(tolerance), requested_(requested), any_(requested == ShapeKind::Auto),
        round_(points_.size() >= 60) {}

  /// Returns the first shape that fits. The mesh itself always does. Moves the tree out.
  ShapeChoice choose() {
    using Attempt = std::optional<ShapeChoice> (ShapeChooser::*)() const;
    for (const Attempt attempt : {&ShapeChooser::plane, &ShapeChooser::ball, &ShapeChooser::box,
                                  &ShapeChooser::capsule, &ShapeChooser::cylinder, &ShapeChooser::convex})
      if (auto c = (this->*attempt)()) return std::move(*c);
    ShapeChoice c{MeshShape(std::move(tree_)), ShapeKind::Mesh, 0, {}};
    const std::size_t used = std::get<MeshShape>(c.shape).tree.triangles().size();
    c.remark = fmt::format("collides as a mesh of {} triangles", used);
    return c;
  }

private:
  /// Returns true if the kind was requested, or if any may be taken and this one is likely.
  bool tries(ShapeKind kind, bool likely) const { return requested_ == kind || (any_ && likely); }
  /// Returns true if the vertices are within `limit` of the shape, or if the shape was requested.
  bool near(const ShapeChoice& c, double limit) const { return !any_ || c.deviation <= limit; }

  /// Returns the shape if it was requested, or if it and the mesh are within `limit` of each other.
  std::optional<ShapeChoice> within(double limit, ShapeChoice c) const {
    if (any_ && !(c.deviation <= limit)) return {};
    c.deviation = std::max(c.deviation, distanceBetween(c.shape, tree_, any_ ? limit : kNoLimit));
    if (any_ && !(c.deviation <= limit)) return {};
    c.remark = fmt::format("collides as a {}, within {:.3g} m ({:.2g} % of its size)", nameOf(c.kind),
                           c.deviation, 100 * c.deviation / size_);
    return c;
  }

  std::optional<ShapeChoice> plane() const {
    if (!tries(ShapeKind::Plane, !tree_.closed())) return {};
    return within(1e-6 * size_, fitPlane(tree_, points_));
  }

  /// The vertices must be on the ball; the facets between them may cut inside it by the tolerance of coarse
  /// models.
  std::optional<ShapeChoice> ball() const {
    if (!tries(ShapeKind::Ball, round_)) return {};
    ShapeChoice c = fitBall(points_, tree_.bounds());
    if (!near(c, 0.5 * tolerance_ * size_)) return {};
    return within(kFacets * tolerance_ * size_, std::move(c));
  }

  std::optional<ShapeChoice> box() const {
    if (!tries(ShapeKind::Box, tree_.closed())) return {};
    ShapeChoice c = fitBox(tree_, points_);
    const double thin = std::get<BoxShape>(c.shape).half.minCoeff();
    return within(tolerance_ * thin + rounding_, std::move(c));
  }

  std::optional<ShapeChoice> capsule() const {
    if (!tries(ShapeKind::Capsule, tree_.closed() && round_)) return {};
    ShapeChoice c = fitCapsule(mesh_, tree_, points_);
    const double r = std::get<CapsuleShape>(c.shape).radius;
    if (!near(c, 0.5 * tolerance_ * r)) return {};
    return within(kRodFacets * tolerance_ * r, std::move(c));
  }

  std::optional<ShapeChoice> cylinder() const {
    if (!tries(ShapeKind::Cylinder, tree_.closed() && round_)) return {};
    ShapeChoice c = fitCylinder(mesh_, tree_, points_);
    const auto& s = std::get<CylinderShape>(c.shape);
    const double radius = s.radius, thin = std::min(s.radius, s.half);
    if (!near(c, 0.5 * tolerance_ * thin)) return {};
    return within(kRodFacets * tolerance_ * radius, std::move(c));
  }

  std::optional<ShapeChoice> convex() const {
    if (!tries(ShapeKind::Convex, tree_.closed() && tree_.corners().size() <= 4 * kMostCorners)) return {};
    auto hull = convexHull(tree_.corners());
    if (!hull || (any_ && hull->points.size() > kMostCorners)) return {};
    const double limit = tolerance_ * hull->inside + rounding_;
    return within(limit, ShapeChoice{std::move(*hull), ShapeKind::Convex, 0, {}});
  }

  const Mesh& mesh_;
  TriangleTree tree_;
  const std::vector<Vec3> points_;  ///< vertices of its triangles
  const double size_, rounding_, tolerance_;
  const ShapeKind requested_;
  const bool any_;    ///< any kind may be taken
  const bool round_;  ///< enough vertices for a curved shape
};

}  // namespace

Result<ShapeChoice> chooseShape(const Mesh& mesh, ShapeKind requested, double tolerance) {
  TriangleTree tree(mesh);
  if (tree.empty()) return Result<ShapeChoice>::failure("has no usable triangle to collide with");
  return ShapeChooser(mesh, std::move(tree), requested, tolerance).choose();
}

}  // namespace stadion
