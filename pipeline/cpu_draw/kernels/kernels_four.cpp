/// The kernels with 4 lanes, in instructions that every processor of the architecture has.
///
/// Linkage  this file defines nothing that other files could share but its table.

#include "pipeline/cpu_draw/kernels/kernel_functions.h"

namespace stadion {

const DrawKernels kDrawByFour = KernelFunctions<DrawFour>::named("4 lanes");

}  // namespace stadion
