#include "pipeline/cluster/orders.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace stadion::cluster {
namespace {

stadion_wire_Pose written(const Pose& X) {
  return {{X.p.x(), X.p.y(), X.p.z()}, {X.q.x(), X.q.y(), X.q.z(), X.q.w()}};
}

Pose read(const stadion_wire_Pose& X) {
  return {Vec3(X.p[0], X.p[1], X.p[2]), Quat(X.q[3], X.q[0], X.q[1], X.q[2])};
}

/// The sequence borrows its elements, so they must not move.
template <class Sequence, class T>
void lend(std::vector<T>& from, Sequence& to) {
  to._buffer = from.data();
  to._release = false;
  to._length = to._maximum = static_cast<std::uint32_t>(from.size());
}

template <class Sequence>
auto spanOf(const Sequence& s) {
  return std::span(s._buffer, s._length);
}

stadion_wire_Tracker written(const TrackerSample& t) {
  stadion_wire_Tracker w{};
  t.name.copy(w.name, sizeof(w.name) - 1);
  w.pose = written(t.X_RT);
  w.buttons = t.buttons;
  w.stamp = t.stamp;
  w.valid = t.valid;
  w.controls_only = t.controlsOnly;
  std::ranges::copy(t.axes, w.axes);
  return w;
}

constexpr double kFarthest = 1e7;  ///< from the rig: ten times the limit of input logs [m]
constexpr double kWidestEyes = 1;  ///< [m]

bool isPlace(const Pose& X) {
  const double squared = X.q.squaredNorm();
  return X.finite() && X.p.cwiseAbs().maxCoeff() <= kFarthest && squared > 0.25 && squared < 4;
}

template <std::size_t N>
bool areAxes(const std::array<float, N>& axes) {
  return std::ranges::all_of(axes, [](float a) { return a >= -1 && a <= 1; });
}

template <class Knot>
bool followEachOther(const std::vector<Knot>& knots) {
  return std::ranges::all_of(knots, isTime, &Knot::time) && std::ranges::is_sorted(knots, {}, &Knot::time);
}

bool makesSense(const TrackerSample& t) {
  return isPlace(t.X_RT) && areAxes(t.axes) && isTime(t.stamp) && followEachOther(t.knots) &&
         followEachOther(t.controls) && std::ranges::all_of(t.knots, isPlace, &PoseKnot::X) &&
         std::ranges::all_of(t.controls, areAxes<kTrackerAxes>, &ControlKnot::axes);
}

bool makesSense(const HeardOrder& heard) {
  const TimeSignature& now = heard.order.signature;
  if (!isTime(now.time) || now.step < 0 || now.step > now.time) return false;
  std::vector<std::string_view> names;
  for (const TrackerSample& t : heard.input.trackers) {
    if (!makesSense(t)) return false;
    names.push_back(t.name);
  }
  std::ranges::sort(names);
  return std::ranges::adjacent_find(names) == names.end();
}

TrackerSample read(const stadion_wire_Tracker& w) {
  TrackerSample t;
  t.name.assign(w.name, strnlen(w.name, sizeof(w.name)));
  t.X_RT = read(w.pose);
  t.buttons = w.buttons;
  t.stamp = w.stamp;
  t.valid = w.valid;
  t.controlsOnly = w.controls_only;
  std::ranges::copy(w.axes, t.axes.begin());
  for (const stadion_wire_PoseKnot& k : spanOf(w.knots)) t.knots.push_back({k.time, read(k.pose), k.jump});
  for (const stadion_wire_ControlKnot& k : spanOf(w.controls)) {
    ControlKnot& knot = t.controls.emplace_back();
    knot.time = k.time;
    knot.buttons = k.buttons;
    std::ranges::copy(k.axes, knot.axes.begin());
  }
  return t;
}

}  // namespace

bool isTime(Nanoseconds time) {
  constexpr Nanoseconds kLatest = 1'000'000'000'000'000'000;  ///< thirty years of a show [ns]
  return time >= 0 && time <= kLatest;
}

stadion_wire_Presentation written(const Presentation& shown) {
  return {shown.black, shown.swapEyes, shown.pattern, shown.eyeSeparation};
}

std::optional<Presentation> read(const stadion_wire_Presentation& shown) {
  if (!(std::abs(shown.eye_separation) <= kWidestEyes)) return {};
  return Presentation{shown.black, shown.swap_eyes, shown.pattern, shown.eye_separation};
}

std::optional<Standstill> readStandstill(std::uint8_t still) {
  if (still > static_cast<std::uint8_t>(Standstill::Waiting)) return {};
  return static_cast<Standstill>(still);
}

const Order& WrittenOrder::write(const OrderNumbers& numbers, const FrameOrder& o, const InputSample* input) {
  Order& w = order_;
  w.session = numbers.session;
  w.serial = numbers.serial;
  w.members = numbers.members;
  w.explain = numbers.explain;
  w.frame = o.signature.frame;
  w.time = o.signature.time;
  w.step = o.signature.step;
  decisions_.clear();
  trackers_.clear();
  for (const DegradationDecision& d : o.signature.decisions)
    decisions_.push_back({d.load, d.position, d.level});
  lend(decisions_, w.decisions);
  w.last = o.last;
  w.shown = written(o.presentation);
  w.still = static_cast<std::uint8_t>(o.still);
  w.stands_after = static_cast<std::uint8_t>(o.standsAfter);
  w.sampled = input != nullptr;
  const std::size_t count = input ? input->trackers.size() : 0;
  if (knots_.size() < count) {
    knots_.resize(count);
    controls_.resize(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const TrackerSample& t = input->trackers[i];
    stadion_wire_Tracker& tracker = trackers_.emplace_back(written(t));
    knots_[i].clear();
    controls_[i].clear();
    for (const PoseKnot& k : t.knots) knots_[i].push_back({k.time, written(k.X), k.jump});
    for (const ControlKnot& k : t.controls) {
      stadion_wire_ControlKnot& knot = controls_[i].emplace_back();
      knot.time = k.time;
      knot.buttons = k.buttons;
      std::ranges::copy(k.axes, knot.axes);
    }
    lend(knots_[i], tracker.knots);
    lend(controls_[i], tracker.controls);
  }
  lend(trackers_, w.trackers);
  return w;
}

std::size_t WrittenOrder::bytes() const {
  // As XCDR1 lays it out, up to the padding.
  std::size_t bytes = 72 + decisions_.size() * sizeof(stadion_wire_Decision);
  for (const stadion_wire_Tracker& t : trackers_)
    bytes += 4 + std::strlen(t.name) + 1 + sizeof(t.pose) + sizeof(t.axes) + 26 +
             t.knots._length * sizeof(stadion_wire_PoseKnot) +
             t.controls._length * sizeof(stadion_wire_ControlKnot);
  return bytes;
}

std::optional<HeardOrder> readOrder(const Order& w) {
  HeardOrder heard;
  heard.numbers = {w.session, w.serial, w.members, w.explain};
  TimeSignature& now = heard.order.signature;
  now.frame = w.frame;
  now.time = w.time;
  now.step = w.step;
  for (const stadion_wire_Decision& d : spanOf(w.decisions))
    if (!now.decisions.add({d.load, d.position, d.level})) return {};
  const auto shown = cluster::read(w.shown);
  const auto still = readStandstill(w.still), standsAfter = readStandstill(w.stands_after);
  if (!shown || !still || !standsAfter) return {};
  heard.order.presentation = *shown;
  heard.order.still = *still;
  heard.order.standsAfter = *standsAfter;
  heard.order.last = w.last;
  heard.sampled = w.sampled;
  heard.input.time = w.time;
  for (const stadion_wire_Tracker& t : spanOf(w.trackers)) heard.input.trackers.push_back(read(t));
  if (!makesSense(heard)) return {};
  return heard;
}

}  // namespace stadion::cluster
