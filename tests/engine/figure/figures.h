#pragma once
// Skeletons for tests.

#include "engine/figure/skeleton.h"

#include <random>

namespace stadion::test {

inline Affine moved(double x, double y, double z) {
  Affine X = Affine::Identity();
  X.translation() = Vec3(x, y, z);
  return X;
}

inline Bone bone(const char* name, std::int32_t parent, const Affine& X_PB) {
  Bone b;
  b.name = name;
  b.parent = parent;
  b.X_PB = X_PB;
  b.rest.translation = X_PB.translation();
  b.rest.rotation = Quat(X_PB.linear());
  return b;
}

inline ClipChannel channel(std::uint32_t bone, ChannelTarget target, Interpolation how,
                           std::vector<float> times, std::vector<float> values) {
  return {bone, target, how, std::move(times), std::move(values)};
}

/// A chain of bones, each a metre above the one before, and a joint for each.
inline Skeleton chain(int bones) {
  Skeleton s;
  for (int i = 0; i < bones; ++i) {
    s.bones.push_back(bone("b", i - 1, i == 0 ? Affine::Identity() : moved(0, 0, 1)));
    s.joints.push_back({static_cast<std::uint32_t>(i), moved(0, 0, -i)});
  }
  return s;
}

/// Numbers from a generator that is the same everywhere.
class RandomKeys {
public:
  explicit RandomKeys(unsigned seed) : engine_(seed) {}
  float in(double low, double high) {
    return static_cast<float>(low + (high - low) * (static_cast<double>(engine_()) / 4294967295.0));
  }
  std::vector<float> many(std::size_t count, double low, double high) {
    std::vector<float> values(count);
    for (float& v : values) v = in(low, high);
    return values;
  }

private:
  std::mt19937 engine_;
};

/// Clips of all properties and interpolations, with random keys, on each bone.
inline Clip wildClip(const Skeleton& skeleton, unsigned seed) {
  RandomKeys random(seed);
  Clip clip{"wild" + std::to_string(seed), 0, {}};
  for (std::uint32_t b = 0; b < skeleton.bones.size(); ++b)
    for (const ChannelTarget target :
         {ChannelTarget::Translation, ChannelTarget::Rotation, ChannelTarget::Scale}) {
      if (random.in(0, 1) < 0.3f) continue;
      ClipChannel c{b, target, static_cast<Interpolation>(static_cast<int>(random.in(0, 2.999))), {}, {}};
      for (float t = random.in(0, 0.2); t < 2; t += random.in(0.05, 0.6)) c.times.push_back(t);
      const std::size_t each = c.width() * (c.interpolation == Interpolation::Cubic ? 3 : 1);
      const double low = target == ChannelTarget::Scale ? 0.5 : -1;
      c.values = random.many(c.times.size() * each, low, target == ChannelTarget::Scale ? 1.2 : 1);
      clip.length = std::max(clip.length, double{c.times.back()});
      clip.channels.push_back(std::move(c));
    }
  return clip;
}

}  // namespace stadion::test
