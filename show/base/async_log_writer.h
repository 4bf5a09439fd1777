#pragma once
/// Writes lines one after the other on a thread of its own, so that the caller never waits for a blocked
/// terminal or a disk.
///
/// Threads  write() from any. Ends when everything has been written.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace stadion {

class AsyncLogWriter {
public:
  explicit AsyncLogWriter(std::function<void(const std::string&)> say);
  ~AsyncLogWriter();
  AsyncLogWriter(const AsyncLogWriter&) = delete;
  AsyncLogWriter& operator=(const AsyncLogWriter&) = delete;

  /// While lines cannot be written, no more than the first thousand are kept.
  void write(std::string line);

private:
  void work();

  std::function<void(const std::string&)> say_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> lines_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace stadion
