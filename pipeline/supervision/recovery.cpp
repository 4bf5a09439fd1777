#include "pipeline/supervision/recovery.h"

#include <algorithm>

namespace stadion {

Recovery::Step Recovery::died(Nanoseconds time, Nanoseconds played) {
  if (deaths_ > 0 && (time >= steadyAt_ || played >= kLong)) deaths_ = 0;
  ++deaths_;
  if (deaths_ >= kMost) return {Way::GiveUp, {}};
  const bool again = deaths_ >= kFromScene;
  // A show that restarts is still far from the place of the last crash.
  steadyAt_ = kSteady + (again ? 0 : time);
  const Milliseconds pause =
      deaths_ == 1 ? Milliseconds(0) : std::min(kLongest, kShortest * (1 << (deaths_ - 2)));
  return {again ? Way::Restart : Way::GoOn, pause};
}

}  // namespace stadion
