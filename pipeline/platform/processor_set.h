#pragma once
/// Some of a machine's processors, numbered as the system numbers its hardware threads.
///
/// A plain value: it travels to other processes as it is.
///
/// Threads  bindThisThread() concerns the thread that calls it, and those that it starts later.

#include <array>
#include <cstddef>
#include <cstdint>

namespace stadion {

class ProcessorSet {
public:
  static constexpr std::size_t kMost = 1024;  ///< processors; what lies beyond is left out

  void add(std::size_t processor);
  bool contains(std::size_t processor) const;
  bool empty() const { return size() == 0; }
  std::size_t size() const;

  /// From now on the thread runs on these alone. False, and nothing is changed, if the system refuses.
  bool bindThisThread() const { return bindThread(0); }
  /// The same for a thread of any process, by its number; a process's first thread has the process's.
  bool bindThread(int thread) const;

  bool operator==(const ProcessorSet&) const = default;

private:
  std::array<std::uint64_t, kMost / 64> bits_{};
};

/// Where the calling thread may run.
ProcessorSet processorsOfThisThread();

}  // namespace stadion
