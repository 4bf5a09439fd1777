#pragma once
/// Times in which threads were ready but had no processor, from Linux's scheduler.
///
/// Units    milliseconds, since the thread began.
/// Threads  all calls from one thread, which is the first in the results.
/// Errors   if the system gives no figures, all delays are 0.

#include <cstdint>
#include <vector>

namespace stadion {

class RunDelay {
public:
  RunDelay() = default;
  ~RunDelay();
  RunDelay(const RunDelay&) = delete;
  RunDelay& operator=(const RunDelay&) = delete;

  /// Returns the delays of the calling thread and then of each known thread of the software rasteriser; valid
  /// until the next call.
  const std::vector<double>& ofDrawing();
  /// Returns the delay of the calling thread.
  double own();

private:
  void findRasteriser();
  int ownFile();

  std::vector<int> files_;  ///< first the calling thread's, then the rasteriser's
  std::vector<double> delays_;
  std::uint64_t looked_ = 0;
};

/// Returns the longest delay of one of them between two readings; threads that came later are left out.
double mostDelayed(const std::vector<double>& before, const std::vector<double>& now);

}  // namespace stadion
