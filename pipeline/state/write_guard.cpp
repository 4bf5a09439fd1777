#include "pipeline/state/write_guard.h"

#include "engine/base/running_stage.h"
#include "pipeline/state/guard_cost.h"

#include <atomic>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <string_view>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace stadion {

struct StageRecord {
  std::atomic<const void*> firstWrite = nullptr;  ///< its address; null: there was none
};

namespace {

struct GuardedRange {
  std::byte* at = nullptr;
  std::size_t bytes = 0;
};

/// What the signal handler reads. Only the guard that exists writes it.
GuardedRange guardedRanges[WriteGuard::kMostRanges];
std::atomic<std::size_t> guardedCount = 0;
struct sigaction actionBefore {};
GuardCost guardCost;

static_assert(std::atomic<const void*>::is_always_lock_free, "the signal handler must not wait");

/// Of the stage that began on this thread.
thread_local constinit StageRecord ownStage;

/// Names the thread. Calls only what a signal handler may.
void reportWriteOutsideStages() {
  constexpr std::size_t kNameBytes = 16;  // of the system
  char name[kNameBytes + 1] = {};
  prctl(PR_GET_NAME, name);
  for (const std::string_view part :
       {std::string_view("stadion: --guard: the thread \""), std::string_view(name),
        std::string_view("\", which runs no stage, wrote to the published scene\n")})
    [[maybe_unused]] const auto n = write(STDERR_FILENO, part.data(), part.size());
}

const GuardedRange* rangeOf(const void* address) {
  const auto* at = static_cast<const std::byte*>(address);
  for (std::size_t i = 0; i < guardedCount.load(std::memory_order_acquire); ++i)
    if (at >= guardedRanges[i].at && at < guardedRanges[i].at + guardedRanges[i].bytes)
      return &guardedRanges[i];
  return nullptr;
}

void protect(const GuardedRange& range, int rights) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point began = Clock::now();
  mprotect(range.at, range.bytes, rights);
  guardCost.milliseconds += std::chrono::duration<double, std::milli>(Clock::now() - began).count();
  ++guardCost.calls;
}

/// In a signal handler. The instruction that failed runs again when it returns.
extern "C" void noteGuardedWrite(int, siginfo_t* info, void*) {
  const int error = errno;
  const GuardedRange* range = rangeOf(info->si_addr);
  const bool ours = range && info->si_code == SEGV_ACCERR;
  StageRecord* const stage = RunningStage::current();
  if (ours && !stage) {
    reportWriteOutsideStages();
    _exit(WriteGuard::kOutsideStages);
  }
  const void* none = nullptr;
  if (ours) stage->firstWrite.compare_exchange_strong(none, info->si_addr);
  if (!ours || mprotect(range->at, range->bytes, PROT_READ | PROT_WRITE) != 0)
    sigaction(SIGSEGV, &actionBefore, nullptr);
  errno = error;
}

}  // namespace

WriteGuard::WriteGuard() {
  assert(guardedCount == 0);
  guardCost = {};
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
  protect(guardedRanges[range], PROT_READ | PROT_WRITE);
}

void WriteGuard::close(std::size_t range) const {
  protect(guardedRanges[range], PROT_READ);
}

WriteGuard::Stage::Stage() {
  ownStage.firstWrite = nullptr;
  RunningStage::begin(&ownStage);
}

WriteGuard::Stage::~Stage() {
  RunningStage::begin(nullptr);
}

const void* WriteGuard::Stage::written() const {
  return ownStage.firstWrite;
}

GuardCost costOfGuard() {
  return guardCost;
}

}  // namespace stadion
