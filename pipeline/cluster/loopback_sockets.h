#pragma once
/// Binds the sockets that a library opens to the loopback interface. Cyclone DDS sends from the interface
/// that it is given, but listens on all of them. Without this class, other hosts could talk to a cluster on
/// one host.
///
/// Threads  one at a time; no other thread should open sockets for the network meanwhile.

#include <set>
#include <string>

namespace stadion::cluster {

class LoopbackSockets {
public:
  /// Remembers the process's current sockets, which other code owns.
  LoopbackSockets();
  /// Restricts the UDP sockets opened since then to the loopback interface. Returns empty, or why it failed.
  std::string bind() const;

private:
  std::set<int> before_;
};

/// Returns this process's descriptors that are sockets for UDP over IP.
std::set<int> udpSockets();

}  // namespace stadion::cluster
