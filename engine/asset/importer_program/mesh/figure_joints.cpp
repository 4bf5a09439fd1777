#include "engine/asset/importer_program/mesh/figure_joints.h"

#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace stadion::importer {
namespace {

/// A matrix that mirrors gets a negative scale along x.
BonePlace placeOf(const Affine& X) {
  BonePlace place;
  place.translation = X.translation();
  Mat3 axes = X.linear();
  for (int k = 0; k < 3; ++k) place.scale[k] = axes.col(k).norm();
  if (axes.determinant() < 0) place.scale.x() = -place.scale.x();
  for (int k = 0; k < 3; ++k)
    if (place.scale[k] != 0) axes.col(k) /= place.scale[k];
  const Quat q(axes);
  place.rotation = q.coeffs().allFinite() && q.norm() > 1e-6 ? q.normalized() : Quat::Identity();
  return place;
}

/// A name that a script can write: without control characters and quotation marks, without blanks at its ends,
/// and given once.
std::string nameFor(const SourceClip& clip, const std::vector<Clip>& before, ModelInventory& inventory) {
  std::string name = clip.name;
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ' || c == '"' || c == '\\' || c == 127) c = '_';
  const std::size_t first = name.find_first_not_of(' ');
  name = first == std::string::npos ? "clip" + std::to_string(before.size() + 1)
                                    : name.substr(first, name.find_last_not_of(' ') + 1 - first);
  const auto isTaken = [&](const std::string& wanted) {
    return std::ranges::any_of(before, [&](const Clip& c) { return c.name == wanted; });
  };
  std::string own = name;
  for (int n = 2; isTaken(own); ++n) own = name + "_" + std::to_string(n);
  if (own != clip.name && !clip.name.empty())
    inventory.add(ContentUse::Approximated,
                  "clip " + inQuotes(clip.name) + ": it is called " + inQuotes(own));
  return own;
}

bool allFinite(const std::vector<float>& values) {
  return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
}

bool playable(const SourceChannel& c) {
  return !c.times.empty() && allFinite(c.times) && allFinite(c.values) && std::ranges::is_sorted(c.times);
}

}  // namespace

FigureJoints::FigureJoints(const SourceScene& scene, const SkeletonLimits& limits)
    : scene_(scene), limits_(limits), firstWeight_(scene.nodes.size(), -1), boneOf_(scene.nodes.size(), -1),
      jointOfNode_(scene.nodes.size(), -1) {
  bones_.push_back({{}, -1, scene.toShow, placeOf(scene.toShow)});
  for (const std::uint32_t root : scene.roots) addBones(root);
  // A joint may lie outside of the shown scene.
  for (const SourceSkin& skin : scene.skins)
    for (std::uint32_t at : skin.joints) {
      while (boneOf_[at] < 0 && scene.nodes[at].parent >= 0)
        at = static_cast<std::uint32_t>(scene.nodes[at].parent);
      addBones(at);
    }
  addJoints();
  addWeights();
}

void FigureJoints::addBones(std::uint32_t root) {
  std::vector<std::pair<std::uint32_t, std::int32_t>> rest{{root, 0}};
  while (!rest.empty()) {
    const auto [node, parent] = rest.back();
    rest.pop_back();
    if (boneOf_[node] >= 0) continue;
    if (bones_.size() >= limits_.bones)
      throw Refusal("has more than " + std::to_string(limits_.bones) + " nodes, too many for a figure");
    boneOf_[node] = static_cast<std::int32_t>(bones_.size());
    const SourceNode& from = scene_.nodes[node];
    bones_.push_back({from.name, parent, from.X_PN, from.place.value_or(placeOf(from.X_PN))});
    for (auto child = from.children.rbegin(); child != from.children.rend(); ++child)
      rest.emplace_back(*child, boneOf_[node]);
  }
}

/// Vertices are stored as `toShow` turns those of the primitives.
void FigureJoints::addJoints() {
  const Affine toFile = scene_.toShow.inverse();
  for (std::size_t node = 0; node < scene_.nodes.size(); ++node) {
    if (boneOf_[node] < 0 || scene_.nodes[node].meshes.empty()) continue;
    jointOfNode_[node] = static_cast<std::int32_t>(joints_.size());
    joints_.push_back({static_cast<std::uint32_t>(boneOf_[node]), toFile});
  }
  for (const SourceSkin& skin : scene_.skins) {
    if (std::ranges::any_of(skin.inverseBinds, [](const Affine& X) { return !X.matrix().allFinite(); }))
      throw Refusal("has a skin " + inQuotes(skin.name) + " with an inverse bind matrix that is not finite");
    firstOfSkin_.push_back(static_cast<std::uint32_t>(joints_.size()));
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
      joints_.push_back({static_cast<std::uint32_t>(boneOf_[skin.joints[i]]), skin.inverseBinds[i] * toFile});
  }
  if (joints_.size() > limits_.joints)
    throw Refusal("has more than " + std::to_string(limits_.joints) + " joints");
}

/// Each node has weights of its own, also if it shares a mesh.
void FigureJoints::addWeights() {
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    if (boneOf_[i] < 0) continue;
    const SourceNode& node = scene_.nodes[i];
    const std::size_t first = weights_.size();
    for (const std::uint32_t number : node.meshes) {
      const SourceMesh& mesh = scene_.meshes[number];
      std::size_t targets = 0;
      for (const SourcePrimitive& part : mesh.primitives) targets = std::max(targets, part.targets.size());
      for (std::size_t k = weights_.size() - first; k < targets; ++k)
        weights_.push_back(
            {k < mesh.targetNames.size() ? mesh.targetNames[k] : std::string(), weightAtRest(node, mesh, k)});
    }
    if (weights_.size() > limits_.weights)
      throw Refusal("has more than " + std::to_string(limits_.weights) + " morph targets");
    if (weights_.size() > first) firstWeight_[i] = static_cast<std::int32_t>(first);
  }
}

std::int32_t FigureJoints::skinOf(std::uint32_t node, std::uint32_t mesh) const {
  const std::int32_t own = scene_.meshes[mesh].skin;
  return own >= 0 ? own : scene_.nodes[node].skin;
}

VertexJoints FigureJoints::carriedBy(std::uint32_t joint) const {
  VertexJoints v;
  v.joint[0] = static_cast<std::uint16_t>(joint);
  return v;
}

VertexJoints FigureJoints::of(const SourcePrimitive& part, std::size_t vertex, std::uint32_t node,
                              std::int32_t skin) const {
  const VertexJoints alone = carriedBy(static_cast<std::uint32_t>(jointOfNode_[node]));
  if (skin < 0 || vertex >= part.joints.size() || vertex >= part.weights.size()) return alone;
  const auto number = static_cast<std::size_t>(skin);
  VertexJoints v;
  float sum = 0;
  for (std::size_t k = 0; k < VertexJoints::kMost; ++k) {
    const float weight = part.weights[vertex][k];
    const std::uint16_t joint = part.joints[vertex][k];
    const bool counts = weight > 0 && std::isfinite(weight) && joint < scene_.skins[number].joints.size();
    v.joint[k] = counts ? static_cast<std::uint16_t>(firstOfSkin_[number] + joint) : 0;
    v.weight[k] = counts ? weight : 0;
    sum += v.weight[k];
  }
  if (!(sum > 0) || !std::isfinite(sum)) return alone;
  for (float& weight : v.weight) weight /= sum;
  return v;
}

/// Splits a channel with the numbers of all weights into one for each.
bool FigureJoints::addWeightChannels(const SourceChannel& from, Clip& clip) const {
  if (firstWeight_[from.node] < 0) return false;
  const auto first = static_cast<std::size_t>(firstWeight_[from.node]);
  std::size_t end = weights_.size();  // where those of another node begin
  for (const std::int32_t other : firstWeight_)
    if (other > firstWeight_[from.node]) end = std::min(end, static_cast<std::size_t>(other));
  const std::size_t rows = from.times.size() * (from.interpolation == Interpolation::Cubic ? 3 : 1);
  const std::size_t width = end - first;
  if (from.values.size() != rows * width) return false;
  for (std::size_t k = 0; k < width; ++k) {
    ClipChannel c{
        static_cast<std::uint32_t>(first + k), ChannelTarget::Weights, from.interpolation, from.times, {}};
    for (std::size_t row = 0; row < rows; ++row) c.values.push_back(from.values[row * width + k]);
    clip.channels.push_back(std::move(c));
  }
  return true;
}

Clip FigureJoints::clipOf(const SourceClip& from, std::string name, std::size_t& leftOut) const {
  Clip clip{std::move(name), 0, {}};
  for (const SourceChannel& c : from.channels) {
    if (boneOf_[c.node] < 0) continue;
    if (!playable(c)) {
      ++leftOut;
      continue;
    }
    clip.length = std::max(clip.length, double{c.times.back()});
    if (c.target == ChannelTarget::Weights) {
      if (!addWeightChannels(c, clip)) ++leftOut;
      continue;
    }
    clip.channels.push_back(
        {static_cast<std::uint32_t>(boneOf_[c.node]), c.target, c.interpolation, c.times, c.values});
  }
  return clip;
}

Skeleton FigureJoints::skeleton(ModelInventory& inventory) const {
  if (scene_.clips.size() > limits_.clips)
    throw Refusal("has more than " + std::to_string(limits_.clips) + " clips");
  Skeleton skeleton{bones_, joints_, {}, weights_, {}, {}};
  std::size_t leftOut = 0;
  std::uint64_t keys = 0;
  for (const SourceClip& clip : scene_.clips) {
    skeleton.clips.push_back(clipOf(clip, nameFor(clip, skeleton.clips, inventory), leftOut));
    for (const ClipChannel& c : skeleton.clips.back().channels) keys += c.values.size();
  }
  if (keys > limits_.keys)
    throw Refusal("has clips with more than " + std::to_string(limits_.keys) + " numbers");
  if (leftOut > 0)
    inventory.add(ContentUse::LeftOut, counted(leftOut, "channel", "channels") +
                                           " of clips with times that do not ascend, numbers that are not "
                                           "finite, or too few or many of them");
  return skeleton;
}

}  // namespace stadion::importer
