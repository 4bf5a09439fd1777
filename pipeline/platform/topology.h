#pragma once
/// The machine's processors and their relation to each other: packages, memories, cores, hardware threads.
/// Only processors that this process may use count.
///
/// Ownership  owns hwloc's description.
/// Threads    one at a time; loading takes some milliseconds.
/// Errors     unknown values are empty or 0.

#include "pipeline/platform/processor_set.h"

#include <memory>
#include <string>
#include <vector>

namespace stadion {

class Topology {
public:
  /// Returns this machine's topology.
  static Topology ofThisMachine();
  /// Returns a topology described in hwloc's words, such as "package:2 core:4 pu:2"; for tests.
  static Topology synthetic(const std::string& description);
  ~Topology();
  Topology(Topology&&) noexcept;
  Topology& operator=(Topology&&) noexcept;

  std::string model() const;            ///< name of the processor, given by its maker
  std::size_t cores() const;            ///< number of cores, which do not share units
  std::size_t hardwareThreads() const;  ///< processors, as the system counts them

  /// Divides the processors into one part per wall and keeps close ones together. With more walls than
  /// processors, several walls get the same one.
  std::vector<ProcessorSet> parts(std::size_t walls) const;

private:
  struct Loaded;
  explicit Topology(std::unique_ptr<Loaded> loaded);

  std::unique_ptr<Loaded> loaded_;  ///< null if unknown
};

}  // namespace stadion
