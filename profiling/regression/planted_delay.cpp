#include "profiling/regression/planted_delay.h"

#include <charconv>
#include <ctime>

namespace stadion::regression {

std::optional<PlantedDelay> PlantedDelay::parse(const std::string& text) {
  const std::size_t colon = text.find(':'), equals = text.rfind('=');
  if (colon == text.npos || equals == text.npos || equals < colon) return std::nullopt;
  const std::string where = text.substr(0, colon), count = text.substr(equals + 1);
  PlantedDelay planted;
  planted.name = text.substr(colon + 1, equals - colon - 1);
  const auto [end, problem] = std::from_chars(count.data(), count.data() + count.size(), planted.iterations);
  if (problem != std::errc() || end != count.data() + count.size() || planted.name.empty())
    return std::nullopt;
  if (where == "simulate")
    planted.where = Where::Simulate;
  else if (where == "draw")
    planted.where = Where::Draw;
  else if (where != "cull")
    return std::nullopt;
  return planted;
}

// A chain of multiplications: each needs the one before, so that no processor does several at a time.
void burn(std::uint64_t iterations) {
  std::uint64_t x = 1;
  for (std::uint64_t i = 0; i < iterations; ++i) x = x * 6364136223846793005ULL + 1442695040888963407ULL;
  volatile std::uint64_t kept = x;
  (void)kept;
}

std::uint64_t threadNanoseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<std::uint64_t>(t.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(t.tv_nsec);
}

}  // namespace stadion::regression
