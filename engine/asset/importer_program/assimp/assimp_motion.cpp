#include "engine/asset/importer_program/assimp/assimp_scene.h"

#include <map>
#include <string>

namespace stadion::importer {
namespace {

using NodesByName = std::map<std::string, std::uint32_t>;

/// assimp keeps the bones of each mesh, with their weights. Each mesh with bones gets a skin.
class SkinReader {
public:
  SkinReader(const NodesByName& nodes, SourceScene& to) : nodes_(nodes), to_(to) {}

  void read(const aiMesh& from, std::uint32_t mesh) {
    if (from.mNumBones == 0 || to_.meshes[mesh].primitives.empty()) return;
    SourceSkin skin;
    skin.name = from.mName.C_Str();
    SourcePrimitive& part = to_.meshes[mesh].primitives[0];
    part.joints.resize(part.positions.size());
    part.weights.resize(part.positions.size());
    for (unsigned b = 0; b < from.mNumBones; ++b)
      if (from.mBones[b]) readBone(*from.mBones[b], skin, part);
    to_.meshes[mesh].skin = static_cast<std::int32_t>(to_.skins.size());
    to_.skins.push_back(std::move(skin));
  }

private:
  void readBone(const aiBone& bone, SourceSkin& skin, SourcePrimitive& part) {
    const auto node = nodes_.find(bone.mName.C_Str());
    if (node == nodes_.end()) return;
    const auto joint = static_cast<std::uint16_t>(skin.joints.size());
    skin.joints.push_back(node->second);
    skin.inverseBinds.push_back(toAffine(bone.mOffsetMatrix));
    for (unsigned w = 0; w < bone.mNumWeights; ++w)
      if (bone.mWeights[w].mVertexId < part.positions.size()) addWeight(bone.mWeights[w], joint, part);
  }

  /// Replaces the least of the four weights if the new one is greater.
  static void addWeight(const aiVertexWeight& weight, std::uint16_t joint, SourcePrimitive& part) {
    Float4& weights = part.weights[weight.mVertexId];
    int least = 0;
    for (int k = 1; k < 4; ++k)
      if (weights[k] < weights[least]) least = k;
    if (!(weight.mWeight > weights[least])) return;
    weights[least] = weight.mWeight;
    part.joints[weight.mVertexId][least] = joint;
  }

  const NodesByName& nodes_;
  SourceScene& to_;
};

template <class Key>
void addVectors(const Key* keys, unsigned count, double ticks, ChannelTarget target, std::uint32_t node,
                SourceClip& clip) {
  if (!keys || count == 0) return;
  SourceChannel channel{node, target, Interpolation::Linear, {}, {}};
  for (unsigned i = 0; i < count; ++i) {
    channel.times.push_back(static_cast<float>(keys[i].mTime / ticks));
    const auto& v = keys[i].mValue;
    channel.values.insert(channel.values.end(), {v.x, v.y, v.z});
    if constexpr (requires { v.w; }) channel.values.push_back(v.w);
  }
  clip.channels.push_back(std::move(channel));
}

SourceClip clipOf(const aiAnimation& from, const NodesByName& nodes) {
  SourceClip clip{from.mName.C_Str(), {}};
  const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 25;
  for (unsigned i = 0; i < from.mNumChannels; ++i) {
    const aiNodeAnim& c = *from.mChannels[i];
    const auto node = nodes.find(c.mNodeName.C_Str());
    if (node == nodes.end()) continue;
    addVectors(c.mPositionKeys, c.mNumPositionKeys, ticks, ChannelTarget::Translation, node->second, clip);
    addVectors(c.mRotationKeys, c.mNumRotationKeys, ticks, ChannelTarget::Rotation, node->second, clip);
    addVectors(c.mScalingKeys, c.mNumScalingKeys, ticks, ChannelTarget::Scale, node->second, clip);
  }
  return clip;
}

}  // namespace

void convertMotion(const aiScene& scene, SourceScene& to) {
  NodesByName nodes;
  for (std::uint32_t i = 0; i < to.nodes.size(); ++i) nodes.try_emplace(to.nodes[i].name, i);
  SkinReader skins(nodes, to);
  for (unsigned i = 0; i < scene.mNumMeshes; ++i)
    if (scene.mMeshes[i]) skins.read(*scene.mMeshes[i], i);
  for (unsigned i = 0; i < scene.mNumAnimations; ++i)
    if (scene.mAnimations[i]) to.clips.push_back(clipOf(*scene.mAnimations[i], nodes));
}

}  // namespace stadion::importer
