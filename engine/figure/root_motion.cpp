#include "engine/figure/root_motion.h"

#include "engine/figure/clip_sampler.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr Nanoseconds kFadeStep = 10'000'000;  ///< of a cross-fade [ns]
constexpr Nanoseconds kMostFadeSteps = 1000;   ///< a longer one has longer steps

GroundMove mixedWay(const GroundMove& under, const GroundMove& over, double weight) {
  return {under.x + weight * (over.x - under.x), under.y + weight * (over.y - under.y),
          under.turn + weight * (over.turn - under.turn)};
}

/// How far the blended clips take the bone.
GroundMove blendedWay(Nanoseconds from, Nanoseconds to, const ClipPlayer& player, const RootPath& path) {
  GroundMove way;
  for (const ClipPlayer::Stretch& s : player.stretches(from, to)) way = mixedWay(way, path.way(s), s.weight);
  return way;
}

}  // namespace

RootPath::RootPath(const Skeleton& skeleton, std::uint32_t bone) : bone_(bone) {
  std::vector<std::uint32_t> numbers;
  for (auto i = static_cast<std::int32_t>(bone); i >= 0;
       i = skeleton.bones[static_cast<std::size_t>(i)].parent)
    numbers.insert(numbers.begin(), static_cast<std::uint32_t>(i));
  for (const std::uint32_t i : numbers) {
    chain_.push_back(skeleton.bones[i]);
    atRest_ = atRest_ * skeleton.bones[i].X_PB;
  }
  for (const Clip& clip : skeleton.clips) {
    Clip& own = clips_.emplace_back();
    std::vector<char>& moved = moved_.emplace_back(chain_.size(), char{0});
    for (const ClipChannel& channel : clip.channels) {
      const auto at = std::ranges::find(numbers, channel.bone);
      if (channel.target == ChannelTarget::Weights || at == numbers.end()) continue;
      own.channels.push_back(channel);
      own.channels.back().bone = static_cast<std::uint32_t>(at - numbers.begin());
      moved[own.channels.back().bone] = 1;
    }
    begin_.push_back(this->at(clips_.size() - 1, 0));
    pass_.push_back(groundMoveBetween(begin_.back(), this->at(clips_.size() - 1, clip.length)));
  }
}

GroundMove RootPath::at(std::size_t clip, double time) const {
  std::vector<BonePlace> places;
  places.reserve(chain_.size());
  for (const Bone& bone : chain_) places.push_back(bone.rest);
  sampleClip(clips_[clip], time, places);
  Affine X_NB = Affine::Identity();
  for (std::size_t i = 0; i < chain_.size(); ++i)
    X_NB = X_NB * (moved_[clip][i] ? places[i].matrix() : chain_[i].X_PB);
  return groundMoveOf(X_NB, atRest_);
}

/// From the beginning of a clip, over the passes of a loop.
GroundMove RootPath::sinceBegin(const ClipPlayer::Stretch& s, double time) const {
  if (!s.loop) return groundMoveBetween(begin_[s.clip], at(s.clip, std::clamp(time, 0.0, s.length)));
  const double pass = std::floor(time / s.length);
  const double within = std::clamp(time - pass * s.length, 0.0, s.length);
  return groundMovePower(pass_[s.clip], static_cast<std::int64_t>(pass)) *
         groundMoveBetween(begin_[s.clip], at(s.clip, within));
}

GroundMove RootPath::way(const ClipPlayer::Stretch& s) const {
  if (s.clip >= clips_.size() || s.from == s.to || clips_[s.clip].channels.empty()) return {};
  return groundMoveBetween(sinceBegin(s, s.from), sinceBegin(s, s.to));
}

void RootMotion::begin(const Pose& X_PN, Nanoseconds when) {
  X_PN_ = X_PN;
  since_ = when;
  reached_ = {};
}

/// In steps on a grid that begins at `from`; the last one may end between its points. `end`: of the cross-fade.
GroundMove RootMotion::fadedWay(Nanoseconds from, Nanoseconds end, Nanoseconds to, const ClipPlayer& player,
                                const RootPath& path) const {
  const Nanoseconds step = std::max(kFadeStep, (end - from) / kMostFadeSteps);
  if (reached_.from != from || reached_.time > to) reached_ = {from, from, {}};
  while (reached_.time + step <= to) {
    reached_.way = reached_.way * blendedWay(reached_.time, reached_.time + step, player, path);
    reached_.time += step;
  }
  if (reached_.time == to) return reached_.way;
  return reached_.way * blendedWay(reached_.time, to, player, path);
}

/// The scale stays along the node's own axes.
Pose RootMotion::moved(const Pose& X_PN, const GroundMove& way, const Vec3& scale) {
  const Pose X = way.pose();
  return X_PN * Pose{scale.cwiseProduct(X.p), X.q};
}

Pose RootMotion::at(Nanoseconds time, const ClipPlayer& player, const RootPath& path,
                    const Vec3& scale) const {
  const Nanoseconds to = player.reached(time);
  Pose X_PN = X_PN_;
  for (Nanoseconds from = since_; from < to;) {
    const auto end = player.nextReplaced(from);
    if (!end) return moved(X_PN, blendedWay(from, to, player, path), scale);
    const Nanoseconds until = std::min(*end, to);
    X_PN = moved(X_PN, fadedWay(from, *end, until, player, path), scale);
    from = until;
  }
  return X_PN;
}

void RootMotion::settle(Nanoseconds time, const ClipPlayer& player, const RootPath& path, const Vec3& scale) {
  begin(at(time, player, path, scale), time);
}

void RootMotion::forget(Nanoseconds time, const ClipPlayer& player, const RootPath& path, const Vec3& scale) {
  const Nanoseconds to = player.reached(time);
  for (auto end = player.nextReplaced(since_); end && *end <= to; end = player.nextReplaced(since_))
    settle(*end, player, path, scale);
}

}  // namespace stadion
