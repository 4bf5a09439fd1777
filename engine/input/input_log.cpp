#include "engine/input/input_log.h"

#include "engine/input/tracker_jump.h"
#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {
namespace {

void copy(const InputStamp& stamp, TrackerSample& sample) {
  sample.X_RT = stamp.X_RT;
  sample.buttons = stamp.buttons;
  sample.axes = stamp.axes;
  sample.valid = stamp.valid;
  sample.controlsOnly = stamp.controlsOnly;
}

/// Whether the device was heard all the way from a to b, with a pose or without.
bool wholeWay(const InputStamp& a, const InputStamp& b) {
  return a.valid == b.valid && a.controlsOnly == b.controlsOnly && (a.valid || a.controlsOnly);
}

constexpr Nanoseconds kEasedGrid = 5'000'000;  ///< corners of an eased way fall on multiples of this [ns]
constexpr std::size_t kMostKnots = 1000;       ///< of one tracker in one frame; what comes after is cut

/// Returns the velocity from the previous stamp to `i`; nothing if it is not known.
Vec3 velocityTo(const InputTrack& track, std::size_t i) {
  if (i == 0 || i >= track.stamps.size()) return Vec3::Zero();
  const InputStamp &a = track.stamps[i - 1], &b = track.stamps[i];
  return a.valid && b.valid ? Vec3((b.X_RT.p - a.X_RT.p) / toSeconds(b.time - a.time)) : Vec3::Zero();
}

/// Returns true if it reached stamp `i` as no hand or foot can: in one step, faster than before and after.
bool jumps(const InputTrack& track, std::size_t i) {
  if (i == 0 || i >= track.stamps.size() || track.stamps[i].smooth) return false;
  const Nanoseconds took = track.stamps[i].time - track.stamps[i - 1].time;
  const Vec3 v = velocityTo(track, i);
  return jumpsBeside(v, velocityTo(track, i - 1), took) && jumpsBeside(v, velocityTo(track, i + 1), took);
}

double share(const InputStamp& a, const InputStamp& b, Nanoseconds time) {
  return static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time);
}

double eased(const InputStamp& a, const InputStamp& b, Nanoseconds time) {
  const double s = share(a, b, time);
  return s * s * (3 - 2 * s);
}

/// How much of the way from a to b is done. An eased way is straight between its corners.
double progress(const InputStamp& a, const InputStamp& b, Nanoseconds time) {
  if (!b.smooth) return share(a, b, time);
  const Nanoseconds corner = time / kEasedGrid * kEasedGrid;
  const Nanoseconds from = std::max(corner, a.time), to = std::min(corner + kEasedGrid, b.time);
  if (time == from) return eased(a, b, time);
  const double part = static_cast<double>(time - from) / static_cast<double>(to - from);
  return eased(a, b, from) + part * (eased(a, b, to) - eased(a, b, from));
}

/// Between two stamps, a.time < time < b.time; `jump`: it does not move, but is at b from b.time on.
void blend(const InputStamp& a, const InputStamp& b, Nanoseconds time, bool jump, TrackerSample& sample) {
  copy(a, sample);
  if (!wholeWay(a, b)) return;  // a lost tracker stays at its last known place
  const double s = progress(a, b, time);
  if (!jump && a.valid) sample.X_RT = det::interpolate(a.X_RT, b.X_RT, s);
  for (std::size_t i = 0; i < kTrackerAxes; ++i)
    sample.axes[i] = static_cast<float>(a.axes[i] + s * (static_cast<double>(b.axes[i]) - a.axes[i]));
}

void sampleTrack(const InputTrack& track, Nanoseconds time, TrackerSample& sample) {
  sample.stamp = time;
  sample.measured = 0;
  sample.knots.clear();
  sample.controls.clear();
  const auto after = std::ranges::upper_bound(track.stamps, time, {}, &InputStamp::time);
  if (after == track.stamps.begin()) return copy(*after, sample);
  const InputStamp& before = *(after - 1);
  if (before.time == time || after == track.stamps.end()) return copy(before, sample);
  blend(before, *after, time, jumps(track, static_cast<std::size_t>(after - track.stamps.begin())), sample);
}

bool samePose(const Pose& a, const Pose& b) {
  return a.p == b.p && a.q.coeffs() == b.q.coeffs();
}

/// The corners between a and b, and b itself, as far as they lie strictly inside the frame.
void addKnots(const InputStamp& a, const InputStamp& b, bool jump, Nanoseconds start, Nanoseconds end,
              PoseTrack& knots) {
  const bool whole = a.valid && b.valid;
  if (whole && b.smooth && !(samePose(a.X_RT, b.X_RT) && a.axes == b.axes)) {
    const Nanoseconds after = std::max(a.time, start), before = std::min(b.time, end);
    for (Nanoseconds t = (after / kEasedGrid + 1) * kEasedGrid; t < before && knots.size() < kMostKnots;
         t += kEasedGrid)
      knots.push_back({t, det::interpolate(a.X_RT, b.X_RT, eased(a, b, t)), false});
  }
  // Lost and found it has jumped.
  const bool jumped = !whole || jump;
  if (b.time > start && (b.time < end || (b.time == end && jumped)) && b.valid && knots.size() < kMostKnots)
    knots.push_back({b.time, b.X_RT, jumped});
}

/// What the buttons and axes do on the way from a to b, and at b, as far as it lies inside the frame. The
/// axes of a tracker that is lost or found do not go evenly: they jump.
void addControls(const InputStamp& a, const InputStamp& b, Nanoseconds start, Nanoseconds end,
                 std::vector<ControlKnot>& controls) {
  const bool whole = wholeWay(a, b);
  if (whole && b.smooth && a.axes != b.axes) {
    const Nanoseconds after = std::max(a.time, start), before = std::min(b.time, end);
    for (Nanoseconds t = (after / kEasedGrid + 1) * kEasedGrid; t < before && controls.size() < kMostKnots;
         t += kEasedGrid) {
      TrackerSample at;
      blend(a, b, t, false, at);
      controls.push_back({t, at.buttons, at.axes});
    }
  }
  if (b.time <= start || b.time > end || controls.size() >= kMostKnots) return;
  if (!whole) controls.push_back({b.time, a.buttons, a.axes});
  if (b.time < end) controls.push_back({b.time, b.buttons, b.axes});
}

void addControls(const InputTrack& track, Nanoseconds start, Nanoseconds end,
                 std::vector<ControlKnot>& controls) {
  TrackerSample first;
  sampleTrack(track, start, first);
  controls.push_back({start, first.buttons, first.axes});
  auto next = std::ranges::upper_bound(track.stamps, start, {}, &InputStamp::time);
  if (next == track.stamps.begin()) {  // before the first it is as it is there
    if (next->time < end) controls.push_back({next->time, next->buttons, next->axes});
    ++next;
  }
  for (; next != track.stamps.end() && (next - 1)->time < end && controls.size() < kMostKnots; ++next)
    addControls(*(next - 1), *next, start, end, controls);
}

/// Records at which neither buttons nor axes change say nothing.
void dropIdle(std::vector<ControlKnot>& controls, const std::array<float, kTrackerAxes>& last) {
  std::size_t kept = 1;
  for (std::size_t i = 1; i < controls.size(); ++i) {
    const ControlKnot &before = controls[kept - 1], &k = controls[i];
    const auto& next = i + 1 < controls.size() ? controls[i + 1].axes : last;
    if (k.buttons == before.buttons && k.axes == before.axes && k.axes == next) continue;
    controls[kept++] = k;
  }
  controls.resize(kept);
}

void addKnots(const InputTrack& track, Nanoseconds start, Nanoseconds end, PoseTrack& knots) {
  auto next = std::ranges::upper_bound(track.stamps, start, {}, &InputStamp::time);
  if (next == track.stamps.begin()) {  // nothing moves before the first
    if (next->valid && next->time < end) knots.push_back({next->time, next->X_RT, false});
    ++next;
  }
  for (; next != track.stamps.end() && (next - 1)->time < end && knots.size() < kMostKnots; ++next)
    addKnots(*(next - 1), *next, jumps(track, static_cast<std::size_t>(next - track.stamps.begin())), start,
             end, knots);
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
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    sample.trackers[i].name = tracks[i].name;
    sampleTrack(tracks[i], showTime, sample.trackers[i]);
  }
}

void InputLog::sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) const {
  sampleAt(end, sample);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    addKnots(tracks[i], start, end, sample.trackers[i].knots);
    addControls(tracks[i], start, end, sample.trackers[i].controls);
    dropIdle(sample.trackers[i].controls, sample.trackers[i].axes);
  }
}

}  // namespace stadion
