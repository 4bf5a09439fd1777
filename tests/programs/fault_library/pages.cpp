/// A stage that writes to memory which has just been made read-only.

#include "tests/programs/fault_library/fault.h"

#include <atomic>
#include <dlfcn.h>
#include <sys/mman.h>

extern "C" {

int mprotect(void* at, std::size_t bytes, int rights) noexcept {
  static const auto call = reinterpret_cast<decltype(&mprotect)>(dlsym(RTLD_NEXT, "mprotect"));
  static const stadion::Fault fault("protect");
  static const long nth = fault.number(" nth=", 1), offset = fault.number(" offset=", 0);
  static std::atomic<long> count = 0;
  const int code = call(at, bytes, rights);
  constexpr std::size_t kLarge = std::size_t{1} << 30;
  if (!fault || rights != PROT_READ || bytes < kLarge || ++count != nth) return code;
  static_cast<volatile char*>(at)[offset] = 1;
  return code;
}

}  // extern "C"
