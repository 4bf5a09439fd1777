#pragma once
/// The kernels that this processor can run.
///
/// Threads  any.

#include "pipeline/cpu_draw/kernels/kernel_data.h"

#include <vector>

namespace stadion {

/// Narrow ones first. All give the same pixels.
std::vector<const DrawKernels*> drawKernelsHere();
/// The fastest ones.
const DrawKernels& bestDrawKernels();

}  // namespace stadion
