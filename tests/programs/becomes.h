#pragma once
/// Waiting for something that other processes do.

#include <chrono>
#include <thread>

namespace stadion {

/// Waits until what is asked for is so. The limit is no measure of speed: a machine may be busy.
template <class Asked>
bool becomes(const Asked& asked) {
  for (int i = 0; i < 30'000; ++i) {
    if (asked()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace stadion
