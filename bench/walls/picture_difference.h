#pragma once
/// Differences between two programs' pictures of the same frame.
///
/// Threads  plain functions.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stadion::bench {

struct RgbPicture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< top row first
};

/// A binary PPM file with 8 bits a channel.
Result<RgbPicture> readPpm(const std::string& file);
/// Returns false if it could not be written.
bool writePpm(const std::string& file, const RgbPicture& picture);

struct PictureDifference {
  double beyond = 0;  ///< share of pixels with a channel that differs by more than `most`
  int worst = 0;      ///< greatest difference of any channel, of 255
};
/// Expects pictures of one size.
PictureDifference difference(const RgbPicture& a, const RgbPicture& b, int most = 2);

/// Differences of the views of one frame.
struct ViewsDifference {
  double frame = 0;      ///< share of the pixels of all views
  double worstView = 0;  ///< the greatest share of the pixels of one view
  std::string view;      ///< view with that share, such as "front_R"; empty: no view differs
  int worst = 0;         ///< greatest difference of any channel, of 255
};
/// Compares the pictures PREFIX_WALL_EYE.ppm of the first walls, both eyes.
Result<ViewsDifference> differenceOfViews(const std::string& prefix, const std::string& other,
                                          std::size_t walls);

}  // namespace stadion::bench
