#include "pipeline/platform/machine.h"

#include "engine/base/shared_library.h"
#include "pipeline/platform/topology.h"

#include <fmt/format.h>

namespace stadion {

bool Machine::isLike(const Machine& other) const {
  return processor == other.processor && cores == other.cores && processors == other.processors &&
         rasteriserBuild == other.rasteriserBuild;
}

Machine thisMachine() {
  const Topology topology = Topology::ofThisMachine();
  const auto library = SharedLibrary::open("libOSMesa.so.8", "libosmesa6");
  Machine m;
  m.processor = topology.model();
  m.cores = static_cast<std::uint32_t>(topology.cores());
  m.processors = static_cast<std::uint32_t>(topology.hardwareThreads());
  m.rasteriserBuild = library ? library.value().buildId() : "none";
  return m;
}

std::string textOf(const Machine& m) {
  const auto many = [](std::uint32_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  return fmt::format("{}, {}, {}, {}", m.processor.empty() ? "unknown processor" : m.processor,
                     many(m.cores, "core"), many(m.processors, "hardware thread"),
                     m.rasteriser.empty() ? "Mesa's build " + m.rasteriserBuild.substr(0, 8) : m.rasteriser);
}

}  // namespace stadion
