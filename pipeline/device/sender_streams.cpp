#include "pipeline/device/sender_streams.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace stadion {
namespace {

constexpr std::size_t kMostStreams = 256;          ///< limit of streams that it distinguishes
constexpr std::size_t kMostLate = 64;              ///< buttons and axes kept in case their sender has set its
                                                   ///< clock
constexpr Nanoseconds kWorthTelling = 50'000'000;  ///< smaller corrections of a clock are not logged [ns]

std::int64_t wholeNumber(double x) {
  return std::fabs(x) < 1e6 && x == std::floor(x) ? static_cast<std::int64_t>(x) : -1;
}

}  // namespace

void SenderStreams::take(std::string_view tracker, const Measurement& m, std::string_view from,
                         std::optional<Nanoseconds> sent) {
  if (sent && trackers_.knows(tracker)) return takeStamped(tracker, m, from, *sent);
  post(tracker, trackers_.now(), m);
}

SenderStreams::Stream& SenderStreams::streamOf(std::string_view host, std::string_view tracker, bool poses) {
  const auto known = std::ranges::find_if(
      streams_, [&](const Stream& s) { return s.poses == poses && s.tracker == tracker && s.host == host; });
  if (known != streams_.end()) return *known;
  if (streams_.size() == kMostStreams) streams_.clear();
  const auto stamped = poses ? SenderClock::Stamped::Poses : SenderClock::Stamped::Controls;
  return streams_.emplace_back(Stream{std::string(host), std::string(tracker), poses, SenderClock(stamped)});
}

void SenderStreams::takeStamped(std::string_view tracker, const Measurement& m, std::string_view host,
                                Nanoseconds sent) {
  const Nanoseconds now = trackers_.now();
  const bool poses = m.kind == Measurement::Kind::Pose;
  Stream& stream = streamOf(host, tracker, poses);
  const SenderClock::Reading reading = stream.clock.read(sent, now);
  if (!reading.ours) {
    trackers_.late(tracker);
    if (!poses && stream.late.size() < kMostLate) stream.late.push_back(m);
    return;
  }
  if (reading.set)
    for (const Measurement& earlier : stream.late) post(tracker, now, earlier);
  stream.late.clear();
  if (reading.set && std::abs(*reading.set) >= kWorthTelling) trackers_.clockWasSet(tracker, *reading.set);
  post(tracker, *reading.ours, m);
}

void SenderStreams::post(std::string_view tracker, Nanoseconds clock, const Measurement& m) {
  const auto& n = m.numbers;
  switch (m.kind) {
  case Measurement::Kind::Pose:
    return trackers_.pose(tracker, clock, {Vec3(n[0], n[1], n[2]), Quat(n[6], n[3], n[4], n[5])});
  case Measurement::Kind::Button: return trackers_.button(tracker, clock, wholeNumber(n[0]), n[1] != 0);
  case Measurement::Kind::Axis: return trackers_.axis(tracker, clock, wholeNumber(n[0]), n[1]);
  }
}

}  // namespace stadion
