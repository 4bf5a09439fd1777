/// Somebody sets the clock: the time of day jumps. Clocks that cannot be set go on.

#include "tests/programs/fault_library/fault.h"

#include <ctime>
#include <dlfcn.h>
#include <sys/time.h>

namespace {

using GetTime = int (*)(clockid_t, timespec*);

int realTime(clockid_t clock, timespec* now) {
  static const auto call = reinterpret_cast<GetTime>(dlsym(RTLD_NEXT, "clock_gettime"));
  return call(clock, now);
}

long millisecondsUp() {
  timespec now{};
  realTime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000 + now.tv_nsec / 1'000'000;
}

/// Of this moment [s].
long jump() {
  static const stadion::Fault fault("clock");
  static const long by = fault.number(" jump=", 0), at = millisecondsUp() + fault.number(" after=", 0);
  return by != 0 && millisecondsUp() >= at ? by : 0;
}

[[gnu::constructor]] void begin() {
  jump();
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const int code = realTime(clock, now);
  if (code == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) now->tv_sec += jump();
  return code;
}

int gettimeofday(timeval* now, void*) noexcept {
  timespec precise{};
  const int code = clock_gettime(CLOCK_REALTIME, &precise);
  now->tv_sec = precise.tv_sec, now->tv_usec = precise.tv_nsec / 1000;
  return code;
}

std::time_t time(std::time_t* to) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (to) *to = now.tv_sec;
  return now.tv_sec;
}

}  // extern "C"
