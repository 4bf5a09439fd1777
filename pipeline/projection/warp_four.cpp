/// The warp's kernels with 4 lanes.
///
/// Linkage  this file defines nothing that other files could share but its table.

#include "pipeline/projection/warp_cells.h"

namespace stadion {

const WarpKernels kWarpByFour{"4 lanes", smoothCell, exactCell};

}  // namespace stadion
