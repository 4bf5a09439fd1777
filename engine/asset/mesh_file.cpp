#include "engine/asset/mesh_file.h"

#include "engine/asset/skeleton_file.h"
#include "engine/base/value_reader.h"
#include "engine/base/value_writer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <type_traits>

namespace stadion {
namespace {

constexpr std::uint32_t kMagic = 0x4d445453;  // "STDM"
constexpr std::uint32_t kVersion = 7;

struct Head {
  std::uint32_t magic, version;
  std::uint32_t vertices, indices, submeshes, materials, textures;
  std::uint32_t hasUvs, hasSecondUvs, hasTangents, hasColours, hasSkeleton, morphs, lights, cameras,
      hasEnvironment;
  double place[12];  ///< columns
};

struct MapRecord {
  float uvTransform[6];
  std::int32_t texture;
  std::uint8_t wrapU, wrapV, mipmaps, magnifiesNearest, minifiesNearest, secondUvs, unused[2];
};

struct MaterialRecord {
  float baseColour[4], emissive[3], roughness, metallic, alphaCutoff, normalScale, occlusionStrength;
  MapRecord maps[kMapKinds];
  std::uint32_t doubleSided, partlyTransparent, unlit;
};

template <std::size_t N>
bool finite(const std::vector<std::array<float, N>>& values) {
  for (const auto& v : values)
    for (float c : v)
      if (!std::isfinite(c)) return false;
  return true;
}

bool unitLength(const std::vector<std::array<float, 3>>& normals) {
  for (const auto& n : normals) {
    const float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (!(square > 0.99f && square < 1.01f)) return false;
  }
  return true;
}

bool within(float value, float low, float high) {
  return value >= low && value <= high;
}

MapRecord recordOf(const MaterialMap& map) {
  MapRecord r{};
  std::ranges::copy(map.uvTransform, r.uvTransform);
  r.texture = map.texture;
  r.wrapU = static_cast<std::uint8_t>(map.sampler.wrapU);
  r.wrapV = static_cast<std::uint8_t>(map.sampler.wrapV);
  r.mipmaps = static_cast<std::uint8_t>(map.sampler.mipmaps);
  r.magnifiesNearest = map.sampler.magnifiesNearest;
  r.minifiesNearest = map.sampler.minifiesNearest;
  r.secondUvs = map.secondUvs;
  return r;
}

bool toMap(const MapRecord& r, std::size_t textures, MaterialMap& map) {
  constexpr auto kLastWrap = static_cast<std::uint8_t>(WrapMode::Clamp);
  if (r.texture < -1 || r.texture >= static_cast<std::int64_t>(textures)) return false;
  if (r.wrapU > kLastWrap || r.wrapV > kLastWrap || r.mipmaps > static_cast<std::uint8_t>(MipmapUse::None))
    return false;
  for (const float f : r.uvTransform)
    if (!within(f, -1e9f, 1e9f)) return false;
  std::ranges::copy(r.uvTransform, map.uvTransform.begin());
  map.texture = r.texture;
  map.sampler = {static_cast<WrapMode>(r.wrapU), static_cast<WrapMode>(r.wrapV), r.magnifiesNearest != 0,
                 r.minifiesNearest != 0, static_cast<MipmapUse>(r.mipmaps)};
  map.secondUvs = r.secondUvs != 0;
  return true;
}

bool toMaterial(const MaterialRecord& r, std::size_t textures, Material& m) {
  for (int k = 0; k < 4; ++k) {
    if (!within(r.baseColour[k], 0, 1)) return false;
    m.baseColour[k] = r.baseColour[k];
  }
  for (int k = 0; k < 3; ++k) {
    if (!within(r.emissive[k], 0, 1000)) return false;
    m.emissive[k] = r.emissive[k];
  }
  if (!within(r.roughness, 0, 1) || !within(r.metallic, 0, 1) || !within(r.alphaCutoff, 0, kMostAlphaCutoff))
    return false;
  if (!within(r.normalScale, -kMostNormalScale, kMostNormalScale) || !within(r.occlusionStrength, 0, 1))
    return false;
  for (std::size_t kind = 0; kind < kMapKinds; ++kind)
    if (!toMap(r.maps[kind], textures, m.maps[kind])) return false;
  m.roughness = r.roughness;
  m.metallic = r.metallic;
  m.alphaCutoff = r.alphaCutoff;
  m.normalScale = r.normalScale;
  m.occlusionStrength = r.occlusionStrength;
  m.doubleSided = r.doubleSided != 0;
  m.partlyTransparent = r.partlyTransparent != 0;
  m.unlit = r.unlit != 0;
  return true;
}

MaterialRecord recordOf(const Material& m) {
  MaterialRecord r{};
  std::ranges::copy(m.baseColour, r.baseColour);
  std::ranges::copy(m.emissive, r.emissive);
  r.roughness = m.roughness;
  r.metallic = m.metallic;
  r.alphaCutoff = m.alphaCutoff;
  r.normalScale = m.normalScale;
  r.occlusionStrength = m.occlusionStrength;
  std::ranges::transform(m.maps, r.maps, [](const MaterialMap& map) { return recordOf(map); });
  r.doubleSided = m.doubleSided;
  r.partlyTransparent = m.partlyTransparent;
  r.unlit = m.unlit;
  return r;
}

bool readMaterials(ValueReader& in, const Head& head, Mesh& mesh) {
  for (std::uint32_t i = 0; i < head.materials; ++i) {
    MaterialRecord record{};
    Material material;
    if (!in.get(record) || !getName(in, material.name) || !toMaterial(record, head.textures, material))
      return false;
    mesh.materials.push_back(std::move(material));
  }
  return true;
}

bool readTextures(ValueReader& in, const Head& head, const MeshLimits& limits, Mesh& mesh) {
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < head.textures; ++i) {
    Texture t;
    if (!in.get(t.width) || !in.get(t.height) || !getName(in, t.name)) return false;
    if (t.width == 0 || t.height == 0 || t.width > limits.textureSide || t.height > limits.textureSide)
      return false;
    const std::uint64_t size = std::uint64_t{t.width} * t.height * 4;
    if ((total += size) > limits.textureBytes || !in.get(t.rgba, size)) return false;
    mesh.textures.push_back(std::move(t));
  }
  return true;
}

bool readGeometry(ValueReader& in, const Head& head, Mesh& mesh) {
  return in.get(mesh.positions, head.vertices) && in.get(mesh.normals, head.vertices) &&
         in.get(mesh.uvs, head.hasUvs ? head.vertices : 0) &&
         in.get(mesh.secondUvs, head.hasSecondUvs ? head.vertices : 0) &&
         in.get(mesh.tangents, head.hasTangents ? head.vertices : 0) &&
         in.get(mesh.colours, head.hasColours ? head.vertices : 0) &&
         in.get(mesh.joints, head.hasSkeleton ? head.vertices : 0) && in.get(mesh.indices, head.indices) &&
         in.get(mesh.submeshes, head.submeshes);
}

struct MorphRecord {
  std::uint32_t weight, vertices, hasNormals, unused;
};

bool readMorphs(ValueReader& in, const Head& head, const MeshLimits& limits, const Skeleton& skeleton,
                std::vector<Morph>& morphs) {
  std::uint64_t left = limits.morphedVertices;
  for (std::uint32_t i = 0; i < head.morphs; ++i) {
    MorphRecord r{};
    Morph& m = morphs.emplace_back();
    if (!in.get(r) || r.weight >= skeleton.weights.size() || r.vertices > left) return false;
    left -= r.vertices;
    m.weight = r.weight;
    if (!in.get(m.vertices, r.vertices) || !in.get(m.positions, r.vertices) ||
        !in.get(m.normals, r.hasNormals ? r.vertices : 0))
      return false;
    const bool ascend = std::ranges::adjacent_find(m.vertices, std::greater_equal<>()) == m.vertices.end();
    if (!ascend || (!m.vertices.empty() && m.vertices.back() >= head.vertices)) return false;
    if (!finite(m.positions) || !finite(m.normals)) return false;
  }
  return true;
}

bool readFigure(ValueReader& in, const Head& head, const MeshLimits& limits, Mesh& mesh) {
  if (!head.hasSkeleton) return true;
  auto skeleton = readSkeleton(in, limits.skeleton);
  if (!skeleton) return false;
  for (const VertexJoints& v : mesh.joints) {
    float sum = 0;
    for (const float weight : v.weight) {
      if (!within(weight, 0, 1)) return false;
      sum += weight;
    }
    if (!within(sum, 0.999f, 1.001f)) return false;
    for (const std::uint16_t joint : v.joint)
      if (joint >= skeleton->joints.size()) return false;
  }
  if (!readMorphs(in, head, limits, *skeleton, mesh.morphs)) return false;
  mesh.skeleton = std::make_shared<const Skeleton>(std::move(*skeleton));
  return true;
}

struct ModelLightRecord {
  std::uint32_t kind;
  float position[3], direction[3], colour[3], range, innerAngle, outerAngle;
};

struct ModelCameraRecord {
  float position[3], direction[3];
};

bool isPlace(const std::array<float, 3>& position, const std::array<float, 3>& direction) {
  constexpr float kFarthest = 1e8f;  // [m]
  const float square =
      direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
  return within(square, 0.99f, 1.01f) &&
         std::ranges::all_of(position, [](float c) { return within(c, -kFarthest, kFarthest); });
}

bool isLight(const ModelLight& light) {
  constexpr float kMostAngle = 1.6f;  // a right angle, and rounding
  return isPlace(light.position, light.direction) &&
         std::ranges::all_of(light.colour, [](float c) { return within(c, 0, 1e9f); }) &&
         within(light.range, 0, 1e9f) && within(light.outerAngle, 0, kMostAngle) &&
         within(light.innerAngle, 0, light.outerAngle);
}

bool readLights(ValueReader& in, const Head& head, Mesh& mesh) {
  for (std::uint32_t i = 0; i < head.lights; ++i) {
    ModelLightRecord r{};
    ModelLight& light = mesh.lights.emplace_back();
    if (!in.get(r) || !getName(in, light.name) || r.kind > static_cast<std::uint32_t>(ModelLight::Kind::Spot))
      return false;
    light.kind = static_cast<ModelLight::Kind>(r.kind);
    std::ranges::copy(r.position, light.position.begin());
    std::ranges::copy(r.direction, light.direction.begin());
    std::ranges::copy(r.colour, light.colour.begin());
    light.range = r.range, light.innerAngle = r.innerAngle, light.outerAngle = r.outerAngle;
    if (!isLight(light)) return false;
  }
  return true;
}

bool readCameras(ValueReader& in, const Head& head, Mesh& mesh) {
  for (std::uint32_t i = 0; i < head.cameras; ++i) {
    ModelCameraRecord r{};
    ModelCamera& camera = mesh.cameras.emplace_back();
    if (!in.get(r) || !getName(in, camera.name)) return false;
    std::ranges::copy(r.position, camera.position.begin());
    std::ranges::copy(r.direction, camera.direction.begin());
    if (!isPlace(camera.position, camera.direction)) return false;
  }
  return true;
}

void putLightsAndCameras(const Mesh& mesh, ValueWriter& out) {
  for (const ModelLight& light : mesh.lights) {
    ModelLightRecord r{};
    r.kind = static_cast<std::uint32_t>(light.kind);
    std::ranges::copy(light.position, r.position);
    std::ranges::copy(light.direction, r.direction);
    std::ranges::copy(light.colour, r.colour);
    r.range = light.range, r.innerAngle = light.innerAngle, r.outerAngle = light.outerAngle;
    out.put(r);
    putName(out, light.name);
  }
  for (const ModelCamera& camera : mesh.cameras) {
    ModelCameraRecord r{};
    std::ranges::copy(camera.position, r.position);
    std::ranges::copy(camera.direction, r.direction);
    out.put(r);
    putName(out, camera.name);
  }
}

bool readEnvironment(ValueReader& in, const Head& head, Mesh& mesh) {
  if (!head.hasEnvironment) return true;
  auto light = std::make_shared<EnvironmentLight>();
  if (!in.get(light->harmonics) || !in.get(light->pictureSide)) return false;
  if (light->pictureSide > EnvironmentLight::kMostPicture) return false;
  if (!in.get(light->texels, EnvironmentLight::sizeWith(light->pictureSide)) || !light->isSound())
    return false;
  mesh.environment = std::move(light);
  return true;
}

// The submeshes cover the indices in order, without gap or overlap.
const char* faultOf(const Mesh& mesh) {
  if (!finite(mesh.positions) || !finite(mesh.uvs) || !finite(mesh.secondUvs) || !finite(mesh.tangents))
    return "a number that is not finite";
  if (!unitLength(mesh.normals)) return "a normal that is not of unit length";
  for (std::uint32_t index : mesh.indices)
    if (index >= mesh.positions.size()) return "an index out of range";
  std::uint64_t next = 0;
  for (const Submesh& s : mesh.submeshes) {
    if (s.firstIndex != next || s.indexCount % 3 != 0 || s.material >= mesh.materials.size())
      return "a wrong run of triangles";
    next += s.indexCount;
  }
  if (next != mesh.indices.size()) return "a wrong run of triangles";
  return nullptr;
}

/// A rotation and a translation.
bool readPlace(const Head& head, Mesh& mesh) {
  std::copy(std::begin(head.place), std::end(head.place), mesh.place.data());
  const Mat3 turn = mesh.place.linear();
  return mesh.place.matrix().allFinite() && (turn.transpose() * turn - Mat3::Identity()).norm() < 1e-6 &&
         turn.determinant() > 0;
}

Head headOf(const Mesh& mesh) {
  const auto count = [](const auto& v) { return static_cast<std::uint32_t>(v.size()); };
  Head head{kMagic,
            kVersion,
            count(mesh.positions),
            count(mesh.indices),
            count(mesh.submeshes),
            count(mesh.materials),
            count(mesh.textures),
            !mesh.uvs.empty(),
            !mesh.secondUvs.empty(),
            !mesh.tangents.empty(),
            !mesh.colours.empty(),
            mesh.skeleton != nullptr,
            count(mesh.morphs),
            count(mesh.lights),
            count(mesh.cameras),
            mesh.environment != nullptr,
            {}};
  std::copy_n(mesh.place.data(), 12, head.place);
  return head;
}

}  // namespace

std::vector<std::uint8_t> encode(const Mesh& mesh) {
  ValueWriter out;
  out.put(headOf(mesh));
  out.put(mesh.positions);
  out.put(mesh.normals);
  out.put(mesh.uvs);
  out.put(mesh.secondUvs);
  out.put(mesh.tangents);
  out.put(mesh.colours);
  if (mesh.skeleton) out.put(mesh.joints);
  out.put(mesh.indices);
  out.put(mesh.submeshes);
  for (const Material& m : mesh.materials) {
    out.put(recordOf(m));
    putName(out, m.name);
  }
  for (const Texture& t : mesh.textures) {
    out.put(t.width);
    out.put(t.height);
    putName(out, t.name);
    out.put(t.rgba);
  }
  if (mesh.skeleton) {
    writeSkeleton(*mesh.skeleton, out);
    for (const Morph& m : mesh.morphs) {
      out.put(MorphRecord{m.weight, static_cast<std::uint32_t>(m.vertices.size()), !m.normals.empty(), 0});
      out.put(m.vertices);
      out.put(m.positions);
      out.put(m.normals);
    }
  }
  putLightsAndCameras(mesh, out);
  if (mesh.environment) {
    out.put(mesh.environment->harmonics);
    out.put(mesh.environment->pictureSide);
    out.put(mesh.environment->texels);
  }
  return std::move(out.bytes);
}

Result<std::unique_ptr<Mesh>> decode(std::span<const std::uint8_t> bytes, const MeshLimits& limits) {
  using Decoded = Result<std::unique_ptr<Mesh>>;
  ValueReader in(std::as_bytes(bytes));
  Head head{};
  if (!in.get(head) || head.magic != kMagic || head.version != kVersion)
    return Decoded::failure("not a mesh of this version");
  if (head.vertices > limits.vertices || head.indices / 3 > limits.triangles || head.indices % 3 != 0 ||
      head.materials > limits.materials || head.materials == 0 || head.textures > limits.textures ||
      head.submeshes > limits.materials || head.morphs > limits.morphs || head.lights > limits.lights ||
      head.cameras > limits.cameras || (head.morphs && !head.hasSkeleton))
    return Decoded::failure("a mesh beyond the limits");
  auto mesh = std::make_unique<Mesh>();
  if (!readGeometry(in, head, *mesh) || !readMaterials(in, head, *mesh) ||
      !readTextures(in, head, limits, *mesh) || !readFigure(in, head, limits, *mesh) ||
      !readPlace(head, *mesh) || !readLights(in, head, *mesh) || !readCameras(in, head, *mesh) ||
      !readEnvironment(in, head, *mesh) || !in.atEnd())
    return Decoded::failure("a mesh that is cut short or has a bad material, texture, skeleton, place, "
                            "light, camera or environment");
  if (const char* fault = faultOf(*mesh)) return Decoded::failure(std::string("a mesh with ") + fault);
  return mesh;
}

}  // namespace stadion
