#include "pipeline/projection/warp_kernel.h"

namespace stadion {

const WarpKernels& bestWarpKernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return kWarpBySixteen;
  if (__builtin_cpu_supports("avx2")) return kWarpByEight;
#endif
  return kWarpByFour;
}

}  // namespace stadion
