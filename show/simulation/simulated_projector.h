#pragma once
/// A projector as the simulator sees it: where its pixels fall, which pixel lights a point, and how much light
/// a value gives.
///
/// This code and the drawing share no geometry, only the definitions in projector.h.
///
/// Frames     R is the rig.
/// Units      metres; pixels, with the centre of the upper left pixel at (0.5, 0.5); light as in projector.h.
/// Ownership  borrows the projector and the screen.
/// Threads    const use from any number of threads.

#include "engine/display/projector.h"
#include "show/simulation/simulated_screen.h"

#include <array>
#include <optional>
#include <vector>

namespace stadion {

class SimulatedProjector {
public:
  SimulatedProjector(const Projector& projector, const SimulatedScreen& screen);

  std::uint32_t width() const { return projector_.width; }
  std::uint32_t height() const { return projector_.height; }
  /// Returns the point that a place of the output lights.
  std::optional<Vec3> pointAt(double x, double y) const;
  /// Returns the place of the output that lights a point of the screen.
  std::optional<Vec2> placeOf(const Vec3& point) const;
  /// Returns the light of a channel for a value from 0 to 255.
  double light(std::uint8_t value, std::size_t channel) const { return light_[channel][value]; }
  const ProjectorLight& lamp() const { return projector_.light; }

private:
  const Pose* lens() const;
  std::optional<LightRay> rayAt(double x, double y) const;
  std::optional<Vec3> measuredAt(const MeasuredImage& image, double x, double y) const;
  /// Where the light to a point of P, which is before the lens, passes the picture [pixels].
  Vec2 placeIn(const LensImage& l, const Vec3& p) const;
  std::optional<Vec2> throughLens(const Vec3& point) const;
  std::optional<Vec2> throughFisheye(const FisheyeImage& image, const Vec3& point) const;
  std::optional<Vec2> amongMeasured(const Vec3& point) const;
  const std::vector<std::uint32_t>* trianglesNear(double x, double y) const;
  void sortTriangles();
  void solvePins(const PinnedImage& image);

  const Projector& projector_;
  const SimulatedScreen& screen_;
  std::array<std::array<double, 256>, 3> light_{};
  Mat3 outputFromScreen_ = Mat3::Identity(), screenFromOutput_ = Mat3::Identity();  ///< of pins, in shares
  std::size_t tileColumns_ = 0;
  std::vector<std::vector<std::uint32_t>> tiles_;  ///< triangles of a mesh by part of the output
};

}  // namespace stadion
