#pragma once
/// How long the other walls wait for a late wall in a run where the newest frame counts.
///
/// The deadline is one and a half times the usual duration, and at least one and a half frames. So a wall
/// that usually finishes within a frame makes the others miss one frame at most. A wall that only lacks a
/// processor gets twice that (per_wall_process_renderer.cpp). The usual duration is the median of the last
/// few frames. One long frame does not change it, and a view that becomes slower is awaited again soon.
///
/// Threads  one at a time.

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

namespace stadion::wall_process {

class AnswerDeadline {
public:
  using Milliseconds = std::chrono::duration<double, std::milli>;

  static constexpr std::size_t kKnown = 3,
                               kLast = 5;  ///< frames that define the usual duration, at least and at most

  explicit AnswerDeadline(double rate) : frame_(1000 / rate) {}

  /// Records how long a frame took, whether the others waited for it or not.
  void took(Milliseconds time);
  /// Returns nothing until the usual duration is known.
  std::optional<Milliseconds> limit() const;

private:
  Milliseconds frame_;
  std::array<Milliseconds, kLast> last_{};  ///< in a ring
  std::size_t count_ = 0;                   ///< in all
};

}  // namespace stadion::wall_process
