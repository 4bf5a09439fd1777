/// The warp's kernels with 8 lanes.
///
/// Linkage  this file defines nothing that other files could share but its table.

#include "pipeline/projection/warp_cells.h"

namespace stadion {

#ifdef __AVX2__
const WarpKernels kWarpByEight{"8 lanes", smoothCell, exactCell};
#endif

}  // namespace stadion
