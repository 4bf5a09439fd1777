#include "dynamics/shapes/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace stadion {
namespace {

using Index = std::uint32_t;

struct Facet {
  std::array<Index, 3> v;
  Vec3 normal;
  double offset;
  bool alive = true;
};

/// Quickhull with brute-force visibility: clouds here have some thousand points and hulls some hundred.
class Builder {
public:
  explicit Builder(const std::vector<Vec3>& points) : points_(points) {
    double size = 0;
    for (const Vec3& p : points_) size = std::max(size, (p - points_[0]).norm());
    tolerance_ = 1e-7 * size;
  }

  bool run() {
    if (!begin()) return false;
    std::vector<Index> rest(points_.size());
    for (Index i = 0; i < rest.size(); ++i) rest[i] = i;
    for (std::size_t round = 0; round < points_.size(); ++round) {
      // The point that is farthest outside of the facet it is farthest outside of.
      Index best = 0;
      double far = tolerance_;
      std::erase_if(rest, [&](Index i) {
        double out = -1e300;
        for (const Facet& f : facets_)
          if (f.alive) out = std::max(out, f.normal.dot(points_[i]) - f.offset);
        if (out > far) {
          far = out;
          best = i;
        }
        return out <= tolerance_;
      });
      if (far <= tolerance_) return true;
      insert(best);
      std::erase_if(facets_, [](const Facet& f) { return !f.alive; });
    }
    return true;
  }

  const std::vector<Facet>& facets() const { return facets_; }

private:
  bool begin() {
    if (points_.size() < 4) return false;
    const auto farthest = [&](auto measure) {
      Index best = 0;
      double far = -1;
      for (Index i = 0; i < points_.size(); ++i)
        if (const double d = measure(points_[i]); d > far) {
          far = d;
          best = i;
        }
      return std::pair(best, far);
    };
    const Vec3 o = points_[0];
    const Index a = farthest([&](const Vec3& p) { return (p - o).squaredNorm(); }).first;
    const Vec3 A = points_[a];
    const Index b = farthest([&](const Vec3& p) { return (p - A).squaredNorm(); }).first;
    const Vec3 u = (points_[b] - A).normalized();
    const auto [c, dc] = farthest([&](const Vec3& p) { return (p - A).cross(u).norm(); });
    if (!(dc > tolerance_)) return false;
    const Vec3 n = (points_[b] - A).cross(points_[c] - A).normalized();
    const auto [d, dd] = farthest([&](const Vec3& p) { return std::fabs(n.dot(p - A)); });
    if (!(dd > tolerance_)) return false;
    inside_ = (A + points_[b] + points_[c] + points_[d]) / 4;
    add(a, b, c);
    add(a, b, d);
    add(a, c, d);
    add(b, c, d);
    return true;
  }

  void add(Index a, Index b, Index c) {
    Facet f;
    f.v = {a, b, c};
    f.normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    const double area = f.normal.norm();
    f.normal = area > 0 ? Vec3(f.normal / area) : Vec3::Zero();
    f.offset = f.normal.dot(points_[a]);
    if (f.normal.dot(inside_) > f.offset) {
      std::swap(f.v[1], f.v[2]);
      f.normal = -f.normal;
      f.offset = -f.offset;
    }
    facets_.push_back(f);
  }

  void insert(Index p) {
    std::set<std::pair<Index, Index>> rim;
    for (Facet& f : facets_) {
      if (f.normal.dot(points_[p]) - f.offset <= 0) continue;
      f.alive = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = f.v[k], b = f.v[(k + 1) % 3];
        if (!rim.erase({b, a})) rim.insert({a, b});
      }
    }
    for (const auto& [a, b] : rim) add(a, b, p);
  }

  const std::vector<Vec3>& points_;
  std::vector<Facet> facets_;
  Vec3 inside_ = Vec3::Zero();
  double tolerance_ = 0;
};

/// Facets in one plane become one polygon: the rim of their union, in order. Returns the face of each.
std::vector<Index> merge(const std::vector<Facet>& facets, double tolerance, ConvexShape& s) {
  constexpr Index kNone = ~Index{0};
  std::vector<Index> faceOf(facets.size(), kNone);
  std::set<std::array<Index, 2>> edges;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (faceOf[i] != kNone) continue;
    std::map<Index, Index> next;
    std::set<std::pair<Index, Index>> rim;
    for (std::size_t j = i; j < facets.size(); ++j) {
      const Facet& f = facets[j];
      const bool flat =
          j == i || (faceOf[j] == kNone && f.normal.dot(facets[i].normal) > 1 - 1e-6 &&
                     std::ranges::all_of(f.v, [&](Index v) {
                       return std::fabs(facets[i].normal.dot(s.points[v]) - facets[i].offset) <= tolerance;
                     }));
      if (!flat) continue;
      faceOf[j] = static_cast<Index>(s.faces.size());
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = f.v[k], b = f.v[(k + 1) % 3];
        if (!rim.erase({b, a})) rim.insert({a, b});
      }
    }
    for (const auto& [a, b] : rim) next[a] = b;
    if (next.empty()) continue;
    ConvexShape::Face face{facets[i].normal, -1e300, static_cast<Index>(s.loops.size()), 0};
    const Index start = next.begin()->first;
    for (Index at = start; face.count <= next.size();) {
      s.loops.push_back(at);
      ++face.count;
      face.offset = std::max(face.offset, face.normal.dot(s.points[at]));
      const auto to = next.find(at);
      if (to == next.end()) break;
      edges.insert({std::min(at, to->second), std::max(at, to->second)});
      at = to->second;
      if (at == start) break;
    }
    s.faces.push_back(face);
  }
  s.edges.assign(edges.begin(), edges.end());
  return faceOf;
}

std::uint32_t farthestOfAll(const std::vector<Vec3>& points, const Vec3& d) {
  double far = -1e300;
  std::uint32_t best = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (const double h = d.dot(points[i]); h > far) {
      far = h;
      best = i;
    }
  return best;
}

/// Each edge of the triangles, from both its ends: also those inside flat faces, so that no corner is alone.
void connect(const std::vector<Facet>& facets, const std::vector<Index>& faceOf, ConvexShape& s) {
  s.firstNeighbour.assign(s.points.size() + 1, 0);
  for (const Facet& f : facets)
    for (const Index v : f.v) ++s.firstNeighbour[v + 1];
  for (std::size_t i = 1; i < s.firstNeighbour.size(); ++i) s.firstNeighbour[i] += s.firstNeighbour[i - 1];
  s.neighbours.resize(s.firstNeighbour.back());
  std::vector<Index> next(s.firstNeighbour.begin(), s.firstNeighbour.end() - 1);
  for (const Facet& f : facets)
    for (std::size_t k = 0; k < 3; ++k) s.neighbours[next[f.v[k]]++] = f.v[(k + 1) % 3];
  std::set<std::array<Index, 2>> around;
  for (std::size_t i = 0; i < facets.size(); ++i)
    for (const Index v : facets[i].v)
      if (faceOf[i] < s.faces.size()) around.insert({v, faceOf[i]});
  s.firstFace.assign(s.points.size() + 1, 0);
  for (const auto& [corner, face] : around) {
    ++s.firstFace[corner + 1];
    s.facesAround.push_back(face);
  }
  for (std::size_t i = 1; i < s.firstFace.size(); ++i) s.firstFace[i] += s.firstFace[i - 1];
  for (std::size_t i = 0; i < 8; ++i)
    s.outermost[i] = farthestOfAll(s.points, Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
}

}  // namespace

std::uint32_t ConvexShape::farthest(const Vec3& d) const {
  if (few()) return farthestOfAll(points, d);
  std::uint32_t best =
      outermost[std::size_t{d.x() > 0} | std::size_t{d.y() > 0} << 1 | std::size_t{d.z() > 0} << 2];
  double far = d.dot(points[best]);
  for (bool higher = true; higher;) {
    higher = false;
    const std::uint32_t from = best;
    for (std::uint32_t i = firstNeighbour[from]; i < firstNeighbour[from + 1]; ++i)
      if (const double h = d.dot(points[neighbours[i]]); h > far) {
        far = h;
        best = neighbours[i];
        higher = true;
      }
  }
  return best;
}

std::optional<ConvexShape> convexHull(const std::vector<Vec3>& cloud) {
  if (!std::ranges::all_of(cloud, [](const Vec3& p) { return p.allFinite(); })) return {};
  std::vector<Vec3> points = cloud;
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Builder builder(points);
  if (!builder.run()) return {};
  // Only the corners stay, with new numbers.
  std::map<Index, Index> number;
  for (const Facet& f : builder.facets())
    for (const Index v : f.v) number.emplace(v, 0);
  ConvexShape s;
  for (auto& [old, now] : number) {
    now = static_cast<Index>(s.points.size());
    s.points.push_back(points[old]);
  }
  std::vector<Facet> facets = builder.facets();
  for (Facet& f : facets)
    for (Index& v : f.v) v = number[v];
  Aabb box;
  for (const Vec3& p : s.points) box.include(p);
  s.centre = box.centre();
  for (const Vec3& p : s.points) s.reach = std::max(s.reach, (p - s.centre).norm());
  connect(facets, merge(facets, 2e-7 * s.reach, s), s);
  s.inside = 1e300;
  for (const ConvexShape::Face& f : s.faces) s.inside = std::min(s.inside, f.offset - f.normal.dot(s.centre));
  if (!(s.inside >
        0)) {  // the middle of the bounds of a slanted body may lie outside: the mean of corners not
    s.centre.setZero();
    for (const Vec3& p : s.points) s.centre += p / static_cast<double>(s.points.size());
    s.reach = 0;
    s.inside = 1e300;
    for (const Vec3& p : s.points) s.reach = std::max(s.reach, (p - s.centre).norm());
    for (const ConvexShape::Face& f : s.faces)
      s.inside = std::min(s.inside, f.offset - f.normal.dot(s.centre));
  }
  return s;
}

}  // namespace stadion
