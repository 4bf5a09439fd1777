#include "engine/input/run_decisions.h"

namespace stadion {
namespace {

std::uint64_t tickAt(Nanoseconds time, double rate) {
  return static_cast<std::uint64_t>(toSeconds(time) * rate + 0.5);
}

}  // namespace

FrameClock::FrameClock(double rate, const TimeSignature& last, std::map<std::uint64_t, Nanoseconds> decided)
    : rate_(rate), decided_(std::move(decided)), frame_(last.frame + 1), tick_(tickAt(last.time, rate)),
      time_(last.time) {}

const Nanoseconds* FrameClock::decisionOfNext() const {
  const auto decided = decided_.find(frame_);
  return decided != decided_.end() && decided->second > time_ ? &decided->second : nullptr;
}

Nanoseconds FrameClock::timeOfNext(std::uint64_t ticks) const {
  const Nanoseconds* decided = decisionOfNext();
  return decided ? *decided : signatureAt(tickOfNext(ticks), rate_).time;
}

TimeSignature FrameClock::nextAfter(Nanoseconds step) {
  const TimeSignature now{frame_++, time_ + step, step};
  tick_ = tickAt(now.time, rate_);
  time_ = now.time;
  return now;
}

TimeSignature FrameClock::next(std::uint64_t ticks) {
  TimeSignature now;
  now.time = timeOfNext(ticks);
  tick_ = decisionOfNext() ? tickAt(now.time, rate_) : tickOfNext(ticks);
  now.frame = frame_++;
  now.step = now.frame == 0 ? 0 : now.time - time_;
  time_ = now.time;
  return now;
}

}  // namespace stadion
