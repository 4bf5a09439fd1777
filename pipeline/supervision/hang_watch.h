#pragma once
/// Whether a player that is watched still shows pictures, or hangs: in a driver, in a loop, stopped.
///
///     HangWatch watch(progress, fromSeconds(10));   // as the player is started
///     if (const auto silent = watch.hangs()) ...    // a few times a second
///
/// Opening a show, its drivers and devices, and writing its summary may take kLonger times as long.
///
/// Threads  who watches.

#include "pipeline/supervision/shared_progress.h"

#include <optional>

namespace stadion {

class HangWatch {
public:
  static constexpr int kLonger = 12;

  using Clock = Nanoseconds (*)();
  /// `after`: while it plays, no picture may come for so long [ns]. `progress` must outlive it. `clock`:
  /// tells the time as `progress` notes it; a test passes its own.
  HangWatch(const SharedProgress& progress, Nanoseconds after, Clock clock = machineClock);
  /// How long no picture has come, at least, if it hangs [ns]. Whoever has not asked for a second was stopped
  /// itself (Ctrl-Z, a debugger, a machine that slept): what was before does not count.
  std::optional<Nanoseconds> hangs();
  /// It has shown a picture.
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
