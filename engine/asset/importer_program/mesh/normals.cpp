#include "engine/asset/importer_program/mesh/geometry.h"

#include "engine/asset/mesh_checks.h"
#include "engine/maths/functions.h"

#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace stadion::importer {
namespace {

constexpr double kCosCrease = 0.7660444431;  // 40 degrees
// A point where more triangles meet is smoothed over all of them: comparing each with each would take for
// ever.
constexpr std::size_t kMostPairs = 512;

Vec3 pointOf(const std::array<float, 3>& p) {
  return {p[0], p[1], p[2]};
}

bool missing(const FlatVertex& v) {
  return v.normal == std::array<float, 3>{0, 0, 0};
}

struct Face {
  Vec3 normal = Vec3::Zero();  // unit, or zero
  std::array<double, 3> angle{};
};

Face faceOf(const Flat& flat, const FlatTriangle& t) {
  std::array<Vec3, 3> p;
  for (int k = 0; k < 3; ++k) p[k] = pointOf(flat.vertices[t.corner[k]].position);
  Face face;
  const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]);
  if (n.norm() > 0) face.normal = n / n.norm();
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
    face.angle[k] = det::atan2(a.cross(b).norm(), a.dot(b));
  }
  return face;
}

// The corners (3 x triangle + k) that meet at each position, grouped by prefix sums.
struct CornerTable {
  std::vector<std::uint32_t> weld, start, corner;

  explicit CornerTable(const Flat& flat) {
    std::vector<std::array<float, 3>> positions;
    std::vector<VertexJoints> joints;
    for (const FlatVertex& v : flat.vertices) positions.push_back(v.position);
    for (std::size_t i = 0; flat.hasJoints && i < flat.vertices.size(); ++i)
      joints.push_back(flat.vertices[i].joints);
    weld = weldPositions(positions, joints);
    start.assign(flat.vertices.size() + 1, 0);
    for (const FlatTriangle& t : flat.triangles)
      for (std::uint32_t c : t.corner) ++start[weld[c] + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    corner.resize(start.back());
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (std::uint32_t t = 0; t < flat.triangles.size(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) corner[next[weld[flat.triangles[t].corner[k]]]++] = 3 * t + k;
  }
};

Vec3 cornerNormal(const std::vector<Face>& faces, const CornerTable& meeting, std::uint32_t position,
                  const Face& own) {
  const std::uint32_t begin = meeting.start[position], end = meeting.start[position + 1];
  const bool all = end - begin > kMostPairs || own.normal.isZero();
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = begin; i < end; ++i) {
    const Face& other = faces[meeting.corner[i] / 3];
    if (all || own.normal.dot(other.normal) >= kCosCrease)
      sum += other.angle[meeting.corner[i] % 3] * other.normal;
  }
  if (sum.norm() > 1e-9) return sum.normalized();
  return own.normal.isZero() ? Vec3::UnitZ() : own.normal;
}

bool same(const FlatVertex& a, const FlatVertex& b) {
  return a.position == b.position && a.normal == b.normal && a.uv == b.uv && a.secondUv == b.secondUv &&
         a.tangent == b.tangent && a.colour == b.colour && a.joints == b.joints && a.morph == b.morph;
}

// Finds equal vertices: open addressing over the numbers of those already in the mesh.
class VertexSet {
public:
  explicit VertexSet(std::size_t most) : slots_(std::bit_ceil(2 * most + 16), kEmpty) {}

  std::uint32_t add(const FlatVertex& v) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = XXH3_64bits(&v, sizeof v) & mask;
    while (slots_[at] != kEmpty && !same(vertices[slots_[at]], v)) at = (at + 1) & mask;
    if (slots_[at] == kEmpty) {
      slots_[at] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(v);
    }
    return slots_[at];
  }

  std::vector<FlatVertex> vertices;

private:
  static_assert(sizeof(FlatVertex) == 88, "hashed as bytes: no padding");
  static constexpr std::uint32_t kEmpty = 0xffffffff;
  std::vector<std::uint32_t> slots_;
};

/// The differences of all primitives that belong to one weight. `numbers`: by vertex, FlatVertex::morph.
Morph morphOf(const Flat& flat, std::uint32_t weight, const std::vector<std::uint32_t>& numbers) {
  constexpr std::array<float, 3> kNone{0, 0, 0};
  Morph morph;
  morph.weight = weight;
  bool normals = false;
  for (const FlatMorph& from : flat.morphs) normals |= from.weight == weight && !from.normals.empty();
  for (std::uint32_t v = 0; v < numbers.size(); ++v)
    for (const FlatMorph& from : flat.morphs) {
      if (from.weight != weight || numbers[v] < from.first ||
          numbers[v] - from.first >= from.positions.size())
        continue;
      const std::size_t at = numbers[v] - from.first;
      const std::array<float, 3>& turn = from.normals.empty() ? kNone : from.normals[at];
      if (from.positions[at] == kNone && turn == kNone) continue;
      morph.vertices.push_back(v);
      morph.positions.push_back(from.positions[at]);
      if (normals) morph.normals.push_back(turn);
    }
  return morph;
}

void joinMorphs(const Flat& flat, const std::vector<FlatVertex>& vertices, Mesh& mesh) {
  if (flat.morphs.empty()) return;
  std::vector<std::uint32_t> numbers;
  for (const FlatVertex& v : vertices) numbers.push_back(v.morph);
  std::uint32_t most = 0;
  for (const FlatMorph& from : flat.morphs) most = std::max(most, from.weight);
  for (std::uint32_t weight = 0; weight <= most; ++weight)
    if (Morph morph = morphOf(flat, weight, numbers); !morph.vertices.empty())
      mesh.morphs.push_back(std::move(morph));
}

}  // namespace

void makeNormals(Flat& flat) {
  const bool needed = std::any_of(flat.triangles.begin(), flat.triangles.end(), [&](const FlatTriangle& t) {
    return std::any_of(t.corner.begin(), t.corner.end(),
                       [&](std::uint32_t c) { return missing(flat.vertices[c]); });
  });
  if (!needed) return;
  std::vector<Face> faces;
  faces.reserve(flat.triangles.size());
  for (const FlatTriangle& t : flat.triangles) faces.push_back(faceOf(flat, t));
  const CornerTable meeting(flat);
  // Every corner that needs a normal gets a vertex of its own; joinInto joins those that came out equal.
  for (std::uint32_t t = 0; t < flat.triangles.size(); ++t) {
    for (std::uint32_t& c : flat.triangles[t].corner) {
      if (c >= meeting.weld.size() || !missing(flat.vertices[c])) continue;
      FlatVertex v = flat.vertices[c];
      const Vec3 n = cornerNormal(faces, meeting, meeting.weld[c], faces[t]);
      for (int k = 0; k < 3; ++k) v.normal[k] = static_cast<float>(n[k]) + 0.0f;
      c = static_cast<std::uint32_t>(flat.vertices.size());
      flat.vertices.push_back(v);
    }
  }
}

void joinInto(const Flat& flat, Mesh& mesh) {
  std::vector<std::uint32_t> order(flat.triangles.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return flat.triangles[a].material < flat.triangles[b].material;
  });
  VertexSet set(std::min(flat.vertices.size(), 3 * flat.triangles.size()));
  for (std::uint32_t i : order) {
    const FlatTriangle& t = flat.triangles[i];
    const auto material = t.material < mesh.materials.size() ? t.material : 0;
    if (mesh.submeshes.empty() || mesh.submeshes.back().material != material)
      mesh.submeshes.push_back({static_cast<std::uint32_t>(mesh.indices.size()), 0, material});
    for (std::uint32_t c : t.corner) mesh.indices.push_back(set.add(flat.vertices[c]));
    mesh.submeshes.back().indexCount += 3;
  }
  for (const FlatVertex& v : set.vertices) {
    mesh.positions.push_back(v.position);
    mesh.normals.push_back(v.normal);
    if (flat.hasUvs) mesh.uvs.push_back(v.uv);
    if (flat.hasSecondUvs) mesh.secondUvs.push_back(v.secondUv);
    if (flat.hasTangents) mesh.tangents.push_back(v.tangent);
    if (flat.hasColours) mesh.colours.push_back(v.colour);
    if (flat.hasJoints) mesh.joints.push_back(v.joints);
  }
  joinMorphs(flat, set.vertices, mesh);
}

}  // namespace stadion::importer
