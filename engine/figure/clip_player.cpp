#include "engine/figure/clip_player.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kShortest = 1e-3;  ///< shortest pass of a loop [s]
constexpr double kMostTurned = 64;  ///< a loop that passes more often between two times has no turns

double seconds(Nanoseconds time) {
  return static_cast<double>(time) * 1e-9;
}

}  // namespace

void ClipPlayer::play(const Start& start, Nanoseconds when) {
  resume(when);
  if (start.fade <= 0) layers_.clear();
  // The lowest has the most weight, so the one above it goes.
  if (layers_.size() == FigureRecord::kMostLayers) layers_.erase(layers_.begin() + 1);
  Layer layer;
  layer.clip = start.clip;
  layer.length = start.length;
  layer.speed = start.speed;
  layer.start = start.speed < 0 && start.at == 0 ? start.length : start.at;
  layer.loop = start.loop && start.length >= kShortest;
  layer.since = when;
  layer.fade = std::max<Nanoseconds>(start.fade, 0);
  layers_.push_back(layer);
}

void ClipPlayer::pause(Nanoseconds when) {
  if (!paused()) pausedAt_ = when;
}

void ClipPlayer::resume(Nanoseconds when) {
  if (!paused()) return;
  for (Layer& layer : layers_) layer.since += when - pausedAt_;
  pausedAt_ = -1;
}

void ClipPlayer::stop() {
  layers_.clear();
  pausedAt_ = -1;
}

Nanoseconds ClipPlayer::reached(Nanoseconds time) const {
  return paused() ? std::min(time, pausedAt_) : time;
}

double ClipPlayer::timeIn(const Layer& layer, Nanoseconds time) {
  const double t = layer.start + layer.speed * seconds(time - layer.since);
  if (!layer.loop) return std::clamp(t, 0.0, layer.length);
  double within = t - std::floor(t / layer.length) * layer.length;
  if (layer.speed < 0 && within == 0) within = layer.length;  // a pass backwards begins at the end
  return std::clamp(within, 0.0, layer.length);
}

double ClipPlayer::weightOf(const Layer& layer, Nanoseconds time) {
  if (layer.fade == 0) return 1;
  return std::clamp(static_cast<double>(time - layer.since) / static_cast<double>(layer.fade), 0.0, 1.0);
}

/// When the pass that is under way ends; nothing if none does.
std::optional<Nanoseconds> ClipPlayer::endOf(const Layer& layer) {
  if (layer.ended || layer.speed == 0) return {};
  const double way = layer.speed > 0 ? layer.length - layer.start : layer.start;
  const double lasts = (way + layer.length * static_cast<double>(layer.passes)) / std::fabs(layer.speed);
  if (!(lasts < 9e9)) return {};
  return layer.since + std::llround(lasts * 1e9);
}

bool ClipPlayer::moves(Nanoseconds time) const {
  if (layers_.empty() || paused()) return false;
  const auto runs = [&](const Layer& l) { return (l.speed != 0 && !l.ended) || weightOf(l, time) < 1; };
  return std::any_of(layers_.begin() + static_cast<std::ptrdiff_t>(firstSeen(time)), layers_.end(), runs);
}

std::optional<ClipPlayer::End> ClipPlayer::takeEnd(Nanoseconds until) {
  if (layers_.empty()) return {};
  Layer& layer = layers_.back();
  const auto end = endOf(layer);
  if (!end || *end > reached(until)) return {};
  ++layer.passes;
  layer.ended = !layer.loop;
  return End{*end, layer.loop};
}

double ClipPlayer::endsUpTo(Nanoseconds time) const {
  if (layers_.empty()) return 0;
  const Layer& layer = layers_.back();
  const auto end = endOf(layer);
  if (!end || *end > time) return 0;
  return layer.loop ? seconds(time - *end) * std::fabs(layer.speed) / layer.length + 1 : 1;
}

std::size_t ClipPlayer::firstSeen(Nanoseconds time) const {
  std::size_t first = layers_.empty() ? 0 : layers_.size() - 1;
  while (first > 0 && weightOf(layers_[first], time) < 1) --first;
  return first;
}

void ClipPlayer::forget(Nanoseconds time) {
  layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(firstSeen(reached(time))));
}

FigureRecord ClipPlayer::at(Nanoseconds time) const {
  FigureRecord record;
  const Nanoseconds now = reached(time);
  for (std::size_t i = firstSeen(now); i < layers_.size(); ++i)
    record.layers[record.layerCount++] = {layers_[i].clip, static_cast<float>(weightOf(layers_[i], now)),
                                          timeIn(layers_[i], now)};
  return record;
}

void ClipPlayer::turns(const Skeleton& skeleton, Nanoseconds from, Nanoseconds to,
                       std::vector<Nanoseconds>& times) const {
  const Nanoseconds end = reached(to);
  const auto add = [&](Nanoseconds time) {
    if (time > from && time <= end) times.push_back(time);
  };
  if (paused()) add(pausedAt_);
  for (std::size_t i = firstSeen(from); i < layers_.size(); ++i) {
    add(layers_[i].since);
    add(layers_[i].since + layers_[i].fade);
    if (layers_[i].clip < skeleton.clips.size())
      addKeys(layers_[i], skeleton.clips[layers_[i].clip], from, end, times);
  }
}

void ClipPlayer::addKeys(const Layer& layer, const Clip& clip, Nanoseconds from, Nanoseconds to,
                         std::vector<Nanoseconds>& times) {
  if (layer.speed == 0 || from >= to) return;
  const auto unwrapped = [&](Nanoseconds time) {
    return layer.start + layer.speed * seconds(time - layer.since);
  };
  const double first = std::min(unwrapped(from), unwrapped(to)),
               last = std::max(unwrapped(from), unwrapped(to));
  const auto addAt = [&](double clipTime) {
    const double lasts = (clipTime - layer.start) / layer.speed;
    if (!(std::fabs(lasts) < 9e9)) return;
    const Nanoseconds time = layer.since + std::llround(lasts * 1e9);
    if (time > from && time <= to) times.push_back(time);
  };
  const auto addPass = [&](double begins) {
    addAt(begins);
    addAt(begins + layer.length);
    for (const ClipChannel& channel : clip.channels)
      for (auto key = std::ranges::lower_bound(channel.times, first - begins);
           key != channel.times.end() && *key <= last - begins; ++key)
        addAt(begins + *key);
  };
  if (!layer.loop) return addPass(0);
  if (last - first > kMostTurned * layer.length) return;
  for (double pass = std::floor(first / layer.length); pass * layer.length <= last; ++pass)
    addPass(pass * layer.length);
}

bool ClipPlayer::fits(std::size_t clips) const {
  return layers_.size() <= FigureRecord::kMostLayers && std::ranges::all_of(layers_, [&](const Layer& l) {
           return l.clip < clips && std::isfinite(l.start) && std::isfinite(l.speed) &&
                  std::isfinite(l.length) && (!l.loop || l.length >= kShortest) && l.fade >= 0;
         });
}

}  // namespace stadion
