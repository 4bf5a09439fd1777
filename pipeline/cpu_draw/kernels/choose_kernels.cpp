#include "pipeline/cpu_draw/kernels/choose_kernels.h"

namespace stadion {

std::vector<const DrawKernels*> drawKernelsHere() {
  std::vector<const DrawKernels*> here{&kDrawByFour};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) here.push_back(&kDrawByEight);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    here.push_back(&kDrawBySixteen);
#endif
  return here;
}

const DrawKernels& bestDrawKernels() {
  static const DrawKernels& best = *drawKernelsHere().back();
  return best;
}

}  // namespace stadion
