/// The kernels with 16 lanes, in instructions that AVX-512 has.
///
/// Linkage  this file defines nothing that other files could share but its table.

#include "pipeline/cpu_draw/kernels/kernel_functions.h"

namespace stadion {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
const DrawKernels kDrawBySixteen = KernelFunctions<DrawSixteen>::named("16 lanes");
#endif

}  // namespace stadion
