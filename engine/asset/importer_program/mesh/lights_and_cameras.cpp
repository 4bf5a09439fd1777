#include "engine/asset/importer_program/mesh/lights_and_cameras.h"

#include "engine/asset/importer_program/source/light_kind.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace stadion::importer {
namespace {

constexpr float kBrightest = 1e9f;
constexpr double kFarthestFromShow = 1e7;  // [m]
constexpr std::size_t kMostTold = 20;

std::array<float, 3> floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Moves a place and a direction of a node to the mesh. Returns false if they are nowhere.
bool move(const Affine& X, const Float3& fromPosition, const Float3& fromDirection,
          std::array<float, 3>& position, std::array<float, 3>& direction) {
  const Vec3 p = X * Vec3(fromPosition[0], fromPosition[1], fromPosition[2]);
  const Vec3 d = X.linear() * Vec3(fromDirection[0], fromDirection[1], fromDirection[2]);
  const double length = d.norm();
  if (!(p.norm() < kFarthestFromShow) || !std::isfinite(length) || !(length > 1e-30)) return false;
  position = floats(p);
  direction = floats(d / length);
  return true;
}

/// In metres. As in glTF, scales of nodes do not change it.
float rangeOf(const SourceLight& from, const Affine& toShow) {
  const double range = double{from.range} * toShow.linear().col(0).norm();
  return range > 0 && range < kFarthestFromShow ? static_cast<float>(range) : 0;
}

class LightsAndCameras {
public:
  LightsAndCameras(const SourceScene& scene, const NodeChoice& choice, const MeshLimits& limits, Mesh& mesh,
                   ModelInventory& inventory)
      : scene_(scene), choice_(choice), limits_(limits), mesh_(mesh), inventory_(inventory) {}

  /// Without recursion: files nest deep.
  void read() {
    std::vector<std::pair<std::uint32_t, Affine>> left;
    for (auto root = choice_.roots().rbegin(); root != choice_.roots().rend(); ++root)
      left.emplace_back(*root, choice_.above(*root));
    while (!left.empty()) {
      const auto [number, above] = left.back();
      left.pop_back();
      if (choice_.isLeftOut(number)) continue;
      const SourceNode& node = scene_.nodes[number];
      const Affine X = above * node.X_PN;
      take(node, X);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        left.emplace_back(*child, X);
    }
  }

private:
  void take(const SourceNode& node, const Affine& X) {
    if (node.light >= 0) takeLight(scene_.lights[static_cast<std::size_t>(node.light)], node.name, X);
    if (node.camera >= 0) takeCamera(scene_.cameras[static_cast<std::size_t>(node.camera)], node.name, X);
  }

  void leaveOut(const char* what, const std::string& name, bool tooMany) {
    if (told_ == kMostTold) return;
    ++told_;
    inventory_.add(ContentUse::LeftOut, fmt::format("the {} \"{}\": {}", what, name,
                                                    tooMany ? "the model has too many"
                                                            : "its node is too far away, or of no size"));
  }

  void takeLight(const SourceLight& from, const std::string& name, const Affine& X) {
    const auto kind = lightKind(from.kind);
    ModelLight to;
    if (!kind) return;
    to.name = name.empty() ? from.name : name;
    const bool tooMany = mesh_.lights.size() == limits_.lights;
    if (tooMany || !move(X, from.position, from.direction, to.position, to.direction))
      return leaveOut("light", to.name, tooMany);
    to.kind = *kind;
    for (std::size_t k = 0; k < 3; ++k) {
      const float c = from.colour[k] * from.intensity;
      to.colour[k] = c > 0 ? std::min(c, kBrightest) : 0;  // not a number: dark
    }
    to.range = rangeOf(from, scene_.toShow);
    const auto angle = [](double a) { return a > 0 ? static_cast<float>(std::min(a, 1.57)) : 0; };
    to.outerAngle = angle(from.outerAngle);
    to.innerAngle = std::min(angle(from.innerAngle), to.outerAngle);
    mesh_.lights.push_back(std::move(to));
  }

  void takeCamera(const SourceCamera& from, const std::string& name, const Affine& X) {
    ModelCamera to;
    to.name = name.empty() ? from.name : name;
    const bool tooMany = mesh_.cameras.size() == limits_.cameras;
    if (tooMany || !move(X, from.position, from.direction, to.position, to.direction))
      return leaveOut("camera", to.name, tooMany);
    mesh_.cameras.push_back(std::move(to));
  }

  const SourceScene& scene_;
  const NodeChoice& choice_;
  const MeshLimits& limits_;
  Mesh& mesh_;
  ModelInventory& inventory_;
  std::size_t told_ = 0;
};

}  // namespace

void readLightsAndCameras(const SourceScene& scene, const NodeChoice& choice, const MeshLimits& limits,
                          Mesh& mesh, ModelInventory& inventory) {
  LightsAndCameras(scene, choice, limits, mesh, inventory).read();
}

}  // namespace stadion::importer
