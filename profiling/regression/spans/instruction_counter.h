#pragma once
/// Counts the instructions that a thread executes in user space, by the processor's own counter, where there
/// is one and the system lets it be read.
///
/// Source   perf_event_open(2): PERF_COUNT_HW_INSTRUCTIONS, without the kernel's and a hypervisor's.
/// Threads  opened, and read, by the thread that is counted.
/// Errors   open() says why nothing can be counted: virtual machines and containers often hide the counters.

#include "engine/base/file_descriptor.h"

#include <cstdint>
#include <optional>
#include <string>

namespace stadion::regression {

class InstructionCounter {
public:
  /// Counts the calling thread from now on. Nothing, with the reason in `why`, if it cannot.
  static std::optional<InstructionCounter> open(std::string& why);

  /// Executed so far.
  std::uint64_t now() const;

private:
  explicit InstructionCounter(FileDescriptor counter) : counter_(std::move(counter)) {}
  FileDescriptor counter_;
};

/// Why this machine's instructions cannot be counted by hardware; empty if they can.
std::string whyNotByHardware();
/// The same of an error number that perf_event_open() gave.
std::string whyNotByHardware(int error);

}  // namespace stadion::regression
