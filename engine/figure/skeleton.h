#pragma once
/// The skeleton of a mesh: its bones at rest, what of the mesh each carries, and its clips.
///
/// A file's nodes are the bones, whether it calls them so or not. What hangs from a node without a skin is
/// carried by that node alone.
///
/// Frames   B: a bone. P: its parent bone; for a root the mesh's frame N (metres, +Z up).
/// Units    seconds of the clip; lengths in the parent's unit, roots bring them to metres.
/// Threads  immutable after import, as the mesh is.

#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

/// Where a bone is, as clips change it: X_PB = translation · rotation · scale.
struct BonePlace {
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
  Vec3 scale = Vec3::Ones();

  Affine matrix() const {
    Affine X;
    X.linear() = rotation.toRotationMatrix() * scale.asDiagonal();
    X.translation() = translation;
    return X;
  }
};

struct Bone {
  std::string name;
  std::int32_t parent = -1;          ///< a bone before this one; -1 = none
  Affine X_PB = Affine::Identity();  ///< at rest; may shear, which a BonePlace cannot
  BonePlace rest;                    ///< the same, for what a clip does not move
};

/// A bone as vertices name it. `X_BN` takes the mesh's coordinates to the bone's: it undoes the pose in which
/// the mesh was bound.
struct Joint {
  std::uint32_t bone = 0;
  Affine X_BN = Affine::Identity();
};

/// The joints that carry a vertex. Weights are not negative and their sum is 1.
struct VertexJoints {
  static constexpr std::size_t kMost = 4;
  std::array<std::uint16_t, kMost> joint{};
  std::array<float, kMost> weight{1, 0, 0, 0};

  bool operator==(const VertexJoints&) const = default;
};

/// What of a bone a channel moves.
enum class ChannelTarget : std::uint8_t { Translation, Rotation, Scale, Weights };
enum class Interpolation : std::uint8_t { Step, Linear, Cubic };

/// The weight of a morph target (morph.h).
struct MorphWeight {
  std::string name;
  float rest = 0;  ///< where no clip moves it
};

/// Keys of one property of a bone, as in glTF 2.0, section 3.11. Times ascend. Each key has three numbers, a
/// rotation four (x, y, z, w), a weight one. A cubic key has three such values: tangent in, value, tangent out.
struct ClipChannel {
  std::uint32_t bone = 0;  ///< of Weights: which of Skeleton::weights instead
  ChannelTarget target = ChannelTarget::Translation;
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> times;  ///< [s]
  std::vector<float> values;

  std::size_t width() const {
    return target == ChannelTarget::Rotation ? 4 : target == ChannelTarget::Weights ? 1 : 3;
  }
};

struct Clip {
  std::string name;
  double length = 0;  ///< time of its last key [s]
  std::vector<ClipChannel> channels;
};

struct Skeleton {
  std::vector<Bone> bones;  ///< parents before their children
  std::vector<Joint> joints;
  std::vector<Clip> clips;
  std::vector<MorphWeight> weights;
  /// Holds the origins and the carried vertices of all bones in N, whatever clips are played and blended. [m]
  Sphere reach;
  Sphere addedReach;  ///< the same with added layers
};

/// The most that a skeleton may hold.
struct SkeletonLimits {
  std::uint32_t bones = 4096, joints = 4096, clips = 1024, weights = 4096;
  std::uint64_t keys = 50'000'000;  ///< numbers of all keys
};

}  // namespace stadion
