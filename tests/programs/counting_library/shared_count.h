#pragma once
/// A number in a file that several programs add to. It stays mapped: a program may ask for memory to its end.

#include <atomic>
#include <cstdint>
#include <fcntl.h>
#include <new>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace stadion {

/// Names the file; it holds eight zero bytes at first.
constexpr const char* kSharedCountVariable = "STADION_COUNT_ALLOCATIONS_IN";

class SharedCount {
public:
  /// Allocates nothing.
  explicit SharedCount(const char* file) {
    const int fd = ::open(file, O_RDWR | O_CLOEXEC);
    if (fd < 0) return;
    void* at = ::mmap(nullptr, sizeof(Count), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    ::close(fd);
    if (at != MAP_FAILED) count_ = static_cast<Count*>(at);
  }
  explicit SharedCount(const std::string& file) : SharedCount(file.c_str()) {}

  void add() {
    if (count_) count_->fetch_add(1, std::memory_order_relaxed);
  }
  std::uint64_t value() const { return count_ ? count_->load(std::memory_order_relaxed) : 0; }

private:
  using Count = std::atomic<std::uint64_t>;
  static_assert(Count::is_always_lock_free);

  Count* count_ = nullptr;
};

}  // namespace stadion
