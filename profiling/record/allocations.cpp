#include "profiling/record/allocations.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>
#include <sys/mman.h>

#ifdef STADION_SANITIZED
#define STADION_COUNTS_ALLOCATIONS 0
#else
#define STADION_COUNTS_ALLOCATIONS 1
#endif

namespace stadion {
namespace {

thread_local Allocations soFar;
std::atomic<std::uint64_t> ofAll = 0;

}  // namespace

Allocations allocationsSoFar() {
  return soFar;
}

std::uint64_t allocationsOfAllThreads() {
  return ofAll.load(std::memory_order_relaxed);
}

bool countsAllocations() {
  return STADION_COUNTS_ALLOCATIONS == 1;
}

#if STADION_COUNTS_ALLOCATIONS
namespace {

/// x86-64's and most of Arm's.
constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// A block of many pages gets large ones if the system has some: it is touched for the first time in a fraction of the
/// time, and reading it here and there misses fewer translations. What does not fill one has small ones, as ever.
void* takeBlock(std::size_t bytes, std::size_t alignment) {
  void* memory = std::aligned_alloc(std::max(alignment, kLargePage), bytes);
  // Only advice: without it, or without large pages, the block is as good.
  if (memory) madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
  return memory;
}

/// As the standard requires: calls the handler until there is memory, or until it throws.
template <class Take>
void* allocate(std::size_t bytes, const Take& take) {
  ++soFar.count;
  soFar.bytes += bytes;
  ofAll.fetch_add(1, std::memory_order_relaxed);
  for (;;) {
    if (void* memory = take()) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}

}  // namespace
#endif

}  // namespace stadion

// The other forms (arrays, nothrow, sized) call these.
#if STADION_COUNTS_ALLOCATIONS
void* operator new(std::size_t bytes) {
  return stadion::allocate(bytes, [bytes] {
    return bytes < stadion::kLargePage ? std::malloc(bytes > 0 ? bytes : 1) : stadion::takeBlock(bytes, 1);
  });
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  // aligned_alloc wants whole multiples.
  const std::size_t whole = (bytes + align - 1) / align * align;
  return stadion::allocate(bytes, [align, whole] {
    return whole < stadion::kLargePage ? std::aligned_alloc(align, whole > 0 ? whole : align)
                                       : stadion::takeBlock(whole, align);
  });
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
#endif
