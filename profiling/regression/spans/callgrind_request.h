#pragma once
/// Requests to valgrind's tool callgrind from a program that runs under it: write the instructions counted
/// since the last request under a label, and begin counting. Elsewhere it does nothing and costs some ten
/// instructions.
///
/// Source   Valgrind's manual, "The client request mechanism": valgrind recognises four rotations of a
///          register that leave it as it was. Requests of callgrind.h: 'C', 'T', then DUMP_STATS_AT = 3,
///          START_INSTRUMENTATION = 4.
/// Threads  any.

#include <cstdint>

namespace stadion::regression {

inline void askCallgrind(std::uint64_t request, const void* argument) {
#if defined(__x86_64__) && defined(__GNUC__)
  constexpr std::uint64_t kTool = (std::uint64_t{'C'} << 24) + (std::uint64_t{'T'} << 16);
  volatile std::uint64_t words[6] = {kTool + request, reinterpret_cast<std::uint64_t>(argument), 0, 0, 0, 0};
  std::uint64_t answer = 0;
  asm volatile("rolq $3, %%rdi; rolq $13, %%rdi; rolq $61, %%rdi; rolq $51, %%rdi; xchgq %%rbx, %%rbx"
               : "=d"(answer)
               : "a"(&words[0]), "0"(answer)
               : "cc", "memory");
#else
  (void)request;
  (void)argument;
#endif
}

inline void dumpInstructionsAs(const char* label) {
  askCallgrind(3, label);
}
inline void beginCountingInstructions() {
  askCallgrind(4, nullptr);
}

}  // namespace stadion::regression
