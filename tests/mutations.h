#pragma once
/// How many damaged inputs the tests of robustness try, and which.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace stadion::test {

struct Mutations {
  int count = 0;
  std::uint64_t seed = 0;
};

/// `usual` many with seed 0; under STADION_FULL 10 000. STADION_MUTATIONS and STADION_SEED override both.
inline Mutations mutations(int usual) {
  Mutations m{std::getenv("STADION_FULL") ? 10'000 : usual, 0};
  if (const char* count = std::getenv("STADION_MUTATIONS")) m.count = std::atoi(count);
  if (const char* seed = std::getenv("STADION_SEED")) m.seed = std::strtoull(seed, nullptr, 10);
  if (m.count < 1) m.count = 1;
  std::printf("%d damaged inputs, STADION_SEED=%llu\n", m.count, static_cast<unsigned long long>(m.seed));
  return m;
}

}  // namespace stadion::test
