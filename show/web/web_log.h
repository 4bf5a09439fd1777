#pragma once
/// The last lines that a show has reported, for readers that may be slow.
///
/// Threads  add() from any thread, also one of a frame: it waits for no other. Readers share a lock among themselves.
/// Errors   lines that come faster than kMost between two reads are dropped, and counted.

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace stadion {

struct WebLogLine {
  std::uint64_t number = 0;  ///< from 1
  double uptime = 0;         ///< since the program began [s]
  std::string text{};
};

class WebLog {
public:
  static constexpr std::size_t kMost = 400, kLongest = 500;

  WebLog() = default;
  ~WebLog();
  WebLog(const WebLog&) = delete;
  WebLog& operator=(const WebLog&) = delete;

  void add(double uptime, const std::string& text);
  /// Returns the last lines with a number above `after`.
  std::vector<WebLogLine> linesAfter(std::uint64_t after) const;
  /// Returns the number of the newest line; 0: there is none.
  std::uint64_t newest() const;
  std::uint64_t dropped() const { return dropped_; }

private:
  struct Entry {
    WebLogLine line;
    Entry* before = nullptr;
  };
  void takeNew() const;

  mutable std::atomic<Entry*> newest_ = nullptr;  ///< lines that no reader has taken
  mutable std::atomic<std::size_t> waiting_ = 0;
  std::atomic<std::uint64_t> dropped_ = 0;
  mutable std::mutex mutex_;  ///< guards the members below, which only readers use
  mutable std::deque<WebLogLine> lines_;
  mutable std::uint64_t count_ = 0;
};

}  // namespace stadion
