#include "pipeline/state/shared_segment.h"

#include <algorithm>
#include <fcntl.h>
#include <new>
#include <sys/mman.h>
#include <unistd.h>

namespace stadion {

SharedSegment::SharedSegment(const char* name, std::size_t reserveBytes) : reserve_(reserveBytes) {
  descriptor_ = memfd_create(name, MFD_CLOEXEC);
  if (descriptor_ < 0) throw std::bad_alloc();
  void* at = mmap(nullptr, reserve_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, descriptor_, 0);
  if (at == MAP_FAILED) {
    close(descriptor_);
    throw std::bad_alloc();
  }
  data_ = static_cast<std::byte*>(at);
}

SharedSegment::SharedSegment(int descriptor, std::size_t reserveBytes, Access access)
    : reserve_(reserveBytes), descriptor_(descriptor) {
  const int rights = access == Access::Write ? PROT_READ | PROT_WRITE : PROT_READ;
  void* at = mmap(nullptr, reserve_, rights, MAP_SHARED | MAP_NORESERVE, descriptor_, 0);
  if (at == MAP_FAILED) {
    close(descriptor_);
    throw std::bad_alloc();
  }
  data_ = static_cast<std::byte*>(at);
}

SharedSegment::~SharedSegment() {
  munmap(data_, reserve_);
  close(descriptor_);
}

void SharedSegment::growTo(std::size_t bytes) {
  if (bytes <= size_) return;
  // Grows in steps, so that a slowly growing scene does not call the system for every instance.
  const std::size_t step = std::max<std::size_t>(std::size_t{1} << 16, size_ / 2);
  const std::size_t wanted = std::min(std::max(bytes, size_ + step), reserve_);
  if (bytes > reserve_ || ftruncate(descriptor_, static_cast<off_t>(wanted)) != 0) throw std::bad_alloc();
  size_ = wanted;
}

void SharedSegment::discard(std::size_t offset, std::size_t bytes) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t first = (offset + page - 1) / page * page, last = (offset + bytes) / page * page;
  if (last > first)
    fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(first),
              static_cast<off_t>(last - first));
}

}  // namespace stadion
