#pragma once
/// The decisions of clock and operator in a live run, as its input log keeps them, so that a replay applies
/// them.
///
/// Most frames follow each other at 1/rate, and most files are ready when they are due: only differences are
/// written.
///
/// Units    show time [ns], from the start of the show.
/// Threads  plain values.

#include "engine/base/time_signature.h"
#include "engine/input/operator_command.h"

#include <cstdint>
#include <map>
#include <utility>

namespace stadion {

/// The operator's commands, by the frame in which they took effect.
using RunOrders = std::multimap<std::uint64_t, OperatorCommand>;

/// Degradations because of overload, by their first frame.
using DegradationDecisions = std::multimap<std::uint64_t, DegradationDecision>;

struct RunDecisions {
  double rate = 0;                              ///< frames a second of the recorded run; 0 = not said
  std::map<std::uint64_t, Nanoseconds> frames;  ///< frame number to its show time; the ones after it follow
  std::map<std::uint32_t, Nanoseconds> loads;   ///< load number to when it took effect, because it came late

  RunOrders orders;  ///< about pictures and sounds alone, with their figures
  DegradationDecisions degradation;

  bool empty() const { return frames.empty() && loads.empty() && orders.empty() && degradation.empty(); }

  Nanoseconds end() const { return frames.empty() ? 0 : frames.rbegin()->second; }
};

/// The show time of each frame: on the ticks of the rate, unless it was decided otherwise.
///
/// Threads  one thread.
class FrameClock {
public:
  explicit FrameClock(double rate, std::map<std::uint64_t, Nanoseconds> decided = {})
      : rate_(rate), decided_(std::move(decided)) {}
  /// Continues after the frame `last`.
  FrameClock(double rate, const TimeSignature& last, std::map<std::uint64_t, Nanoseconds> decided = {});

  /// The next frame, `ticks` after the previous one; a decision made earlier overrides `ticks`.
  TimeSignature next(std::uint64_t ticks = 1);
  /// The next frame, so much show time after the previous one, whatever the ticks; the ones after it are on
  /// ticks again. For slow motion. Expects a step of at least 1 ns.
  TimeSignature nextAfter(Nanoseconds step);
  /// When that will be.
  Nanoseconds timeOfNext(std::uint64_t ticks = 1) const;

private:
  std::uint64_t tickOfNext(std::uint64_t ticks) const { return frame_ > 0 ? tick_ + ticks : tick_; }
  /// Returns the decision about the next frame; null if there was none.
  const Nanoseconds* decisionOfNext() const;

  double rate_;
  std::map<std::uint64_t, Nanoseconds> decided_;
  std::uint64_t frame_ = 0, tick_ = 0;
  Nanoseconds time_ = 0;
};

}  // namespace stadion
