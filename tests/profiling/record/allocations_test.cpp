/// Memory from operator new: counted, and on large pages where a block has room for them.

#include "profiling/record/allocations.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <sys/resource.h>

namespace stadion {
namespace {

bool systemHasLargePages() {
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  std::string modes;
  std::getline(file, modes);
  return modes.find('[') != std::string::npos && modes.find("[never]") == std::string::npos;
}

long smallFaults() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return use.ru_minflt;
}

TEST(Allocations, CountBlocksOfEverySize) {
  if (!countsAllocations()) GTEST_SKIP() << "a sanitizer counts its own";
  for (const std::size_t bytes :
       {std::size_t{0}, std::size_t{1}, std::size_t{5} << 20, std::size_t{2} << 20}) {
    const Allocations before = allocationsSoFar();
    ::operator delete(::operator new(bytes));
    const Allocations during = allocationsSoFar() - before;
    EXPECT_EQ(during.count, 1u);
    EXPECT_EQ(during.bytes, bytes);
  }
}

TEST(Allocations, LargeBlocksKeepTheirAlignment) {
  for (const std::size_t bytes : {std::size_t{64}, std::size_t{3} << 20, (std::size_t{4} << 20) + 1}) {
    const std::align_val_t alignment{std::size_t{1} << 14};
    void* memory = ::operator new(bytes, alignment);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % (std::size_t{1} << 14), 0u);
    std::memset(memory, 1, bytes);
    ::operator delete(memory, alignment);
  }
}

TEST(Allocations, ALargeBlockIsFilledWithFewFaults) {
  if (!countsAllocations()) GTEST_SKIP() << "a sanitizer has an operator new of its own";
  constexpr std::size_t kBytes = (std::size_t{48} << 20) + 4096;
  const long before = smallFaults();
  std::unique_ptr<char[]> block(new char[kBytes]);
  std::memset(block.get(), 7, kBytes);
  const long during = smallFaults() - before;
  EXPECT_EQ(block[kBytes - 1], 7);
  // Small pages would take 12289. A machine whose memory is in pieces may lack some large ones.
  if (systemHasLargePages()) {
    EXPECT_LT(during, 6200);
  }
}

}  // namespace
}  // namespace stadion
