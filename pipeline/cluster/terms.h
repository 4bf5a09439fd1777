#pragma once
/// What who leads and who follows hold to alike.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>

namespace stadion::cluster {

constexpr std::size_t kMostTold = 200;           ///< of what another machine says [characters]
constexpr std::chrono::milliseconds kLook{100};  ///< how often a wait looks whether it is still wanted

/// A number that no other session or machine has; never 0.
inline std::uint64_t anyNumber() {
  std::random_device device;
  return std::uint64_t{device()} << 32U | device() | 1U;
}

}  // namespace stadion::cluster
