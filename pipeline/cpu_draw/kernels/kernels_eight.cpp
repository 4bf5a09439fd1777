/// The kernels with 8 lanes, in instructions that AVX2 has.
///
/// Linkage  this file defines nothing that other files could share but its table.

#include "pipeline/cpu_draw/kernels/kernel_functions.h"

namespace stadion {

#ifdef __AVX2__
const DrawKernels kDrawByEight = KernelFunctions<DrawEight>::named("8 lanes");
#endif

}  // namespace stadion
