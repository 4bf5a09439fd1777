#include "pipeline/loop/pacer.h"

#include <thread>

namespace stadion {

Pacer::Pacer(Pace pace, double rate, bool everyTick)
    : pace_(pace), everyTick_(everyTick),
      period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / rate))) {}

void Pacer::hold(Clock::duration by) {
  if (!started_) return;
  next_ += by;
  if (catchUpUntil_ != Clock::time_point{}) catchUpUntil_ += by;
}

std::uint64_t Pacer::wait() {
  if (pace_ == Pace::Free) return 1;
  const auto now = Clock::now();
  if (!started_) {
    started_ = true;
    next_ = now + period_ - startsLate_;
    catchUpUntil_ = now + startsLate_;
    return 1;
  }
  if (now <= next_) catchUpUntil_ = {};
  if (now < catchUpUntil_) {
    next_ += period_;
    return 1;
  }
  std::uint64_t ticks = 1;
  if (now > next_ && everyTick_) {
    ++missed_;
    next_ = (pace_ == Pace::Float ? now : next_) + period_;
    return 1;
  }
  if (now > next_) {
    const auto late = static_cast<std::uint64_t>((now - next_) / period_);
    missed_ += late + (pace_ == Pace::Lock ? 1 : 0);
    if (pace_ == Pace::Float) {
      next_ = now + period_;
      return 1 + late;
    }
    ticks += late + 1;
    next_ += period_ * static_cast<Clock::rep>(late + 1);
  }
  std::this_thread::sleep_until(next_);
  next_ += period_;
  return ticks;
}

}  // namespace stadion
