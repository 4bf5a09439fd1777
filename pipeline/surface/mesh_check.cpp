#include "pipeline/surface/mesh_check.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace stadion {
namespace {

std::uint64_t stir(std::uint64_t x) {  // Steele et al. 2014, SplitMix's finaliser
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

std::uint64_t bits(float x) {
  return std::bit_cast<std::uint32_t>(x + 0.0f);
}  // -0 counts as +0

std::uint64_t placeOf(const std::array<float, 3>& p) {
  return stir(stir(bits(p[0]) | bits(p[1]) << 32) + bits(p[2]));
}

/// Of a figure, vertices with other joints lie elsewhere once it moves.
std::uint64_t placeOf(const Mesh& mesh, std::uint32_t vertex) {
  std::uint64_t place = placeOf(mesh.positions[vertex]);
  if (mesh.joints.empty()) return place;
  const VertexJoints& carried = mesh.joints[vertex];
  for (std::size_t k = 0; k < VertexJoints::kMost; ++k)
    place = stir(place + (std::uint64_t{carried.joint[k]} | bits(carried.weight[k]) << 32));
  return place;
}

std::uint64_t edge(std::uint64_t from, std::uint64_t to) {
  return stir(from + 3 * to);
}

}  // namespace

bool isClosed(const Mesh& mesh) {
  std::uint64_t balance = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint64_t a = placeOf(mesh, mesh.indices[i]);
    const std::uint64_t b = placeOf(mesh, mesh.indices[i + 1]);
    const std::uint64_t c = placeOf(mesh, mesh.indices[i + 2]);
    balance += edge(a, b) + edge(b, c) + edge(c, a) - edge(b, a) - edge(c, b) - edge(a, c);
  }
  return balance == 0 && !mesh.indices.empty();
}

std::string drawingFault(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  if (mesh.normals.size() != count) return "its normals do not match its vertices";
  if (!mesh.uvs.empty() && mesh.uvs.size() != count)
    return "its texture coordinates do not match its vertices";
  if (!mesh.secondUvs.empty() && mesh.secondUvs.size() != count)
    return "its second texture coordinates do not match its vertices";
  if (!mesh.tangents.empty() && mesh.tangents.size() != count)
    return "its tangents do not match its vertices";
  if (!mesh.colours.empty() && mesh.colours.size() != count) return "its colours do not match its vertices";
  for (const std::uint32_t index : mesh.indices)
    if (index >= count) return "a triangle names a vertex that is not there";
  for (const Submesh& part : mesh.submeshes) {
    if (std::uint64_t{part.firstIndex} + part.indexCount > mesh.indices.size())
      return "a part of it names triangles that are not there";
    if (part.material >= mesh.materials.size()) return "a part of it names a material that is not there";
  }
  const auto names = [&](const MaterialMap& map) {
    return map.texture >= static_cast<std::int64_t>(mesh.textures.size());
  };
  for (const Material& material : mesh.materials)
    if (std::ranges::any_of(material.maps, names)) return "a material names a texture that is not there";
  for (const Texture& texture : mesh.textures)
    if (texture.width == 0 || texture.height == 0 || texture.width > 8192 || texture.height > 8192 ||
        texture.rgba.size() != std::size_t{texture.width} * texture.height * 4)
      return "a texture's size does not match its pixels";
  return {};
}

}  // namespace stadion
