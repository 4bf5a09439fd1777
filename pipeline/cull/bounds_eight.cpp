/// Eight bounds at a time; this file alone is compiled for AVX2 and defines nothing that others could share.

#include "pipeline/cull/bounds_kernel.h"

namespace stadion {
namespace {

unsigned boxes(const float* bounds, unsigned nodes, const VolumePlanes* volumes, const TreeGroup* in,
               unsigned groups, TreeGroup* out, unsigned long long* tested) {
  return testBoxes<EightFloats>(bounds, nodes, volumes, in, groups, out, tested);
}
unsigned spheres(const float* bounds, unsigned nodes, const VolumePlanes* volumes, const TreeGroup* in,
                 unsigned groups, TreeSphere* out, unsigned long long* tested) {
  return testSpheres<EightFloats>(bounds, nodes, volumes, in, groups, out, tested);
}

}  // namespace

const BoundsKernels kEightBounds{boxes, spheres};

}  // namespace stadion
