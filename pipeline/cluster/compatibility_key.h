#pragma once
/// The files and settings that all hosts of a cluster must share to play one show, and the checks for
/// differences between them.
///
/// Threads  plain values.

#include "pipeline/cluster/cluster_file.h"

#include <cstdint>
#include <string>
#include <wire.h>  // made from wire.idl

namespace stadion::cluster {

struct CompatibilityKey {
  std::uint64_t script = 0;   ///< hash of its text
  std::uint64_t input = 0;    ///< hash of the input log; 0: no log is played
  std::uint64_t cluster = 0;  ///< hashOf() the cluster file
  std::uint64_t walls = 0;    ///< hash of the wall file
  /// Options of the pictures, such as --look; may differ where machines do [120 bytes at most].
  std::string pictures{};
  std::string plugins{};  ///< names, versions and hashes of its plugins; empty: none [250 bytes at most]

  /// Hash of the script and the input log. A new leader continues a show only if this hash is the same.
  std::uint64_t show() const;
};

/// Hashes what the file says for all hosts. The interface is left out: each host has its own.
std::uint64_t hashOf(const ClusterFile& file);

stadion_wire_CompatibilityKey written(const CompatibilityKey& agreement);
CompatibilityKey read(const stadion_wire_CompatibilityKey& agreement);

/// Returns why `ours` cannot follow `lead`; empty if it can. Only the leader plays an input log.
std::string refusal(const CompatibilityKey& lead, const CompatibilityKey& ours,
                    const std::string& nameOfLead);
/// Returns the settings that will look different; empty if there are none.
std::string remark(const CompatibilityKey& lead, const CompatibilityKey& ours, const std::string& nameOfLead);

/// Returns the message to log if a host of another cluster is heard in our network.
std::string inTheWay(const ClusterFile& ours);

}  // namespace stadion::cluster
