#include "pipeline/supervision/hang_watch.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr Nanoseconds kAsleep = fromSeconds(1);

}  // namespace

HangWatch::HangWatch(const SharedProgress& progress, Nanoseconds after, Clock clock)
    : progress_(progress), after_(after), clock_(clock), before_(progress.framesShown()), since_(clock()),
      looked_(since_) {}

std::optional<Nanoseconds> HangWatch::hangs() {
  const Nanoseconds now = clock_();
  const SharedProgress::Phase phase = progress_.phase();
  if (now - looked_ > kAsleep || phase != phase_) {
    since_ = now;
    phase_ = phase;
  }
  looked_ = now;
  // The first picture waits for drivers and for uploads.
  const bool plays = phase == SharedProgress::Phase::Playing && shows();
  const Nanoseconds limit = plays ? after_ : kLonger * after_;
  if (now - std::max(since_, progress_.lastShown()) <= limit) return {};
  return limit;
}

}  // namespace stadion
