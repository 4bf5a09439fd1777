#include "profiling/record/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

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
  return stadion::allocate(bytes, [bytes] { return std::malloc(bytes > 0 ? bytes : 1); });
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  // aligned_alloc wants whole multiples.
  const std::size_t whole = (bytes + align - 1) / align * align;
  return stadion::allocate(bytes,
                           [align, whole] { return std::aligned_alloc(align, whole > 0 ? whole : align); });
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
