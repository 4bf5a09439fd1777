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
  const EyeFrustum frustum = eyeFrustum(screen, eyePosition(X_RH, eye, hall_.eyeSeparation), hall_.depth);
  clipFromRig = projectionMatrix(frustum) * viewMatrix(frustum, Pose{}, Vec3::Zero());
  Picture picture(width, height);
  paint({clipFromRig, frustum.eye, eye}, picture);
  return picture;
}

std::vector<Picture> HallPictures::draw(std::size_t entry, const Pose& X_RH, const Painter& paint) {
  const WallEntry& e = hall_.walls[entry];
  const Projection* projection = projections_[entry].get();
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
