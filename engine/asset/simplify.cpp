#include "engine/asset/simplify.h"

#include "engine/asset/nearest_triangle.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>

namespace stadion {
namespace {

/// A level is worth its memory if it has at most this part of the triangles of the one before.
constexpr double kWorthwhile = 0.75;
constexpr double kFinest = 1.0 / (1 << 18), kCoarsest = 0.2;  ///< errors that are tried, of its size
constexpr double kStep = 4;
constexpr double kColours = 12;            ///< of 255: by so much a colour may differ
constexpr double kPicture = 1.0 / 128;     ///< of the picture: so far it may be shifted
constexpr std::size_t kFewTriangles = 32;  ///< what has no more is drawn as it is

/// Points of a triangle that are looked at: its corners, the middles of its edges, its middle.
const Vec3 kSamples[] = {
    {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {1. / 3, 1. / 3, 1. / 3}};

double farthestFrom(const Mesh& mesh, std::span<const std::uint32_t> from, const NearestTriangle& to) {
  double farthest = 0;
  for (std::size_t i = 0; i + 2 < from.size(); i += 3) {
    const Vec3 a = placeOf(mesh, from[i]), b = placeOf(mesh, from[i + 1]), c = placeOf(mesh, from[i + 2]);
    for (const Vec3& w : kSamples)
      farthest = std::max(farthest, to.nearest(w[0] * a + w[1] * b + w[2] * c, farthest).distance);
  }
  return farthest;
}

/// What is painted on a surface: colour, and the place in the picture.
struct CornerLook {
  Eigen::Vector4d colour = Eigen::Vector4d::Constant(255);
  Eigen::Vector4d uv = Eigen::Vector4d::Zero();  ///< both places
};

CornerLook lookAt(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners, const Vec3& weights) {
  CornerLook paint;
  if (!mesh.colours.empty()) paint.colour.setZero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double w = weights[static_cast<Eigen::Index>(k)];
    if (!mesh.colours.empty()) {
      const auto& c = mesh.colours[corners[k]];
      paint.colour += w * Eigen::Vector4d(c[0], c[1], c[2], c[3]);
    }
    const auto addUv = [&](const auto& uvs, int first) {
      if (uvs.empty()) return;
      const auto& uv = uvs[corners[k]];
      paint.uv.segment<2>(first) += w * Eigen::Vector2d(double{uv[0]}, double{uv[1]});
    };
    addUv(mesh.uvs, 0);
    addUv(mesh.secondUvs, 2);
  }
  return paint;
}

/// Whether the simplified surface shows the same colours and the same part of the picture at the same places.
bool paintedAlike(const Mesh& mesh, std::span<const std::uint32_t> full, const NearestTriangle& simplified) {
  if (mesh.colours.empty() && mesh.uvs.empty() && mesh.secondUvs.empty()) return true;
  for (std::size_t i = 0; i + 2 < full.size(); i += 3) {
    const std::array<std::uint32_t, 3> corners{full[i], full[i + 1], full[i + 2]};
    for (const Vec3& w : kSamples) {
      const Vec3 p = w[0] * placeOf(mesh, corners[0]) + w[1] * placeOf(mesh, corners[1]) +
                     w[2] * placeOf(mesh, corners[2]);
      const auto there = simplified.nearest(p, 0);
      const CornerLook wanted = lookAt(mesh, corners, w), found = lookAt(mesh, there.corners, there.weights);
      if ((wanted.colour - found.colour).cwiseAbs().maxCoeff() > kColours) return false;
      if ((wanted.uv - found.uv).cwiseAbs().maxCoeff() > kPicture) return false;
    }
  }
  return true;
}

/// Triangles of one material that hang together, by the places of their corners.
struct MeshPiece {
  std::size_t submesh = 0;
  std::vector<std::uint32_t> indices;  ///< of the full surface
};

/// By vertex: one that is at the same place, the same for all of them.
std::vector<std::uint32_t> placesOf(const Mesh& mesh) {
  std::vector<std::uint32_t> number(mesh.positions.size()), first(mesh.positions.size(), ~0U);
  const meshopt_Stream positions{mesh.positions.data(), sizeof mesh.positions[0], sizeof mesh.positions[0]};
  meshopt_generateVertexRemapMulti(number.data(), mesh.indices.data(), mesh.indices.size(),
                                   mesh.positions.size(), &positions, 1);
  std::vector<std::uint32_t> place(mesh.positions.size(), 0);
  for (const std::uint32_t v : mesh.indices) {
    if (first[number[v]] == ~0U) first[number[v]] = v;
    place[v] = first[number[v]];
  }
  return place;
}

/// Union-find: maps each element to the representative of its group.
class Groups {
public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

private:
  std::vector<std::uint32_t> parent_;
};

std::vector<MeshPiece> piecesOf(const Mesh& mesh, const std::vector<std::uint32_t>& place) {
  Groups groups(mesh.positions.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    for (const std::size_t k : {i + 1, i + 2}) groups.join(place[mesh.indices[i]], place[mesh.indices[k]]);
  std::vector<MeshPiece> pieces;
  std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> known;
  for (std::size_t part = 0; part < mesh.submeshes.size(); ++part) {
    const Submesh& submesh = mesh.submeshes[part];
    for (std::size_t i = submesh.firstIndex; i < submesh.firstIndex + std::size_t{submesh.indexCount};
         i += 3) {
      const auto [at, isNew] = known.try_emplace({part, groups.of(place[mesh.indices[i]])}, pieces.size());
      if (isNew) pieces.push_back({part, {}});
      for (const std::size_t k : {i, i + 1, i + 2}) pieces[at->second].indices.push_back(mesh.indices[k]);
    }
  }
  return pieces;
}

/// Which of a piece's vertices are at a place.
using AtPlace = std::multimap<std::uint32_t, std::uint32_t>;

/// Returns the vertex at the corner's place with the normal nearest to the triangle's.
std::uint32_t vertexFor(const Mesh& mesh, const AtPlace& vertices, std::uint32_t place, const Vec3& normal) {
  const auto [first, last] = vertices.equal_range(place);
  std::uint32_t best = first->second;
  double most = -2;
  for (auto v = first; v != last; ++v) {
    const auto& n = mesh.normals[v->second];
    const double along = normal.dot(Vec3(double{n[0]}, double{n[1]}, double{n[2]}));
    if (along > most) {
      most = along;
      best = v->second;
    }
  }
  return best;
}

/// Where pictures lie on the surface their edges must stay; else edges of normals and colours may go as any
/// other, and each triangle takes the vertices that suit it best.
class Collapse {
public:
  Collapse(const Mesh& mesh, const std::vector<std::uint32_t>& places, const MeshPiece& piece)
      : mesh_(mesh), welded_(mesh.uvs.empty() && mesh.secondUvs.empty()) {
    for (const std::uint32_t v : piece.indices) {
      const std::uint32_t corner = welded_ ? places[v] : v;
      corners_.push_back(corner);
      if (welded_) atPlace_.insert({corner, v});
    }
    vertices_ = corners_;
    std::ranges::sort(vertices_);
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const std::uint32_t v : vertices_) positions_.push_back(mesh.positions[v]);
    for (std::uint32_t& c : corners_)
      c = static_cast<std::uint32_t>(std::ranges::lower_bound(vertices_, c) - vertices_.begin());
    scale_ = meshopt_simplifyScale(positions_.data()->data(), positions_.size(), sizeof positions_[0]);
  }

  /// As few triangles as an error of `target` [m] allows, by meshoptimizer's own measure.
  std::vector<std::uint32_t> to(double target) const {
    if (!(scale_ > 0)) return {};
    std::vector<std::uint32_t> fewer(corners_.size());
    fewer.resize(meshopt_simplify(fewer.data(), corners_.data(), corners_.size(), positions_.data()->data(),
                                  positions_.size(), sizeof positions_[0], 0,
                                  static_cast<float>(target / double{scale_}), 0, nullptr));
    for (std::uint32_t& v : fewer) v = vertices_[v];
    for (std::size_t i = 0; welded_ && i + 2 < fewer.size(); i += 3) {
      const Vec3 a = placeOf(mesh_, fewer[i]), b = placeOf(mesh_, fewer[i + 1]),
                 c = placeOf(mesh_, fewer[i + 2]);
      const Vec3 normal = (b - a).cross(c - a).stableNormalized();
      for (std::size_t k = i; k < i + 3; ++k) fewer[k] = vertexFor(mesh_, atPlace_, fewer[k], normal);
    }
    return fewer;
  }

private:
  const Mesh& mesh_;
  bool welded_;
  AtPlace atPlace_;
  std::vector<std::uint32_t> corners_, vertices_;  ///< corners: by place in `vertices_`
  std::vector<std::array<float, 3>> positions_;
  float scale_ = 0;
};

/// The piece with fewer triangles, nowhere farther off than `error` [m]; the piece itself if that cannot be.
/// meshoptimizer's measure is a mean: where it is not strict enough, less is asked of it.
std::vector<std::uint32_t> simplified(const Mesh& mesh, const MeshPiece& piece, const Collapse& collapse,
                                      double error, double& found) {
  for (const double strict : {1.0, 0.25, 0.0625}) {
    std::vector<std::uint32_t> fewer = collapse.to(strict * error);
    if (fewer.empty()) continue;
    if (fewer.size() == piece.indices.size()) break;
    const double off = surfaceDistance(mesh, piece.indices, fewer);
    if (off > error || !paintedAlike(mesh, piece.indices, NearestTriangle(mesh, fewer))) continue;
    found = std::max(found, off);
    return fewer;
  }
  return piece.indices;
}

/// All pieces, each as simple as the error allows.
MeshLevel levelOf(const Mesh& mesh, const std::vector<MeshPiece>& pieces,
                  const std::vector<Collapse>& collapses, double error) {
  std::vector<std::vector<std::uint32_t>> parts(mesh.submeshes.size());
  MeshLevel level;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const MeshPiece& piece = pieces[i];
    const std::vector<std::uint32_t> fewer = simplified(mesh, piece, collapses[i], error, level.error);
    parts[piece.submesh].insert(parts[piece.submesh].end(), fewer.begin(), fewer.end());
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const auto first = static_cast<std::uint32_t>(level.indices.size());
    level.indices.insert(level.indices.end(), parts[part].begin(), parts[part].end());
    level.submeshes.push_back(
        {first, static_cast<std::uint32_t>(parts[part].size()), mesh.submeshes[part].material});
  }
  return level;
}

}  // namespace

double surfaceDistance(const Mesh& mesh, const std::vector<std::uint32_t>& a,
                       const std::vector<std::uint32_t>& b) {
  if (a.empty() || b.empty()) return a.empty() == b.empty() ? 0 : std::numeric_limits<double>::infinity();
  const NearestTriangle ofA(mesh, a), ofB(mesh, b);
  return std::max(farthestFrom(mesh, a, ofB), farthestFrom(mesh, b, ofA));
}

void addLevels(Mesh& mesh, std::size_t count) {
  mesh.levels.clear();
  std::size_t before = mesh.indices.size();
  std::vector<MeshPiece> pieces;
  std::vector<Collapse> collapses;
  if (count > 0 && before > 3 * kFewTriangles) {
    const std::vector<std::uint32_t> places = placesOf(mesh);
    pieces = piecesOf(mesh, places);
    for (const MeshPiece& piece : pieces) collapses.emplace_back(mesh, places, piece);
  }
  const double size = 2 * mesh.sphere.radius;
  for (double error = size * kFinest; mesh.levels.size() < count && error < size * kCoarsest;
       error *= kStep) {
    if (pieces.empty() || before <= 3 * kFewTriangles) break;
    MeshLevel level = levelOf(mesh, pieces, collapses, error);
    if (static_cast<double>(level.indices.size()) > kWorthwhile * static_cast<double>(before)) continue;
    before = level.indices.size();
    mesh.levels.push_back(std::move(level));
  }
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;  // 2^64 by the golden ratio
  mesh.hash ^= kOdd * (mesh.levels.size() + 1);
}

}  // namespace stadion
