#include "pipeline/supervision/recovery.h"

#include <algorithm>

namespace stadion {

Recovery::Step Recovery::died(std::uint64_t frame, std::uint64_t shown) {
  if (deaths_ > 0 && (frame >= steadyAt_ || shown >= kLong)) deaths_ = 0;
  ++deaths_;
  if (deaths_ >= kMost) return {Way::GiveUp, {}};
  const bool again = deaths_ >= kFromScene;
  // A show that begins again has not come anywhere near yet.
  steadyAt_ = kSteady + (again ? 0 : frame);
  const Milliseconds pause =
      deaths_ == 1 ? Milliseconds(0) : std::min(kLongest, kShortest * (1 << (deaths_ - 2)));
  return {again ? Way::BeginAgain : Way::GoOn, pause};
}

}  // namespace stadion
