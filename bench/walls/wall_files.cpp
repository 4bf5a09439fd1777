#include "bench/walls/wall_files.h"

#include "bench/walls/wall_room.h"
#include "engine/base/atomic_file.h"
#include "engine/maths/angles.h"

#include <cmath>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

/// Scripts are no larger than 64 MiB.
constexpr std::size_t kNodesInAFile = 100'000;

/// Positions in whole nanometres, so that closed surfaces close exactly: open ones would be drawn from both
/// sides.
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

/// Returns an angle of any number of turns as less than one turn.
double phaseOf(double radians) {
  return degrees(std::remainder(radians, 2 * kPi));
}

std::string number(const Vec3& p) {
  return fmt::format("{:.17g}, {:.17g}, {:.17g}", p.x(), p.y(), p.z());
}

std::string keyOfPlatform(double t) {
  return fmt::format("{:.9f}, {}, 0, 0, {:.17g}", t, number(platformAt(t).p), degrees(platformHeadingAt(t)));
}

std::string headRecord(double t) {
  const Vec3 p = headAt(t);
  const double yaw = headHeadingAt(t);
  return fmt::format("pose head {:.9f} {:.17g} {:.17g} {:.17g} {:.17g} 0 0 {:.17g}\n", t, p.x(), p.y(), p.z(),
                     std::cos(yaw / 2), std::sin(yaw / 2));
}

std::string roomText(const WallScene& scene, std::size_t walls) {
  const auto corner = [](const Vec3& p) { return fmt::format("{} {} {}", p.x(), p.y(), p.z()); };
  std::string text =
      fmt::format("unit m\neye-separation {}\nnear {}\nfar {}\n", kWallEyeSeparation, kWallNear, scene.far());
  for (std::size_t i = 0; i < std::min(walls, roomWalls().size()); ++i) {
    const RoomWall& w = roomWalls()[i];
    text += fmt::format("wall {} lower-left {} lower-right {} upper-left {}\n", w.name, corner(w.lowerLeft),
                        corner(w.lowerRight), corner(w.upperLeft));
  }
  return text;
}

/// Returns the script of every moving node from `first` to `end`, with the motion of movedNode().
std::string movingNodes(const WallScene& scene, std::size_t first, std::size_t end) {
  std::string targets;
  std::vector<double> numbers;
  for (std::size_t i = first; i < end; ++i) {
    if (!scene.moves(i)) continue;
    targets += fmt::format(",\n  target=n_{}", i);
    numbers.push_back(static_cast<double>(i));
  }
  if (targets.empty()) return {};
  // -cos(a) is sin(a - 90 degrees). Numbers rise by the same step.
  const double at = numbers.front(), step = numbers.size() > 1 ? numbers[1] - numbers[0] : 0;
  const Vec3 phase(phaseOf(at), phaseOf(at) - 90, phaseOf(0.37 * at));
  const Vec3 phaseStep(phaseOf(step), phaseOf(step), phaseOf(0.37 * step));
  return fmt::format("sway( amplitude=\"2, 2, 0.5\", frequency=\"{}\", phase=\"{}\", phasestep=\"{}\", "
                     "angularvelocity=\"0, 0, {:.17g}\"{} )\n",
                     number(Vec3(1.1, 1.1, 1.9) / (2 * kPi)), number(phase), number(phaseStep), degrees(0.8),
                     targets);
}

/// Returns the script without the nodes.
std::string showText(std::size_t frames) {
  const Vec3 light = raised(0.3, 1, 0.5);
  std::string text = fmt::format("light( direction=\"{}\", colour=\"0.75, 0.75, 0.75\", shadows=off )\n"
                                 "sky( zenith=\"0.1, 0.12, 0.2\", horizon=\"0.1, 0.12, 0.2\", ground=\"0.1, "
                                 "0.12, 0.2\", ambient=\"0.25, 0.25, 0.25\" )\n"
                                 "rig( name=room )\npath( target=room",
                                 number(-light));
  for (std::size_t frame = 0; frame <= frames; ++frame)
    text += fmt::format(",\n  key=\"{}\"", keyOfPlatform(static_cast<double>(frame) / kWallSceneRate));
  text += " )\n";
  return text;
}

/// Returns the nodes from `first` on, as many as a file holds.
std::string nodesText(const WallScene& scene, const std::vector<WallNode>& nodes, std::size_t first,
                      bool grouped) {
  const std::size_t cells = scene.tiny() ? 32 : 20;
  const auto cellOf = [&](double x) {
    return std::min(cells - 1, static_cast<std::size_t>((x + 100) / 200 * static_cast<double>(cells)));
  };
  std::string text;
  if (grouped)
    for (std::size_t cell = 0; cell < cells * cells; ++cell)
      text += fmt::format("group( name=cell_{} )\n", cell);
  const std::size_t end = std::min(first + kNodesInAFile, nodes.size());
  for (std::size_t i = first; i < end; ++i) {
    const WallNode& node = nodes[i];
    text += fmt::format("object( file=mesh_{}.obj, position=\"{}\", orientation=\"0, 0, {:.17g}\"", node.mesh,
                        number(node.position), degrees(node.heading));
    if (scene.moves(i)) text += fmt::format(", name=n_{}", i);
    if (grouped && !scene.moves(i))
      text += fmt::format(", parent=cell_{}", cellOf(-node.position.y()) * cells + cellOf(node.position.x()));
    text += " )\n";
  }
  return text + movingNodes(scene, first, end);
}

}  // namespace

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
  const std::vector<WallNode> nodes = wallNodes(scene);
  std::string show = showText(frames);
  for (std::size_t first = 0; first < nodes.size(); first += kNodesInAFile) {
    const std::string part = nodesText(scene, nodes, first, grouped);
    if (nodes.size() <= kNodesInAFile) {
      show += part;
      break;
    }
    const std::string name = fmt::format("part_{}.evs", first / kNodesInAFile);
    write(name, part);
    show += fmt::format("scene( file={} )\n", name);
  }
  write("show.evs", show);
  return wrong;
}

}  // namespace stadion::bench
