#include "engine/asset/importer_program/gltf/gltf_parts.h"

#include <algorithm>
#include <cmath>

namespace stadion::importer {
namespace {

Affine matrixOf(const std::array<float, 16>& m) {
  Affine X;
  X.matrix() << m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13], m[2], m[6], m[10], m[14];
  return X;
}

BonePlace placeOf(const GltfValue& node) {
  const Float3 t = node.reals<3>("translation", {0, 0, 0}), s = node.reals<3>("scale", {1, 1, 1});
  const Float4 r = node.reals<4>("rotation", {0, 0, 0, 1});
  Quat q(double{r[3]}, double{r[0]}, double{r[1]}, double{r[2]});
  if (!(q.norm() > 1e-6)) q = Quat::Identity();
  return {Vec3(t[0], t[1], t[2]), q.normalized(), Vec3(s[0], s[1], s[2])};
}

std::int32_t numberOr(std::optional<std::uint32_t> index) {
  return index ? static_cast<std::int32_t>(*index) : -1;
}

class GltfNodes {
public:
  GltfNodes(GltfDocument& document, SourceScene& to) : root_(document.root()), to_(to) {}

  void read() {
    readCameras();
    readLights();
    const std::vector<GltfValue> nodes = root_.objects("nodes", "node");
    const std::size_t skins = root_.objects("skins", "skin").size();
    for (const GltfValue& node : nodes) to_.nodes.push_back(nodeOf(node, nodes.size(), skins));
    for (std::size_t i = 0; i < nodes.size(); ++i) adopt(i, nodes[i]);
    refuseCycles(nodes);
    readScenes();
  }

private:
  void readCameras() {
    for (const GltfValue& camera : root_.objects("cameras", "camera")) {
      const GltfValue lens = camera.object("perspective");
      to_.cameras.push_back({nameOf(camera),
                             lens.number("yfov", 0),
                             lens.number("znear", 0),
                             lens.number("zfar", 0),
                             {},
                             {0, 0, -1}});
    }
  }

  void readLights() {
    for (const GltfValue& light : root_.extension("KHR_lights_punctual").objects("lights", "light"))
      to_.lights.push_back(lightOf(light));
  }

  /// A light of pi candela, or of pi lux if directional, gives a white surface the radiance 1.
  static SourceLight lightOf(const GltfValue& from) {
    constexpr double kPi = 3.14159265358979323846, kQuarter = kPi / 4, kHalf = kPi / 2;
    SourceLight to;
    to.name = nameOf(from);
    to.kind = from.text("type");
    to.colour = from.reals<3>("color", {1, 1, 1});
    to.intensity = from.real("intensity", 1) / static_cast<float>(kPi);
    to.range = from.real("range", 0);
    const GltfValue cone = from.object("spot");
    to.outerAngle = std::clamp(cone.number("outerConeAngle", kQuarter), 0.0, kHalf);
    to.innerAngle = std::clamp(cone.number("innerConeAngle", 0), 0.0, to.outerAngle);
    return to;
  }

  SourceNode nodeOf(const GltfValue& from, std::size_t nodes, std::size_t skins) const {
    SourceNode node;
    node.name = nameOf(from);
    if (from.has("matrix")) {
      node.X_PN = matrixOf(from.reals<16>("matrix", {}));
    } else {
      node.place = placeOf(from);
      node.X_PN = node.place->matrix();
    }
    if (const auto mesh = from.index("mesh", to_.meshes.size())) node.meshes.push_back(*mesh);
    node.children = from.indices("children", nodes);
    node.targetWeights = weightsOf(from);
    node.skin = numberOr(from.index("skin", skins));
    node.camera = numberOr(from.index("camera", to_.cameras.size()));
    node.light = numberOr(from.extension("KHR_lights_punctual").index("light", to_.lights.size()));
    return node;
  }

  void adopt(std::size_t parent, const GltfValue& from) {
    for (const std::uint32_t child : to_.nodes[parent].children) {
      if (to_.nodes[child].parent >= 0)
        from.refuse("its child " + std::to_string(child) + " has two parents");
      to_.nodes[child].parent = static_cast<std::int32_t>(parent);
    }
  }

  /// Each node has one parent at most, so a path to the root that is longer than the list of nodes is
  /// a cycle.
  void refuseCycles(const std::vector<GltfValue>& nodes) const {
    std::vector<bool> sound(to_.nodes.size());
    for (std::size_t i = 0; i < to_.nodes.size(); ++i) {
      std::size_t steps = 0;
      for (auto at = static_cast<std::int32_t>(i); at >= 0 && !sound[static_cast<std::size_t>(at)];
           at = to_.nodes[static_cast<std::size_t>(at)].parent)
        if (++steps > to_.nodes.size()) nodes[i].refuse("it is its own ancestor");
      for (auto at = static_cast<std::int32_t>(i); at >= 0 && !sound[static_cast<std::size_t>(at)];
           at = to_.nodes[static_cast<std::size_t>(at)].parent)
        sound[static_cast<std::size_t>(at)] = true;
    }
  }

  void readScenes() {
    const std::vector<GltfValue> scenes = root_.objects("scenes", "scene");
    const std::uint32_t shown = root_.index("scene", std::max<std::size_t>(scenes.size(), 1)).value_or(0);
    for (std::size_t i = 0; i < scenes.size(); ++i)
      if (i == shown)
        to_.roots = scenes[i].indices("nodes", to_.nodes.size());
      else
        to_.otherScenes.push_back(nameOf(scenes[i]));
    if (!scenes.empty()) return;
    for (std::uint32_t i = 0; i < to_.nodes.size(); ++i)
      if (to_.nodes[i].parent < 0) to_.roots.push_back(i);
  }

  GltfValue root_;
  SourceScene& to_;
};

/// Reads the channels of one animation.
class GltfClip {
public:
  GltfClip(GltfDocument& document, const GltfValue& from, std::size_t nodes)
      : document_(document), from_(from), nodes_(nodes), samplers_(from.objects("samplers", "sampler")) {}

  SourceClip read() {
    SourceClip clip{nameOf(from_), {}};
    for (const GltfValue& channel : from_.objects("channels", "channel"))
      if (auto read = channelOf(channel)) clip.channels.push_back(std::move(*read));
    return clip;
  }

private:
  /// Nothing for a channel without a node, or with a property of an extension.
  std::optional<SourceChannel> channelOf(const GltfValue& from) {
    const GltfValue target = from.object("target");
    const auto node = target.index("node", nodes_);
    const auto property = propertyOf(target.text("path"));
    const auto sampler = from.index("sampler", samplers_.size());
    if (!node || !property) return {};
    if (!sampler) from.refuse("it names no sampler");
    SourceChannel channel{*node, *property, interpolationOf(samplers_[*sampler]), {}, {}};
    channel.times = valuesOf(samplers_[*sampler], "input");
    channel.values = valuesOf(samplers_[*sampler], "output");
    const std::size_t keys = channel.times.size() * (channel.interpolation == Interpolation::Cubic ? 3 : 1);
    const std::size_t width = *property == ChannelTarget::Rotation  ? 4
                              : *property == ChannelTarget::Weights ? 1
                                                                    : 3;
    const bool matches = *property == ChannelTarget::Weights ? keys == 0 || channel.values.size() % keys == 0
                                                             : channel.values.size() == keys * width;
    if (!matches) from.refuse("its times and values differ in number");
    return channel;
  }

  std::vector<float> valuesOf(const GltfValue& sampler, const char* key) {
    const auto accessor = sampler.index(key, document_.accessors().size());
    if (!accessor) sampler.refuse(std::string("\"") + key + "\" is missing");
    return document_.numbers(*accessor).values;
  }

  static std::optional<ChannelTarget> propertyOf(const std::string& path) {
    if (path == "translation") return ChannelTarget::Translation;
    if (path == "rotation") return ChannelTarget::Rotation;
    if (path == "scale") return ChannelTarget::Scale;
    return path == "weights" ? std::optional(ChannelTarget::Weights) : std::nullopt;
  }

  static Interpolation interpolationOf(const GltfValue& sampler) {
    const std::string mode = sampler.text("interpolation");
    return mode == "STEP"          ? Interpolation::Step
           : mode == "CUBICSPLINE" ? Interpolation::Cubic
                                   : Interpolation::Linear;
  }

  GltfDocument& document_;
  const GltfValue& from_;
  std::size_t nodes_;
  std::vector<GltfValue> samplers_;
};

SourceSkin gltfSkin(GltfDocument& document, const GltfValue& from, std::size_t nodes) {
  SourceSkin skin{nameOf(from), from.indices("joints", nodes), {}};
  skin.inverseBinds.resize(skin.joints.size(), Affine::Identity());
  const auto accessor = from.index("inverseBindMatrices", document.accessors().size());
  if (!accessor) return skin;
  const GltfNumbers matrices = document.numbers(*accessor);
  if (matrices.components != 16 || matrices.count() < skin.joints.size())
    from.refuse("it has fewer inverse bind matrices than joints");
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    skin.inverseBinds[i] = matrixOf(matrices.element<16>(i));
  return skin;
}

}  // namespace

void readGltfNodes(GltfDocument& document, SourceScene& to) {
  GltfNodes(document, to).read();
}

void readGltfMotion(GltfDocument& document, SourceScene& to) {
  for (const GltfValue& skin : document.root().objects("skins", "skin"))
    to.skins.push_back(gltfSkin(document, skin, to.nodes.size()));
  for (const GltfValue& clip : document.root().objects("animations", "animation"))
    to.clips.push_back(GltfClip(document, clip, to.nodes.size()).read());
}

}  // namespace stadion::importer
