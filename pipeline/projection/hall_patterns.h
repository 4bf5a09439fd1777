#pragma once
/// Patterns for setting up a hall, for all its outputs.
///
/// Room    flat walls: metres, name and cube (picture/test_pattern.h). Projectors and panoramas: lines of equal
///         azimuth and elevation around the usual place of the eyes, every 10 degrees and heavy every 30, and the cube. They
///         go through views, warp and blend as a show does. So lines of neighbours lie on each other where the
///         hall is as its file says.
/// Pixels, Gamma, Bars  the output alone, pixel by pixel (picture/output_pattern.h).
/// Blend   white through the blend: each projector shows its ramps, and the screen is evenly white.
///
/// Ownership  copies the hall.
/// Threads    one at a time.

#include "engine/base/diagnostic.h"
#include "engine/display/wall_file.h"
#include "pipeline/picture/picture.h"
#include "pipeline/projection/hall_pictures.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace stadion {

enum class HallPattern { Room, Pixels, Blend, Gamma, Bars };

class HallPatterns {
public:
  /// Not `stereo`: one picture from the middle between the eyes. Fails as HallPictures does.
  static Result<std::unique_ptr<HallPatterns>> create(const WallFile& hall, bool stereo);

  /// Returns the pictures of an entry, for each eye that it shows. A flat wall's have this size, those of others
  /// that of their output.
  std::vector<Picture> pictures(std::size_t entry, HallPattern pattern, std::uint32_t width,
                                std::uint32_t height);

  /// Takes over an entry of another version of the hall. What the entry shares with others is made again for it
  /// alone. Keeps the old pictures if there can be none.
  void change(const WallFile& hall, std::size_t entry);

private:
  HallPatterns(const WallFile& hall, bool stereo);
  std::vector<Picture> projected(std::size_t entry, HallPattern pattern);
  Picture ofOutput(std::size_t entry, HallPattern pattern, std::optional<Eye> eye, std::uint32_t width,
                   std::uint32_t height) const;

  WallFile hall_;
  bool stereo_;
  std::unique_ptr<HallPictures> views_;  ///< null: no projector
};

}  // namespace stadion
