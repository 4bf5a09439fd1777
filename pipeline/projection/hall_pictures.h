#pragma once
/// The pictures of a hall's outputs, of scenes that a function paints: for test patterns, and for the
/// simulator, which checks the drawing of halls.
///
/// The views, and the pass that makes an output's picture of them, are those of a show.
///
/// Frames   R is the rig.
/// Ownership  copies the hall.
/// Threads    one at a time; works on threads of its own.

#include "engine/base/diagnostic.h"
#include "engine/display/wall_file.h"
#include "pipeline/picture/picture.h"
#include "pipeline/projection/projection.h"

#include <functional>
#include <memory>
#include <vector>

namespace stadion {

/// A view that a painter fills.
struct PaintedView {
  Mat4 clipFromRig;         ///< as OpenGL: x and y from -w to w; z from 0 to w
  Vec3 eye = Vec3::Zero();  ///< in R [m]
  Eye picture = Eye::Left;  ///< eye that sees it
};

class HallPictures {
public:
  using Painter = std::function<void(const PaintedView&, Picture&)>;

  /// Fails as makeProjections does.
  static Result<std::unique_ptr<HallPictures>> create(const WallFile& hall);

  /// Returns the pictures of an entry as its output gets them, one for each eye that it shows, the left one
  /// first. X_RH is the pose of the head. The painter fills sRGB pictures of the size that it gets; it is
  /// called once for each view. Flat walls get their views without a pass, 1 pixel for 1. A panorama gives one
  /// picture.
  std::vector<Picture> draw(std::size_t entry, const Pose& X_RH, const Painter& paint);

  /// Takes over an entry of another version of the hall, which has the same entries.
  void change(const WallFile& hall, std::size_t entry);

private:
  /// An eye, and where the origin of the screen's coordinates lies, both in R [m].
  struct SeenFrom {
    Vec3 origin, eye;
  };

  explicit HallPictures(const WallFile& hall);
  Picture paintView(const Wall& screen, std::uint32_t width, std::uint32_t height, const Pose& X_RH, Eye eye,
                    const Painter& paint, Mat4& clipFromRig) const;
  Picture paintFrom(const Wall& screen, std::uint32_t width, std::uint32_t height, const SeenFrom& from,
                    Eye eye, const Painter& paint, Mat4& clipFromRig) const;
  std::vector<Picture> drawPanorama(const Projection& projection, const Pose& X_RH, const Painter& paint);

  WallFile hall_;
  DrawPool pool_;
  std::vector<std::shared_ptr<const Projection>> projections_;  ///< by entry
};

}  // namespace stadion
