#include "engine/input/rig_file.h"

#include "engine/input/tracker_feed.h"
#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

void rig_file(Bytes bytes) {
  Diagnostics findings;
  const auto rig = parseRigFile(asText(bytes), "any.rig", findings);
  require(rig.has_value() || findings.hasErrors(), "what is refused has a reason");
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
  if (!rig) return;
  Diagnostics again;
  require(parseRigFile(formatRigFile(*rig), "again.rig", again).has_value(), "what is written is read again");
  TrackerFeed feed(*rig);
  constexpr Nanoseconds kTenMilliseconds = 10'000'000;
  InputSample sample;
  for (int i = 1; i <= 4; ++i) {
    for (const RigTracker& t : rig->trackers)
      feed.pose(t.name, i * kTenMilliseconds, {Vec3(i, 1, 2), Quat(0, 1, 0, 0)});
    feed.sampleFrame(i * kTenMilliseconds, (i - 1) * kTenMilliseconds, i * kTenMilliseconds, sample);
    for (const TrackerSample& t : sample.trackers) require(t.X_RT.finite(), "a tracker is somewhere");
  }
}

}  // namespace stadion::fuzz
