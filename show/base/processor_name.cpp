#include "show/base/processor_name.h"

#include <fmt/format.h>
#include <fstream>

namespace stadion {

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  std::string name, family, model;
  // Of the first processor; virtual machines give many models the same name.
  for (std::string line; std::getline(file, line) && !line.empty();) {
    const std::size_t at = line.find(": ");
    if (at == line.npos) continue;
    if (line.starts_with("model name")) name = line.substr(at + 2);
    if (line.starts_with("cpu family")) family = line.substr(at + 2);
    if (line.starts_with("model\t")) model = line.substr(at + 2);
  }
  return name.empty() ? "an unknown processor" : fmt::format("{} (family {}, model {})", name, family, model);
}

}  // namespace stadion
