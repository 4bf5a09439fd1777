#pragma once
/// Keeps sockets that a library opens to the loopback interface. Cyclone DDS sends from the interface that it
/// is given, but listens on every one: without this, other machines could talk to a cluster that is on one.
///
/// Threads  one at a time; no other thread should open sockets for the network meanwhile.

#include <set>
#include <string>

namespace stadion::cluster {

class LoopbackSockets {
public:
  /// Those that this process has already are somebody else's.
  LoopbackSockets();
  /// The sockets for UDP that have been opened since hear of the loopback interface alone. Empty, or why not.
  std::string bind() const;

private:
  std::set<int> before_;
};

/// This process's descriptors that are sockets for UDP over IP.
std::set<int> udpSockets();

}  // namespace stadion::cluster
