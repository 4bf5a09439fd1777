#pragma once
/// Detects that a supervised player hangs and shows no pictures: in a driver, in a loop, or stopped.
///
///     HangWatch watch(progress, fromSeconds(10));   // as the player is started
///     if (const auto silent = watch.hangs()) ...    // a few times a second
///
/// The limit is kLonger times as long while the player opens a show, its drivers and devices, and while it
/// writes its summary.
///
/// Threads  the watching thread.

#include "pipeline/supervision/shared_progress.h"

#include <optional>

namespace stadion {

class HangWatch {
public:
  static constexpr int kLonger = 12;

  using Clock = Nanoseconds (*)();
  /// `after`: the longest time without a picture while the show plays [ns]. `progress` must outlive it.
  /// `clock` must be the clock that `progress` uses; a test passes its own.
  HangWatch(const SharedProgress& progress, Nanoseconds after, Clock clock = machineClock);
  /// Returns the least time without a picture if the player hangs [ns]. If a second or more has passed
  /// between two calls, the watcher itself was stopped (Ctrl-Z, a debugger, a sleeping machine): earlier time
  /// does not count.
  std::optional<Nanoseconds> hangs();
  /// Returns true if the player has shown a picture.
  bool shows() const { return progress_.framesShown() > before_; }

private:
  const SharedProgress& progress_;
  Nanoseconds after_;
  Clock clock_;
  std::uint64_t before_;  ///< frames shown by players before this one
  Nanoseconds since_, looked_;
  SharedProgress::Phase phase_ = SharedProgress::Phase::Opening;
};

}  // namespace stadion
