#include "engine/hall_formats/neighbour_files.h"

#include "engine/base/plain_file.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace stadion {

NeighbourFiles neighboursOf(const std::string& configuration) {
  return [folder = std::filesystem::path(configuration).parent_path()](
             const std::string& name, std::size_t limit) -> Result<std::string> {
    std::string plain = name;
    std::ranges::replace(plain, '\\', '/');
    const std::filesystem::path path(plain);
    const bool upwards = std::ranges::find(path, std::filesystem::path("..")) != path.end();
    if (name.empty() || name.find('\0') != std::string::npos || path.is_absolute() || upwards)
      return Result<std::string>::failure(fmt::format(
          "{} must be the name of a file beside the configuration, or in a folder below", quotedWord(name)));
    return readPlainFile((folder / path).string(), limit);
  };
}

}  // namespace stadion
