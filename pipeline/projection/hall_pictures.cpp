#include "pipeline/projection/hall_pictures.h"

#include "engine/display/frustum.h"
#include "pipeline/platform/processor_set.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr PixelSize kUsual{800, 600};  ///< of a flat wall that states nothing

}  // namespace

HallPictures::HallPictures(const WallFile& hall)
    : hall_(hall), pool_(std::max<std::size_t>(1, processorsOfThisThread().size())) {}

Result<std::unique_ptr<HallPictures>> HallPictures::create(const WallFile& hall) {
  std::unique_ptr<HallPictures> pictures(new HallPictures(hall));
  auto projections = makeProjections(pictures->hall_, pictures->pool_);
  if (!projections) return projections.error();
  pictures->projections_ = std::move(projections.value());
  return pictures;
}

Picture HallPictures::paintView(const Wall& screen, std::uint32_t width, std::uint32_t height,
                                const Pose& X_RH, Eye eye, const Painter& paint, Mat4& clipFromRig) const {
  return paintFrom(screen, width, height, {Vec3::Zero(), eyePosition(X_RH, eye, hall_.eyeSeparation)}, eye,
                   paint, clipFromRig);
}

Picture HallPictures::paintFrom(const Wall& screen, std::uint32_t width, std::uint32_t height,
                                const SeenFrom& from, Eye eye, const Painter& paint,
                                Mat4& clipFromRig) const {
  const EyeFrustum frustum = eyeFrustum(screen, from.eye, hall_.depth);
  clipFromRig =
      projectionMatrix(frustum) * viewMatrix(frustum, {from.origin, Quat::Identity()}, Vec3::Zero());
  Picture picture(width, height);
  paint({clipFromRig, from.origin + frustum.eye, eye}, picture);
  return picture;
}

std::vector<Picture> HallPictures::drawPanorama(const Projection& projection, const Pose& X_RH,
                                                const Painter& paint) {
  const PanoramaView& view = *projection.panorama();
  const Eye eye = view.eye == PanoramaEye::Right ? Eye::Right : Eye::Left;
  const double separation = view.eye == PanoramaEye::Middle ? 0 : hall_.eyeSeparation;
  const Vec3 from = view.at ? *view.at : eyePosition(X_RH, eye, separation);
  const Facets& of = projection.facets();
  std::vector<Picture> painted;
  std::vector<FacetPicture> facets(of.all.size());
  for (std::size_t f = 0; f < facets.size(); ++f)
    painted.push_back(paintFrom(of.all[f].rectangle, of.width, of.height, {from, Vec3::Zero()}, eye, paint,
                                facets[f].clipFromRig));
  for (std::size_t f = 0; f < facets.size(); ++f) facets[f].picture = &painted[f];
  std::vector<Picture> shown(1);
  projection.draw(facets, shown[0], &pool_);
  return shown;
}

void HallPictures::change(const WallFile& hall, std::size_t entry) {
  hall_ = hall;
  auto made = makeProjections(hall_, pool_, entry);
  if (made) projections_[entry] = std::move(made.value()[entry]);
}

std::vector<Picture> HallPictures::draw(std::size_t entry, const Pose& X_RH, const Painter& paint) {
  const WallEntry& e = hall_.walls[entry];
  const Projection* projection = projections_[entry].get();
  if (projection && projection->panorama()) return drawPanorama(*projection, X_RH, paint);
  std::vector<Picture> shown;
  for (const Eye eye : kEyes) {
    Mat4 clip;
    if (!projection) {
      const PixelSize size = e.pixels.width > 0 ? e.pixels : kUsual;
      shown.push_back(paintView(e.wall, size.width, size.height, X_RH, eye, paint, clip));
      continue;
    }
    if (projection->eye() && *projection->eye() != eye) continue;
    std::vector<Picture> painted;
    std::vector<FacetPicture> facets;
    const Facets& of = projection->facets();
    for (const Facet& facet : of.all) {
      painted.push_back(paintView(facet.rectangle, of.width, of.height, X_RH, eye, paint, clip));
      facets.push_back({clip, nullptr});
    }
    for (std::size_t f = 0; f < facets.size(); ++f) facets[f].picture = &painted[f];
    projection->draw(facets, shown.emplace_back(), &pool_);
  }
  return shown;
}

}  // namespace stadion
