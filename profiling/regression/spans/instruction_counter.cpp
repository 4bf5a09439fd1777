#include "profiling/regression/spans/instruction_counter.h"

#include <cerrno>
#include <cstring>
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace stadion::regression {

std::string whyNotByHardware(int error) {
  switch (error) {
  case ENOENT:
  case ENODEV:
  case EOPNOTSUPP: return "this machine has no hardware counters, or its virtualisation hides them";
  case EACCES:
  case EPERM:
    return "the system does not let this user read hardware counters (sysctl kernel.perf_event_paranoid=2 or "
           "less would)";
  case ENOSYS: return "this system has no perf_event_open";
  default: return std::string("hardware counters cannot be opened: ") + std::strerror(error);
  }
}

std::optional<InstructionCounter> InstructionCounter::open(std::string& why) {
  perf_event_attr counted{};
  counted.type = PERF_TYPE_HARDWARE;
  counted.size = sizeof counted;
  counted.config = PERF_COUNT_HW_INSTRUCTIONS;
  counted.exclude_kernel = 1;
  counted.exclude_hv = 1;
  // A counter shared in turns would count a part and guess the rest.
  counted.pinned = 1;
  const long file = syscall(SYS_perf_event_open, &counted, 0, -1, -1, PERF_FLAG_FD_CLOEXEC);
  if (file < 0) {
    why = whyNotByHardware(errno);
    return std::nullopt;
  }
  InstructionCounter counter{FileDescriptor(static_cast<int>(file))};
  // Some virtual machines have a counter that never counts.
  if (counter.now() == 0) {
    why = "the hardware counter does not count";
    return std::nullopt;
  }
  return counter;
}

std::uint64_t InstructionCounter::now() const {
  std::uint64_t count = 0;
  return read(counter_.get(), &count, sizeof count) == static_cast<ssize_t>(sizeof count) ? count : 0;
}

std::string whyNotByHardware() {
  std::string why;
  (void)InstructionCounter::open(why);
  return why;
}

}  // namespace stadion::regression
