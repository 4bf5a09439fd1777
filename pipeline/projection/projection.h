#pragma once
/// Makes the pictures of one projector or panorama from those of its facets: warp and blend, in one pass.
///
/// Frames   R is the rig. The facets of a panorama, and the points of its map, are relative to the eye, in the axes
///          of R. So its pictures show the same directions wherever the eye is.
/// Ownership  keeps all it needs; the hall may go after makeProjections.
/// Threads    constant after it was made; draw() on any number of threads.

#include "engine/base/diagnostic.h"
#include "engine/display/wall_file.h"
#include "pipeline/picture/picture.h"
#include "pipeline/platform/draw_pool.h"
#include "pipeline/projection/facets.h"
#include "pipeline/projection/pixel_map.h"
#include "pipeline/projection/warp_kernel.h"
#include "pipeline/projection/warp_table.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace stadion {

/// The picture of a facet, as it was drawn.
struct FacetPicture {
  Mat4 clipFromRig;  ///< R to clip coordinates: x and y from -w to w
  const Picture* picture = nullptr;
};

/// From where a panorama is seen.
struct PanoramaView {
  PanoramaEye eye = PanoramaEye::Middle;
  std::optional<Vec3> at;  ///< in R [m]; none: from the eye
};

class Projection {
public:
  const Facets& facets() const { return facets_; }
  /// The eye for which the projector shows pictures; none: both.
  const std::optional<Eye>& eye() const { return eye_; }
  /// From where a panorama is seen; none: this is a projector.
  const std::optional<PanoramaView>& panorama() const { return panorama_; }
  std::uint32_t width() const { return map_.width; }    ///< of the output [pixels]
  std::uint32_t height() const { return map_.height; }  ///< [pixels]

  /// Fills `shown`, which gets the output's size, from a picture for each facet. Works on the pool; null: on
  /// this thread.
  void draw(std::span<const FacetPicture> facets, Picture& shown, DrawPool* pool,
            const WarpKernels& kernels = bestWarpKernels()) const;

private:
  friend class ProjectionMaking;
  friend class PanoramaMaking;
  struct Shown;
  void drawRow(const Shown& shown, std::uint32_t row) const;

  Facets facets_;
  std::optional<Eye> eye_;
  std::optional<PanoramaView> panorama_;
  PixelMap map_;
  WarpLight light_;
  std::unique_ptr<const ProjectorTable> table_;  ///< of `light_`; null: none
  std::vector<std::uint8_t> facetOf_;            ///< by cell
};

/// Returns the projections of the hall by entry; null for walls. Takes seconds in large halls: works on the
/// pool. `only`: makes that of one entry. Fails if a projector lights nothing that visitors see, a mask cannot be read, or a panorama is too small.
Result<std::vector<std::shared_ptr<const Projection>>> makeProjections(const WallFile& hall, DrawPool& pool,
                                                                       std::optional<std::size_t> only = {});

}  // namespace stadion
