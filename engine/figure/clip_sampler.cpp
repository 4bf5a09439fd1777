#include "engine/figure/clip_sampler.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

using Value = std::array<double, 4>;

/// Which of a cubic key's values.
constexpr std::size_t kTangentIn = 0, kValue = 1, kTangentOut = 2;

class Keys {
public:
  explicit Keys(const ClipChannel& channel)
      : channel_(channel), width_(channel.width()),
        parts_(channel.interpolation == Interpolation::Cubic ? 3 : 1) {}

  Value at(std::size_t key) const { return part(key, parts_ == 3 ? kValue : 0); }
  Value part(std::size_t key, std::size_t which) const {
    Value v{};
    const float* from = channel_.values.data() + (key * parts_ + which) * width_;
    std::copy_n(from, width_, v.begin());
    return v;
  }

private:
  const ClipChannel& channel_;
  std::size_t width_, parts_;
};

Quat quatOf(const Value& v) {
  const Quat q(v[3], v[0], v[1], v[2]);
  const double length = q.norm();
  return length > 1e-12 ? Quat(q.coeffs() / length) : Quat::Identity();
}

Value valueOf(const Quat& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

Value linear(const Value& a, const Value& b, double s) {
  Value v{};
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = a[k] + s * (b[k] - a[k]);
  return v;
}

/// The Hermite spline of glTF: tangents are for one second.
Value cubic(const Keys& keys, std::size_t key, double s, double interval) {
  const Value p0 = keys.part(key, kValue), m0 = keys.part(key, kTangentOut);
  const Value p1 = keys.part(key + 1, kValue), m1 = keys.part(key + 1, kTangentIn);
  const double s2 = s * s, s3 = s2 * s;
  Value v{};
  for (std::size_t k = 0; k < v.size(); ++k)
    v[k] = (2 * s3 - 3 * s2 + 1) * p0[k] + interval * (s3 - 2 * s2 + s) * m0[k] + (3 * s2 - 2 * s3) * p1[k] +
           interval * (s3 - s2) * m1[k];
  return v;
}

Value between(const ClipChannel& channel, const Keys& keys, std::size_t key, double time) {
  const double from = double{channel.times[key]}, interval = double{channel.times[key + 1]} - from;
  const double s = interval > 0 ? (time - from) / interval : 0;
  if (channel.interpolation == Interpolation::Step) return keys.at(key);
  if (channel.interpolation == Interpolation::Cubic) return cubic(keys, key, s, interval);
  if (channel.target == ChannelTarget::Rotation)
    return valueOf(det::slerp(quatOf(keys.at(key)), quatOf(keys.at(key + 1)), s));
  return linear(keys.at(key), keys.at(key + 1), s);
}

}  // namespace

std::array<double, 4> sampleChannel(const ClipChannel& channel, double time) {
  const Keys keys(channel);
  const auto& times = channel.times;
  const auto after =
      std::upper_bound(times.begin(), times.end(), time, [](double t, float key) { return t < double{key}; });
  const auto next = static_cast<std::size_t>(after - times.begin());
  const Value v = next == 0              ? keys.at(0)
                  : next == times.size() ? keys.at(next - 1)
                                         : between(channel, keys, next - 1, time);
  return channel.target == ChannelTarget::Rotation ? valueOf(quatOf(v)) : v;
}

void sampleClip(const Clip& clip, double time, std::span<BonePlace> places) {
  for (const ClipChannel& channel : clip.channels) {
    if (channel.target == ChannelTarget::Weights) continue;
    const Value v = sampleChannel(channel, time);
    BonePlace& place = places[channel.bone];
    switch (channel.target) {
    case ChannelTarget::Translation: place.translation = {v[0], v[1], v[2]}; break;
    case ChannelTarget::Rotation: place.rotation = quatOf(v); break;
    case ChannelTarget::Scale: place.scale = {v[0], v[1], v[2]}; break;
    case ChannelTarget::Weights: break;
    }
  }
}

double scaleGrowth(double begin, double now) {
  constexpr double kLeast = 1e-6;  // nothing grows from less
  return std::fabs(begin) < kLeast ? 1 : now / begin;
}

void sampleWeights(const Clip& clip, double time, std::span<double> weights) {
  for (const ClipChannel& channel : clip.channels)
    if (channel.target == ChannelTarget::Weights) weights[channel.bone] = sampleChannel(channel, time)[0];
}

}  // namespace stadion
