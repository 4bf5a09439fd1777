/// The warp's kernels with 16 lanes.
///
/// Linkage  this file defines nothing that other files could share but its table.

#include "pipeline/projection/warp_cells.h"

namespace stadion {

#ifdef __AVX512F__
const WarpKernels kWarpBySixteen{"16 lanes", smoothCell, exactCell};
#endif

}  // namespace stadion
