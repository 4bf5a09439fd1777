#pragma once
/// Four doubles at once, for the recurrences of Taylor series. Internal to dynamics/.
///
/// Every operation goes by element and nothing is fused, so that all machines get the same bits, whether they
/// have AVX or not.

#include "engine/maths/maths.h"

namespace stadion {

using Wide = double __attribute__((vector_size(32)));

/// Four numbers that lie anywhere in memory.
using WideAnywhere = double __attribute__((vector_size(32), aligned(8), may_alias));

inline void set(Wide& w, const Vec3& v) {
  w = Wide{v.x(), v.y(), v.z(), 0};
}
inline Vec3 firstThree(const Wide& w) {
  return {w[0], w[1], w[2]};
}

/// Whether this machine has AVX2.
inline bool hasWide() {
  return __builtin_cpu_supports("avx2") != 0;
}

}  // namespace stadion
