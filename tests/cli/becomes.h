#pragma once
/// Waiting for something that other processes do.

#include <chrono>
#include <thread>

namespace stadion {

/// Waits until what is asked for is so, for a minute at most.
template <class Asked>
bool becomes(const Asked& asked) {
  for (int i = 0; i < 6000; ++i) {
    if (asked()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace stadion
