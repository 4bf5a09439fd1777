#pragma once
/// Lets the calling thread run only when the show's threads leave a processor free.
///
/// The thread gets the nice value 19 and the batch policy: the system does not interrupt a thread of the show to run
/// it. It still gets a little time if all processors are busy, so that the operator can act then.
///
/// Threads  the calling one.

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace stadion {

inline void yieldToShow(const char* name) {
  const sched_param none{};
  sched_setscheduler(0, SCHED_BATCH, &none);
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), 19);
  pthread_setname_np(pthread_self(), name);
}

}  // namespace stadion
