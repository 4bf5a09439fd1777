#include "dynamics/shapes/triangle_tree.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace stadion {
namespace {

using Key = std::array<double, 3>;

Key keyOf(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Aabb boxOf(const Triangle& t) {
  Aabb b;
  for (const Vec3& v : t.v) b.include(v);
  return b;
}

double squaredDistance(const Aabb& b, const Vec3& p) {
  return (b.lo - p).cwiseMax(p - b.hi).cwiseMax(0.0).squaredNorm();
}

/// Useful triangles only: finite, not degenerate, each once.
std::vector<Triangle> usable(const std::vector<std::array<Vec3, 3>>& all) {
  std::vector<Triangle> out;
  std::map<std::array<Key, 3>, bool> seen;
  for (const std::array<Vec3, 3>& v : all) {
    Triangle t;
    t.v = v;
    const Vec3 n = (v[1] - v[0]).cross(v[2] - v[0]);
    const double longest =
        std::max({(v[1] - v[0]).squaredNorm(), (v[2] - v[1]).squaredNorm(), (v[0] - v[2]).squaredNorm()});
    if (!(n.norm() > 1e-7 * longest) || !std::isfinite(longest)) continue;
    t.normal = n.normalized();
    t.next = {-1, -1, -1};
    t.merged = {false, false, false};
    std::array<Key, 3> key = {keyOf(t.v[0]), keyOf(t.v[1]), keyOf(t.v[2])};
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    if (seen.emplace(key, true).second) out.push_back(t);
  }
  return out;
}

/// Those whose corners exist and are finite.
std::vector<std::array<Vec3, 3>> trianglesOf(const Mesh& mesh) {
  std::vector<std::array<Vec3, 3>> out;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<Vec3, 3>& v = out.emplace_back();
    bool good = true;
    for (std::size_t k = 0; k < 3 && good; ++k) {
      const std::uint32_t at = mesh.indices[i + k];
      good = at < mesh.positions.size();
      if (!good) break;
      const auto& p = mesh.positions[at];
      v[k] = {p[0], p[1], p[2]};
      good = v[k].allFinite();
    }
    if (!good) out.pop_back();
  }
  return out;
}

/// Negative if the faces look inwards [m3].
double volume(const std::vector<Triangle>& triangles) {
  double sum = 0;
  const Vec3 from = triangles.front().v[0];
  for (const Triangle& t : triangles) sum += (t.v[0] - from).dot((t.v[1] - from).cross(t.v[2] - from)) / 6;
  return sum;
}

}  // namespace

ClosestPoint closestPoint(const Triangle& t, const Vec3& p) {
  // Inside the prism over the triangle the face is nearest; else the nearest of the three edges.
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 e = t.v[(i + 1) % 3] - t.v[i];
    if (t.normal.cross(e).dot(p - t.v[i]) < 0) inside = false;
  }
  if (inside) return {p - t.normal * t.normal.dot(p - t.v[0]), -1, false};
  ClosestPoint best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = t.v[i], &b = t.v[(i + 1) % 3], e = b - a;
    const double s = std::clamp((p - a).dot(e) / e.squaredNorm(), 0.0, 1.0);
    const Vec3 q = s == 0 ? a : s == 1 ? b : Vec3(a + s * e);
    const double d = (p - q).squaredNorm();
    if (d < nearest) {
      nearest = d;
      best = {q, s == 1 ? static_cast<int>((i + 1) % 3) : static_cast<int>(i), s == 0 || s == 1};
    }
  }
  return best;
}

TriangleTree::TriangleTree(const Mesh& mesh) : triangles_(usable(trianglesOf(mesh))) {
  dropped_ = mesh.indices.size() / 3 - triangles_.size();
  prepare();
}

TriangleTree::TriangleTree(const std::vector<std::array<Vec3, 3>>& triangles)
    : triangles_(usable(triangles)) {
  dropped_ = triangles.size() - triangles_.size();
  prepare();
}

void TriangleTree::prepare() {
  for (const Triangle& t : triangles_) bounds_.include(boxOf(t));
  if (triangles_.empty()) return;
  collectCorners();
  connect();
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(2 * triangles_.size());
  build(0, static_cast<std::uint32_t>(order_.size()));
  for (const std::uint32_t i : order_) boxes_.push_back(boxOf(triangles_[i]));
}

void TriangleTree::collectCorners() {
  std::map<Key, std::uint32_t> places;
  for (const Triangle& t : triangles_) {
    std::array<std::uint32_t, 3>& own = cornersOf_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, fresh] = places.emplace(keyOf(t.v[k]), static_cast<std::uint32_t>(corners_.size()));
      if (fresh) corners_.push_back(t.v[k]);
      own[k] = at->second;
    }
  }
  aroundFirst_.assign(corners_.size() + 1, 0);
  for (const auto& own : cornersOf_)
    for (const std::uint32_t c : own) ++aroundFirst_[c + 1];
  std::partial_sum(aroundFirst_.begin(), aroundFirst_.end(), aroundFirst_.begin());
  around_.resize(aroundFirst_.back());
  std::vector<std::uint32_t> next(aroundFirst_.begin(), aroundFirst_.end() - 1);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    for (const std::uint32_t c : cornersOf_[i]) around_[next[c]++] = i;
}

void TriangleTree::connect() {
  // Vertices at equal places count as one, so that meshes with split normals are whole.
  std::map<std::pair<Key, Key>, std::pair<std::int32_t, std::size_t>> open;
  std::size_t unmatched = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      Triangle& t = triangles_[i];
      const Key a = keyOf(t.v[k]), b = keyOf(t.v[(k + 1) % 3]);
      const auto other = open.find({b, a});
      if (other == open.end()) {
        open[{a, b}] = {static_cast<std::int32_t>(i), k};
        ++unmatched;
        continue;
      }
      const auto [j, l] = other->second;
      Triangle& u = triangles_[static_cast<std::size_t>(j)];
      open.erase(other);
      --unmatched;
      t.next[k] = j;
      u.next[l] = static_cast<std::int32_t>(i);
      // Flat or hollow: the far corner of the neighbour does not lie below this face.
      const Vec3 far = u.v[(l + 2) % 3] - t.v[k];
      t.merged[k] = u.merged[l] = t.normal.dot(far) >= -1e-5 * far.norm();
    }
  }
  closed_ = unmatched == 0 && std::fabs(volume(triangles_)) > 1e-9 * (bounds_.hi - bounds_.lo).squaredNorm() *
                                                                  (bounds_.hi - bounds_.lo).norm();
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Aabb box, centres;
  const auto centre = [&](std::uint32_t t) {
    return Vec3((triangles_[t].v[0] + triangles_[t].v[1] + triangles_[t].v[2]) / 3);
  };
  for (std::uint32_t i = first; i < first + count; ++i) {
    box.include(boxOf(triangles_[order_[i]]));
    centres.include(centre(order_[i]));
  }
  nodes_[self].box = box;
  if (count <= 4) {
    nodes_[self].first = first;
    nodes_[self].count = count;
    return;
  }
  int axis = 0;
  (centres.hi - centres.lo).maxCoeff(&axis);
  const auto middle = order_.begin() + first + count / 2;
  std::nth_element(order_.begin() + first, middle, order_.begin() + first + count,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = centre(a)[axis], y = centre(b)[axis];
                     return x != y ? x < y : a < b;
                   });
  build(first, count / 2);
  nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
  build(first + count / 2, count - count / 2);
}

void TriangleTree::overlapping(const Aabb& box, std::vector<std::uint32_t>& found) const {
  found.clear();
  walk([&](const Aabb& b) { return b.overlaps(box); }, [&](std::uint32_t i) { found.push_back(i); });
  std::sort(found.begin(), found.end());
}

Vec3 TriangleTree::outwardsAt(std::int32_t triangle, const ClosestPoint& at) const {
  const auto i = static_cast<std::size_t>(triangle);
  const Triangle& t = triangles_[i];
  if (at.edge < 0) return t.normal;
  const auto k = static_cast<std::size_t>(at.edge);
  if (!at.corner) {
    const std::int32_t next = t.next[k];
    return next < 0 ? t.normal : Vec3(t.normal + triangles_[static_cast<std::size_t>(next)].normal);
  }
  const std::uint32_t corner = cornersOf_[i][k];
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t j : around(corner)) {
    const auto& own = cornersOf_[j];
    const std::size_t m = own[0] == corner ? 0 : own[1] == corner ? 1 : 2;
    const Triangle& u = triangles_[j];
    const Vec3 a = u.v[(m + 1) % 3] - u.v[m], b = u.v[(m + 2) % 3] - u.v[m];
    sum += det::atan2(a.cross(b).norm(), a.dot(b)) * u.normal;
  }
  return sum;
}

bool TriangleTree::encloses(const Vec3& p) const {
  if (!closed_ || (p.array() < bounds_.lo.array()).any() || (p.array() > bounds_.hi.array()).any())
    return false;
  ClosestPoint at;
  const std::int32_t i = nearest(p, 1e300, at);
  return i >= 0 && outwardsAt(i, at).dot(p - at.point) < 0;
}

std::int32_t TriangleTree::nearest(const Vec3& p, double limit, ClosestPoint& at, double enough,
                                   std::int32_t hint) const {
  std::int32_t best = -1;
  double bound = limit < 1e150 ? limit * limit : std::numeric_limits<double>::infinity();
  if (nodes_.empty()) return best;
  if (hint >= 0 && static_cast<std::size_t>(hint) < triangles_.size() && enough > 0) {
    at = closestPoint(triangles_[static_cast<std::size_t>(hint)], p);
    if ((at.point - p).squaredNorm() < enough * enough) return hint;
  }
  std::uint32_t stack[64];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::uint32_t self = stack[--top];
    const Node& n = nodes_[self];
    if (squaredDistance(n.box, p) > bound) continue;
    if (n.count == 0) {
      const std::uint32_t left = self + 1, right = n.first;
      const bool leftFirst = squaredDistance(nodes_[left].box, p) <= squaredDistance(nodes_[right].box, p);
      stack[top++] = leftFirst ? right : left;
      stack[top++] = leftFirst ? left : right;
      continue;
    }
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
      const ClosestPoint c = closestPoint(triangles_[order_[i]], p);
      const double d = (c.point - p).squaredNorm();
      const auto index = static_cast<std::int32_t>(order_[i]);
      // On a tie the face that p is most in front of: the sign of an edge's two faces may differ.
      if (d < bound || (d == bound &&
                        (best < 0 || (triangles_[order_[i]].normal.dot(p - c.point) >
                                      triangles_[static_cast<std::size_t>(best)].normal.dot(p - c.point))))) {
        bound = d;
        best = index;
        at = c;
        if (d < enough * enough) return best;
      }
    }
  }
  return best;
}

}  // namespace stadion
