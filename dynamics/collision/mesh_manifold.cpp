#include "dynamics/collision/mesh_manifold.h"

#include "dynamics/collision/mesh_pairs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace stadion {
namespace {

constexpr std::size_t kMostPoints = 8;  ///< points of a pair
constexpr double kSunk = 0.1;           ///< share of a mesh's size by which it may have sunk into another
constexpr double kSheet = 0.2;          ///< the same into an open mesh
constexpr double kTurnedAway = 1e-3;    ///< cosine above which a face looks away
constexpr double kParallel = 1e-5;      ///< sine of the angle between edges that do not cross
constexpr double kHollow = 1e-3;        ///< sine of the angle by which faces at a hollow edge rise
constexpr double kSunkIntoWall = 1e-3;  ///< beyond a hollow edge, a corner is over the floor up to here [m]
constexpr double kOverFace = 1e-9;      ///< a corner that is beyond an edge by less is over the face [m]
constexpr double kFlat = 1e-5;          ///< sine of the angle of an edge that is none
constexpr double kSame = 1e-6;          ///< distances that differ less are equal [m]

/// One of the two meshes, in the frame of B, in which the search is done.
struct Body {
  const TriangleTree& tree;
  Pose X;       ///< tree to search frame, which is B's
  Vec3 middle;  ///< in the search frame
  double size;  ///< half a diagonal [m]

  /// Whether some face at the corner looks against n. What is open looks both ways, and sticks out at its
  /// rim; but in the middle of a flat part there is no corner for what comes along it.
  bool facesAgainst(std::uint32_t corner, const Vec3& n) const {
    const Vec3 local = X.q.conjugate() * n;
    return std::ranges::any_of(tree.around(corner), [&](std::uint32_t i) {
      const double facing = tree.triangles()[i].normal.dot(local);
      return facing < -kTurnedAway || (!tree.closed() && (facing > kTurnedAway || endsAt(i, corner)));
    });
  }
  /// Whether the surface ends with one of the triangle's edges at its corner.
  bool endsAt(std::uint32_t i, std::uint32_t corner) const {
    const auto& corners = tree.cornersOf(i);
    for (std::size_t k = 0; k < 3; ++k)
      if (tree.triangles()[i].next[k] < 0 && (corners[k] == corner || corners[(k + 1) % 3] == corner))
        return true;
    return false;
  }
  /// Whether nothing of the surface is nearer to x than `depth`.
  bool nothingNearer(const Vec3& x, double depth) const {
    ClosestPoint at;
    const Vec3 local = X.inverse() * x;
    const double nearer = depth * (1 - 1e-6) - 1e-9;
    return !(nearer > 0) || tree.nearest(local, nearer, at) < 0;
  }
};

/// An edge of a mesh with the directions that its faces leave free: n . out >= 0 for both.
struct Edge {
  Vec3 p, d, out[2], up;  ///< up: the middle of those directions
  bool border;
};

/// How far the other may be below a face of this one.
double limitOf(const Body& faces, const Body& other) {
  return faces.tree.closed() ? kSunk * std::min(faces.size, other.size) : kSheet * other.size;
}

/// The axis of the mesh that a face's normal is nearest to, with its sign: a number below 6. A corner may touch
/// several faces, and each of these contacts has its own forces.
std::uint32_t mainAxisOf(const Body& faces, const Vec3& n) {
  const Vec3 local = faces.X.q.conjugate() * n;
  Eigen::Index axis = 0;
  local.cwiseAbs().maxCoeff(&axis);
  return static_cast<std::uint32_t>(2 * axis + (local[axis] < 0 ? 1 : 0));
}

/// Names the contact of a corner over a face with normal n.
std::uint32_t cornerKey(std::uint32_t corner, const Body& faces, const Vec3& n, bool flipped) {
  return (flipped ? 1u << 30 : 0u) + (mainAxisOf(faces, n) << 27) + corner;
}

class Gather {
public:
  Gather(const Body& a, const Body& b, double margin, std::vector<ManifoldPoint>& found)
      : a_(a), b_(b), margin_(margin), sunkA_(limitOf(a, b)), sunkB_(limitOf(b, a)),
        reach_(1e-6 + std::max({margin, sunkA_, sunkB_})), found_(found), known_(a.tree.corners().size()),
        corners_(std::make_unique_for_overwrite<Vec3[]>(known_.size())) {}

  /// False if no triangles of the two are within the margin.
  bool run() {
    bool any = false;
    const auto place = [&](std::uint32_t i) {
      const auto& c = a_.tree.cornersOf(i);
      return Corners{{cornerOfA(c[0]), cornerOfA(c[1]), cornerOfA(c[2])}};
    };
    const auto look = [&](std::uint32_t i, std::uint32_t j, const Corners& t) {
      any = true;
      meet(i, t.v, j, b_.tree.triangles()[j]);
    };
    MeshPairs(a_.tree, b_.tree, a_.X).each([&] { return margin_; }, place, look);
    return any;
  }

private:
  /// All that is needed of most triangles.
  struct Corners {
    std::array<Vec3, 3> v;
  };

  static double sideOf(const Body& faces, const Triangle& t, const Vec3& other) {
    return faces.tree.closed() || t.normal.dot(other - t.v[0]) >= 0 ? 1 : -1;
  }

  /// A corner of a in the search frame, found when it is first asked for.
  const Vec3& cornerOfA(std::uint32_t c) {
    if (!known_[c]) {
      known_[c] = true;
      corners_[c] = a_.X * a_.tree.corners()[c];
    }
    return corners_[c];
  }

  /// `va`: the corners of triangle i of a. Most corners and edges of two triangles are far from each other:
  /// boxes say so first, and the rest of triangle i is hardly ever wanted.
  void meet(std::uint32_t i, const std::array<Vec3, 3>& va, std::uint32_t j, const Triangle& tb) {
    const double sideB = sideOf(b_, tb, a_.middle);
    const Aabb boxA = boxOf(va), nearA = widened(boxA), nearB = widened(boxOf(tb.v));
    std::optional<Triangle> made;
    const auto ta = [&]() -> const Triangle& {
      if (!made) {
        made = a_.tree.triangles()[i];
        made->v = va;
        made->normal = a_.X.q * made->normal;
      }
      return *made;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      if (const std::uint32_t c = a_.tree.cornersOf(i)[k];
          a_.tree.around(c).front() == i && contains(nearB, va[k]))
        cornerOverFace(a_, c, va[k], b_, tb, sideB * tb.normal, sunkB_, static_cast<std::int32_t>(j), false);
      if (const std::uint32_t c = b_.tree.cornersOf(j)[k];
          b_.tree.around(c).front() == j && contains(nearA, tb.v[k]))
        cornerOverFace(b_, c, tb.v[k], a_, ta(), sideOf(a_, ta(), b_.middle) * ta().normal, sunkA_, -1, true);
    }
    std::array<Aabb, 3> around;  // the edges of b
    std::array<bool, 3> counts;
    for (std::size_t l = 0; l < 3; ++l) {
      counts[l] = mayStickOut(tb, j, l, sideB);
      if (counts[l]) {
        around[l] = widened(boxOf(edge(tb, l)));
        counts[l] = around[l].overlaps(boxA);
      }
    }
    if (counts[0] || counts[1] || counts[2]) meetEdges(i, ta(), j, tb, sideB, around, counts);
  }

  /// Of the edges of b those that count, with a box around each that is wide enough.
  void meetEdges(std::uint32_t i, const Triangle& ta, std::uint32_t j, const Triangle& tb, double sideB,
                 const std::array<Aabb, 3>& around, const std::array<bool, 3>& counts) {
    const double sideA = sideOf(a_, ta, b_.middle);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!mayStickOut(ta, i, k, sideA)) continue;
      const Aabb box = boxOf(edge(ta, k));
      const auto isNear = [&](std::size_t l) { return counts[l] && around[l].overlaps(box); };
      Edge ea;
      if (!(isNear(0) || isNear(1) || isNear(2)) || !edgeOf(a_, ta, k, sideA, ea)) continue;
      for (std::size_t l = 0; l < 3; ++l)
        if (Edge eb; isNear(l) && edgeOf(b_, tb, l, sideB, eb)) edgesCross(i * 3 + k, ea, j * 3 + l, eb);
    }
  }

  static std::array<Vec3, 2> edge(const Triangle& t, std::size_t k) { return {t.v[k], t.v[(k + 1) % 3]}; }
  template <std::size_t N>
  static Aabb boxOf(const std::array<Vec3, N>& corners) {
    Aabb box;
    for (const Vec3& v : corners) box.include(v);
    return box;
  }
  /// What lies over it, has sunk into it or crosses it is in here.
  Aabb widened(Aabb box) const {
    box.lo.array() -= reach_;
    box.hi.array() += reach_;
    return box;
  }
  static bool contains(const Aabb& box, const Vec3& p) {
    return (p.array() >= box.lo.array()).all() && (p.array() <= box.hi.array()).all();
  }

  /// Whether x is not over triangle t, because it lies beyond its edge m. A wall may stand there: what has sunk into
  /// the wall is still over the floor. If the wall leans back, what comes to it along the floor is over both.
  bool isBeyondEdge(const Body& faces, const Triangle& t, std::size_t m, const Vec3& n, const Vec3& x) const {
    const Vec3 inwards = t.normal.cross(t.v[(m + 1) % 3] - t.v[m]);
    const double inside = inwards.dot(x - t.v[m]) / inwards.norm();
    if (inside >= -kOverFace) return false;
    const std::int32_t next = t.next[m];
    if (next < 0 || inside < -std::max(kSunkIntoWall, margin_)) return true;
    const Vec3 other = faces.X.q * faces.tree.triangles()[static_cast<std::size_t>(next)].normal;
    const double side = n.dot(t.normal);
    return !(side * inwards.dot(other) > kHollow * inwards.norm()) ||
           side * other.dot(x - t.v[m]) < -kSunkIntoWall;
  }

  void cornerOverFace(const Body& corners, std::uint32_t c, const Vec3& x, const Body& faces,
                      const Triangle& t, const Vec3& n, double sunk, std::int32_t triangle, bool flipped) {
    const double height = n.dot(x - t.v[0]);
    if (!(height < margin_) || height < -sunk) return;
    for (std::size_t m = 0; m < 3; ++m)
      if (isBeyondEdge(faces, t, m, n, x)) return;
    const std::uint32_t key = cornerKey(c, faces, n, flipped);
    for (std::size_t f = 0; f < keys_.size(); ++f)  // on a seam it is over both faces
      if (keys_[f] == key && found_[f].gap.normal.dot(flipped ? Vec3(-n) : n) > 0.999) return;
    if (!corners.facesAgainst(c, n) || (height < 0 && !faces.nothingNearer(x, -height))) return;
    if (flipped)
      add({{height, x, -n, true, -1}, key, Carrier::B});
    else
      add({{height, x - height * n, n, true, triangle}, key, Carrier::A});
  }

  /// False of an edge that is another triangle's, and of most that stick out nowhere.
  static bool mayStickOut(const Triangle& t, std::uint32_t i, std::size_t k, double side) {
    const std::int32_t next = t.next[k];
    return !(next >= 0 && static_cast<std::uint32_t>(next) < i) && !(side > 0 && t.merged[k]);
  }

  /// False if the edge is none that sticks out.
  static bool edgeOf(const Body& body, const Triangle& t, std::size_t k, double side, Edge& e) {
    const std::int32_t next = t.next[k];
    e.p = t.v[k];
    e.d = t.v[(k + 1) % 3] - e.p;
    e.border = next < 0;
    e.out[0] = e.d.cross(t.normal).normalized();
    if (e.border) {
      e.out[1] = e.out[0];
      e.up = e.out[0];
      return true;
    }
    const Vec3 other = body.X.q * body.tree.triangles()[static_cast<std::size_t>(next)].normal;
    e.out[1] = other.cross(e.d).normalized();
    const Vec3 normals = side * (t.normal + other);
    e.up = normals.squaredNorm() > 0.01 ? normals : Vec3(e.out[0] + e.out[1]);
    // A hollow edge sticks out nowhere, but it does from behind.
    return e.out[0].dot(other) * side > (side > 0 ? -kFlat : kFlat);
  }

  void edgesCross(std::size_t i, const Edge& a, std::size_t j, const Edge& b) {
    Vec3 n = a.d.cross(b.d);
    const double size = n.norm(), la = a.d.norm(), lb = b.d.norm();
    if (!(size > kParallel * la * lb)) return;
    n /= size;
    const Vec3 w = b.p - a.p;
    const double s = w.cross(b.d).dot(n) / size, t = w.cross(a.d).dot(n) / size;
    if (!(s > 0 && s < 1 && t > 0 && t < 1)) return;
    const double towards = n.dot(b.up) - n.dot(a.up);
    if (towards < 0) n = -n;
    const double gap = -n.dot(w);
    if (!(gap < margin_) || gap < -std::min(0.05 * std::min(la, lb), std::max(sunkA_, sunkB_))) return;
    constexpr double kWedge = -1e-9;
    for (int k = 0; k < 2; ++k)
      if (n.dot(b.out[k]) < kWedge || n.dot(a.out[k]) > -kWedge) return;
    const Vec3 on = b.p + t * b.d;
    const auto key = static_cast<std::uint32_t>((i * 73856093u ^ j * 19349663u) | (1u << 31));
    add({{gap, on, n, false, -1}, key, Carrier::None});
  }

  void add(ManifoldPoint p) {
    keys_.push_back(p.key);
    found_.push_back(std::move(p));
  }

  const Body &a_, &b_;
  double margin_, sunkA_, sunkB_, reach_;
  std::vector<ManifoldPoint>& found_;
  std::vector<std::uint32_t> keys_;  ///< of found_, to be searched
  std::vector<bool> known_;          ///< which corners of a have been placed
  std::unique_ptr<Vec3[]> corners_;
};

Body bodyOf(const TriangleTree& mesh, const Pose& X, const Vec3& middle) {
  return {mesh, X, middle, 0.5 * (mesh.bounds().hi - mesh.bounds().lo).norm()};
}

/// Keeps the deepest point and the widest spread, the same ones while they differ only by rounding.
void thin(std::vector<ManifoldPoint>& points, double size) {
  if (points.size() <= kMostPoints) return;
  std::ranges::sort(points, {}, &ManifoldPoint::key);
  std::size_t first = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].gap.distance < points[first].gap.distance - kSame) first = i;
  std::swap(points[0], points[first]);
  std::vector<double> away(points.size(), 1e300);
  for (std::size_t kept = 1; kept < kMostPoints; ++kept) {
    const Gap& last = points[kept - 1].gap;
    std::size_t best = kept;
    for (std::size_t i = kept; i < points.size(); ++i) {
      away[i] = std::min(away[i], (points[i].gap.point - last.point).squaredNorm() +
                                      size * size * (points[i].gap.normal - last.normal).squaredNorm());
      if (away[i] > away[best] * (1 + 1e-6)) best = i;
    }
    std::swap(points[kept], points[best]);
    std::swap(away[kept], away[best]);
  }
  points.resize(kMostPoints);
}

}  // namespace

const TriangleTree* trianglesOf(const Shape& shape, TriangleTree& sheet) {
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) return &mesh->tree;
  const auto* plane = std::get_if<PlaneShape>(&shape);
  if (!plane || !plane->bounded()) return nullptr;
  std::array<Vec3, 4> corner;
  for (std::size_t i = 0; i < 4; ++i)
    corner[i] = plane->pose * Vec3(i == 0 || i == 3 ? -plane->half.x() : plane->half.x(),
                                   i < 2 ? -plane->half.y() : plane->half.y(), 0);
  sheet = TriangleTree({{corner[0], corner[1], corner[2]}, {corner[0], corner[2], corner[3]}});
  return &sheet;
}

bool meshesManifold(const TriangleTree& a, const Pose& X_WA, const Vec3& middleA, const TriangleTree& b,
                    const Pose& X_WB, const Vec3& middleB, double margin,
                    std::vector<ManifoldPoint>& points) {
  const Pose X_BW = X_WB.inverse();
  const Body ba = bodyOf(a, X_BW * X_WA, X_BW * middleA), bb = bodyOf(b, {}, X_BW * middleB);
  std::vector<ManifoldPoint> found;
  const bool near = Gather(ba, bb, margin, found).run();
  thin(found, std::min(ba.size, bb.size));
  for (ManifoldPoint& p : found) {
    p.gap.point = X_WB * p.gap.point;
    p.gap.normal = X_WB.q * p.gap.normal;
  }
  points.insert(points.end(), found.begin(), found.end());
  return near;
}

void cornersBeyondBorder(const TriangleTree& a, const Pose& X_WA, const Vec3& middleA, const TriangleTree& b,
                         const Pose& X_WB, double margin, std::vector<CornerBeyond>& corners) {
  const Pose X_BW = X_WB.inverse();
  const Body ba = bodyOf(a, X_BW * X_WA, X_BW * middleA), bb = bodyOf(b, {}, Vec3::Zero());
  const double most = std::max(kSunkIntoWall, margin), sunk = limitOf(bb, ba);
  for (std::uint32_t c = 0; c < a.corners().size(); ++c) {
    const Vec3 x = ba.X * a.corners()[c];
    ClosestPoint at;
    const std::int32_t i = b.nearest(x, 2 * most, at);
    if (i < 0 || at.edge < 0) continue;
    const Triangle& t = b.triangles()[static_cast<std::size_t>(i)];
    const Vec3 n = t.normal.dot(ba.middle - t.v[0]) >= 0 ? t.normal : Vec3(-t.normal);
    const double height = n.dot(x - t.v[0]);
    const Vec3 inwards = at.point - x + height * n;
    const double beyond = inwards.norm();
    if (!(beyond > kOverFace) || beyond > most || !(height < margin) || height < -sunk ||
        !ba.facesAgainst(c, n))
      continue;
    const Gap gap{height, X_WB * (x - height * n), X_WB.q * n, true, i};
    corners.push_back(
        {{gap, cornerKey(c, bb, n, false), Carrier::A}, X_WB * at.point, X_WB.q * (inwards / beyond)});
  }
}

}  // namespace stadion
