/// Memory that is not there.
///
/// The program has an operator new of its own, which libraries use as well, and which asks malloc. So malloc
/// is where it fails; what libraries of C ask for themselves does not.

#include "tests/programs/fault_library/fault.h"

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <dlfcn.h>
#include <link.h>

extern "C" {
// The C library's own.
void* __libc_malloc(std::size_t bytes);
void* __libc_memalign(std::size_t alignment, std::size_t bytes);
}

namespace {

using Main = int (*)(int, char**, char**);

/// Where the program's own code lies.
struct Code {
  std::uintptr_t begin = 0, end = 0;

  bool holds(const void* place) const {
    const auto at = reinterpret_cast<std::uintptr_t>(place);
    return at >= begin && at < end;
  }
};

int findCode(dl_phdr_info* object, std::size_t, void* to) {  // the program comes first
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || !(part.p_flags & PF_X)) continue;
    const std::uintptr_t begin = object->dlpi_addr + part.p_vaddr;
    *static_cast<Code*>(to) = {begin, begin + part.p_memsz};
  }
  return 1;
}

Code codeOfProgram() {
  Code code;
  dl_iterate_phdr(findCode, &code);
  return code;
}

struct Allocations {
  const stadion::Fault fault{"new"};
  const long nth = fault.number(" nth=", 0), from = fault.number(" from=", 0);
  const bool tell = fault.number(" tell=", 0) != 0;
  const Code code = codeOfProgram();
  std::atomic<long> asked = 0;

  bool fails(const void* caller) {
    if (!fault || !code.holds(caller)) return false;
    const long number = ++asked;
    return number == nth || (from > 0 && number >= from);
  }
};

std::atomic<Allocations*> counted = nullptr;  // from main() to its end
Main programsMain = nullptr;

int countedMain(int argc, char** argv, char** environment) {
  static Allocations allocations;  // a thread may outlive main()
  counted = &allocations;
  const int code = programsMain(argc, argv, environment);
  counted = nullptr;
  if (allocations.tell) std::fprintf(stderr, "asked for memory: %ld\n", allocations.asked.load());
  return code;
}

bool fails(const void* caller) {
  Allocations* now = counted;
  return now && now->fails(caller);
}

void* nothing() {
  errno = ENOMEM;
  return nullptr;
}

}  // namespace

extern "C" {

int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(), void (*rtldFini)(),
                      void* stackEnd) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  programsMain = main;
  return start(countedMain, argc, argv, init, fini, rtldFini, stackEnd);
}

void* malloc(std::size_t bytes) {
  return fails(__builtin_return_address(0)) ? nothing() : __libc_malloc(bytes);
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  return fails(__builtin_return_address(0)) ? nothing() : __libc_memalign(alignment, bytes);
}

}  // extern "C"
