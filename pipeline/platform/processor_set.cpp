#include "pipeline/platform/processor_set.h"

#include <bit>
#include <sched.h>

namespace stadion {

static_assert(ProcessorSet::kMost <= CPU_SETSIZE);

void ProcessorSet::add(std::size_t processor) {
  if (processor < kMost) bits_[processor / 64] |= std::uint64_t{1} << (processor % 64);
}

bool ProcessorSet::contains(std::size_t processor) const {
  return processor < kMost && (bits_[processor / 64] >> (processor % 64) & 1) != 0;
}

std::size_t ProcessorSet::size() const {
  std::size_t n = 0;
  for (const std::uint64_t word : bits_) n += static_cast<std::size_t>(std::popcount(word));
  return n;
}

bool ProcessorSet::bindThread(int thread) const {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (std::size_t i = 0; i < kMost; ++i)
    if (contains(i)) CPU_SET(i, &set);
  return sched_setaffinity(thread, sizeof set, &set) == 0;
}

ProcessorSet processorsOfThisThread() {
  cpu_set_t set;
  CPU_ZERO(&set);
  ProcessorSet mine;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return mine;
  for (std::size_t i = 0; i < ProcessorSet::kMost; ++i)
    if (CPU_ISSET(i, &set)) mine.add(i);
  return mine;
}

}  // namespace stadion
