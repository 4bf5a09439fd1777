#include "bench/walls/wall_scene.h"

#include "engine/maths/angles.h"

#include <cmath>

namespace stadion::bench {
namespace {

/// Steele, Lea and Flood 2014.
class SplitMix64 {
public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  double next() {  // 0 to 1
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
  }

private:
  std::uint64_t state_;
};

std::uint8_t byteOf(double c) {
  return static_cast<std::uint8_t>(std::floor(255 * c + 0.5));
}

std::array<std::uint8_t, 3> colourOf(std::uint32_t mesh, double theta, double phi) {
  return {byteOf(0.5 + 0.5 * std::sin(0.7 * mesh)), byteOf(0.5 + 0.5 * std::sin(0.7 * mesh + 2 + phi)),
          byteOf(0.5 + 0.5 * std::sin(0.7 * mesh + 4 + theta))};
}

WallMesh lumpySphere(std::uint32_t number) {
  constexpr std::uint32_t kSlices = 10, kStacks = 6;
  WallMesh mesh;
  for (std::uint32_t j = 0; j <= kStacks; ++j)
    for (std::uint32_t i = 0; i <= kSlices; ++i) {
      const double theta = 2 * kPi * i / kSlices, phi = kPi * j / kStacks;
      const std::array<double, 3> d{std::sin(phi) * std::cos(theta), std::cos(phi),
                                    std::sin(phi) * std::sin(theta)};
      const double r = 0.8 * (1 + 0.25 * std::sin((number % 4 + 1) * theta) * std::sin(phi));
      mesh.vertices.push_back({{d[0] * r, d[1] * r, d[2] * r}, d, colourOf(number, theta, phi)});
    }
  for (std::uint32_t j = 0; j < kStacks; ++j)
    for (std::uint32_t i = 0; i < kSlices; ++i) {
      const std::uint32_t a = (kSlices + 1) * j + i, b = a + 1, e = a + kSlices + 1, f = e + 1;
      if (j != 0) mesh.indices.insert(mesh.indices.end(), {a, b, f});
      if (j != kStacks - 1) mesh.indices.insert(mesh.indices.end(), {a, f, e});
    }
  return mesh;
}

WallMesh tetrahedron(std::uint32_t number) {
  const double q = 0.15 / std::sqrt(3.0);
  const std::array<Vec3, 4> corners{Vec3(q, q, q), Vec3(-q, -q, q), Vec3(-q, q, -q), Vec3(q, -q, -q)};
  constexpr std::uint32_t kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  WallMesh mesh;
  for (std::uint32_t face = 0; face < 4; ++face) {
    const Vec3 &a = corners[kFaces[face][0]], &b = corners[kFaces[face][1]], &c = corners[kFaces[face][2]];
    const Vec3 n = (b - a).cross(c - a).normalized();
    for (std::uint32_t j = 0; j < 3; ++j) {
      const Vec3& p = corners[kFaces[face][j]];
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back({{p.x(), p.y(), p.z()}, {n.x(), n.y(), n.z()}, colourOf(number, face, j)});
    }
  }
  return mesh;
}

}  // namespace

std::vector<WallNode> wallNodes(const WallScene& scene) {
  SplitMix64 random(12345);
  std::vector<WallNode> nodes(scene.nodes());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double x = random.next() * 200 - 100, y = random.next() * 30 - 15, z = random.next() * 200 - 100;
    nodes[i] = {raised(x, y, z), random.next() * 2 * kPi, static_cast<std::uint32_t>(i % kWallMeshes)};
  }
  return nodes;
}

WallNode movedNode(const WallNode& rest, std::size_t number, double t) {
  const auto i = static_cast<double>(number);
  WallNode at = rest;
  at.position +=
      raised(2 * std::sin(1.1 * t + i), 0.5 * std::sin(1.9 * t + 0.37 * i), 2 * std::cos(1.1 * t + i));
  at.heading += 0.8 * t;
  return at;
}

WallMesh wallMesh(const WallScene& scene, std::uint32_t number) {
  return scene.tiny() ? tetrahedron(number) : lumpySphere(number);
}

double WallMesh::radius() const {
  double most = 0;
  for (const WallVertex& v : vertices)
    most = std::max(most, std::hypot(v.position[0], v.position[1], v.position[2]));
  return most;
}

}  // namespace stadion::bench
