#include "pipeline/view/wall_views.h"

#include "pipeline/projection/projection.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

namespace stadion {
namespace {

/// The eye that looks from there. `from` is not Middle.
Eye eyeAt(ViewPoint from, bool swapped) {
  return (from == ViewPoint::Right) != swapped ? Eye::Right : Eye::Left;
}

/// Moves the views, which have the panorama's eye, so that this eye is their origin.
void placeAround(const PanoramaView& panorama, PlacedViews& placed) {
  const Vec3 eye = panorama.at ? *panorama.at : placed.views[0].eye;
  placed.around = true;
  placed.X_WR.p = placed.X_WR * eye;
  for (std::uint32_t v = 0; v < placed.count; ++v) {
    placed.views[v].eye = Vec3::Zero();
    placed.views[v].picture = Eye::Left;
  }
  if (!panorama.at) return;
  placed.origin = placed.X_WR.p;
  placed.margin = 0;
}

}  // namespace

bool isSameScreen(const Wall& a, const Wall& b) {
  return a.lowerLeft == b.lowerLeft && a.lowerRight == b.lowerRight && a.upperLeft == b.upperLeft;
}

std::vector<View> viewsOf(const Wall& screen, bool stereo) {
  if (!stereo) return {{screen, ViewPoint::Middle}};
  return {{screen, ViewPoint::Left}, {screen, ViewPoint::Right}};
}

std::vector<View> viewsOf(const Projection& projection, bool stereo) {
  std::vector<View> views;
  if (projection.panorama()) {
    constexpr ViewPoint kFrom[] = {ViewPoint::Middle, ViewPoint::Left, ViewPoint::Right};
    const ViewPoint from = kFrom[static_cast<std::size_t>(projection.panorama()->eye)];
    for (const Facet& facet : projection.facets().all) views.push_back({facet.rectangle, from});
    return views;
  }
  for (const Facet& facet : projection.facets().all) {
    if (!stereo) {
      views.push_back({facet.rectangle, ViewPoint::Middle});
      continue;
    }
    if (projection.eye() != Eye::Right) views.push_back({facet.rectangle, ViewPoint::Left});
    if (projection.eye() != Eye::Left) views.push_back({facet.rectangle, ViewPoint::Right});
  }
  return views;
}

Mat4 clipFromRig(const DrawList& list, std::uint32_t view) {
  const Pose X_WR = list.viewer.rig();
  Mat4 rig = Mat4::Identity();
  rig.topLeftCorner<3, 3>() = X_WR.q.toRotationMatrix();
  rig.topRightCorner<3, 1>() = X_WR.p - list.origin;
  return list.views[view].projection * list.views[view].view * rig;
}

std::uint32_t PlacedViews::endOfScreen(std::uint32_t first) const {
  std::uint32_t end = first + 1;
  while (end < count && isSameScreen(*views[end].screen, *views[first].screen)) ++end;
  return end;
}

ConvexVolume PlacedViews::volume(std::uint32_t first, std::uint32_t end) const {
  std::array<Vec3, DrawList::kMostViews> eyes;
  for (std::uint32_t v = first; v < end; ++v) eyes[v - first] = views[v].eye;
  ConvexVolume seen =
      unionFrustum(*views[first].screen, {eyes.data(), end - first}, depth, around ? 0 : margin);
  if (around)  // the whole volume moves along
    for (Plane& plane : std::span(seen.planes.data(), seen.count)) plane.offset += std::sqrt(3.0) * margin;
  return seen.transformed(X_WR, origin);
}

void PlacedViews::setUp(DrawList& list) const {
  list.origin = origin;
  list.viewCount = count;
  for (std::uint32_t v = 0; v < count; ++v) {
    const EyeFrustum frustum = eyeFrustum(*views[v].screen, views[v].eye, depth);
    list.views[v].projection = projectionMatrix(frustum);
    list.views[v].view = viewMatrix(frustum, X_WR, origin);
    list.views[v].eye = views[v].picture;
  }
}

PlacedViews place(const ViewerRecord& viewer, const WallViews& wall, const EyeChoice& choice,
                  const CameraView* camera) {
  PlacedViews placed;
  placed.depth = wall.depth;
  placed.X_WR = viewer.rig();
  if (camera) {
    placed.count = 1;
    placed.views[0] = {&camera->screen, camera->eye, Eye::Left};
    placed.origin = placed.X_WR * camera->eye;
    return placed;
  }
  assert(wall.views.size() <= placed.views.size());
  const Pose X_RH = viewer.head();
  const double separation = choice.separation >= 0 ? choice.separation : wall.eyeSeparation;
  double widest = 0;
  for (const View& view : wall.views) {
    const bool middle = view.from == ViewPoint::Middle;
    const Eye eye = middle ? Eye::Left : eyeAt(view.from, choice.swapped);
    placed.views[placed.count++] = {&view.screen, eyePosition(X_RH, eye, middle ? 0 : separation),
                                    view.from == ViewPoint::Right ? Eye::Right : Eye::Left};
    if (!middle) widest = separation;
  }
  placed.origin = placed.X_WR * X_RH.p;
  placed.margin = wall.reach.ofEyes(widest);
  if (wall.projection && wall.projection->panorama()) placeAround(*wall.projection->panorama(), placed);
  return placed;
}

}  // namespace stadion
