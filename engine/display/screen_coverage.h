#pragma once
/// Which points of a screen a projector lights.
///
/// Frames     rig space. Units: metres.
/// Ownership  LightTest borrows the projector and the surface.
/// Threads    const use from any number of threads.

#include "engine/display/screen_surface.h"

#include <vector>

namespace stadion {

/// Returns some 2000 points, each for an equal area of the screen.
std::vector<Vec3> samplesOf(const Screen& screen);

class LightTest {
public:
  LightTest(const Projector& projector, const ScreenSurface& surface);

  /// Returns true if a pixel of the projector lights this point of the screen. Measured images are compared
  /// at some thousand points.
  bool lights(const Vec3& p) const;

private:
  struct Patch {
    Vec3 a, b, c;
  };

  bool throughLens(const Vec3& p) const;
  bool betweenPins(const PinnedImage& image, const Vec3& p) const;
  void addPatches();

  const Projector& projector_;
  const ScreenSurface& surface_;
  std::vector<Patch> patches_;  ///< of a measured image
};

}  // namespace stadion
