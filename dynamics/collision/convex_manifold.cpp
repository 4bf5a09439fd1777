#include "dynamics/collision/convex_manifold.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kFlat = 0.9999;        ///< a face this square to the normal carries a patch
constexpr double kFlatEdge = 1 - 1e-9;  ///< cosine between faces that are one
constexpr std::size_t kMost = 16;       ///< points of a pair
constexpr double kUpright = 0.99999;    ///< a disc nearer to flat lies on points that turn with it
constexpr double kWall = 0.2;  ///< share of its size by which a body may be behind a face that it touches

struct Corner {
  Vec3 p;
  std::uint32_t key;
};

struct Polygon {
  std::array<Corner, 40> at;
  int count = 0;
  void add(const Corner& c) {
    if (count < 40) at[static_cast<std::size_t>(count++)] = c;
  }
  const Corner& operator[](int i) const { return at[static_cast<std::size_t>(i)]; }
};

/// What has n . p <= d; a polygon of two is a line.
Polygon clipped(const Polygon& in, const Vec3& n, double d, std::uint32_t side) {
  Polygon out;
  const int last = in.count == 2 ? 1 : in.count;
  for (int i = 0; i < in.count; ++i) {
    const Corner &a = in[i], &b = in[(i + 1) % in.count];
    const double ha = n.dot(a.p) - d, hb = n.dot(b.p) - d;
    if (ha <= 0) out.add(a);
    if (i < last && ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)))
      out.add({a.p + (b.p - a.p) * (ha / (ha - hb)), 32 + 32 * side + a.key % 32});
  }
  return out;
}

Polygon polygonOf(const Feature& f) {
  Polygon p;
  for (int i = 0; i < f.count; ++i)
    p.add({f.points[static_cast<std::size_t>(i)], static_cast<std::uint32_t>(i)});
  return p;
}

/// How the core is round at its point x, under which it lies on a plane with normal n.
Rounding roundingAt(const ConvexCore& c, const Vec3& n, const Vec3& x) {
  if (c.kind != ConvexCore::Kind::Cylinder) return {c.radius, Vec3::Zero()};
  const Rounding rim{c.half.x(), c.R.col(2)};
  if (std::fabs(rim.axis.dot(n)) > kUpright) return {};
  const Vec3 across = x - c.p - rim.axis * rim.axis.dot(x - c.p);
  return (across - rim.offset(-n, rim.axis)).norm() < 1e-6 * rim.radius ? rim : Rounding{};
}

/// The part of `body`'s side over the flat face of `flat`, whose outward normal is m.
void overFace(const ConvexCore& body, const Feature& face, bool faceIsB, double margin, std::uint32_t key,
              std::vector<ManifoldPoint>& points) {
  const Vec3 m = face.normal, n = faceIsB ? m : Vec3(-m);  // outwards; from b to a
  Polygon p = polygonOf(featureTowards(body, -m, false));
  for (int i = 0; i < face.count && p.count > 0; ++i) {
    const Vec3 &x = face.points[static_cast<std::size_t>(i)],
               &y = face.points[static_cast<std::size_t>((i + 1) % face.count)];
    const Vec3 out = (y - x).cross(m);
    const double length = out.norm();
    if (!(length > 0)) continue;
    p = clipped(p, out / length, out.dot(x) / length + 1e-12, static_cast<std::uint32_t>(i));
  }
  const double level = m.dot(face.points[0]);
  for (int i = 0; i < p.count; ++i) {
    const double gap = m.dot(p[i].p) - level - body.radius;
    if (gap > margin || points.size() >= 4 * kMost) continue;
    const Vec3 onBody = p[i].p - body.radius * m;
    const Vec3 onB = faceIsB ? Vec3(onBody - gap * n) : onBody;
    const Rounding rounding = roundingAt(body, m, p[i].p);
    const Carrier carrier = rounding.radius == 0 ? Carrier::None : faceIsB ? Carrier::A : Carrier::B;
    points.push_back({{gap, onB, n, true, -1}, key + p[i].key + (faceIsB ? 0 : 2048), carrier, rounding});
  }
}

/// Two straight sides along each other.
bool alongLines(const ConvexCore& a, const Feature& la, const ConvexCore& b, const Feature& lb, const Vec3& n,
                double margin, std::uint32_t key, std::vector<ManifoldPoint>& points) {
  if (la.count != 2 || lb.count != 2) return false;
  const Vec3 d = la.points[1] - la.points[0], e = lb.points[1] - lb.points[0];
  const double ld = d.norm(), le = e.norm();
  if (!(ld > 0) || !(le > 0) || std::fabs(d.dot(e)) < kFlat * ld * le || std::fabs(d.dot(n)) > 0.02 * ld)
    return false;
  const Vec3 u = e / le;
  Polygon p = clipped(polygonOf(la), u, std::max(u.dot(lb.points[0]), u.dot(lb.points[1])), 0);
  p = clipped(p, -u, std::max(-u.dot(lb.points[0]), -u.dot(lb.points[1])), 1);
  bool any = false;
  for (int i = 0; i < p.count; ++i) {
    const double s = std::clamp((p[i].p - lb.points[0]).dot(u) / le, 0.0, 1.0);
    const Vec3 onB = lb.points[0] + s * e + b.radius * n;
    const double gap = n.dot(p[i].p - onB) - a.radius;
    if (gap > margin) continue;
    points.push_back({{gap, onB, n, false, -1}, key + p[i].key + 4096});
    any = true;
  }
  return any;
}

/// Keeps the deepest point and the widest spread.
void thin(std::vector<ManifoldPoint>& points, std::size_t from, std::size_t most) {
  if (points.size() - from <= most) return;
  const auto begin = points.begin() + static_cast<std::ptrdiff_t>(from);
  std::iter_swap(begin, std::min_element(begin, points.end(), [](const auto& l, const auto& r) {
                   return l.gap.distance < r.gap.distance;
                 }));
  for (std::size_t kept = 1; kept < most; ++kept) {
    std::size_t best = from + kept;
    double far = -1;
    for (std::size_t i = from + kept; i < points.size(); ++i) {
      double d = 1e300;
      for (std::size_t k = from; k < from + kept; ++k)
        d = std::min(d, (points[k].gap.point - points[i].gap.point).squaredNorm() +
                            (points[k].gap.normal - points[i].gap.normal).squaredNorm());
      if (d > far) {
        far = d;
        best = i;
      }
    }
    std::swap(points[from + kept], points[best]);
  }
  points.resize(from + most);
}

}  // namespace

void convexManifold(const ConvexCore& a, const ConvexCore& b, const ConvexGap& gap, double margin,
                    std::uint32_t key, std::vector<ManifoldPoint>& points) {
  if (!(gap.distance < margin)) return;
  const std::size_t before = points.size();
  const Vec3& n = gap.normal;
  const Feature fb = featureTowards(b, n, true), fa = featureTowards(a, -n, true);
  const double flatB = fb.count > 2 && b.radius == 0 ? fb.normal.dot(n) : 0,
               flatA = fa.count > 2 && a.radius == 0 ? -fa.normal.dot(n) : 0;
  if (flatB > kFlat && flatB >= flatA - 1e-9) {
    overFace(a, fb, true, margin, key, points);
  } else if (flatA > kFlat) {
    overFace(b, fa, false, margin, key, points);
  } else {
    alongLines(a, featureTowards(a, -n, false), b, featureTowards(b, n, false), n, margin, key, points);
  }
  // The nearest points themselves, unless the patch already reaches as near.
  double least = 1e300;
  for (std::size_t i = before; i < points.size(); ++i) least = std::min(least, points[i].gap.distance);
  if (least > gap.distance + 1e-7) points.push_back({{gap.distance, gap.onB, n, false, -1}, key + 8191});
  thin(points, before, 8);
}

void planeManifold(const ConvexCore& a, const Vec3& n, double level, double margin,
                   std::vector<ManifoldPoint>& points) {
  const std::size_t before = points.size();
  const Feature f = featureTowards(a, -n, false);
  for (int i = 0; i <= f.count; ++i) {
    // The lowest point of all is a rim's or a feature's own first one; of a hull it may belong to no face
    // here.
    const Vec3 x = (i < f.count ? f.points[static_cast<std::size_t>(i)] : a.support(-n)) - a.radius * n;
    const double gap = n.dot(x) - level;
    if (gap > margin) continue;
    bool known = false;
    for (std::size_t k = before; k < points.size(); ++k)
      known = known || (points[k].gap.point - x).squaredNorm() < 1e-16;
    if (known) continue;
    points.push_back({{gap, x, n, true, -1},
                      1000 + static_cast<std::uint32_t>(i),
                      Carrier::A,
                      roundingAt(a, n, x + a.radius * n)});
  }
  thin(points, before, 8);
}

bool meshNormal(const ConvexCore& a, const ConvexCore& face, const TriangleTree& tree, std::uint32_t triangle,
                ConvexGap& gap) {
  const Triangle& t = tree.triangles()[triangle];
  const double facing = face.normal.dot(gap.normal);
  if (std::fabs(facing) > kFlat) return true;
  // Which edge or corner is it that sticks out here?
  int edge = -1;
  double nearest = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 out = (face.v[(i + 1) % 3] - face.v[i]).cross(face.normal).normalized();
    const double d = std::fabs(out.dot(gap.onB - face.v[i]));
    if (out.dot(gap.normal) > 0 && d < nearest) {
      nearest = d;
      edge = static_cast<int>(i);
    }
  }
  if (edge < 0 || !t.merged[static_cast<std::size_t>(edge)]) return true;
  const Vec3 n = facing < 0 && face.normal.dot(a.middle() - face.v[0]) < 0 ? Vec3(-face.normal) : face.normal;
  const double depth = a.extent(-n) + n.dot(face.v[0]);
  // Far behind that face it has not come through it: the face stands on it like a wall. But an edge in the
  // middle of a flat part does not touch it.
  const double across = std::min(a.extent(n) + a.extent(-n), (face.v[1] - face.v[0]).norm());
  if (depth > kWall * across) {
    const std::int32_t next = t.next[static_cast<std::size_t>(edge)];
    return next < 0 || tree.triangles()[static_cast<std::size_t>(next)].normal.dot(t.normal) < kFlatEdge;
  }
  gap.normal = n;
  gap.distance = -depth;
  gap.onA = gap.onB = a.support(-n) - a.radius * n;
  return false;
}

void meshManifold(const ConvexCore& a, const MeshShape& mesh, const Pose& X, double margin,
                  std::vector<ManifoldPoint>& points) {
  const std::size_t before = points.size();
  const Mat3 R = X.q.toRotationMatrix();
  // The body's box in the mesh's axes.
  Aabb box;
  for (int i = 0; i < 3; ++i) {
    box.hi[i] = a.extent(R.col(i)) - R.col(i).dot(X.p) + margin;
    box.lo[i] = -a.extent(-R.col(i)) - R.col(i).dot(X.p) - margin;
  }
  mesh.tree.eachOverlapping(box, [&](std::uint32_t i) {
    const Triangle& t = mesh.tree.triangles()[i];
    const ConvexCore face = coreOf(t, X);
    const bool behind = face.normal.dot(a.middle() - face.v[0]) < 0;
    if (behind && mesh.tree.closed()) return;
    ConvexGap g = convexGap(a, face, behind ? Vec3(-face.normal) : face.normal);
    if (!(g.distance < margin)) return;
    const std::size_t first = points.size();
    const bool own = meshNormal(a, face, mesh.tree, i, g);
    convexManifold(a, face, g, margin, (i + 1) * 8192, points);
    for (std::size_t k = points.size(); k-- > first;) {
      ManifoldPoint& p = points[k];
      p.gap.triangle = static_cast<std::int32_t>(i);
      // Where a neighbour speaks for an edge only what lies over the face itself counts; and a point on a
      // seam counts once.
      bool drop = !own && !p.gap.face;
      for (std::size_t m = before; m < first && !drop; ++m)
        drop = (points[m].gap.point - p.gap.point).squaredNorm() < 1e-14 &&
               points[m].gap.normal.dot(p.gap.normal) > 0.999;
      if (drop) points.erase(points.begin() + static_cast<std::ptrdiff_t>(k));
    }
    if (points.size() > before + 6 * kMost) thin(points, before, kMost);
  });
  thin(points, before, kMost);
}

bool solidManifold(const Side& a, const Side& b, double tau, double margin,
                   std::vector<ManifoldPoint>& points) {
  const bool convexA = isConvex(*a.shape), convexB = isConvex(*b.shape);
  if (!convexA && !convexB) return false;
  if (!convexA) {
    if (!solidManifold(b, a, tau, margin, points)) return false;
    for (ManifoldPoint& p : points) {
      p.gap.point += p.gap.distance * p.gap.normal;
      p.gap.normal = -p.gap.normal;
      if (p.carrier != Carrier::None) p.carrier = p.carrier == Carrier::A ? Carrier::B : Carrier::A;
    }
    return true;
  }
  const Vec3 origin = a.at(tau).p;  // all is relative to here, for the sake of digits
  const auto placed = [&](const Side& s) {
    const Pose X = s.at(tau).pose;
    return Pose{X.p - origin, X.q};
  };
  ConvexCore ca, cb;
  coreOf(*a.shape, placed(a), ca);
  if (convexB) {
    coreOf(*b.shape, placed(b), cb);
    convexManifold(ca, cb, convexGap(ca, cb, ca.middle() - cb.middle()), margin, 0, points);
  } else if (const auto* plane = std::get_if<PlaneShape>(b.shape)) {
    if (ca.kind == ConvexCore::Kind::Box) return false;
    const Pose X = placed(b) * plane->pose;
    const Vec3 n = X.q * Vec3::UnitZ();
    planeManifold(ca, n, n.dot(X.p), margin, points);
  } else {
    meshManifold(ca, std::get<MeshShape>(*b.shape), placed(b), margin, points);
  }
  for (ManifoldPoint& p : points) p.gap.point += origin;
  return true;
}

}  // namespace stadion
