#pragma once
/// Constants and rules that the leader and its followers share.

#include "pipeline/cluster/bus.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>

namespace stadion::cluster {

/// Limit for text from another host [characters].
constexpr std::size_t kMaxRemoteText = 200;
/// How often a wait checks whether it is still wanted.
constexpr std::chrono::milliseconds kPollInterval{100};
/// A wait of this length logs its reason.
constexpr std::chrono::seconds kLongWait{2};

/// Returns a number that no other session or host has; never 0. Of two numbers the earlier one is lower, as
/// far as the hosts' clocks agree.
inline std::uint64_t anyNumber() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto ms =
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
  return ms << 20U | (std::random_device{}() & 0xfffffU) | 1U;
}

/// Returns true if a session has a show: it has begun, or continues another session's show.
inline bool hasShow(const Session& s) {
  return s.begun || s.resumes != 0;
}
/// Returns true if `other` leads on, of two leaders. If both have a show, it is the later one, which has
/// looked for the earlier one in vain. If neither has one, it is the earlier one.
inline bool supersedes(const Session& other, const Session& ours) {
  return other.number > ours.number ? hasShow(other) : !hasShow(ours);
}

}  // namespace stadion::cluster
