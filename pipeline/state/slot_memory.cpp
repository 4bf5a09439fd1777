#include "pipeline/state/slot_memory.h"

#include <memory>
#include <new>
#include <sys/mman.h>

namespace stadion {
namespace {

constexpr std::size_t kLargePage = std::size_t{1} << 21;

}  // namespace

SlotMemory::SlotMemory(std::size_t reserveBytes)
    : mappedBytes_(reserveBytes + kLargePage), reserve_(reserveBytes) {
  mapped_ =
      mmap(nullptr, mappedBytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped_ == MAP_FAILED) throw std::bad_alloc();
  void* at = mapped_;
  std::size_t room = mappedBytes_;
  data_ = static_cast<std::byte*>(std::align(kLargePage, reserve_, at, room));
  madvise(data_, reserve_, MADV_HUGEPAGE);  // if the system has no large pages, small ones are used
}

SlotMemory::~SlotMemory() {
  munmap(mapped_, mappedBytes_);
}

void SlotMemory::growTo(std::size_t bytes) const {
  if (bytes > reserve_) throw std::bad_alloc();
}

}  // namespace stadion
