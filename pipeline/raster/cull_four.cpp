/// Four triangles at a time, with instructions that every processor of the architecture has.

#include "pipeline/raster/cull_kernel.h"

namespace stadion {
namespace {

bool project(const float* x, const float* y, const float* z, unsigned count, const PictureMatrix& matrix,
             float* px, float* py, float* nearness, PictureBounds& bounds) {
  return TriangleCulling<ByFour>::project(x, y, z, count, matrix, px, py, nearness, bounds);
}
unsigned keep(const int* a, const int* b, const int* c, unsigned count, const float* px, const float* py,
              const float* nearness, float facing, const SeenSquares& seen, unsigned* out) {
  return TriangleCulling<ByFour>::keep(a, b, c, count, px, py, nearness, facing, seen, out);
}
void squares(const float* depths, int width, int height, const NearnessOfDepth& of, float* nearness) {
  farthestOfSquares(depths, width, height, of, nearness);
}

}  // namespace

const CullKernels kCullByFour{project, keep, squares};

}  // namespace stadion
