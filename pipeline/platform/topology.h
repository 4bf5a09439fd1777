#pragma once
/// What the machine's processors are, and how they lie to each other: packages, memories, cores, hardware
/// threads. Only those that this process may use count.
///
/// Ownership  owns hwloc's description.
/// Threads    one at a time; looking takes some milliseconds.
/// Errors     what cannot be found out is empty or 0.

#include "pipeline/platform/processor_set.h"

#include <memory>
#include <string>
#include <vector>

namespace stadion {

class Topology {
public:
  /// This machine's.
  static Topology ofThisMachine();
  /// One that is described by hwloc's words, such as "package:2 core:4 pu:2"; for tests.
  static Topology synthetic(const std::string& description);
  ~Topology();
  Topology(Topology&&) noexcept;
  Topology& operator=(Topology&&) noexcept;

  std::string model() const;            ///< of the processor, as its maker calls it
  std::size_t cores() const;            ///< that can work without sharing their units
  std::size_t hardwareThreads() const;  ///< processors, as the system counts them

  /// The processors in as many parts as there are walls, so that what is near to each other stays together.
  /// Where there are more walls than processors, several walls have the same one.
  std::vector<ProcessorSet> parts(std::size_t walls) const;

private:
  struct Loaded;
  explicit Topology(std::unique_ptr<Loaded> loaded);

  std::unique_ptr<Loaded> loaded_;  ///< null: nothing is known
};

}  // namespace stadion
