#pragma once
/// What all projectors of a hall light, and how they share the light where they overlap.
///
/// Shares   of two projectors that light a point, each gets a share in proportion to the square of its
///          distance to the edges of its picture: its borders, or lines inside that the wall file states. So shares sum to 1, and ramps have no kink at their ends.
///          Projectors for different eyes do not share.
/// Black    a projector's black pixels give some light. Where fewer of them lie on each other, projectors
///          lift their blacks to the brightest sum in the hall.
/// White    the hall's white is that of its darkest projector, by channel.
/// Frames   R is the rig. A pixel's centre is at 0.5.
/// Ownership  borrows the hall.
/// Threads    constant after it was made; then any.
/// Errors   a mask that cannot be read.

#include "engine/base/diagnostic.h"
#include "engine/display/wall_file.h"
#include "pipeline/picture/picture.h"
#include "pipeline/projection/pixel_map.h"
#include "pipeline/projection/thrown_image.h"
#include "pipeline/projection/warp_kernel.h"

#include <memory>
#include <optional>
#include <vector>

namespace stadion {

/// Returns the value from 0 to 1 that gives this part of a display's light. `gamma`: 0 = the curve of sRGB.
double displayValue(double light, double gamma);

/// Returns how light becomes values of a projector, if the hall's white and black have this light.
WarpLight warpLight(const ProjectorLight& light, const std::array<double, 3>& white, double black);

class BlendedHall {
public:
  static Result<std::unique_ptr<BlendedHall>> create(const WallFile& hall);

  /// Returns what a place of the entry's output lights [pixels]; nothing: no screen.
  std::optional<LitPoint> litBy(std::size_t entry, double x, double y) const;
  /// Returns the image of an entry that is a projector.
  const ThrownImage& imageOf(std::size_t entry) const { return *images_[entry]; }
  /// Returns how light becomes values of the entry's projector.
  WarpLight lightOf(std::size_t entry) const;

private:
  explicit BlendedHall(const WallFile& hall);
  std::optional<Diagnostic> readMasks();
  const Projector& projector(std::size_t entry) const { return *hall_.walls[entry].projector; }
  bool mayShare(std::size_t a, std::size_t b) const;
  double blackAt(std::size_t entry, const Vec3& point) const;
  void findBrightestBlack();
  Vec3 maskAt(std::size_t entry, const Vec2& place) const;
  Vec3 betaAt(std::size_t entry, const Vec2& place) const;

  const WallFile& hall_;
  std::vector<std::unique_ptr<ScreenSurface>> surfaces_;  ///< by screen
  std::vector<std::unique_ptr<ThrownImage>> images_;      ///< by entry; null: a flat wall
  std::vector<LightMap> masks_;                           ///< by entry, of files; without a width: none
  std::array<double, 3> white_{1, 1, 1};                  ///< of the hall
  double black_ = 0;                                      ///< of the hall: the brightest sum
};

}  // namespace stadion
