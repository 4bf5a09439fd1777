#include "engine/asset/importer_program/mesh/geometry.h"

#include "engine/asset/mesh_checks.h"
#include "engine/maths/functions.h"
#include "engine/maths/srgb.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stadion::importer {
namespace {

constexpr double kFarthest = 1e7;  // [m] beyond that single precision has lost the metre

bool usable(const std::array<float, 3>& p) {
  return std::all_of(p.begin(), p.end(),
                     [](float c) { return std::abs(c) <= static_cast<float>(kFarthest); });
}

std::uint8_t byteOf(float c) {
  const float value = std::isfinite(c) ? std::clamp(c, 0.0f, 1.0f) : 1.0f;
  return static_cast<std::uint8_t>(std::lround(value * 255.0f));
}

std::uint8_t colourByte(float c, bool linear) {
  return byteOf(linear && c > 0 ? static_cast<float>(srgbFromLinear(double{c})) : c);
}

std::array<float, 3> turnedNormal(const Float3& n, const Mat3& cofactors) {
  const Vec3 turned = cofactors * Vec3(n[0], n[1], n[2]);
  const double length = turned.norm();
  if (!std::isfinite(length) || !(length > 1e-30)) return {0, 0, 0};
  const Vec3 unit = turned / length;
  return {static_cast<float>(unit.x()), static_cast<float>(unit.y()), static_cast<float>(unit.z())};
}

/// A tangent that is no direction is left to the texture coordinates.
std::array<float, 4> turnedTangent(const Float4& t, const Mat3& by) {
  const Vec3 turned = by * Vec3(t[0], t[1], t[2]);
  const double length = turned.norm();
  if (!std::isfinite(length) || !(length > 1e-30)) return {0, 0, 0, 1};
  const bool mirrors = by.determinant() < 0;
  const float side = (t[3] < 0) != mirrors ? -1.0f : 1.0f;
  return {static_cast<float>(turned.x() / length), static_cast<float>(turned.y() / length),
          static_cast<float>(turned.z() / length), side};
}

// Turns normals, without dividing by the determinant.
Mat3 cofactorsOf(const Mat3& m) {
  Mat3 cofactors;
  for (int c = 0; c < 3; ++c) cofactors.col(c) = m.col((c + 1) % 3).cross(m.col((c + 2) % 3));
  return m.determinant() < 0 ? Mat3(-cofactors) : cofactors;
}

// From v counted from the bottom of the picture to v counted from the top, as the rows lie.
class UvMap {
public:
  explicit UvMap(const UvTransform& t) : t_(t), identity_(t == UvTransform{}) {
    cos_ = det::cos(double{t.rotation});
    sin_ = det::sin(double{t.rotation});
  }

  Float2 operator()(const Float2& from) const {
    if (!isUsable(from)) return {0, 0};
    const Float2 top{from[0], 1.0f - from[1]};
    if (identity_) return top;
    const double u = double{t_.scale[0]} * double{top[0]}, v = double{t_.scale[1]} * double{top[1]};
    const Float2 to{static_cast<float>(cos_ * u + sin_ * v + double{t_.offset[0]}),
                    static_cast<float>(cos_ * v - sin_ * u + double{t_.offset[1]})};
    return isUsable(to) ? to : Float2{0, 0};
  }

private:
  static bool isUsable(const Float2& uv) { return std::abs(uv[0]) < 1e6f && std::abs(uv[1]) < 1e6f; }
  UvTransform t_;
  bool identity_;
  double cos_ = 1, sin_ = 0;
};

/// Where one primitive's maps take their coordinates from.
struct PrimitiveUvs {
  const std::vector<Float2>*first, *second;  ///< second: null if no map reads it
  UvMap firstMap, secondMap;
};

const SourceMaterial* materialOf(const SourceScene& scene, const SourcePrimitive& part) {
  return part.material < scene.materials.size() ? &scene.materials[part.material] : nullptr;
}

/// Maps that agree have their transform in the coordinates. A set that the primitive lacks is the first one.
PrimitiveUvs uvsOf(const SourcePrimitive& part, const SourceMaterial* material) {
  const auto set = [&](std::uint32_t number) { return &part.uvs[part.uvs[number].empty() ? 0 : number]; };
  const std::optional<UvSource> common = material ? commonUvSource(*material) : UvSource{};
  if (common) return {set(common->set), nullptr, UvMap(common->transform), UvMap(UvTransform{})};
  const auto maps = drawnMaps(*material);
  const bool second = std::ranges::any_of(maps, [](auto map) { return map && uvSourceOf(*map).set == 1; });
  return {set(0), second ? set(1) : nullptr, UvMap(UvTransform{}), UvMap(UvTransform{})};
}

class Flattener {
public:
  Flattener(const SourceScene& scene, const FigureJoints* joints, const NodeChoice* choice,
            const FlattenLimits& limits)
      : scene_(scene), joints_(joints), choice_(choice), limits_(limits) {
    flat.hasJoints = joints != nullptr;
  }

  void visit(std::uint32_t index, const Affine& X_parent, std::uint32_t depth) {
    if (depth > limits_.nodeDepth)
      throw Refusal("nests its nodes deeper than " + std::to_string(limits_.nodeDepth));
    const SourceNode& node = scene_.nodes[index];
    const Affine X = X_parent * node.X_PN;
    for (const std::uint32_t mesh : node.meshes)
      for (const SourcePrimitive& primitive : scene_.meshes[mesh].primitives) {
        const std::size_t first = flat.vertices.size();
        const std::int32_t skin = joints_ ? joints_->skinOf(index, mesh) : -1;
        const Shape shape = restOf(primitive, node, scene_.meshes[mesh]);
        append(primitive, shape, joints_ ? scene_.toShow : X, skin < 0 && X.linear().determinant() < 0);
        if (!joints_) continue;
        takeJoints(primitive, index, skin, first);
        takeMorphs(primitive, index, first);
      }
    for (const std::uint32_t child : node.children)
      if (!choice_ || !choice_->isLeftOut(child)) visit(child, X, depth + 1);
  }

  Flat flat;

private:
  /// Positions and normals of a primitive.
  struct Shape {
    const std::vector<Float3>&positions, &normals;
  };

  /// An object stands in the shape that its morph targets give it at rest. A figure morphs as it is drawn.
  Shape restOf(const SourcePrimitive& part, const SourceNode& node, const SourceMesh& mesh) {
    const auto weightOf = [&](std::size_t k) { return joints_ ? 0 : weightAtRest(node, mesh, k); };
    bool morphs = false;
    for (std::size_t k = 0; k < part.targets.size(); ++k) morphs = morphs || weightOf(k) != 0;
    if (!morphs) return {part.positions, part.normals};
    positions_ = part.positions;
    normals_ = part.normals;
    for (std::size_t k = 0; k < part.targets.size(); ++k) {
      addTo(positions_, part.targets[k].positions, weightOf(k));
      addTo(normals_, part.targets[k].normals, weightOf(k));
    }
    return {positions_, normals_};
  }

  static void addTo(std::vector<Float3>& values, const std::vector<Float3>& differences, float weight) {
    for (std::size_t i = 0; i < std::min(values.size(), differences.size()); ++i)
      for (std::size_t c = 0; c < 3; ++c) values[i][c] += weight * differences[i][c];
  }

  void takeMorphs(const SourcePrimitive& part, std::uint32_t node, std::size_t first) {
    const std::int32_t weight = joints_->firstWeight(node);
    if (weight < 0 || part.targets.empty()) return;
    const std::uint32_t number = morphed_ + 1;
    for (std::size_t i = first; i < flat.vertices.size(); ++i) flat.vertices[i].morph = ++morphed_;
    for (std::size_t k = 0; k < part.targets.size(); ++k) {
      const MorphTarget& target = part.targets[k];
      const std::size_t count = flat.vertices.size() - first;
      if (target.positions.size() != count && target.normals.size() != count) continue;
      if ((morphs_ += count) > limits_.mesh.morphedVertices)
        throw Refusal("has morph targets of more than " + std::to_string(limits_.mesh.morphedVertices) +
                      " vertices together");
      FlatMorph morph{static_cast<std::uint32_t>(weight) + static_cast<std::uint32_t>(k), number, {}, {}};
      const Mat3 turn = scene_.toShow.linear();
      morph.positions.resize(count);
      for (std::size_t i = 0; i < target.positions.size() && i < count; ++i)
        morph.positions[i] = difference(target.positions[i], turn);
      const bool normals = scene_.keepNormals && target.normals.size() == count;
      const double scale = turn.col(0).norm();
      for (std::size_t i = 0; normals && i < target.normals.size(); ++i)
        morph.normals.push_back(difference(target.normals[i], turn / scale));
      flat.morphs.push_back(std::move(morph));
    }
  }

  static std::array<float, 3> difference(const Float3& d, const Mat3& by) {
    const Vec3 turned = by * Vec3(d[0], d[1], d[2]);
    if (!(turned.norm() < kFarthest)) return {0, 0, 0};
    return {static_cast<float>(turned.x()), static_cast<float>(turned.y()), static_cast<float>(turned.z())};
  }

  void append(const SourcePrimitive& part, const Shape& shape, const Affine& X, bool mirrored) {
    if (part.triangles.empty()) return;
    if (flat.vertices.size() + part.positions.size() > limits_.mesh.vertices)
      throw Refusal("has more than " + std::to_string(limits_.mesh.vertices) + " vertices");
    if (flat.triangles.size() + part.triangles.size() > limits_.mesh.triangles)
      throw Refusal("has more than " + std::to_string(limits_.mesh.triangles) + " triangles");
    const auto first = static_cast<std::uint32_t>(flat.vertices.size());
    appendVertices(part, shape, X);
    for (std::array<std::uint32_t, 3> corner : part.triangles) {
      for (std::uint32_t& c : corner) c += first;
      flat.triangles.push_back({corner, part.material, mirrored});
    }
  }

  void takeJoints(const SourcePrimitive& part, std::uint32_t node, std::int32_t skin, std::size_t first) {
    for (std::size_t i = first; i < flat.vertices.size(); ++i)
      flat.vertices[i].joints = joints_->of(part, i - first, node, skin);
  }

  void appendVertices(const SourcePrimitive& part, const Shape& shape, const Affine& X) {
    const Mat3 cofactors = cofactorsOf(X.linear());
    const SourceMaterial* material = materialOf(scene_, part);
    const PrimitiveUvs uvs = uvsOf(part, material);
    const bool normals = scene_.keepNormals && !part.normals.empty();
    const bool second = uvs.second && !uvs.second->empty();
    const bool tangents =
        normals && !part.tangents.empty() && material && drawnMaps(*material)[kNormalMap] != nullptr;
    flat.hasUvs |= !uvs.first->empty();
    flat.hasSecondUvs |= second;
    flat.hasTangents |= tangents;
    flat.hasColours |= !part.colours.empty();
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
      FlatVertex v;
      const Float3& at = shape.positions[i];
      const Vec3 p = X * Vec3(at[0], at[1], at[2]);
      for (int k = 0; k < 3; ++k) v.position[k] = static_cast<float>(p[k]) + 0.0f;  // + 0 makes -0 equal to 0
      if (normals) v.normal = turnedNormal(shape.normals[i], cofactors);
      if (!uvs.first->empty()) v.uv = uvs.firstMap((*uvs.first)[i]);
      if (second) v.secondUv = uvs.secondMap((*uvs.second)[i]);
      if (tangents) v.tangent = turnedTangent(part.tangents[i], X.linear());
      if (!part.colours.empty()) v.colour = colour(part.colours[i]);
      flat.vertices.push_back(v);
    }
  }

  std::array<std::uint8_t, 4> colour(const Float4& c) const {
    const bool linear = scene_.linearColours;
    return {colourByte(c[0], linear), colourByte(c[1], linear), colourByte(c[2], linear), byteOf(c[3])};
  }

  const SourceScene& scene_;
  const FigureJoints* joints_;  ///< null: of an object
  const NodeChoice* choice_;    ///< null: of a figure, all nodes
  const FlattenLimits& limits_;
  std::uint32_t morphed_ = 0;                ///< vertices that morph targets move
  std::uint64_t morphs_ = 0;                 ///< the same, once for each target
  std::vector<Float3> positions_, normals_;  ///< restOf()'s answer
};

enum class Fault { None, NotFinite, Collapsed, Sliver };

Vec3 vec(const std::array<float, 3>& p) {
  return {p[0], p[1], p[2]};
}

Fault faultOf(const Flat& flat, const FlatTriangle& t) {
  const auto& a = flat.vertices[t.corner[0]].position;
  const auto& b = flat.vertices[t.corner[1]].position;
  const auto& c = flat.vertices[t.corner[2]].position;
  if (!usable(a) || !usable(b) || !usable(c)) return Fault::NotFinite;
  // A morph target may open it.
  if (std::ranges::any_of(t.corner, [&](std::uint32_t i) { return flat.vertices[i].morph != 0; }))
    return Fault::None;
  if (a == b || b == c || c == a) return Fault::Collapsed;
  const Vec3 ab = vec(b) - vec(a), ac = vec(c) - vec(a);
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ab - ac).squaredNorm()});
  return ab.cross(ac).norm() > 1e-7 * longest ? Fault::None : Fault::Sliver;
}

bool closedSurface(const Flat& flat, const std::vector<Fault>& faults) {
  Mesh shape;
  for (const FlatVertex& v : flat.vertices) shape.positions.push_back(v.position);
  for (std::size_t i = 0; i < flat.triangles.size(); ++i)
    if (faults[i] == Fault::None || faults[i] == Fault::Sliver)
      shape.indices.insert(shape.indices.end(), flat.triangles[i].corner.begin(),
                           flat.triangles[i].corner.end());
  return closed(shape);
}

}  // namespace

Flat flatten(const SourceScene& scene, const NodeChoice& choice, const FlattenLimits& limits) {
  Flattener flattener(scene, nullptr, &choice, limits);
  for (const std::uint32_t root : choice.roots())
    if (!choice.isLeftOut(root)) flattener.visit(root, choice.above(root), 0);
  turnMirrored(flattener.flat);
  return std::move(flattener.flat);
}

Flat flattenFigure(const SourceScene& scene, const FigureJoints& joints, const FlattenLimits& limits) {
  Flattener flattener(scene, &joints, nullptr, limits);
  for (const std::uint32_t root : scene.roots) flattener.visit(root, scene.toShow, 0);
  return std::move(flattener.flat);
}

void turnMirrored(Flat& flat) {
  for (FlatTriangle& t : flat.triangles)
    if (std::exchange(t.mirrored, false)) std::swap(t.corner[1], t.corner[2]);
}

DroppedTriangles dropBadTriangles(Flat& flat) {
  DroppedTriangles dropped;
  std::vector<Fault> faults;
  bool slivers = false, notFinite = false;
  for (const FlatTriangle& t : flat.triangles) {
    faults.push_back(faultOf(flat, t));
    slivers |= faults.back() == Fault::Sliver;
    notFinite |= faults.back() == Fault::NotFinite;
  }
  const bool keepSlivers = slivers && !notFinite && closedSurface(flat, faults);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < flat.triangles.size(); ++i) {
    dropped.notFinite += faults[i] == Fault::NotFinite;
    const bool keep = faults[i] == Fault::None || (faults[i] == Fault::Sliver && keepSlivers);
    dropped.degenerate += !keep && faults[i] != Fault::NotFinite;
    if (keep) flat.triangles[kept++] = flat.triangles[i];
  }
  flat.triangles.resize(kept);
  return dropped;
}

}  // namespace stadion::importer
