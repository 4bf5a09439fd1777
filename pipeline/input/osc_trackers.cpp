#include "pipeline/input/osc_trackers.h"

#include "engine/text_line.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr Nanoseconds kAnotherClock = 500'000'000;  ///< farther off than any network delays [ns]

std::int64_t wholeNumber(double x) {
  return std::fabs(x) < 1e6 && x == std::floor(x) ? static_cast<std::int64_t>(x) : -1;
}

}  // namespace

Nanoseconds SenderClock::ours(Nanoseconds sent, Nanoseconds arrived) {
  const Nanoseconds offset = arrived - sent;
  if (known_) offset_ += std::max<Nanoseconds>(0, arrived - at_) / 1000;
  if (!known_ || offset < offset_ || offset - offset_ > kAnotherClock) offset_ = offset;
  known_ = true, at_ = arrived;
  return sent + offset_;
}

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
  const Nanoseconds now = trackers_.now();
  if (m.numeric && m.path.starts_with(kHead) && slash != m.path.npos && slash > kHead.size()) {
    const std::string_view name = m.path.substr(kHead.size(), slash - kHead.size());
    if (understood(name, m.path.substr(slash + 1), m, m.sent ? clock_.ours(*m.sent, now) : now)) return;
  }
  ++misunderstood_;
  trackers_.misunderstood("OSC message " + quotedWord(m.path) + " with " + std::to_string(m.numbers.size()) +
                          " numbers is no measurement; there are /tracker/NAME/pose x y z qx qy qz qw, "
                          "/tracker/NAME/button i down, /tracker/NAME/axis i value");
}

bool OscTrackers::understood(std::string_view tracker, std::string_view what, const OscMessage& m,
                             Nanoseconds clock) {
  const auto& n = m.numbers;
  if (what == "pose" && n.size() == 7)
    trackers_.pose(tracker, clock, {Vec3(n[0], n[1], n[2]), Quat(n[6], n[3], n[4], n[5])});
  else if (what == "button" && n.size() == 2)
    trackers_.button(tracker, clock, wholeNumber(n[0]), n[1] != 0);
  else if (what == "axis" && n.size() == 2)
    trackers_.axis(tracker, clock, wholeNumber(n[0]), n[1]);
  else
    return false;
  return true;
}

}  // namespace stadion
