#pragma once
/// How long threads could have run, but got no processor: what Linux's scheduler says.
///
/// Units    milliseconds, since the thread began.
/// Threads  all calls from one thread: it is the one whose delay comes first.
/// Errors   where the system does not say, nothing ever waits.

#include <cstdint>
#include <vector>

namespace stadion {

class RunDelay {
public:
  RunDelay() = default;
  ~RunDelay();
  RunDelay(const RunDelay&) = delete;
  RunDelay& operator=(const RunDelay&) = delete;

  /// Of the calling thread first, then of each thread of the software rasteriser, as far as they are known;
  /// valid until the next call.
  const std::vector<double>& ofDrawing();
  /// Of the calling thread.
  double own();

private:
  void findRasteriser();
  int ownFile();

  std::vector<int> files_;  ///< the calling thread's, then the rasteriser's
  std::vector<double> delays_;
  std::uint64_t looked_ = 0;
};

/// The most that one of them has waited between two looks; threads that came later are left out.
double mostDelayed(const std::vector<double>& before, const std::vector<double>& now);

}  // namespace stadion
