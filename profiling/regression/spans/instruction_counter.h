#pragma once
/// Counts a thread's instructions in user space with the processor's counter, if it exists and the system
/// permits reading it.
///
/// Source   perf_event_open(2): PERF_COUNT_HW_INSTRUCTIONS, without the kernel's and a hypervisor's.
/// Threads  opened and read by the measured thread.
/// Errors   open() says why counting is not possible: virtual machines and containers often hide the
///          counters.

#include "engine/base/file_descriptor.h"

#include <cstdint>
#include <optional>
#include <string>

namespace stadion::regression {

class InstructionCounter {
public:
  /// Counts the calling thread from now on. Returns nothing, with the reason in `why`, if this is not
  /// possible.
  static std::optional<InstructionCounter> open(std::string& why);

  /// Returns the instructions so far.
  std::uint64_t now() const;

private:
  explicit InstructionCounter(FileDescriptor counter) : counter_(std::move(counter)) {}
  FileDescriptor counter_;
};

/// Returns why this machine cannot count instructions by hardware; empty if it can.
std::string whyNotByHardware();
/// Returns the same for an error number of perf_event_open().
std::string whyNotByHardware(int error);

}  // namespace stadion::regression
