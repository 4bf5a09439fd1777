/// Preloaded into a program, counts how often it asks for memory with operator new, in a file that a test
/// looks into meanwhile.

#include "tests/programs/counting_library/shared_count.h"

#include <cstdlib>
#include <new>

namespace {

void count() {
  static stadion::SharedCount shared([] {
    const char* file = std::getenv(stadion::kSharedCountVariable);
    return file ? file : "";
  }());
  shared.add();
}

}  // namespace

// The other forms (arrays, nothrow, sized) call these.
void* operator new(std::size_t bytes) {
  count();
  if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  count();
  const auto align = static_cast<std::size_t>(alignment);
  const std::size_t whole = (bytes + align - 1) / align * align;
  if (void* memory = std::aligned_alloc(align, whole > 0 ? whole : align)) return memory;
  throw std::bad_alloc();
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
