#pragma once
/// Says lines one after the other on a thread of its own: whoever tells something never waits for a terminal
/// that is held, or a disk.
///
/// Threads  tell() from any. Ends when everything has been said.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace stadion {

class TellingThread {
public:
  explicit TellingThread(std::function<void(const std::string&)> say);
  ~TellingThread();
  TellingThread(const TellingThread&) = delete;
  TellingThread& operator=(const TellingThread&) = delete;

  /// While nobody can hear it, no more than the first thousand lines are kept.
  void tell(std::string line);

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
