#include "pipeline/device/osc_trackers.h"

#include "engine/plain_text/text_line.h"

#include <algorithm>

namespace stadion {

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
      return streams_.take(name, *measured, m.from, m.sent);
    }
  }
  ++misunderstood_;
  trackers_.misunderstood("OSC message " + quotedWord(m.path) + " with " + std::to_string(m.numbers.size()) +
                          " numbers is no measurement; there are /tracker/NAME/pose x y z qx qy qz qw, "
                          "/tracker/NAME/button i down, /tracker/NAME/axis i value");
}

std::optional<Measurement> OscTrackers::measurementOf(std::string_view what,
                                                      std::span<const double> numbers) {
  struct Form {
    std::string_view word;
    std::size_t count;
    Measurement::Kind kind;
  };
  using enum Measurement::Kind;
  constexpr Form kForms[] = {{"pose", 7, Pose}, {"button", 2, Button}, {"axis", 2, Axis}};
  for (const Form& form : kForms) {
    if (what != form.word || numbers.size() != form.count) continue;
    Measurement m{form.kind, {}};
    std::ranges::copy(numbers, m.numbers.begin());
    return m;
  }
  return {};
}

}  // namespace stadion
