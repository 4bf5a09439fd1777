#include "pipeline/cull/wall_view.h"

namespace stadion {

ConvexVolume WallEyes::volume() const {
  return unionFrustum(*wall, {eyes.data(), count}, depth, margin).transformed(X_WR, origin);
}

void WallEyes::setUp(DrawList& list) const {
  list.origin = origin;
  list.eyeCount = count;
  for (std::uint32_t e = 0; e < count; ++e) {
    const EyeFrustum frustum = eyeFrustum(*wall, eyes[e], depth);
    list.eyes[e].projection = projectionMatrix(frustum);
    list.eyes[e].view = viewMatrix(frustum, X_WR, origin);
  }
}

WallEyes eyesOf(const ViewerRecord& viewer, const WallView& view, double eyeSeparation,
                const CameraView* from) {
  WallEyes seen;
  seen.wall = from ? &from->screen : &view.wall;
  seen.depth = view.depth;
  seen.X_WR = viewer.rig();
  if (from) {
    seen.count = 1, seen.eyes[0] = from->eye;
    seen.origin = seen.X_WR * from->eye;
    return seen;
  }
  const Pose X_RH = viewer.head();
  const double separation = eyeSeparation >= 0 ? eyeSeparation : view.eyeSeparation;
  seen.count = view.stereo ? 2 : 1;
  for (std::uint32_t e = 0; e < seen.count; ++e)
    seen.eyes[e] = eyePosition(X_RH, kEyes[e], view.stereo ? separation : 0);
  seen.origin = seen.X_WR * X_RH.p;
  seen.margin = view.reach.ofEyes(view.stereo ? separation : 0);
  return seen;
}

}  // namespace stadion
