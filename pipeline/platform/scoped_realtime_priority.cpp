#include "pipeline/platform/scoped_realtime_priority.h"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace stadion {
namespace {

/// The structure of sched_setattr(2); glibc has it from 2.41 on.
struct Attributes {
  std::uint32_t size = sizeof(Attributes), policy = SCHED_OTHER;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime = 0, deadline = 0, period = 0;  ///< [ns]; 0: the system's own
};

constexpr std::uint64_t kResetOnFork = 1;      ///< threads that this thread starts are ordinary ones
constexpr std::uint64_t kShortTurn = 100'000;  ///< the least that Linux takes [ns]

bool set(const Attributes& attributes) {
  return syscall(SYS_sched_setattr, 0, &attributes, 0) == 0;
}

}  // namespace

ScopedRealtimePriority::ScopedRealtimePriority(For threads) : handedDown_(threads == For::ThoseItStarts) {
  Attributes now;
  if (syscall(SYS_sched_getattr, 0, &now, sizeof now, 0) != 0 || now.policy != SCHED_OTHER) return;
  nice_ = now.nice;
  Attributes realTime, shortTurns;
  realTime.policy = SCHED_RR;
  realTime.priority = 1;
  realTime.flags = handedDown_ ? 0 : kResetOnFork;
  shortTurns.nice = now.nice;
  shortTurns.runtime = kShortTurn;
  changed_ = set(realTime) || set(shortTurns);
}

ScopedRealtimePriority::~ScopedRealtimePriority() {
  if (!changed_) return;
  Attributes usual;
  usual.nice = nice_;
  usual.flags = handedDown_ ? 0 : kResetOnFork;  // only root may undo it
  set(usual);
}

}  // namespace stadion
