#pragma once
/// Whether this machine has the network interface that a cluster file names. Only a machine that plays needs
/// it: the file may be written and checked elsewhere.
///
/// Threads  free function, any thread.

#include "pipeline/cluster/cluster_file.h"

namespace stadion {

/// An error with the place in the file if there is none of that name or address (with those that there are),
/// or if it has no multicast; and one if the loopback interface is not up.
void checkInterface(const ClusterFile& cluster, Diagnostics& out);

}  // namespace stadion
