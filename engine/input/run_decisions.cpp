#include "engine/input/run_decisions.h"

namespace stadion {
namespace {

std::uint64_t tickAt(Nanoseconds time, double rate) {
  return static_cast<std::uint64_t>(toSeconds(time) * rate + 0.5);
}

}  // namespace

FrameClock::FrameClock(double rate, const TimeSignature& last)
    : rate_(rate), frame_(last.frame + 1), tick_(tickAt(last.time, rate)), time_(last.time) {}

TimeSignature FrameClock::next(std::uint64_t ticks) {
  if (frame_ > 0) tick_ += ticks;
  TimeSignature now = signatureAt(tick_, rate_);
  if (const auto decided = decided_.find(frame_); decided != decided_.end() && decided->second > time_) {
    now.time = decided->second;
    tick_ = tickAt(now.time, rate_);
  }
  now.frame = frame_++;
  now.step = now.frame == 0 ? 0 : now.time - time_;
  time_ = now.time;
  return now;
}

}  // namespace stadion
