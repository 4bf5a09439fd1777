#pragma once
/// Describes this machine, as far as the speed of drawing in software depends on it.
///
/// Threads  plain functions; thisMachine() loads OSMesa, but makes no context.

#include <cstdint>
#include <string>

namespace stadion {

struct Machine {
  std::string processor;         ///< name given by its maker
  std::uint32_t cores = 0;       ///< cores that this process may use
  std::uint32_t processors = 0;  ///< hardware threads that it may use
  std::string rasteriserBuild;   ///< build of OSMesa's library; differs between versions of Mesa
  std::string rasteriser{};  ///< description that the rasteriser gives of itself; for people, not compared

  /// Returns true if figures from one machine hold on the other.
  bool isLike(const Machine& other) const;
};

/// Leaves out the rasteriser's own description, which would require starting it.
Machine thisMachine();

/// "Intel(R) Xeon(R) Processor, 2 cores, 2 hardware threads, llvmpipe ... Mesa 22.3.6"
std::string textOf(const Machine& machine);

}  // namespace stadion
