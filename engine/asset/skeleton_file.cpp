#include "engine/asset/skeleton_file.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

struct SkeletonHead {
  std::uint32_t bones, joints, clips, weights;
};

struct BoneRecord {
  std::int32_t parent;
  double matrix[12], translation[3], rotation[4], scale[3];
};

struct JointRecord {
  std::uint32_t bone;
  double matrix[12];
};

struct ChannelRecord {
  std::uint32_t bone;
  ChannelTarget target;
  Interpolation interpolation;
  std::uint64_t times, values;
};

template <std::size_t kCount>
void copyTo(const double* from, double (&to)[kCount]) {
  std::copy_n(from, kCount, to);
}

template <std::size_t kCount>
bool takeFinite(const double (&from)[kCount], double* to) {
  std::copy_n(from, kCount, to);
  return std::all_of(from, from + kCount, [](double v) { return std::isfinite(v); });
}

bool readBone(ValueReader& in, std::size_t before, Bone& bone) {
  BoneRecord r{};
  if (!in.get(r) || !getName(in, bone.name)) return false;
  bone.parent = r.parent;
  return r.parent >= -1 && r.parent < static_cast<std::int64_t>(before) &&
         takeFinite(r.matrix, bone.X_PB.data()) && takeFinite(r.translation, bone.rest.translation.data()) &&
         takeFinite(r.rotation, bone.rest.rotation.coeffs().data()) &&
         takeFinite(r.scale, bone.rest.scale.data()) && std::fabs(bone.rest.rotation.norm() - 1) < 1e-6;
}

bool ascendAndFinite(const ClipChannel& c) {
  const auto finite = [](float v) { return std::isfinite(v); };
  return std::ranges::is_sorted(c.times) && std::ranges::all_of(c.times, finite) &&
         std::ranges::all_of(c.values, finite);
}

bool readChannel(ValueReader& in, const SkeletonHead& head, std::uint64_t& keysLeft, ClipChannel& c) {
  ChannelRecord r{};
  if (!in.get(r) || r.target > ChannelTarget::Weights || r.interpolation > Interpolation::Cubic ||
      r.times == 0 || r.values > keysLeft)
    return false;
  if (r.bone >= (r.target == ChannelTarget::Weights ? head.weights : head.bones)) return false;
  keysLeft -= r.values;
  c.bone = r.bone;
  c.target = r.target;
  c.interpolation = r.interpolation;
  const std::uint64_t each = c.width() * (r.interpolation == Interpolation::Cubic ? 3 : 1);
  return r.values / each == r.times && r.values % each == 0 && in.get(c.times, r.times) &&
         in.get(c.values, r.values) && ascendAndFinite(c);
}

bool readClip(ValueReader& in, const SkeletonHead& head, std::uint64_t& keysLeft, Clip& clip) {
  std::uint32_t channels = 0;
  if (!getName(in, clip.name) || !in.get(clip.length) || !in.get(channels)) return false;
  if (!std::isfinite(clip.length) || channels > in.left() / sizeof(ChannelRecord)) return false;
  clip.channels.resize(channels);
  return std::ranges::all_of(clip.channels,
                             [&](ClipChannel& c) { return readChannel(in, head, keysLeft, c); });
}

}  // namespace

void putName(ValueWriter& out, const std::string& text) {
  const auto length = static_cast<std::uint32_t>(std::min<std::size_t>(text.size(), kLongestName));
  out.put(length);
  out.raw(text.data(), length);
}

bool getName(ValueReader& in, std::string& text) {
  std::uint32_t length = 0;
  if (!in.get(length) || length > kLongestName || length > in.left()) return false;
  text.resize(length);
  return in.raw(text.data(), length);
}

void writeSkeleton(const Skeleton& skeleton, ValueWriter& out) {
  const auto count = [](const auto& v) { return static_cast<std::uint32_t>(v.size()); };
  out.put(SkeletonHead{count(skeleton.bones), count(skeleton.joints), count(skeleton.clips),
                       count(skeleton.weights)});
  for (const Bone& bone : skeleton.bones) {
    BoneRecord r{bone.parent, {}, {}, {}, {}};
    copyTo(bone.X_PB.data(), r.matrix), copyTo(bone.rest.translation.data(), r.translation);
    copyTo(bone.rest.rotation.coeffs().data(), r.rotation), copyTo(bone.rest.scale.data(), r.scale);
    out.put(r);
    putName(out, bone.name);
  }
  for (const Joint& joint : skeleton.joints) {
    JointRecord r{joint.bone, {}};
    copyTo(joint.X_BN.data(), r.matrix);
    out.put(r);
  }
  for (const MorphWeight& w : skeleton.weights) {
    out.put(w.rest);
    putName(out, w.name);
  }
  for (const Clip& clip : skeleton.clips) {
    putName(out, clip.name);
    out.put(clip.length);
    out.put(count(clip.channels));
    for (const ClipChannel& c : clip.channels) {
      out.put(ChannelRecord{c.bone, c.target, c.interpolation, c.times.size(), c.values.size()});
      out.put(c.times);
      out.put(c.values);
    }
  }
}

std::optional<Skeleton> readSkeleton(ValueReader& in, const SkeletonLimits& limits) {
  SkeletonHead head{};
  if (!in.get(head) || head.bones == 0 || head.bones > limits.bones || head.joints > limits.joints ||
      head.clips > limits.clips || head.weights > limits.weights)
    return {};
  Skeleton skeleton;
  for (std::uint32_t i = 0; i < head.bones; ++i)
    if (!readBone(in, i, skeleton.bones.emplace_back())) return {};
  for (std::uint32_t i = 0; i < head.joints; ++i) {
    JointRecord r{};
    Joint& joint = skeleton.joints.emplace_back();
    if (!in.get(r) || r.bone >= head.bones || !takeFinite(r.matrix, joint.X_BN.data())) return {};
    joint.bone = r.bone;
  }
  for (std::uint32_t i = 0; i < head.weights; ++i) {
    MorphWeight& w = skeleton.weights.emplace_back();
    if (!in.get(w.rest) || !std::isfinite(w.rest) || !getName(in, w.name)) return {};
  }
  std::uint64_t keysLeft = limits.keys;
  for (std::uint32_t i = 0; i < head.clips; ++i)
    if (!readClip(in, head, keysLeft, skeleton.clips.emplace_back())) return {};
  return skeleton;
}

}  // namespace stadion
