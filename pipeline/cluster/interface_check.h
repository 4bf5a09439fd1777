#pragma once
/// Whether this machine has the network interface that a cluster file names. Only a machine that plays needs
/// it: the file may be written and checked elsewhere.
///
/// Threads  free function, any thread.

#include "pipeline/cluster/cluster_file.h"

namespace stadion {

/// An error with the place in the file, and the interfaces that there are, if there is none of that name or
/// address.
void checkInterface(const ClusterFile& cluster, Diagnostics& out);

}  // namespace stadion
