#include "pipeline/device/dtrack_trackers.h"
#include "pipeline/device/freed_trackers.h"
#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

/// Packets on the ports of DTrack and FreeD.
void tracker_packets(Bytes bytes) {
  Nanoseconds time = 1'000'000'000;
  LiveTrackers trackers(
      standardRig(), [](const std::string&) {}, [&] { return time += 1'000'000; });
  DTrackTrackers dtrack(trackers);
  FreeDTrackers freed(trackers);
  dtrack.take({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "10.0.0.1");
  freed.take(bytes, "10.0.0.2");
  InputSample sample;
  trackers.sampleFrame(0, 16'666'667, sample);
  for (const TrackerSample& t : sample.trackers) {
    require(t.X_RT.finite(), "a tracker is somewhere");
    for (const float a : t.axes) require(a >= -1 && a <= 1, "an axis is in its range");
  }
}

}  // namespace stadion::fuzz
