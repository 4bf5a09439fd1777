/// Eight triangles at a time. This file is compiled for AVX2 and defines nothing that other files could
/// share.

#include "pipeline/raster/raster_kernel.h"

namespace stadion {
namespace {

void shade(const VerticesToShade& vertices, unsigned first, unsigned end, const Shading& by,
           const PictureVertices& out) {
  Raster<ByEight>::shade(vertices, first, end, by, out);
}
void draw(const unsigned* corners, unsigned triangles, const PictureVertices& vertices, float facing,
          const RasterTarget& to) {
  Raster<ByEight>::draw(corners, triangles, vertices, facing, to);
}

}  // namespace

const RasterKernels kRasterByEight{shade, draw};

}  // namespace stadion
