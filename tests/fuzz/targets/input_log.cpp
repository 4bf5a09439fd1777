#include "engine/input/input_log.h"

#include "tests/fuzz/targets.h"

namespace stadion::fuzz {
namespace {

/// Around the first records, where most happens, and at the end.
void playThrough(const InputLog& log) {
  InputSample sample;
  const auto frame = [&](Nanoseconds start, Nanoseconds end) {
    log.sampleFrame(start, end, sample);
    for (const TrackerSample& t : sample.trackers) {
      require(t.X_RT.finite(), "a tracker is somewhere");
      for (const PoseKnot& k : t.knots)
        require(k.X.finite() && k.time >= start && k.time <= end, "a knot is somewhere in its frame");
    }
  };
  constexpr Nanoseconds kFrame = 16'666'667;
  Nanoseconds before = 0;
  for (Nanoseconds time = 0; time < 8 * kFrame; time += kFrame) frame(before, time), before = time;
  for (const InputTrack& track : log.tracks) {
    const Nanoseconds last = track.stamps.back().time;
    frame(last > kFrame ? last - kFrame : 0, last);
  }
  if (log.end() > before) frame(before, log.end());
}

}  // namespace

void input_log(Bytes bytes) {
  Diagnostics findings;
  const auto log = parseInputLog(asText(bytes), "any.input", findings);
  require(log.has_value() || findings.hasErrors(), "what is refused has a reason");
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
  if (!log) return;
  playThrough(*log);
  Diagnostics again;
  const std::string text = formatInputLog(*log);
  const auto read = parseInputLog(text, "again.input", again);
  require(read && formatInputLog(*read) == text, "what is written is read again");
}

}  // namespace stadion::fuzz
