#pragma once
/// A follower without a network, for tests of what it makes of messages.

#include "pipeline/cluster/follower.h"

#include <memory>
#include <string>

namespace stadion::cluster {

/// A cluster of two hosts.
inline ClusterFile room() {
  ClusterFile file;
  for (const char* name : {"front", "left"}) file.nodes.push_back({name, {name}, 1});
  return file;
}

/// The host "left", without a network.
inline std::unique_ptr<Follower> follower() {
  return Follower::unconnected({room(), 1, {1}, [](const std::string&) {}, [] { return true; }}, 7);
}

/// The session of a leader that begins, or has begun.
inline Session session(double rate, bool begun) {
  Session s{};
  s.number = 1, s.compatibility.script = 1, s.rate = rate, s.begun = begun, s.giver = kNoNode;
  return s;
}

}  // namespace stadion::cluster
