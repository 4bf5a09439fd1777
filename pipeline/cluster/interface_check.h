#pragma once
/// Checks that this host has the network interface that a cluster file names. Only a host that plays needs
/// it: the file may be written and checked elsewhere.
///
/// Threads  free function, any thread.

#include "pipeline/cluster/cluster_file.h"

namespace stadion {

/// Reports an error with its place in the file if no interface has that name or address, and lists those that
/// exist. Also reports an interface without multicast, and a loopback interface that is down.
void checkInterface(const ClusterFile& cluster, Diagnostics& out);

}  // namespace stadion
