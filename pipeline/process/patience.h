#pragma once
/// How long the other walls wait for one whose frame is not there yet, where the newest frame counts.
///
/// Half as long again as it usually takes, at least a frame and a half. So a wall that is usually done within a
/// frame makes the others miss one at most. (Twice that for one that only lacks a processor, see
/// drawing_in_workers.cpp.) What is usual is the middle of the last few times: one that was long says
/// nothing, and a view that takes longer from now on is waited for again soon.
///
/// Threads  one at a time.

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

namespace stadion::worker {

class Patience {
public:
  using Milliseconds = std::chrono::duration<double, std::milli>;

  static constexpr std::size_t kKnown = 3, kLast = 5;  ///< times, at least and at most, by which it is known

  explicit Patience(double rate) : frame_(1000 / rate) {}

  /// It has taken so long, whether it was waited for or not.
  void took(Milliseconds time);
  /// Nothing while it is not known what is usual.
  std::optional<Milliseconds> limit() const;

private:
  Milliseconds frame_;
  std::array<Milliseconds, kLast> last_{};  ///< in a ring
  std::size_t count_ = 0;                   ///< in all
};

}  // namespace stadion::worker
