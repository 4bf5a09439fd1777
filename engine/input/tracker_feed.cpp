#include "engine/input/tracker_feed.h"

#include "engine/input/head_forecast.h"
#include "engine/input/tracker_jump.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kFarthest = 1000;                         ///< from the tracking system's origin [m]
constexpr std::size_t kMostChanges = 64;                   ///< of one tracker in one frame
constexpr std::size_t kStampsKept = 16;                    ///< more than a frame adds and looks back
constexpr Nanoseconds kSilenceToldEvery = 10'000'000'000;  ///< of one tracker [ns]
constexpr double kKeptWithoutNews = 10;  ///< what a device without a pose holds, at most [s]
constexpr double kRepeatAfter = 0.2;  ///< a message that changes nothing so long after a change: a beat [s]
constexpr double kBeatsMissed = 3;    ///< of a device that repeats its state until it is lost

double eased(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

InputStamp lostAt(Nanoseconds time, const InputTrack& track) {
  InputStamp lost;
  lost.time = time;
  lost.valid = false;
  if (!track.stamps.empty()) lost.X_RT = track.stamps.back().X_RT;
  return lost;
}

Vec3 speedTo(const InputTrack& track, std::size_t i) {
  if (i == 0) return Vec3::Zero();
  const InputStamp &a = track.stamps[i - 1], &b = track.stamps[i];
  return a.valid && b.valid ? Vec3((b.X_RT.p - a.X_RT.p) / toSeconds(b.time - a.time)) : Vec3::Zero();
}

/// By how much the filter (one_euro_filter.h) lags behind what goes evenly: a low pass by 1 / (2 pi cutoff).
double lagAt(const RigFile& rig, double speed) {
  return rig.cutoff > 0 ? 1 / (2 * kPi * (rig.cutoff + rig.beta * speed)) : 0;
}

/// Returns true if the way from the last stamp to X at `time` may count as a jump when the log is read.
bool mayJump(const InputTrack& track, const Pose& X, Nanoseconds time) {
  const InputStamp& last = track.stamps.back();
  if (!last.valid) return false;
  const Vec3 v = (X.p - last.X_RT.p) / toSeconds(time - last.time);
  return jumpsBeside(v, speedTo(track, track.stamps.size() - 1), time - last.time);
}

}  // namespace

TrackerFeed::TrackerFeed(const RigFile& rig) : rig_(rig) {
  for (const RigTracker& t : rig_.trackers) {
    channels_.emplace_back(&t, OneEuroFilter(rig_.cutoff, rig_.beta));
  }
  restart();
}

void TrackerFeed::restart() {
  log_.tracks.clear();
  for (const RigTracker& t : rig_.trackers) log_.tracks.push_back({t.name, {lostAt(0, {})}});
  for (Channel& c : channels_) c.changes.clear();
  lastClock_ = 0;
}

TrackerFeed::Channel* TrackerFeed::channel(std::string_view name) {
  const auto at = std::ranges::find_if(channels_, [&](const Channel& c) { return c.tracker->name == name; });
  if (at != channels_.end()) return &*at;
  ++counts_.unknown;
  return nullptr;
}

bool TrackerFeed::heard(const Channel& c, Nanoseconds clock) const {
  return c.ever && toSeconds(clock - c.last) <= rig_.hold;
}

bool TrackerFeed::controlled(const Channel& c, Nanoseconds clock) const {
  if (c.ever || !c.controlled) return false;
  const double most = std::max(rig_.hold, std::min(kBeatsMissed * c.beat, kKeptWithoutNews));
  return c.beat == 0 || toSeconds(clock - c.lastControl) <= most;
}

std::vector<TrackerFeed::Reception> TrackerFeed::receptionChanges(Nanoseconds clock) {
  std::vector<Reception> news;
  for (Channel& c : channels_) {
    const bool now = there(c, clock);
    const bool ever = c.ever || c.controlled;
    const Nanoseconds last = c.ever ? c.last : c.lastControl;
    const bool toldLately = c.toldSilent && clock - *c.toldSilent < kSilenceToldEvery;
    if (!now && ever && !c.silentSince && !toldLately) {
      c.silentSince = last;
      c.toldSilent = clock;
      news.push_back({c.tracker->name, false, toSeconds(clock - last)});
    } else if (now && c.silentSince) {
      news.push_back({c.tracker->name, true, toSeconds(last - *c.silentSince)});
      c.silentSince.reset();
    }
  }
  return news;
}

bool TrackerFeed::pose(std::string_view name, Nanoseconds clock, const Pose& X_SD) {
  Channel* c = channel(name);
  if (!c) return false;
  const double squared = X_SD.q.squaredNorm();
  if (!X_SD.finite() || X_SD.p.cwiseAbs().maxCoeff() * rig_.unit > kFarthest || !(squared > 0.25) ||
      !(squared < 4))
    return refuse();
  if (c->ever && clock <= c->last) {
    ++counts_.late;
    return false;
  }
  const double dt = toSeconds(clock - c->last);
  if (!heard(*c, clock)) {
    c->from = c->ever ? poseAt(*c, clock).value_or(c->X_RT) : Pose();
    if (c->tracker->safe && (!c->ever || dt > rig_.hold + rig_.ease))
      c->from = {*c->tracker->safe, Quat::Identity()};
    c->found = clock;
    c->filter.reset();
    c->period = 0;
  } else {
    c->period = c->period == 0 ? dt : c->period + 0.1 * (dt - c->period);
  }
  c->X_SD = {X_SD.p, X_SD.q.normalized()};
  c->X_RT = c->filter.pass(rig_.inRig(c->X_SD, *c->tracker), c->ever ? dt : 0);
  c->last = clock;
  c->ever = true;
  ++counts_.taken;
  return true;
}

void TrackerFeed::freeze(std::string_view name, Nanoseconds clock, bool frozen) {
  for (Channel& c : channels_) {
    if (c.tracker->name != name || c.frozen.has_value() == frozen) continue;
    if (frozen) {
      c.frozen = poseAt(c, clock);
      continue;
    }
    c.from = *c.frozen;
    c.found = clock;
    c.frozen.reset();
  }
}

void TrackerFeed::setPrediction(std::string_view name, Nanoseconds ahead) {
  for (Channel& c : channels_)
    if (c.tracker->name == name) c.ahead = std::max<Nanoseconds>(ahead, 0);
}

std::optional<HeadNow> TrackerFeed::predictedHead(std::string_view name, Nanoseconds clock,
                                                  Nanoseconds ahead) const {
  for (const Channel& c : channels_)
    if (c.tracker->name == name)
      if (const auto X = poseAt(c, clock, ahead)) return HeadNow{*X, measuredBy(c, clock)};
  return {};
}

void TrackerFeed::change(Channel& c, Nanoseconds clock, bool changes) {
  ++counts_.taken;
  if (!controlled(c, clock)) {
    c.controlled = true;
    c.beat = 0;
    c.lastControl = c.lastChange = clock;
  }
  const double gap = std::max(0.0, toSeconds(clock - c.lastControl));
  if (changes)
    c.lastChange = clock;
  else if (toSeconds(clock - c.lastChange) > kRepeatAfter)
    c.beat = std::max(gap, 0.99 * c.beat);
  if (!c.ever) c.period = c.period == 0 ? gap : c.period + 0.1 * (gap - c.period);
  c.lastControl = std::max(c.lastControl, clock);
  if (c.changes.size() == kMostChanges) c.changes.pop_back();
  c.changes.push_back({clock, c.buttons, c.axes});
}

bool TrackerFeed::button(std::string_view name, Nanoseconds clock, std::int64_t index, bool down) {
  Channel* c = channel(name);
  if (!c) return false;
  if (index < 1 || index > 32) return refuse();
  const std::uint32_t bit = 1u << (index - 1);
  const std::uint32_t before = c->buttons;
  c->buttons = down ? c->buttons | bit : c->buttons & ~bit;
  change(*c, clock, c->buttons != before);
  return true;
}

bool TrackerFeed::axis(std::string_view name, Nanoseconds clock, std::int64_t index, double value) {
  Channel* c = channel(name);
  if (!c) return false;
  if (index < 0 || index >= static_cast<std::int64_t>(kTrackerAxes) || !std::isfinite(value)) return refuse();
  float& axis = c->axes[static_cast<std::size_t>(index)];
  const float before = axis;
  axis = static_cast<float>(std::clamp(value, -1.0, 1.0));
  change(*c, clock, axis != before);
  return true;
}

/// A measurement is some milliseconds old when its frame ends: it goes on as it went.
Pose TrackerFeed::extrapolated(const Channel& c, Nanoseconds clock, Nanoseconds ahead) const {
  const double t = std::clamp(toSeconds(clock - c.last), 0.0, rig_.predict);
  const Pose X{c.X_RT.p + t * c.filter.velocity(),
               (det::expRotation(t * c.filter.angularVelocity()) * c.X_RT.q).normalized()};
  if (ahead <= 0) return X;
  const Vec3 &v = c.filter.velocity(), &w = c.filter.angularVelocity();
  return forecast(X, v, w, toSeconds(ahead), {lagAt(rig_, v.norm()), lagAt(rig_, w.norm())});
}

std::optional<Pose> TrackerFeed::poseAt(const Channel& c, Nanoseconds clock, Nanoseconds ahead) const {
  if (c.frozen) return c.frozen;
  if (!c.ever) return {};
  const double age = toSeconds(clock - c.last);
  Pose X = extrapolated(c, clock, ahead);
  if (!c.tracker->safe) return age <= rig_.hold ? std::optional(X) : std::nullopt;
  if (age > rig_.hold + rig_.ease) return {};
  const auto along = [&](const Pose& a, const Pose& b, double s) {
    Pose X_ab = det::interpolate(a, b, eased(s));
    X_ab.q.normalize();
    return X_ab;
  };
  const double back = toSeconds(clock - c.found);
  if (back < rig_.ease) X = along(c.from, X, back / rig_.ease);
  if (age <= rig_.hold) return X;
  return along(X, {*c.tracker->safe, Quat::Identity()}, rig_.ease > 0 ? (age - rig_.hold) / rig_.ease : 1);
}

/// Adds the changes between the frames, in the order of their arrival. A change measured before the last
/// frame that came after it happens at the beginning of this one.
void TrackerFeed::addChanges(std::span<const Change> changes, const InputStamp& now, InputTrack& track,
                             Nanoseconds clock, Nanoseconds start) const {
  const InputStamp first = track.stamps.back();
  const Nanoseconds end = now.time;
  const double span = std::max(1.0, static_cast<double>(clock - lastClock_));
  for (const Change& change : changes) {
    InputStamp s = now;
    const double share = std::clamp(static_cast<double>(change.clock - lastClock_) / span, 0.0, 1.0);
    s.time = start + static_cast<Nanoseconds>(share * static_cast<double>(end - start));
    const InputStamp& last = track.stamps.back();
    const bool news = change.buttons != last.buttons || change.axes != last.axes;
    const bool passes = change.buttons != now.buttons || change.axes != now.axes;
    // The frame's start belongs to the frame before, which has been recorded.
    const Nanoseconds taken = std::max(last.time, start);
    if (s.time <= taken && !news) continue;
    if (s.time >= end && !passes) continue;
    s.time = std::max(std::min(s.time, end - 1), taken + 1);
    if (s.time >= end) return;
    if (s.valid) {
      const double way = static_cast<double>(s.time - first.time) / static_cast<double>(end - first.time);
      s.X_RT = det::interpolate(first.X_RT, now.X_RT, way);
      s.X_RT.q.normalize();
    }
    s.buttons = change.buttons;
    s.axes = change.axes;
    track.stamps.push_back(s);
  }
}

void TrackerFeed::addStamps(Channel& c, InputTrack& track, Nanoseconds clock, Nanoseconds start,
                            Nanoseconds end) {
  std::vector<Change> changes;
  changes.swap(c.changes);
  const bool controls = controlled(c, clock);
  const bool forgotten = controls && toSeconds(clock - c.lastControl) > kKeptWithoutNews;
  if (!there(c, clock) || forgotten) {
    c.buttons = 0;
    c.axes = {};
    changes.clear();
  }
  const auto X = poseAt(c, clock);
  const bool wasValid = track.stamps.back().valid, wasThere = wasValid || track.stamps.back().controlsOnly;
  if (!X && !controls) {
    if (wasThere && end > track.stamps.back().time) track.stamps.push_back(lostAt(end, track));
    return;
  }
  InputStamp now = X ? InputStamp() : lostAt(end, track);
  now.time = end;
  now.buttons = c.buttons;
  now.axes = c.axes;
  now.controlsOnly = !X;
  if (X) now.X_RT = *X;
  if (end <= track.stamps.back().time) {  // frame 0
    track.stamps.back() = now;
    return;
  }
  if (X && mayJump(track, *X, end)) {
    if (end - 1 > track.stamps.back().time) track.stamps.push_back(lostAt(end - 1, track));
  } else if (X ? wasValid : controls) {
    addChanges(changes, now, track, clock, start);
  }
  track.stamps.push_back(now);
}

void TrackerFeed::sampleFrame(Nanoseconds clock, Nanoseconds start, Nanoseconds end, InputSample& sample) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    InputTrack& track = log_.tracks[i];
    addStamps(channels_[i], track, clock, start, end);
    const std::size_t extra = track.stamps.size() > kMostChanges + kStampsKept ? kMostChanges : 0;
    track.stamps.erase(track.stamps.begin(), track.stamps.begin() + static_cast<std::ptrdiff_t>(extra));
  }
  lastClock_ = clock;
  log_.sampleFrame(start, end, sample);
  for (std::size_t i = 0; i < channels_.size(); ++i)
    sample.trackers[i].measured = measuredBy(channels_[i], clock);
}

void TrackerFeed::sampleNow(Nanoseconds clock, InputSample& sample) const {
  sample.trackers.resize(channels_.size());
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& c = channels_[i];
    TrackerSample& t = sample.trackers[i] = {};
    const auto X = poseAt(c, clock);
    t.name = c.tracker->name;
    t.valid = X.has_value();
    t.measured = measuredBy(c, clock);
    if (X) t.X_RT = *X;
    t.controlsOnly = !X && controlled(c, clock);
    if (there(c, clock)) {
      t.buttons = c.buttons;
      t.axes = c.axes;
    }
  }
}

std::vector<TrackerFeed::Status> TrackerFeed::status(Nanoseconds clock) const {
  std::vector<Status> all;
  for (const Channel& c : channels_) {
    Status s;
    const bool ever = c.ever || c.controlled;
    s.name = c.tracker->name;
    s.heard = there(c, clock);
    s.posed = c.ever;
    s.age = ever ? toSeconds(clock - (c.ever ? c.last : c.lastControl)) : 0;
    s.rate = s.heard && c.period > 0 ? 1 / c.period : 0;
    s.X_SD = c.X_SD;
    s.X_RT = c.X_RT;
    s.buttons = c.buttons;
    s.axes = c.axes;
    all.push_back(std::move(s));
  }
  return all;
}

}  // namespace stadion
