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

ClipPlayer::Layer ClipPlayer::layerOf(const Start& start, Nanoseconds when) {
  Layer layer;
  layer.clip = start.clip;
  layer.length = start.length;
  layer.speed = start.speed;
  layer.start = start.speed < 0 && start.at == 0 ? start.length : start.at;
  layer.loop = start.loop && start.length >= kShortest * std::max(1.0, std::fabs(start.speed));
  layer.since = when;
  layer.fade = std::max<Nanoseconds>(start.fade, 0);
  return layer;
}

void ClipPlayer::play(const Start& start, Nanoseconds when) {
  resume(when);
  if (start.fade <= 0) layers_.clear();
  // The lowest has the most weight, so the one above it goes.
  if (layers_.size() == FigureRecord::kMostLayers) layers_.erase(layers_.begin() + 1);
  layers_.push_back(layerOf(start, when));
}

void ClipPlayer::addLayer(const Start& start, Nanoseconds when) {
  removeLayers(start.clip, std::max<Nanoseconds>(start.fade, 0), when);
  if (added_.size() == FigureRecord::kMostAdded) added_.erase(added_.begin());
  added_.push_back({layerOf(start, reached(when)), start.weight});
}

void ClipPlayer::removeLayers(std::optional<std::uint32_t> clip, Nanoseconds fade, Nanoseconds when) {
  const Nanoseconds now = reached(when);
  std::erase_if(added_, [&](const Added& a) { return a.goneAt(now); });
  for (Added& a : added_)
    if (a.outSince < 0 && (!clip || a.layer.clip == *clip)) a.outSince = now, a.outFade = fade;
  std::erase_if(added_, [&](const Added& a) { return a.goneAt(now); });
}

void ClipPlayer::pause(Nanoseconds when) {
  if (!paused()) pausedAt_ = when;
}

void ClipPlayer::resume(Nanoseconds when) {
  if (!paused()) return;
  const Nanoseconds paused = when - pausedAt_;
  for (Layer& layer : layers_) layer.since += paused;
  for (Added& a : added_) {
    a.layer.since += paused;
    if (a.outSince >= 0) a.outSince += paused;
  }
  pausedAt_ = -1;
}

void ClipPlayer::stop() {
  layers_.clear();
  added_.clear();
  pausedAt_ = -1;
}

Nanoseconds ClipPlayer::reached(Nanoseconds time) const {
  return paused() ? std::min(time, pausedAt_) : time;
}

double ClipPlayer::unwrapped(const Layer& layer, Nanoseconds time) {
  return layer.start + layer.speed * seconds(time - layer.since);
}

double ClipPlayer::timeIn(const Layer& layer, Nanoseconds time) {
  const double t = unwrapped(layer, time);
  if (!layer.loop) return std::clamp(t, 0.0, layer.length);
  double within = t - std::floor(t / layer.length) * layer.length;
  if (layer.speed < 0 && within == 0) within = layer.length;  // a pass backwards begins at the end
  return std::clamp(within, 0.0, layer.length);
}

double ClipPlayer::weightOf(const Layer& layer, Nanoseconds time) {
  if (layer.fade == 0) return 1;
  return std::clamp(static_cast<double>(time - layer.since) / static_cast<double>(layer.fade), 0.0, 1.0);
}

double ClipPlayer::Added::weightAt(Nanoseconds time) const {
  double share = weight * weightOf(layer, time);
  if (outSince < 0 || time < outSince) return share;
  if (goneAt(time)) return 0;
  return share * (1 - static_cast<double>(time - outSince) / static_cast<double>(outFade));
}

/// When the pass that is under way ends; nothing if none does.
std::optional<Nanoseconds> ClipPlayer::endOf(const Layer& layer) {
  if (layer.ended || layer.speed == 0) return {};
  return endOf(layer, layer.passes);
}

/// When a pass ends, counted from 0; nothing if that is beyond all times.
std::optional<Nanoseconds> ClipPlayer::endOf(const Layer& layer, std::uint64_t pass) {
  const double way = layer.speed > 0 ? layer.length - layer.start : layer.start;
  return after(layer, way + layer.length * static_cast<double>(pass));
}

/// When it has played so many seconds of its clip.
std::optional<Nanoseconds> ClipPlayer::after(const Layer& layer, double way) {
  const double lasts = way / std::fabs(layer.speed);
  if (!(lasts < 9e9)) return {};
  return layer.since + std::llround(lasts * 1e9);
}

/// The next marker that it passes, and when; nothing if there is none.
std::optional<ClipPlayer::Coming> ClipPlayer::nextMarker(const Layer& layer, const ClipMarkers& markers) {
  if (layer.speed == 0) return {};
  const std::span<const std::size_t> order = markers.of(layer.clip, layer.speed < 0);
  if (order.empty()) return {};
  const auto ahead = [&](std::size_t number) {  // of the start, in the first pass
    const double at = markers[number].at;
    return layer.speed > 0 ? at - layer.start : layer.start - at;
  };
  const auto first = static_cast<std::uint64_t>(
      std::ranges::find_if(order, [&](std::size_t number) { return ahead(number) >= 0; }) - order.begin());
  Coming next;
  next.pass = (first + layer.told) / order.size();
  next.marker = order[(first + layer.told) % order.size()];
  if (next.pass > 0 && !layer.loop) return {};
  double way = ahead(next.marker);
  if (next.pass > 0) {
    const double at = markers[next.marker].at;
    way = layer.speed > 0 ? layer.length - layer.start : layer.start;
    way += layer.length * static_cast<double>(next.pass - 1) + (layer.speed > 0 ? at : layer.length - at);
  }
  const auto when = after(layer, way), end = endOf(layer, next.pass);
  if (!when || !end) return {};
  next.when = std::min(*when, *end);
  return next;
}

std::optional<ClipPlayer::Passed> ClipPlayer::takeMarker(const ClipMarkers& markers, Nanoseconds until) {
  if (markers.size() == 0) return {};
  Layer* of = nullptr;
  std::optional<Coming> next;
  const auto look = [&](Layer& layer) {
    const auto coming = nextMarker(layer, markers);
    if (coming && (!next || coming->when < next->when)) next = coming, of = &layer;
  };
  std::optional<Nanoseconds> end;
  if (!layers_.empty()) look(layers_.back()), end = endOf(layers_.back());
  const bool waits = next && end && next->pass > layers_.back().passes;
  if (waits) next.reset();
  for (Added& a : added_) {
    const bool begins = paused() && a.layer.since >= pausedAt_;  // when the pause is over
    if (a.outSince < 0 && !begins) look(a.layer);
  }
  if (!next || next->when > reached(until)) return {};
  if (end && of != &layers_.back() && *end <= next->when) return {};  // that comes first
  ++of->told;
  return Passed{next->when, next->marker};
}

bool ClipPlayer::moves(Nanoseconds time) const {
  if (paused()) return false;
  const auto runs = [&](const Layer& l) { return (l.speed != 0 && !l.ended) || weightOf(l, time) < 1; };
  const auto adds = [&](const Added& a) {
    const auto end = a.layer.loop ? std::nullopt : endOf(a.layer);
    return (a.layer.speed != 0 && (!end || *end > time)) || weightOf(a.layer, time) < 1 || a.outSince >= 0;
  };
  return std::any_of(layers_.begin() + static_cast<std::ptrdiff_t>(firstSeen(time)), layers_.end(), runs) ||
         std::ranges::any_of(added_, adds);
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

double ClipPlayer::markersUpTo(const ClipMarkers& markers, Nanoseconds time) const {
  double sum = 0;
  const auto count = [&](const Layer& l) {
    const std::size_t each = markers.of(l.clip, l.speed < 0).size();
    if (each == 0 || l.speed == 0) return;
    const double passes = l.loop ? seconds(time - l.since) * std::fabs(l.speed) / l.length + 1 : 1;
    sum += std::max(0.0, passes * static_cast<double>(each) - static_cast<double>(l.told));
  };
  if (!layers_.empty()) count(layers_.back());
  for (const Added& a : added_) count(a.layer);
  return sum;
}

std::size_t ClipPlayer::firstSeen(Nanoseconds time) const {
  std::size_t first = layers_.empty() ? 0 : layers_.size() - 1;
  while (first > 0 && weightOf(layers_[first], time) < 1) --first;
  return first;
}

void ClipPlayer::forget(Nanoseconds time) {
  const Nanoseconds now = reached(time);
  layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(firstSeen(now)));
  std::erase_if(added_, [&](const Added& a) { return a.goneAt(now); });
}

std::optional<Nanoseconds> ClipPlayer::nextReplaced(Nanoseconds time) const {
  std::optional<Nanoseconds> next;
  for (std::size_t i = firstSeen(time); i < layers_.size(); ++i)
    if (const Nanoseconds end = layers_[i].since + layers_[i].fade; end > time && (!next || end < *next))
      next = end;
  return next;
}

std::vector<ClipPlayer::Stretch> ClipPlayer::stretches(Nanoseconds from, Nanoseconds to) const {
  std::vector<Stretch> all;
  const Nanoseconds middle = from + (to - from) / 2;
  for (std::size_t i = firstSeen(middle); i < layers_.size(); ++i) {
    const Layer& l = layers_[i];
    all.push_back({l.clip, l.length, unwrapped(l, from), unwrapped(l, to), l.loop, weightOf(l, middle)});
  }
  return all;
}

FigureRecord ClipPlayer::at(Nanoseconds time) const {
  FigureRecord record;
  const Nanoseconds now = reached(time);
  for (std::size_t i = firstSeen(now); i < layers_.size(); ++i)
    record.layers[record.layerCount++] = {layers_[i].clip, static_cast<float>(weightOf(layers_[i], now)),
                                          timeIn(layers_[i], now)};
  for (const Added& a : added_)
    if (!a.goneAt(now) && record.addedCount < FigureRecord::kMostAdded)
      record.added[record.addedCount++] = {a.layer.clip, static_cast<float>(a.weightAt(now)),
                                           timeIn(a.layer, now)};
  return record;
}

void ClipPlayer::turns(const Skeleton& skeleton, Nanoseconds from, Nanoseconds to,
                       std::vector<Nanoseconds>& times) const {
  const Nanoseconds end = reached(to);
  const auto add = [&](Nanoseconds time) {
    if (time > from && time <= end) times.push_back(time);
  };
  if (paused()) add(pausedAt_);
  const auto addLayer = [&](const Layer& layer) {
    add(layer.since);
    add(layer.since + layer.fade);
    if (layer.clip < skeleton.clips.size()) addKeys(layer, skeleton.clips[layer.clip], from, end, times);
  };
  for (std::size_t i = firstSeen(from); i < layers_.size(); ++i) addLayer(layers_[i]);
  for (const Added& a : added_) {
    addLayer(a.layer);
    if (a.outSince >= 0) add(a.outSince), add(a.outSince + a.outFade);
  }
}

void ClipPlayer::addKeys(const Layer& layer, const Clip& clip, Nanoseconds from, Nanoseconds to,
                         std::vector<Nanoseconds>& times) {
  if (layer.speed == 0 || from >= to) return;
  const double first = std::min(unwrapped(layer, from), unwrapped(layer, to)),
               last = std::max(unwrapped(layer, from), unwrapped(layer, to));
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
  const auto fit = [&](const Layer& l) {
    return l.clip < clips && std::isfinite(l.start) && std::isfinite(l.speed) && std::isfinite(l.length) &&
           (!l.loop || l.length >= kShortest) && l.fade >= 0;
  };
  const auto fitsToo = [&](const Added& a) {
    return fit(a.layer) && std::isfinite(a.weight) && a.outFade >= 0;
  };
  return layers_.size() <= FigureRecord::kMostLayers && added_.size() <= FigureRecord::kMostAdded &&
         std::ranges::all_of(layers_, fit) && std::ranges::all_of(added_, fitsToo);
}

}  // namespace stadion
