/// Four bounds at a time, with what every processor of the kind has.

#include "pipeline/cull/bounds_kernel.h"

namespace stadion {
namespace {

unsigned boxes(const float* bounds, unsigned nodes, const VolumePlanes* volumes, const TreeGroup* in,
               unsigned groups, TreeGroup* out, unsigned long long* tested) {
  return testBoxes<FourFloats>(bounds, nodes, volumes, in, groups, out, tested);
}
unsigned spheres(const float* bounds, unsigned nodes, const VolumePlanes* volumes, const TreeGroup* in,
                 unsigned groups, TreeSphere* out, unsigned long long* tested) {
  return testSpheres<FourFloats>(bounds, nodes, volumes, in, groups, out, tested);
}

}  // namespace

const BoundsKernels kFourBounds{boxes, spheres};

}  // namespace stadion
