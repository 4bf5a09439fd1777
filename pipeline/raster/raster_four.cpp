/// Four triangles at a time, with instructions that every processor of the architecture has.

#include "pipeline/raster/raster_kernel.h"

namespace stadion {
namespace {

void shade(const VerticesToShade& vertices, unsigned first, unsigned end, const Shading& by,
           const PictureVertices& out) {
  Raster<ByFour>::shade(vertices, first, end, by, out);
}
void draw(const unsigned* corners, unsigned triangles, const PictureVertices& vertices, float facing,
          const RasterTarget& to) {
  Raster<ByFour>::draw(corners, triangles, vertices, facing, to);
}

}  // namespace

const RasterKernels kRasterByFour{shade, draw};

}  // namespace stadion
