#pragma once
/// Which machine this is, as far as drawing in software depends on it.
///
/// Threads  plain functions; thisMachine() loads OSMesa, but makes no context.

#include <cstdint>
#include <string>

namespace stadion {

struct Machine {
  std::string processor;         ///< as its maker calls it
  std::uint32_t cores = 0;       ///< that this process may use
  std::uint32_t processors = 0;  ///< hardware threads that it may use
  std::string rasteriserBuild;   ///< of OSMesa's library: another version of Mesa has another one
  std::string rasteriser{};      ///< as it describes itself; for people, no part of the comparison

  /// Whether what was measured on the one holds on the other.
  bool isLike(const Machine& other) const;
};

/// Without the rasteriser's description of itself, for which it would have to be started.
Machine thisMachine();

/// "Intel(R) Xeon(R) Processor, 2 cores, 2 hardware threads, llvmpipe ... Mesa 22.3.6"
std::string textOf(const Machine& machine);

}  // namespace stadion
