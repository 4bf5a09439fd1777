#include "profiling/regression/statistics/noise_calibration.h"

#include "profiling/regression/spans/planted_delay.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace stadion::regression {
namespace {

constexpr std::size_t kCells = 1 << 17;  // 1 MiB: beyond the first cache
constexpr int kRepeats = 5;

std::uint64_t next(std::uint64_t& x) {
  x = x * 6364136223846793005ULL + 1442695040888963407ULL;
  return x >> 20;
}

/// Returns cells that point to each other in one large circle.
std::vector<std::uint64_t> circle() {
  std::vector<std::uint64_t> order(kCells), cells(kCells);
  std::iota(order.begin(), order.end(), std::uint64_t{0});
  std::uint64_t x = 7;
  for (std::size_t i = kCells - 1; i > 0; --i) std::swap(order[i], order[next(x) % (i + 1)]);
  for (std::size_t i = 0; i < kCells; ++i) cells[order[i]] = order[(i + 1) % kCells];
  return cells;
}

double kernel(const std::vector<std::uint64_t>& cells, std::vector<double>& values) {
  std::uint64_t x = 1, at = 0;
  double sum = 0;
  for (std::size_t i = 0; i < 400'000; ++i) sum = sum * 0.999 + static_cast<double>(i) / (sum * sum + 1);
  for (double& v : values) v = static_cast<double>(next(x));
  std::ranges::sort(values);
  for (std::size_t i = 0; i < kCells; ++i) at = cells[at];
  return sum + values[values.size() / 2] + static_cast<double>(at);
}

}  // namespace

double calibrationMs() {
  const std::vector<std::uint64_t> cells = circle();
  std::vector<double> values(40'000);
  std::uint64_t least = ~std::uint64_t{0};
  for (int i = 0; i < kRepeats; ++i) {
    const std::uint64_t start = threadNanoseconds();
    volatile double kept = kernel(cells, values);
    (void)kept;
    least = std::min(least, threadNanoseconds() - start);
  }
  return 1e-6 * static_cast<double>(least);
}

}  // namespace stadion::regression
