#include "pipeline/target/rasteriser_settings.h"

#include "pipeline/gl/problem.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <malloc.h>
#include <string>
#include <thread>

namespace stadion {
namespace {

constexpr const char* kVectorWidth = "LP_NATIVE_VECTOR_WIDTH";
constexpr const char* kThreads = "LP_NUM_THREADS";
constexpr unsigned kMostThreads = 32;  // Mesa takes no more

}  // namespace

// The C library takes the size as an int, and for the second value at most 32 MiB.
void keepFreedMemory() {
  constexpr int kKeptAtMost = 1 << 28, kOwnPagesFrom = 1 << 25;  // [bytes]
  mallopt(M_TRIM_THRESHOLD, kKeptAtMost);
  mallopt(M_MMAP_THRESHOLD, kOwnPagesFrom);
}

std::optional<unsigned> rasteriserThreadsGiven() {
  const char* threads = std::getenv(kThreads);
  if (!threads || !*threads) return {};
  return static_cast<unsigned>(std::clamp(std::atoi(threads), 0, static_cast<int>(kMostThreads)));
}

void setRasteriserThreads(unsigned threads) {
  constexpr int kReplace = 1;
  setenv(kThreads, std::to_string(threads).c_str(), kReplace);
}

std::optional<Diagnostic> checkRasteriser() {
  const char* width = std::getenv(kVectorWidth);
  if (!width || std::strcmp(width, "128") == 0 || std::strcmp(width, "256") == 0) return {};
  return problem(std::string(kVectorWidth) + "=" + width +
                 " is not supported, Mesa crashes with some widths: unset it, or set it to 256");
}

std::optional<Diagnostic> pinRasteriser() {
  constexpr int kKeepChoice = 0;
  const unsigned cores = std::clamp(std::thread::hardware_concurrency(), 1u, kMostThreads);
  setenv(kVectorWidth, "256", kKeepChoice);
  if (!rasteriserThreadsGiven()) setRasteriserThreads(cores);
  keepFreedMemory();
  return checkRasteriser();
}

}  // namespace stadion
