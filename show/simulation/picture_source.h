#pragma once
/// What the simulator asks of the drawing: the pictures that a hall's outputs get.
///
/// The simulator paints the views of a scene and receives outputs. It learns nothing about how the drawing
/// made one of the other, so that an error of the drawing cannot hide itself.
///
/// Frames   R is the rig, H the head.
/// Threads  one at a time.

#include "engine/display/wall.h"
#include "pipeline/picture/picture.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace stadion {

/// A view to be painted.
struct SourceView {
  Mat4 clipFromRig;         ///< as OpenGL: x and y from -w to w
  Vec3 eye = Vec3::Zero();  ///< in R [m]
};

class PictureSource {
public:
  using Painter = std::function<void(const SourceView&, Picture&)>;

  virtual ~PictureSource() = default;
  /// Returns the pictures of an entry as its output gets them, one for each eye that it shows, the left one
  /// first. `paint` fills sRGB pictures.
  virtual std::vector<Picture> draw(std::size_t entry, const Pose& X_RH, const Painter& paint) = 0;
};

}  // namespace stadion
