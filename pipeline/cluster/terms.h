#pragma once
/// What who leads and who follows hold to alike.

#include "pipeline/cluster/bus.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>

namespace stadion::cluster {

constexpr std::size_t kMostTold = 200;           ///< of what another machine says [characters]
constexpr std::chrono::milliseconds kLook{100};  ///< how often a wait looks whether it is still wanted
constexpr std::chrono::seconds kLong{2};         ///< who waits so long says what for

/// A number that no other session or machine has; never 0. Of two the one that was taken earlier is lower, as
/// far as the machines' clocks agree.
inline std::uint64_t anyNumber() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto ms =
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
  return ms << 20U | (std::random_device{}() & 0xfffffU) | 1U;
}

/// Whether there is a show in a session: it has begun, or goes on with that of another one.
inline bool hasShow(const Session& s) {
  return s.begun || s.resumes != 0;
}
/// Of two programs that lead, whether `other` goes on: of two that have a show the later one, which has
/// looked for the earlier one in vain; of two that have none the earlier one.
inline bool supersedes(const Session& other, const Session& ours) {
  return other.number > ours.number ? hasShow(other) : !hasShow(ours);
}

}  // namespace stadion::cluster
