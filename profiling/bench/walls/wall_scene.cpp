#include "profiling/bench/walls/wall_scene.h"

#include "engine/atomic_file.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <numbers>

namespace stadion::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRoom = 1.5;  ///< from its middle to each wall [m]
constexpr double kEyeSeparation = 0.065;

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

/// From +Y up to +Z up.
Vec3 raised(double x, double y, double z) {
  return {x, -z, y};
}

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

/// Positions in whole nanometres, so that where the surface closes it does so exactly: what is open would be
/// drawn from both sides.
std::string objText(const WallMesh& mesh) {
  std::string text = "mtllib paint.mtl\n";
  for (const WallVertex& v : mesh.vertices)
    text += fmt::format("v {:.9f} {:.9f} {:.9f} {:.9g} {:.9g} {:.9g}\nvn {:.9g} {:.9g} {:.9g}\n",
                        v.position[0], v.position[1], v.position[2], v.colour[0] / 255.0, v.colour[1] / 255.0,
                        v.colour[2] / 255.0, v.normal[0], v.normal[1], v.normal[2]);
  text += "usemtl paint\n";
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i] + 1, b = mesh.indices[i + 1] + 1, c = mesh.indices[i + 2] + 1;
    text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", a, b, c);
  }
  return text;
}

double degrees(double radians) {
  return radians * 180 / kPi;
}

std::string number(const Vec3& p) {
  return fmt::format("{:.17g}, {:.17g}, {:.17g}", p.x(), p.y(), p.z());
}

/// The platform that carries the room.
std::string keyOfPlatform(double t) {
  const Vec3 p = raised(40 * std::cos(0.1 * t), 0, 40 * std::sin(0.1 * t));
  return fmt::format("{:.9f}, {}, 0, 0, {:.17g}", t, number(p), degrees(0.05 * t));
}

std::string headRecord(double t) {
  const Vec3 p = raised(0.3 * std::sin(1.3 * t), 0.1 * std::sin(1.7 * t), 0.3 * std::cos(0.9 * t));
  const double yaw = 0.5 * std::sin(0.8 * t);
  return fmt::format("pose head {:.9f} {:.17g} {:.17g} {:.17g} {:.17g} 0 0 {:.17g}\n", t, p.x(), p.y(), p.z(),
                     std::cos(yaw / 2), std::sin(yaw / 2));
}

std::string roomText(const WallScene& scene, std::size_t walls) {
  constexpr double h = kRoom;
  const struct {
    const char* name;
    Vec3 lowerLeft, lowerRight, upperLeft;
  } all[] = {{"front", raised(-h, -h, -h), raised(h, -h, -h), raised(-h, h, -h)},
             {"left", raised(-h, -h, h), raised(-h, -h, -h), raised(-h, h, h)},
             {"right", raised(h, -h, -h), raised(h, -h, h), raised(h, h, -h)},
             {"floor", raised(-h, -h, h), raised(h, -h, h), raised(-h, -h, -h)},
             {"back", raised(h, -h, h), raised(-h, -h, h), raised(h, h, h)},
             {"ceiling", raised(-h, h, -h), raised(h, h, -h), raised(-h, h, h)}};
  const auto corner = [](const Vec3& p) { return fmt::format("{} {} {}", p.x(), p.y(), p.z()); };
  std::string text =
      fmt::format("unit m\neye-separation {}\nnear 0.1\nfar {}\n", kEyeSeparation, scene.far());
  for (std::size_t i = 0; i < std::min(walls, std::size(all)); ++i)
    text += fmt::format("wall {} lower-left {} lower-right {} upper-left {}\n", all[i].name,
                        corner(all[i].lowerLeft), corner(all[i].lowerRight), corner(all[i].upperLeft));
  return text;
}

/// What movedNode says, of every node that moves.
std::string movingNodes(const WallScene& scene) {
  std::string targets;
  std::size_t first = scene.nodes(), second = 0;
  for (std::size_t i = 0; i < scene.nodes(); ++i) {
    if (!scene.moves(i)) continue;
    targets += fmt::format(",\n  target=n_{}", i);
    if (first == scene.nodes())
      first = i;
    else if (second == 0)
      second = i;
  }
  if (targets.empty()) return {};
  // -cos(a) is sin(a - 90 degrees).
  const auto at = static_cast<double>(first), step = static_cast<double>(second - first);
  const Vec3 phase(degrees(at), degrees(at) - 90, degrees(0.37 * at));
  const Vec3 phaseStep = Vec3(degrees(step), degrees(step), degrees(0.37 * step));
  return fmt::format("sway( amplitude=\"2, 2, 0.5\", frequency=\"{}\", phase=\"{}\", phasestep=\"{}\", "
                     "angularvelocity=\"0, 0, {:.17g}\"{} )\n",
                     number(Vec3(1.1, 1.1, 1.9) / (2 * kPi)), number(phase), number(phaseStep), degrees(0.8),
                     targets);
}

std::string showText(const WallScene& scene, bool grouped, std::size_t frames) {
  const Vec3 light = raised(0.3, 1, 0.5);
  std::string text = fmt::format("light( direction=\"{}\", colour=\"0.75, 0.75, 0.75\", shadows=off )\n"
                                 "sky( zenith=\"0.1, 0.12, 0.2\", horizon=\"0.1, 0.12, 0.2\", ground=\"0.1, "
                                 "0.12, 0.2\", ambient=\"0.25, 0.25, 0.25\" )\n"
                                 "rig( name=room )\npath( target=room",
                                 number(-light));
  for (std::size_t frame = 0; frame <= frames; ++frame)
    text += fmt::format(",\n  key=\"{}\"", keyOfPlatform(static_cast<double>(frame) / kWallSceneRate));
  text += " )\n";
  const std::size_t cells = scene.tiny() ? 32 : 20;
  if (grouped)
    for (std::size_t cell = 0; cell < cells * cells; ++cell)
      text += fmt::format("group( name=cell_{} )\n", cell);
  const std::vector<WallNode> nodes = wallNodes(scene);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const WallNode& node = nodes[i];
    const bool moves = scene.moves(i);
    text += fmt::format("object( file=mesh_{}.obj, position=\"{}\", orientation=\"0, 0, {:.17g}\"", node.mesh,
                        number(node.position), degrees(node.heading));
    if (moves) text += fmt::format(", name=n_{}", i);
    const auto cellOf = [&](double x) {
      return std::min(cells - 1, static_cast<std::size_t>((x + 100) / 200 * static_cast<double>(cells)));
    };
    if (grouped && !moves)
      text += fmt::format(", parent=cell_{}", cellOf(-node.position.y()) * cells + cellOf(node.position.x()));
    text += " )\n";
  }
  return text + movingNodes(scene);
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

std::string writeWallScene(const std::string& folder, const WallScene& scene, std::size_t walls, bool grouped,
                           std::size_t frames) {
  std::string wrong;
  const auto write = [&](const std::string& name, const std::string& text) {
    if (const auto why = writeFile(folder + "/" + name, text); why && wrong.empty()) wrong = format(*why);
  };
  write("paint.mtl", "newmtl paint\nKd 1 1 1\n");
  for (std::uint32_t k = 0; k < kWallMeshes; ++k)
    write(fmt::format("mesh_{}.obj", k), objText(wallMesh(scene, k)));
  write("room.walls", roomText(scene, walls));
  std::string input = "stadion-input 1\n";
  for (std::size_t frame = 0; frame <= frames; ++frame)
    input += headRecord(static_cast<double>(frame) / kWallSceneRate);
  write("show.input", input);
  write("show.evs", showText(scene, grouped, frames));
  return wrong;
}

}  // namespace stadion::bench
