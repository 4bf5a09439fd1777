#include "engine/asset/mesh_checks.h"

#include "engine/figure/figure_bounds.h"
#include "engine/figure/figure_record.h"

#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

namespace stadion {
namespace {

Vec3 at(const Mesh& mesh, std::uint32_t vertex) {
  const auto& p = mesh.positions[vertex];
  return {p[0], p[1], p[2]};
}

class Hash {
public:
  Hash() : state_(XXH3_createState(), &XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  template <class T>
  void add(const std::vector<T>& v) {
    add(static_cast<std::uint64_t>(v.size()));
    XXH3_64bits_update(state_.get(), v.data(), v.size() * sizeof(T));
  }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    XXH3_64bits_update(state_.get(), text.data(), text.size());
  }
  void add(std::uint64_t n) { XXH3_64bits_update(state_.get(), &n, sizeof n); }
  void add(float f) { add(std::uint64_t{std::bit_cast<std::uint32_t>(f)}); }
  std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

void addMatrix(const Affine& X, Hash& hash) {
  for (int i = 0; i < 12; ++i) hash.add(std::bit_cast<std::uint64_t>(X.data()[i]));
}

/// Names are of clips and bones, which scripts name.
void addSkeleton(const Mesh& mesh, Hash& hash) {
  for (const VertexJoints& v : mesh.joints) {
    for (const std::uint16_t j : v.joint) hash.add(std::uint64_t{j});
    for (const float w : v.weight) hash.add(w);
  }
  for (const Bone& bone : mesh.skeleton->bones) {
    hash.add(bone.name);
    hash.add(static_cast<std::uint64_t>(bone.parent));
    addMatrix(bone.X_PB, hash);
  }
  for (const Joint& joint : mesh.skeleton->joints)
    hash.add(std::uint64_t{joint.bone}), addMatrix(joint.X_BN, hash);
  for (const Clip& clip : mesh.skeleton->clips) {
    hash.add(clip.name);
    for (const ClipChannel& c : clip.channels) {
      hash.add(std::uint64_t{c.bone} << 16 | std::uint64_t(c.target) << 8 | std::uint64_t(c.interpolation));
      hash.add(c.times);
      hash.add(c.values);
    }
  }
  for (const MorphWeight& w : mesh.skeleton->weights) hash.add(w.name), hash.add(w.rest);
  for (const Morph& m : mesh.morphs) {
    hash.add(std::uint64_t{19} << 32 | m.weight);
    hash.add(m.vertices);
    hash.add(m.positions);
    hash.add(m.normals);
  }
}

void addMap(const MaterialMap& map, std::uint64_t kind, Hash& hash) {
  const Sampler& s = map.sampler;
  hash.add(kind << 32);
  hash.add(static_cast<std::uint64_t>(map.texture));
  hash.add(std::uint64_t(s.wrapU) | std::uint64_t(s.wrapV) << 8 | std::uint64_t(s.mipmaps) << 16 |
           std::uint64_t{s.magnifiesNearest} << 24 | std::uint64_t{s.minifiesNearest} << 25 |
           std::uint64_t{map.secondUvs} << 26);
  for (const float f : map.uvTransform) hash.add(f);
}

/// Adds what a material has beyond colours and plain maps of base colour and emission. Other materials add
/// nothing, so that their meshes keep the hashes that they have always had.
void addFurther(const Material& m, Hash& hash) {
  for (std::size_t kind = 0; kind < kMapKinds; ++kind) {
    const MaterialMap& map = m.maps[kind];
    MaterialMap plain;
    plain.texture = map.texture;
    if (map.given() && (!holdsColours(kind) || map != plain)) addMap(map, 3 + kind, hash);
  }
  if (m.maps[kNormalMap].given()) hash.add(m.normalScale);
  if (m.maps[kOcclusionMap].given()) hash.add(m.occlusionStrength);
  if (m.unlit) hash.add(std::uint64_t{16} << 32);
}

/// With names, by which scripts find them.
void addLightsAndCameras(const Mesh& mesh, Hash& hash) {
  const auto addAll = [&](const auto& values) {
    for (const float f : values) hash.add(f);
  };
  for (const ModelLight& light : mesh.lights) {
    hash.add(std::uint64_t{20} << 32 | static_cast<std::uint64_t>(light.kind));
    hash.add(light.name);
    addAll(light.position), addAll(light.direction), addAll(light.colour);
    addAll(std::array{light.range, light.innerAngle, light.outerAngle});
  }
  for (const ModelCamera& camera : mesh.cameras) {
    hash.add(std::uint64_t{21} << 32);
    hash.add(camera.name);
    addAll(camera.position), addAll(camera.direction);
  }
}

// Other names are left out: the same shape under two names is one mesh.
std::uint64_t contentHash(const Mesh& mesh) {
  Hash hash;
  hash.add(mesh.positions);
  hash.add(mesh.normals);
  hash.add(mesh.uvs);
  hash.add(mesh.colours);
  if (!mesh.secondUvs.empty()) hash.add(std::uint64_t{17} << 32), hash.add(mesh.secondUvs);
  if (!mesh.tangents.empty()) hash.add(std::uint64_t{18} << 32), hash.add(mesh.tangents);
  hash.add(mesh.indices);
  for (const Submesh& s : mesh.submeshes) {
    hash.add(std::uint64_t{s.firstIndex});
    hash.add(std::uint64_t{s.indexCount});
    hash.add(std::uint64_t{s.material});
  }
  for (const Material& m : mesh.materials) {
    for (float c : m.baseColour) hash.add(c);
    for (float c : m.emissive) hash.add(c);
    hash.add(m.roughness);
    hash.add(m.metallic);
    hash.add(static_cast<std::uint64_t>(m.maps[kBaseMap].texture));
    hash.add(std::uint64_t{m.doubleSided});
    hash.add(std::uint64_t{m.partlyTransparent});
    // Only where there is such a thing: other meshes keep the hashes that they have always had.
    if (m.masked()) hash.add(std::uint64_t{1} << 32), hash.add(m.alphaCutoff);
    const MaterialMap& glow = m.maps[kEmissiveMap];
    if (glow.given()) hash.add(std::uint64_t{2} << 32), hash.add(static_cast<std::uint64_t>(glow.texture));
    addFurther(m, hash);
  }
  for (const Texture& t : mesh.textures) {
    hash.add(std::uint64_t{t.width});
    hash.add(std::uint64_t{t.height});
    hash.add(t.rgba);
  }
  hash.add(std::uint64_t{mesh.standIn});
  if (mesh.skeleton) addSkeleton(mesh, hash);
  addLightsAndCameras(mesh, hash);
  if (mesh.place.matrix() != Affine::Identity().matrix()) addMatrix(mesh.place, hash);
  if (mesh.environment) {
    hash.add(std::uint64_t{20} << 32 | mesh.environment->pictureSide);
    for (const Radiance& harmonic : mesh.environment->harmonics)
      for (const float c : harmonic) hash.add(c);
    hash.add(mesh.environment->texels);
  }
  return hash.value();
}

/// A figure is seen in any pose, so its bounds hold for all of them.
void boundFigure(Mesh& mesh) {
  auto skeleton = std::make_shared<Skeleton>(*mesh.skeleton);
  skeleton->reach = figureReach(*skeleton, mesh.positions, mesh.joints, mesh.morphs);
  skeleton->addedReach =
      figureReach(*skeleton, mesh.positions, mesh.joints, mesh.morphs, {.added = FigureRecord::kMostAdded});
  mesh.sphere = skeleton->reach;
  mesh.bounds = {};
  mesh.bounds.include(Vec3(mesh.sphere.centre - Vec3::Constant(mesh.sphere.radius)));
  mesh.bounds.include(Vec3(mesh.sphere.centre + Vec3::Constant(mesh.sphere.radius)));
  mesh.skeleton = std::move(skeleton);
}

}  // namespace

void finish(Mesh& mesh) {
  mesh.bounds = {};
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) mesh.bounds.include(at(mesh, v));
  mesh.sphere = {};
  if (!mesh.bounds.empty()) {
    mesh.sphere.centre = mesh.bounds.centre();
    double farthest = 0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
      farthest = std::max(farthest, (at(mesh, v) - mesh.sphere.centre).squaredNorm());
    mesh.sphere.radius = std::sqrt(farthest) * (1 + 1e-12);  // rounding must not leave a vertex outside
  }
  if (mesh.skeleton) boundFigure(mesh);
  mesh.hash = contentHash(mesh);
}

std::vector<std::uint32_t> weldPositions(const std::vector<std::array<float, 3>>& positions,
                                         const std::vector<VertexJoints>& joints) {
  const auto alike = [&](std::uint32_t a, std::uint32_t b) {
    return joints.empty() || (joints[a].joint == joints[b].joint && joints[a].weight == joints[b].weight);
  };
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (positions[a] != positions[b]) return positions[a] < positions[b];
    if (alike(a, b)) return a < b;
    return std::tie(joints[a].joint, joints[a].weight) < std::tie(joints[b].joint, joints[b].weight);
  });
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same =
        i > 0 && positions[order[i]] == positions[order[i - 1]] && alike(order[i], order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

bool closed(const Mesh& mesh) {
  if (mesh.indices.empty()) return false;
  const std::vector<std::uint32_t> weld = weldPositions(mesh.positions, mesh.joints);
  // Each edge as (low end, high end), with the direction in the lowest bit of the second word.
  std::vector<std::pair<std::uint32_t, std::uint64_t>> edges;
  edges.reserve(mesh.indices.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = weld[mesh.indices[i + k]], b = weld[mesh.indices[i + (k + 1) % 3]];
      if (a == b) continue;
      edges.emplace_back(std::min(a, b), std::uint64_t{std::max(a, b)} << 1 | (a < b ? 1 : 0));
    }
  }
  if (edges.empty()) return false;
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    const auto low = edges[i].first;
    const auto high = edges[i].second >> 1;
    std::ptrdiff_t balance = 0;
    for (; i < edges.size() && edges[i].first == low && edges[i].second >> 1 == high; ++i)
      balance += edges[i].second & 1 ? 1 : -1;
    if (balance != 0) return false;
  }
  return true;
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vec3 a = at(mesh, mesh.indices[i]);
    sum += 0.5 * (at(mesh, mesh.indices[i + 1]) - a).cross(at(mesh, mesh.indices[i + 2]) - a).norm();
  }
  return sum;
}

}  // namespace stadion
