#pragma once
/// Catches writes to memory that is published for reading. The ranges are read-only for the whole process
/// while they are closed.
///
/// A write by a thread in a Stage, or by a pool's thread that works for it (engine/base/running_stage.h), is
/// noted. The range is then opened and the thread goes on. So the stage can report the write when it ends. A
/// write by any other thread ends the process with kOutsideStages.
///
/// One guard at a time. Faults elsewhere are left to the signal handler that was there before.
///
/// Threads  construction, add() and destruction while no thread is in a Stage; open() and close() by the
///          thread that publishes; Stage by any thread.
/// Signals  the handler reads a table of fixed size, and calls nothing that locks or allocates: mprotect(),
///          sigaction(), write() and _exit().

#include <cstddef>
#include <cstdint>

namespace stadion {

class WriteGuard {
public:
  static constexpr std::size_t kMostRanges = 8;
  static constexpr int kOutsideStages = 5;  ///< the exit status

  WriteGuard();
  ~WriteGuard();  ///< opens all ranges
  WriteGuard(const WriteGuard&) = delete;
  WriteGuard& operator=(const WriteGuard&) = delete;

  /// Expects whole pages, and at most kMostRanges. Returns the range's number. It is open.
  std::size_t add(std::byte* at, std::size_t bytes);
  void open(std::size_t range) const;
  void close(std::size_t range) const;

  /// While it lives, this thread runs a stage. Stages of a thread do not overlap.
  class Stage {
  public:
    Stage();
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    /// The address of the first write in this stage, by any of its threads; null: there was none.
    const void* written() const;
  };
};

}  // namespace stadion
