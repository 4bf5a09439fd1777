#pragma once
/// What the targets for foreign halls share: a configuration and the one file that it finds under every name.

#include "engine/display/wall_file.h"
#include "engine/hall_formats/neighbour_files.h"
#include "tests/fuzz/targets.h"

#include <algorithm>
#include <string>

namespace stadion::fuzz {

struct HallBytes {
  std::string configuration, file;

  explicit HallBytes(Bytes bytes) {
    const std::string_view text = asText(bytes);
    const std::size_t end = std::min(text.find('\0'), text.size());
    configuration = text.substr(0, end);
    file = text.substr(std::min(end + 1, text.size()));
  }

  NeighbourFiles reader() const {
    return [content = file](const std::string& name, std::size_t limit) {
      if (name.empty() || content.size() > limit)
        return Result<std::string>::failure("there is no such file");
      return Result<std::string>(content);
    };
  }
};

/// Checks what every reader of halls promises.
inline void requireSound(const std::optional<WallFile>& hall, const Diagnostics& findings) {
  require(hall.has_value() || findings.hasErrors(), "what is refused has a reason");
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
  if (!hall) return;
  require(!hall->walls.empty() && hall->walls.size() <= WallFile::kMaxWalls,
          "a hall has walls, and not too many");
  for (const WallEntry& entry : hall->walls) {
    if (!entry.projector) {
      require(entry.wall.lowerLeft.allFinite() && entry.wall.upperRight().allFinite(), "a wall has corners");
      continue;
    }
    require(entry.projector->screen < hall->screens.size(), "a projector has a screen");
    if (const auto* image = std::get_if<MeasuredImage>(&entry.projector->image))
      require(image->points.size() == std::size_t{image->columns} * image->rows, "a grid has all its points");
    if (const auto& alpha = entry.projector->blend.alpha)
      require(alpha->values.size() == std::size_t{alpha->width} * alpha->height * alpha->channels,
              "a light map has all its values");
  }
}

}  // namespace stadion::fuzz
