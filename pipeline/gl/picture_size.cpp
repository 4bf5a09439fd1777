#include "pipeline/gl/picture_size.h"

#include "pipeline/gl/problem.h"

#include <fmt/format.h>

namespace stadion {

std::optional<Diagnostic> checkPictureSize(std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0 || width > kMaxPictureSide || height > kMaxPictureSide)
    return problem(fmt::format("a picture of {} x {} pixels cannot be drawn: each side must be 1 to {}",
                               width, height, kMaxPictureSide));
  if (std::uint64_t{width} * height > kMaxPicturePixels)
    return problem(fmt::format("a picture of {} x {} pixels is too large: at most {} pixels in all", width,
                               height, kMaxPicturePixels));
  return {};
}

}  // namespace stadion
