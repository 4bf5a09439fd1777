#pragma once
/// Four doubles at once, for the recurrences of Taylor series. Internal to dynamics/.
///
/// Every operation goes by element and nothing is fused, so that all machines get the same bits, whether they
/// have AVX or not.

#include "engine/maths/maths.h"

namespace stadion {

using Double4 = double __attribute__((vector_size(32)));

/// Four numbers that lie anywhere in memory. (Behind the `=`, clang ignores the alignment.)
using UnalignedDouble4 __attribute__((vector_size(32), aligned(8), may_alias)) = double;
static_assert(alignof(UnalignedDouble4) == alignof(double));

inline void set(Double4& w, const Vec3& v) {
  w = Double4{v.x(), v.y(), v.z(), 0};
}
inline Vec3 firstThree(const Double4& w) {
  return {w[0], w[1], w[2]};
}

/// Returns true if this machine has AVX2.
inline bool hasAvx2() {
  return __builtin_cpu_supports("avx2") != 0;
}

}  // namespace stadion
