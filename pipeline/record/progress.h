#pragma once
/// A progress bar on a terminal.
///
/// Threads  one thread.
/// Errors   none; without a terminal it does nothing.

#include <chrono>
#include <cstdint>
#include <string>

namespace stadion {

class ProgressBar {
public:
  /// `total` is the number of frames to come (0 = unknown). Draws on descriptor `fd` (2 = stderr) if that is
  /// a terminal.
  explicit ProgressBar(std::uint64_t total, int fd = 2);
  ~ProgressBar() { finish(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  bool shown() const { return shown_; }
  /// `done` frames are finished. Draws at most ten times a second.
  void update(std::uint64_t done);
  /// Clears the bar, so that further output starts on an empty line. Further updates do nothing.
  void finish();

private:
  using Clock = std::chrono::steady_clock;

  std::uint64_t total_;
  int fd_;
  bool shown_ = false;
  bool drawn_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
};

/// The bar as a line of text of at most `columns` letters.
std::string progressLine(std::uint64_t done, std::uint64_t total, double elapsedSeconds,
                         std::uint32_t columns = 72);

}  // namespace stadion
