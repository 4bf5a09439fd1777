#include "engine/asset/import.h"
#include "engine/asset/mesh_checks.h"

namespace stadion {
namespace {

constexpr float kHalf = 0.25f;  // [m]

Texture checks() {
  Texture texture;
  texture.name = "stand-in";
  texture.width = texture.height = 64;
  for (std::uint32_t y = 0; y < texture.height; ++y) {
    for (std::uint32_t x = 0; x < texture.width; ++x) {
      const std::uint8_t c = (x / 16 + y / 16) % 2 == 0 ? 255 : 0;
      texture.rgba.insert(texture.rgba.end(), {c, 0, c, 255});
    }
  }
  return texture;
}

// One side, counter-clockwise seen from outside; u x v is its normal.
void addSide(Mesh& mesh, const Vec3& normal, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  constexpr float kCorners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const auto& c : kCorners) {
    const Vec3 p = kHalf * (normal + c[0] * u + c[1] * v + Vec3::UnitZ());
    mesh.positions.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    mesh.normals.push_back(
        {static_cast<float>(normal.x()), static_cast<float>(normal.y()), static_cast<float>(normal.z())});
    mesh.uvs.push_back({0.5f + 0.5f * c[0], 0.5f - 0.5f * c[1]});
  }
  for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

}  // namespace

std::unique_ptr<Mesh> standIn(const std::string& name) {
  auto mesh = std::make_unique<Mesh>();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 n = Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3), v = Vec3::Unit((axis + 2) % 3);
    addSide(*mesh, n, u, v);
    addSide(*mesh, -n, v, u);
  }
  Material material;
  material.name = "stand-in";
  material.baseColour = {1, 1, 1, 1};
  material.emissive = {0.25f, 0, 0.25f};  // seen in the dark, too
  material.maps[kBaseMap].texture = 0;
  mesh->materials = {material};
  mesh->textures = {checks()};
  mesh->submeshes = {{0, static_cast<std::uint32_t>(mesh->indices.size()), 0}};
  mesh->name = name;
  mesh->standIn = true;
  finish(*mesh);
  return mesh;
}

}  // namespace stadion
