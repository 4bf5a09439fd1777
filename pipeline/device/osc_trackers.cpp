#include "pipeline/device/osc_trackers.h"

#include "engine/plain_text/text_line.h"

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

Result<std::unique_ptr<OscTrackers>> OscTrackers::open(std::uint16_t port, LiveTrackers& trackers) {
  auto made = std::make_unique<OscTrackers>(trackers);
  auto server = OscServer::open(port, [t = made.get()](const OscMessage& m) { t->take(m); });
  if (!server) return server.error();
  made->server_ = std::move(server.value());
  return made;
}

void OscTrackers::take(const OscMessage& m) {
  constexpr std::string_view kHead = "/tracker/";
  const std::size_t slash = m.path.rfind('/');
  if (m.numeric && m.path.starts_with(kHead) && slash != m.path.npos && slash > kHead.size()) {
    const std::string_view name = m.path.substr(kHead.size(), slash - kHead.size());
    if (const auto measured = measurementOf(m.path.substr(slash + 1), m.numbers)) {
      if (m.sent && trackers_.knows(name)) return takeStamped(name, *measured, m.from, *m.sent);
      return post(name, trackers_.now(), *measured);
    }
  }
  ++misunderstood_;
  trackers_.misunderstood("OSC message " + quotedWord(m.path) + " with " + std::to_string(m.numbers.size()) +
                          " numbers is no measurement; there are /tracker/NAME/pose x y z qx qy qz qw, "
                          "/tracker/NAME/button i down, /tracker/NAME/axis i value");
}

std::optional<OscTrackers::Measurement> OscTrackers::measurementOf(std::string_view what,
                                                                   std::span<const double> numbers) {
  struct Form {
    std::string_view word;
    std::size_t count;
    Kind kind;
  };
  constexpr Form kForms[] = {{"pose", 7, Kind::Pose}, {"button", 2, Kind::Button}, {"axis", 2, Kind::Axis}};
  for (const Form& form : kForms) {
    if (what != form.word || numbers.size() != form.count) continue;
    Measurement m{form.kind, {}};
    std::ranges::copy(numbers, m.numbers.begin());
    return m;
  }
  return {};
}

OscTrackers::Stream& OscTrackers::streamOf(std::string_view host, std::string_view tracker, bool poses) {
  const auto known = std::ranges::find_if(
      streams_, [&](const Stream& s) { return s.poses == poses && s.tracker == tracker && s.host == host; });
  if (known != streams_.end()) return *known;
  if (streams_.size() == kMostStreams) streams_.clear();
  const auto stamped = poses ? SenderClock::Stamped::Poses : SenderClock::Stamped::Controls;
  return streams_.emplace_back(Stream{std::string(host), std::string(tracker), poses, SenderClock(stamped)});
}

void OscTrackers::takeStamped(std::string_view tracker, const Measurement& m, std::string_view host,
                              Nanoseconds sent) {
  const Nanoseconds now = trackers_.now();
  Stream& stream = streamOf(host, tracker, m.kind == Kind::Pose);
  const SenderClock::Reading reading = stream.clock.read(sent, now);
  if (!reading.ours) {
    trackers_.late(tracker);
    if (m.kind != Kind::Pose && stream.late.size() < kMostLate) stream.late.push_back(m);
    return;
  }
  if (reading.set)
    for (const Measurement& earlier : stream.late) post(tracker, now, earlier);
  stream.late.clear();
  if (reading.set && std::abs(*reading.set) >= kWorthTelling) trackers_.clockWasSet(tracker, *reading.set);
  post(tracker, *reading.ours, m);
}

void OscTrackers::post(std::string_view tracker, Nanoseconds clock, const Measurement& m) {
  const auto& n = m.numbers;
  switch (m.kind) {
  case Kind::Pose:
    return trackers_.pose(tracker, clock, {Vec3(n[0], n[1], n[2]), Quat(n[6], n[3], n[4], n[5])});
  case Kind::Button: return trackers_.button(tracker, clock, wholeNumber(n[0]), n[1] != 0);
  case Kind::Axis: return trackers_.axis(tracker, clock, wholeNumber(n[0]), n[1]);
  }
}

}  // namespace stadion
