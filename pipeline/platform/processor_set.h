#pragma once
/// A set of a machine's processors, numbered as the system numbers its hardware threads.
///
/// A plain value, which can be sent to other processes.
///
/// Threads  bindThisThread() affects the calling thread and the threads that it starts later.

#include <array>
#include <cstddef>
#include <cstdint>

namespace stadion {

class ProcessorSet {
public:
  static constexpr std::size_t kMost = 1024;  ///< processors; higher numbers are left out

  void add(std::size_t processor);
  bool contains(std::size_t processor) const;
  bool empty() const { return size() == 0; }
  std::size_t size() const;

  /// Restricts the calling thread to these processors. Returns false, and changes nothing, if the system
  /// refuses.
  bool bindThisThread() const { return bindThread(0); }
  /// Restricts a thread of any process, given by its number, to these processors. A process's first thread
  /// has the process's number.
  bool bindThread(int thread) const;

  bool operator==(const ProcessorSet&) const = default;

private:
  std::array<std::uint64_t, kMost / 64> bits_{};
};

/// Returns the processors on which the calling thread may run.
ProcessorSet processorsOfThisThread();

}  // namespace stadion
