#pragma once
/// Several numbers at a time, in GCC's vectors. Internal to pipeline/raster/.
///
/// Linkage  internal; includes nothing: files that are compiled for AVX2 use this, too, and must share no
///          function with other files.

namespace stadion {
namespace {

struct ByFour {
  typedef float Floats __attribute__((vector_size(16)));
  typedef int Ints __attribute__((vector_size(16)));
  static constexpr unsigned kLanes = 4;

  [[gnu::always_inline]] static inline unsigned bits(const Ints& mask) {
    return static_cast<unsigned>(__builtin_ia32_movmskps(Floats(mask)));
  }
  [[gnu::always_inline]] static inline Floats root(const Floats& x) { return __builtin_ia32_sqrtps(x); }
};

#ifdef __AVX2__
struct ByEight {
  typedef float Floats __attribute__((vector_size(32)));
  typedef int Ints __attribute__((vector_size(32)));
  static constexpr unsigned kLanes = 8;

  [[gnu::always_inline]] static inline unsigned bits(const Ints& mask) {
    return static_cast<unsigned>(__builtin_ia32_movmskps256(Floats(mask)));
  }
  [[gnu::always_inline]] static inline Floats root(const Floats& x) { return __builtin_ia32_sqrtps256(x); }
};
#endif

template <class By>
struct Lanes {
  using F = typename By::Floats;
  using I = typename By::Ints;

  [[gnu::always_inline]] static inline F load(const float* from) {
    F f;
    __builtin_memcpy(&f, from, sizeof f);
    return f;
  }
  [[gnu::always_inline]] static inline void store(float* to, const F& f) {
    __builtin_memcpy(to, &f, sizeof f);
  }
  [[gnu::always_inline]] static inline F picked(const float* from, const int* which) {
    F f;
    for (unsigned lane = 0; lane < By::kLanes; ++lane) f[lane] = from[which[lane]];
    return f;
  }
  template <class V>
  [[gnu::always_inline]] static inline V least(const V& a, const V& b) {
    return a < b ? a : b;
  }
  template <class V>
  [[gnu::always_inline]] static inline V most(const V& a, const V& b) {
    return a > b ? a : b;
  }
};

}  // namespace
}  // namespace stadion
