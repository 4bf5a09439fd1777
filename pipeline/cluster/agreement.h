#pragma once
/// What all machines of a cluster must have alike to play one show, and what follows where they have not.
///
/// Threads  plain values.

#include "pipeline/cluster/cluster_file.h"

#include <cstdint>
#include <string>
#include <wire.h>  // made from wire.idl

namespace stadion::cluster {

struct Agreement {
  std::uint64_t script = 0;   ///< hash of its text
  std::uint64_t input = 0;    ///< hash of the input log; 0: nobody plays one
  std::uint64_t cluster = 0;  ///< hashOf() the cluster file
  std::uint64_t walls = 0;    ///< hash of the wall file
  std::string pictures{};     ///< what they look like; may differ where machines do [120 bytes at most]
  std::string plugins{};      ///< names, versions and hashes of its plugins; empty: none [250 bytes at most]

  /// Who leads anew goes on with a show of the same script and input only.
  std::uint64_t show() const;
};

/// Of what the file says to all; which interface a machine has is its own.
std::uint64_t hashOf(const ClusterFile& file);

stadion_wire_Agreement written(const Agreement& agreement);
Agreement read(const stadion_wire_Agreement& agreement);

/// Why `ours` cannot follow `lead`; empty: it can. An input log is played by who leads alone.
std::string refusal(const Agreement& lead, const Agreement& ours, const std::string& nameOfLead);
/// What will be seen to differ; empty: nothing.
std::string remark(const Agreement& lead, const Agreement& ours, const std::string& nameOfLead);

/// What to tell where one of another cluster is heard in the network of ours.
std::string inTheWay(const ClusterFile& ours);

}  // namespace stadion::cluster
