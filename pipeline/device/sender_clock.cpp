#include "pipeline/device/sender_clock.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr Nanoseconds kWindow = 250'000'000;        ///< the least delay within this time counts [ns]
constexpr Nanoseconds kLongestDelay = 250'000'000;  ///< of a datagram behind one that overtook it [ns]
constexpr Nanoseconds kOvertaken = 100'000'000;     ///< the overtaken datagram arrives at most this much
                                                    ///< later [ns]
constexpr int kCopies = 1;                          ///< duplicates of a datagram that a network may make

}  // namespace

void SenderClock::begin(Nanoseconds sent, Nanoseconds arrived) {
  known_ = true;
  newest_ = sent;
  at_ = since_ = arrived;
  offset_ = least_ = arrived - sent;
  older_.reset();
  repeats_ = 0;
}

SenderClock::Reading SenderClock::read(Nanoseconds sent, Nanoseconds arrived) {
  if (!known_) {
    begin(sent, arrived);
    return {arrived};
  }
  if (sent < newest_) return olderThanLast(sent, arrived);
  if (sent == newest_ && what_ == Stamped::Poses) {
    if (++repeats_ <= kCopies) return {};
    // The clock stands still, or ticks slower than measurements come, so it does not give their times.
    at_ = since_ = arrived;
    offset_ = least_ = arrived - sent;
    return {arrived};
  }
  if (setBackWithinAPeriod(sent, arrived)) {
    const Nanoseconds before = offset_;
    begin(sent, arrived);
    return {arrived, before - offset_};
  }
  if (sent > newest_) {
    period_ += (period_ == 0 ? 1 : 0.1) * (static_cast<double>(sent - newest_) - period_);
    older_.reset();
    repeats_ = 0;
  }
  newest_ = sent;
  at_ = arrived;
  const Nanoseconds offset = arrived - sent;
  if (arrived - since_ >= kWindow) {
    offset_ = least_;
    since_ = arrived;
    least_ = offset;
  }
  least_ = std::min(least_, offset);
  offset_ = std::min(offset_, offset);
  return {sent + offset_};
}

/// The stamps still grow then. Delays change the arrival of measurements, but not their stamps.
bool SenderClock::setBackWithinAPeriod(Nanoseconds sent, Nanoseconds arrived) const {
  return what_ == Stamped::Poses &&
         static_cast<double>(sent - newest_)<0.5 * period_&& static_cast<double>(arrived - at_)> 0.75 *
             period_;
}

SenderClock::Reading SenderClock::olderThanLast(Nanoseconds sent, Nanoseconds arrived) {
  const bool second = older_ && sent > *older_;
  const bool surely =
      what_ == Stamped::Controls && (newest_ - sent > kLongestDelay || arrived - at_ > kOvertaken);
  if (!second && !surely) {
    older_ = sent;
    return {};
  }
  const Nanoseconds before = offset_;
  begin(sent, arrived);
  return {arrived, before - offset_};
}

}  // namespace stadion
