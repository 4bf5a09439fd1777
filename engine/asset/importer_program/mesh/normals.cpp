#include "engine/asset/importer_program/mesh/geometry.h"

#include "engine/asset/importer_program/mesh/vertex_set.h"
#include "engine/asset/mesh_checks.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

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

/// Adds the differences of one primitive to those of its weight.
void addMorph(const FlatMorph& from, const std::vector<std::vector<std::uint32_t>>& verticesOf, Morph& to) {
  constexpr std::array<float, 3> kNone{0, 0, 0};
  for (std::size_t i = 0; i < from.positions.size(); ++i) {
    const std::array<float, 3>& turn = from.normals.empty() ? kNone : from.normals[i];
    if (from.positions[i] == kNone && turn == kNone) continue;
    for (const std::uint32_t v : verticesOf[from.first + i]) {
      to.vertices.push_back(v);
      to.positions.push_back(from.positions[i]);
      to.normals.push_back(turn);
    }
  }
}

/// Brings the differences into the order of their vertices.
void sortByVertex(Morph& morph) {
  std::vector<std::uint32_t> order(morph.vertices.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return morph.vertices[i]; });
  Morph sorted;
  sorted.weight = morph.weight;
  for (const std::uint32_t i : order) {
    sorted.vertices.push_back(morph.vertices[i]);
    sorted.positions.push_back(morph.positions[i]);
    sorted.normals.push_back(morph.normals[i]);
  }
  morph = std::move(sorted);
}

void joinMorphs(const Flat& flat, const std::vector<FlatVertex>& vertices, Mesh& mesh) {
  if (flat.morphs.empty()) return;
  std::size_t numbers = 1;
  for (const FlatMorph& from : flat.morphs) numbers = std::max(numbers, from.first + from.positions.size());
  std::vector<std::vector<std::uint32_t>> verticesOf(numbers);  // by FlatVertex::morph
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (vertices[v].morph != 0 && vertices[v].morph < numbers) verticesOf[vertices[v].morph].push_back(v);
  std::map<std::uint32_t, Morph> morphs;  // by weight
  for (const FlatMorph& from : flat.morphs) addMorph(from, verticesOf, morphs[from.weight]);
  for (auto& [weight, morph] : morphs) {
    if (morph.vertices.empty()) continue;
    morph.weight = weight;
    sortByVertex(morph);
    constexpr std::array<float, 3> kNone{0, 0, 0};
    if (std::ranges::all_of(morph.normals, [&](const auto& n) { return n == kNone; })) morph.normals.clear();
    mesh.morphs.push_back(std::move(morph));
  }
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
