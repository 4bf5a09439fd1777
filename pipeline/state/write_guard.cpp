#include "pipeline/state/write_guard.h"

#include <atomic>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace stadion {
namespace {

struct GuardedRange {
  std::byte* at = nullptr;
  std::size_t bytes = 0;
};

/// What the signal handler reads. Only the guard that exists writes it.
GuardedRange guardedRanges[WriteGuard::kMostRanges];
std::atomic<std::size_t> guardedCount = 0;
struct sigaction actionBefore {};

/// Of this thread. The handler must find it without a call that may allocate.
struct StageWrites {
  volatile bool inStage = false;
  void* volatile first = nullptr;
};
[[gnu::tls_model("initial-exec")]] thread_local constinit StageWrites stageWrites;

constexpr std::string_view kOutside =
    "stadion: --guard: a thread that runs no stage wrote to the published scene\n";

const GuardedRange* rangeOf(const void* address) {
  const auto* at = static_cast<const std::byte*>(address);
  for (std::size_t i = 0; i < guardedCount.load(std::memory_order_acquire); ++i)
    if (at >= guardedRanges[i].at && at < guardedRanges[i].at + guardedRanges[i].bytes)
      return &guardedRanges[i];
  return nullptr;
}

/// In a signal handler. The instruction that failed runs again when it returns.
extern "C" void noteGuardedWrite(int, siginfo_t* info, void*) {
  const int error = errno;
  const GuardedRange* range = rangeOf(info->si_addr);
  const bool ours = range && info->si_code == SEGV_ACCERR;
  if (ours && !stageWrites.inStage) {
    [[maybe_unused]] const auto n = write(STDERR_FILENO, kOutside.data(), kOutside.size());
    _exit(WriteGuard::kOutsideStages);
  }
  if (ours && !stageWrites.first) stageWrites.first = info->si_addr;
  if (!ours || mprotect(range->at, range->bytes, PROT_READ | PROT_WRITE) != 0)
    sigaction(SIGSEGV, &actionBefore, nullptr);
  errno = error;
}

}  // namespace

WriteGuard::WriteGuard() {
  assert(guardedCount == 0);
  struct sigaction ours {};
  ours.sa_sigaction = noteGuardedWrite;
  ours.sa_flags = SA_SIGINFO;
  sigaction(SIGSEGV, &ours, &actionBefore);
}

WriteGuard::~WriteGuard() {
  for (std::size_t i = 0; i < guardedCount; ++i) open(i);
  guardedCount = 0;
  struct sigaction now {};
  // After a fault elsewhere the handler of before is there already.
  if (sigaction(SIGSEGV, nullptr, &now) == 0 && now.sa_sigaction == noteGuardedWrite)
    sigaction(SIGSEGV, &actionBefore, nullptr);
}

std::size_t WriteGuard::add(std::byte* at, std::size_t bytes) {
  const std::size_t range = guardedCount;
  assert(range < kMostRanges);
  guardedRanges[range] = {at, bytes};
  guardedCount.store(range + 1, std::memory_order_release);
  return range;
}

void WriteGuard::open(std::size_t range) const {
  mprotect(guardedRanges[range].at, guardedRanges[range].bytes, PROT_READ | PROT_WRITE);
}

void WriteGuard::close(std::size_t range) const {
  mprotect(guardedRanges[range].at, guardedRanges[range].bytes, PROT_READ);
}

WriteGuard::Stage::Stage() {
  stageWrites.first = nullptr;
  stageWrites.inStage = true;
}

WriteGuard::Stage::~Stage() {
  stageWrites.inStage = false;
}

const void* WriteGuard::Stage::written() const {
  return stageWrites.first;
}

}  // namespace stadion
