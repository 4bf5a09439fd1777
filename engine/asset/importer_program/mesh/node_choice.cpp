#include "engine/asset/importer_program/mesh/node_choice.h"

#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>
#include <optional>

namespace stadion::importer {
namespace {

/// A node's name as scripts can write it.
std::string wordOf(const std::string& name) {
  std::string word = name;
  for (char& c : word)
    if (static_cast<unsigned char>(c) <= ' ' || c == 0x7f ||
        std::string_view(",/=()#\"'").find(c) != std::string_view::npos)
      c = '_';
  return word;
}

/// The first node of this name below the given ones, in the order of the file. No recursion: files nest deep.
std::optional<std::uint32_t> nodeBelow(const SourceScene& scene, const std::vector<std::uint32_t>& nodes,
                                       std::string_view word) {
  std::vector<std::uint32_t> left(nodes.rbegin(), nodes.rend());
  while (!left.empty()) {
    const std::uint32_t node = left.back();
    left.pop_back();
    if (wordOf(scene.nodes[node].name) == word) return node;
    const auto& children = scene.nodes[node].children;
    left.insert(left.end(), children.rbegin(), children.rend());
  }
  return std::nullopt;
}

/// Those of scenes that are not shown.
std::vector<std::uint32_t> otherRootsOf(const SourceScene& scene) {
  std::vector<std::uint32_t> roots;
  for (std::uint32_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].parent < 0 && std::ranges::find(scene.roots, i) == scene.roots.end())
      roots.push_back(i);
  return roots;
}

std::optional<std::uint32_t> nodeAt(const SourceScene& scene, std::string_view path) {
  std::optional<std::uint32_t> node;
  for (;;) {
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view word = path.substr(0, end);
    const bool first = !node;
    node = nodeBelow(scene, first ? scene.roots : scene.nodes[*node].children, word);
    if (!node && first) node = nodeBelow(scene, otherRootsOf(scene), word);
    if (!node || end == path.size()) return node;
    path.remove_prefix(end + 1);
  }
}

std::vector<std::string> wordsOf(const SourceScene& scene) {
  std::vector<std::string> words;
  for (const SourceNode& node : scene.nodes)
    if (!node.name.empty()) words.push_back(wordOf(node.name));
  return words;
}

/// The axes of a place at right angles and of unit length, in the order x, y, z; those of the parent if it has none.
Affine withoutScale(const Affine& X) {
  Affine place = Affine::Identity();
  place.translation() = X.translation();
  const Vec3 x = X.linear().col(0).normalized();
  const Vec3 y = (X.linear().col(1) - x * x.dot(X.linear().col(1))).normalized();
  Mat3 axes;
  axes << x, y, x.cross(y);
  if (axes.allFinite() && std::abs(axes.determinant() - 1) < 1e-9) place.linear() = axes;
  return place;
}

}  // namespace

NodeChoice::NodeChoice(const SourceScene& scene, const NodeSelection& nodes)
    : scene_(scene), roots_(scene.roots), leftOut_(scene.nodes.size(), false) {
  std::optional<std::uint32_t> part;
  if (!nodes.part.empty()) {
    part = nodeAt(scene, nodes.part);
    if (!part)
      throw Refusal("has no part \"" + nodes.part + "\"; it has " + listed(wordsOf(scene), "node", "nodes"));
    roots_ = {*part};
    const Mat3 toFile = scene.toShow.linear().inverse();
    Affine X = parentsOf(*part) * scene.nodes[*part].X_PN;
    X.linear() = X.linear() * toFile;  // the show's axes, as they lie in the node
    place_ = withoutScale(X);
    if (!place_.matrix().allFinite()) throw Refusal("puts its part \"" + nodes.part + "\" nowhere");
  }
  for (const std::string& path : nodes.without)
    if (const auto node = nodeAt(scene, path); node && node != part) leftOut_[*node] = hasGaps_ = true;
}

Affine NodeChoice::parentsOf(std::uint32_t node) const {
  Affine X = Affine::Identity();
  for (std::int32_t up = scene_.nodes[node].parent; up >= 0;
       up = scene_.nodes[static_cast<std::size_t>(up)].parent)
    X = scene_.nodes[static_cast<std::size_t>(up)].X_PN * X;
  return scene_.toShow * X;
}

Affine NodeChoice::above(std::uint32_t root) const {
  return place_.inverse(Eigen::Isometry) * parentsOf(root);
}

}  // namespace stadion::importer
