/// A stage that writes to memory which has just been made read-only.

#include "tests/programs/fault_library/fault.h"

#include <atomic>
#include <dlfcn.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>

namespace {

const stadion::Fault& fault() {
  static const stadion::Fault protect("protect");
  return protect;
}

/// What a thread of that name is to write to; null: nothing.
std::atomic<volatile char*> planted = nullptr;

void writeIfNamed() {
  if (!planted.load(std::memory_order_relaxed)) return;
  char name[17] = "";
  prctl(PR_GET_NAME, name);
  if (!fault().begins(name, " thread=")) return;
  if (volatile char* const at = planted.exchange(nullptr)) *at = 1;
}

}  // namespace

extern "C" {

int mprotect(void* at, std::size_t bytes, int rights) noexcept {
  static const auto call = reinterpret_cast<decltype(&mprotect)>(dlsym(RTLD_NEXT, "mprotect"));
  static const long nth = fault().number(" nth=", 1), offset = fault().number(" offset=", 0);
  static std::atomic<long> count = 0;
  const int code = call(at, bytes, rights);
  constexpr std::size_t kLarge = std::size_t{1} << 30;
  if (!fault() || rights != PROT_READ || bytes < kLarge || ++count != nth) return code;
  volatile char* const byte = static_cast<volatile char*>(at) + offset;
  if (fault().has(" thread="))
    planted = byte;
  else
    *byte = 1;
  return code;
}

// A pool's thread unlocks its pool when it begins with a piece.
int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
  static const auto call =
      reinterpret_cast<decltype(&pthread_mutex_unlock)>(dlsym(RTLD_NEXT, "pthread_mutex_unlock"));
  writeIfNamed();
  return call(mutex);
}

}  // extern "C"
