#include "engine/input/input_log.h"

#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {
namespace {

void copy(const InputStamp& stamp, TrackerSample& sample) {
  sample.X_RT = stamp.X_RT;
  sample.buttons = stamp.buttons;
  sample.axes = stamp.axes;
  sample.valid = stamp.valid;
}

/// Between two stamps, a.time < time < b.time.
void blend(const InputStamp& a, const InputStamp& b, Nanoseconds time, TrackerSample& sample) {
  copy(a, sample);
  if (!a.valid || !b.valid) return;  // a lost tracker stays where it was last seen
  const double linear = static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time);
  const double s = b.smooth ? linear * linear * (3 - 2 * linear) : linear;
  sample.X_RT = det::interpolate(a.X_RT, b.X_RT, s);
  for (std::size_t i = 0; i < kTrackerAxes; ++i)
    sample.axes[i] = static_cast<float>(a.axes[i] + s * (static_cast<double>(b.axes[i]) - a.axes[i]));
}

void sampleTrack(const InputTrack& track, Nanoseconds time, TrackerSample& sample) {
  sample.name = track.name;
  sample.stamp = time;
  const auto after = std::ranges::upper_bound(track.stamps, time, {}, &InputStamp::time);
  if (after == track.stamps.begin()) return copy(*after, sample);
  const InputStamp& before = *(after - 1);
  if (before.time == time || after == track.stamps.end()) return copy(before, sample);
  blend(before, *after, time, sample);
}

}  // namespace

const InputTrack* InputLog::find(std::string_view name) const {
  const auto it = std::ranges::find(tracks, name, &InputTrack::name);
  return it == tracks.end() ? nullptr : &*it;
}

Nanoseconds InputLog::end() const {
  Nanoseconds last = decisions.end();
  for (const InputTrack& track : tracks) last = std::max(last, track.stamps.back().time);
  return last;
}

void InputLog::sampleAt(Nanoseconds showTime, InputSample& sample) const {
  sample.time = showTime;
  sample.trackers.resize(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) sampleTrack(tracks[i], showTime, sample.trackers[i]);
}

}  // namespace stadion
