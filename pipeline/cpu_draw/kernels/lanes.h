#pragma once
/// Several numbers at a time. Each operation gives the same bits in every lane of every width: no fused
/// multiply-add, no approximate reciprocals, no library functions.
///
/// Linkage  internal. This header includes no header with functions of external linkage.

#if defined(__SSE2__) && !defined(STADION_PORTABLE_LANES)
#include <immintrin.h>
#define STADION_SSE_LANES 1
#endif

namespace stadion {
namespace {

/// Four lanes: SSE2, or whatever the compiler makes of vectors on another architecture (NEON).
struct DrawFour {
  typedef float Floats __attribute__((vector_size(16)));
  typedef int Ints __attribute__((vector_size(16)));
  typedef unsigned short Halves __attribute__((vector_size(16)));
  static constexpr int kLanes = 4;

#ifdef STADION_SSE_LANES
  [[gnu::always_inline]] static inline unsigned bits(Ints m) {
    return static_cast<unsigned>(_mm_movemask_ps(__m128(m)));
  }
  [[gnu::always_inline]] static inline Floats root(Floats x) {
    return Floats(_mm_sqrt_ps(__m128(x)));
  }
  [[gnu::always_inline]] static inline Floats least(Floats a, Floats b) {
    return Floats(_mm_min_ps(__m128(a), __m128(b)));
  }
  [[gnu::always_inline]] static inline Floats most(Floats a, Floats b) {
    return Floats(_mm_max_ps(__m128(a), __m128(b)));
  }
  /// The upper halves of the products.
  [[gnu::always_inline]] static inline Halves highProduct(Halves a, Halves b) {
    return Halves(_mm_mulhi_epu16(__m128i(a), __m128i(b)));
  }
#else
  [[gnu::always_inline]] static inline unsigned bits(Ints m) {
    unsigned all = 0;
    for (int lane = 0; lane < kLanes; ++lane) all |= static_cast<unsigned>(m[lane] < 0) << lane;
    return all;
  }
  [[gnu::always_inline]] static inline Floats root(Floats x) {
    for (int lane = 0; lane < kLanes; ++lane) x[lane] = __builtin_sqrtf(x[lane]);
    return x;
  }
  [[gnu::always_inline]] static inline Floats least(Floats a, Floats b) {
    return a < b ? a : b;
  }
  [[gnu::always_inline]] static inline Floats most(Floats a, Floats b) {
    return a > b ? a : b;
  }
  [[gnu::always_inline]] static inline Halves highProduct(Halves a, Halves b) {
    typedef unsigned Wide __attribute__((vector_size(32)));
    const Wide product = __builtin_convertvector(a, Wide) * __builtin_convertvector(b, Wide);
    return __builtin_convertvector(product >> 16, Halves);
  }
#endif
  [[gnu::always_inline]] static inline Ints select(Ints m, Ints a, Ints b) {
    return (a & m) | (b & ~m);
  }
  /// Exact for every float; a number that is not finite stays as it is.
  [[gnu::always_inline]] static inline Floats floor(Floats x) {
    const Ints sign = Ints(x) & static_cast<int>(0x80000000U);
    const Floats size = Floats(Ints(x) & 0x7fffffff);
    const Ints fraction = size < 8388608.0f;
    const Floats safe = Floats(Ints(x) & fraction);
    const Floats whole = __builtin_convertvector(__builtin_convertvector(safe, Ints), Floats);
    const Floats down = whole - Floats(Ints(Floats{} + 1.0f) & Ints(whole > safe));
    return Floats(select(fraction, Ints(down) | sign, Ints(x)));
  }
  [[gnu::always_inline]] static inline Ints pick(const int* from, Ints at) {
    return Ints{from[at[0]], from[at[1]], from[at[2]], from[at[3]]};
  }
  /// The numbers at each place, and those that follow them.
  [[gnu::always_inline]] static inline void pairs(const int* from, Ints at, Ints& first, Ints& second) {
    first = pick(from, at);
    second = pick(from + 1, at);
  }
  /// Likewise, from a table of sixteen.
  [[gnu::always_inline]] static inline Ints entry(const int* table, Ints at) {
    return pick(table, at);
  }
  /// The four floats at row(lane), by column.
  template <class Row>
  [[gnu::always_inline]] static inline void columns(const Row& row, Floats* out) {
    const float *a = row(0), *b = row(1), *c = row(2), *d = row(3);
    for (int k = 0; k < 4; ++k) out[k] = Floats{a[k], b[k], c[k], d[k]};
  }
  /// Stores four columns at row(lane).
  template <class Row>
  [[gnu::always_inline]] static inline void rows(const Floats* columns, const Row& row) {
    for (int lane = 0; lane < 4; ++lane) {
      const Floats of{columns[0][lane], columns[1][lane], columns[2][lane], columns[3][lane]};
      __builtin_memcpy(row(lane), &of, sizeof of);
    }
  }
};

#ifdef __AVX2__
struct DrawEight {
  typedef float Floats __attribute__((vector_size(32)));
  typedef int Ints __attribute__((vector_size(32)));
  typedef unsigned short Halves __attribute__((vector_size(32)));
  static constexpr int kLanes = 8;

  [[gnu::always_inline]] static inline unsigned bits(Ints m) {
    return static_cast<unsigned>(_mm256_movemask_ps(__m256(m)));
  }
  [[gnu::always_inline]] static inline Floats root(Floats x) { return Floats(_mm256_sqrt_ps(__m256(x))); }
  [[gnu::always_inline]] static inline Floats least(Floats a, Floats b) {
    return Floats(_mm256_min_ps(__m256(a), __m256(b)));
  }
  [[gnu::always_inline]] static inline Floats most(Floats a, Floats b) {
    return Floats(_mm256_max_ps(__m256(a), __m256(b)));
  }
  [[gnu::always_inline]] static inline Halves highProduct(Halves a, Halves b) {
    return Halves(_mm256_mulhi_epu16(__m256i(a), __m256i(b)));
  }
  [[gnu::always_inline]] static inline Ints select(Ints m, Ints a, Ints b) {
    return Ints(_mm256_blendv_epi8(__m256i(b), __m256i(a), __m256i(m)));
  }
  [[gnu::always_inline]] static inline Floats floor(Floats x) { return Floats(_mm256_floor_ps(__m256(x))); }
  [[gnu::always_inline]] static inline Ints pick(const int* from, Ints at) {
    return Ints(_mm256_i32gather_epi32(from, __m256i(at), 4));
  }
  [[gnu::always_inline]] static inline void pairs(const int* from, Ints at, Ints& first, Ints& second) {
    const __m256i order = _mm256_permute4x64_epi64(__m256i(at), 0xd8);
    const auto* base = reinterpret_cast<const long long*>(from);
    const __m256 low = __m256(_mm256_i32gather_epi64(base, _mm256_castsi256_si128(order), 4));
    const __m256 high = __m256(_mm256_i32gather_epi64(base, _mm256_extracti128_si256(order, 1), 4));
    first = Ints(_mm256_shuffle_ps(low, high, 0x88));
    second = Ints(_mm256_shuffle_ps(low, high, 0xdd));
  }
  [[gnu::always_inline]] static inline Ints entry(const int* table, Ints at) {
    Ints low, high;
    __builtin_memcpy(&low, table, sizeof low), __builtin_memcpy(&high, table + 8, sizeof high);
    return select(at > 7, Ints(_mm256_permutevar8x32_epi32(__m256i(high), __m256i(at))),
                  Ints(_mm256_permutevar8x32_epi32(__m256i(low), __m256i(at))));
  }
  template <class Row>
  [[gnu::always_inline]] static inline void columns(const Row& row, Floats* out) {
    __m256 r[4];
    for (int k = 0; k < 4; ++k)
      r[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row(k))), _mm_loadu_ps(row(k + 4)), 1);
    const __m256 a = _mm256_unpacklo_ps(r[0], r[1]), b = _mm256_unpackhi_ps(r[0], r[1]);
    const __m256 c = _mm256_unpacklo_ps(r[2], r[3]), d = _mm256_unpackhi_ps(r[2], r[3]);
    out[0] = Floats(_mm256_shuffle_ps(a, c, 0x44));
    out[1] = Floats(_mm256_shuffle_ps(a, c, 0xee));
    out[2] = Floats(_mm256_shuffle_ps(b, d, 0x44));
    out[3] = Floats(_mm256_shuffle_ps(b, d, 0xee));
  }
  template <class Row>
  [[gnu::always_inline]] static inline void rows(const Floats* columns, const Row& row) {
    const __m256 x = __m256(columns[0]), y = __m256(columns[1]), z = __m256(columns[2]),
                 w = __m256(columns[3]);
    const __m256 a = _mm256_unpacklo_ps(x, y), b = _mm256_unpackhi_ps(x, y);
    const __m256 c = _mm256_unpacklo_ps(z, w), d = _mm256_unpackhi_ps(z, w);
    const __m256 r[] = {_mm256_shuffle_ps(a, c, 0x44), _mm256_shuffle_ps(a, c, 0xee),
                        _mm256_shuffle_ps(b, d, 0x44), _mm256_shuffle_ps(b, d, 0xee)};
    for (int k = 0; k < 4; ++k) {
      _mm_storeu_ps(row(k), _mm256_castps256_ps128(r[k]));
      _mm_storeu_ps(row(k + 4), _mm256_extractf128_ps(r[k], 1));
    }
  }
};
#endif

#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__)
struct DrawSixteen {
  typedef float Floats __attribute__((vector_size(64)));
  typedef int Ints __attribute__((vector_size(64)));
  typedef unsigned short Halves __attribute__((vector_size(64)));
  static constexpr int kLanes = 16;

  [[gnu::always_inline]] static inline unsigned bits(Ints m) { return _mm512_movepi32_mask(__m512i(m)); }
  [[gnu::always_inline]] static inline Floats root(Floats x) { return Floats(_mm512_sqrt_ps(__m512(x))); }
  [[gnu::always_inline]] static inline Floats least(Floats a, Floats b) {
    return Floats(_mm512_min_ps(__m512(a), __m512(b)));
  }
  [[gnu::always_inline]] static inline Floats most(Floats a, Floats b) {
    return Floats(_mm512_max_ps(__m512(a), __m512(b)));
  }
  [[gnu::always_inline]] static inline Halves highProduct(Halves a, Halves b) {
    return Halves(_mm512_mulhi_epu16(__m512i(a), __m512i(b)));
  }
  [[gnu::always_inline]] static inline Ints select(Ints m, Ints a, Ints b) {
    return Ints(_mm512_ternarylogic_epi32(__m512i(m), __m512i(a), __m512i(b), 0xca));
  }
  [[gnu::always_inline]] static inline Floats floor(Floats x) {
    return Floats(_mm512_roundscale_ps(__m512(x), _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
  }
  [[gnu::always_inline]] static inline Ints pick(const int* from, Ints at) {
    return Ints(_mm512_i32gather_epi32(__m512i(at), from, 4));
  }
  [[gnu::always_inline]] static inline void pairs(const int* from, Ints at, Ints& first, Ints& second) {
    const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(__m512i(at)), from, 4);
    const __m512i high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(__m512i(at), 1), from, 4);
    constexpr Ints kEven{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30};
    first = Ints(_mm512_permutex2var_epi32(low, __m512i(kEven), high));
    second = Ints(_mm512_permutex2var_epi32(low, __m512i(kEven + 1), high));
  }
  [[gnu::always_inline]] static inline Ints entry(const int* table, Ints at) {
    return Ints(_mm512_permutexvar_epi32(__m512i(at), _mm512_loadu_si512(table)));
  }
  template <class Row>
  [[gnu::always_inline]] static inline void columns(const Row& row, Floats* out) {
    __m512 r[4];
    for (int k = 0; k < 4; ++k) {
      r[k] = _mm512_castps128_ps512(_mm_loadu_ps(row(k)));
      r[k] = _mm512_insertf32x4(r[k], _mm_loadu_ps(row(k + 4)), 1);
      r[k] = _mm512_insertf32x4(r[k], _mm_loadu_ps(row(k + 8)), 2);
      r[k] = _mm512_insertf32x4(r[k], _mm_loadu_ps(row(k + 12)), 3);
    }
    const __m512 a = _mm512_unpacklo_ps(r[0], r[1]), b = _mm512_unpackhi_ps(r[0], r[1]);
    const __m512 c = _mm512_unpacklo_ps(r[2], r[3]), d = _mm512_unpackhi_ps(r[2], r[3]);
    out[0] = Floats(_mm512_shuffle_ps(a, c, 0x44));
    out[1] = Floats(_mm512_shuffle_ps(a, c, 0xee));
    out[2] = Floats(_mm512_shuffle_ps(b, d, 0x44));
    out[3] = Floats(_mm512_shuffle_ps(b, d, 0xee));
  }
  template <class Row>
  [[gnu::always_inline]] static inline void rows(const Floats* columns, const Row& row) {
    const __m512 x = __m512(columns[0]), y = __m512(columns[1]), z = __m512(columns[2]),
                 w = __m512(columns[3]);
    const __m512 a = _mm512_unpacklo_ps(x, y), b = _mm512_unpackhi_ps(x, y);
    const __m512 c = _mm512_unpacklo_ps(z, w), d = _mm512_unpackhi_ps(z, w);
    const __m512 r[] = {_mm512_shuffle_ps(a, c, 0x44), _mm512_shuffle_ps(a, c, 0xee),
                        _mm512_shuffle_ps(b, d, 0x44), _mm512_shuffle_ps(b, d, 0xee)};
    for (int k = 0; k < 4; ++k) {
      _mm_storeu_ps(row(k), _mm512_castps512_ps128(r[k]));
      _mm_storeu_ps(row(k + 4), _mm512_extractf32x4_ps(r[k], 1));
      _mm_storeu_ps(row(k + 8), _mm512_extractf32x4_ps(r[k], 2));
      _mm_storeu_ps(row(k + 12), _mm512_extractf32x4_ps(r[k], 3));
    }
  }
};
#endif

/// Operations that do not depend on the width. A mask has all bits of a lane set, or none.
template <class By>
struct DrawLanes {
  using F = typename By::Floats;
  using I = typename By::Ints;
  using H = typename By::Halves;
  static constexpr int kLanes = By::kLanes;
  static constexpr unsigned kAll = (1U << By::kLanes) - 1;

  [[gnu::always_inline]] static inline F load(const float* from) {
    F f;
    __builtin_memcpy(&f, from, sizeof f);
    return f;
  }
  [[gnu::always_inline]] static inline void store(float* to, F f) { __builtin_memcpy(to, &f, sizeof f); }
  [[gnu::always_inline]] static inline I loadInts(const void* from) {
    I i;
    __builtin_memcpy(&i, from, sizeof i);
    return i;
  }
  [[gnu::always_inline]] static inline void storeInts(void* to, I i) { __builtin_memcpy(to, &i, sizeof i); }
  [[gnu::always_inline]] static inline F all(float x) { return F{} + x; }
  [[gnu::always_inline]] static inline F least(F a, F b) { return By::least(a, b); }
  [[gnu::always_inline]] static inline F most(F a, F b) { return By::most(a, b); }
  [[gnu::always_inline]] static inline F clamp(F x) { return most(least(x, all(1)), F{}); }
  [[gnu::always_inline]] static inline F select(I m, F a, F b) { return F(By::select(m, I(a), I(b))); }
  [[gnu::always_inline]] static inline F where(I m, F a) { return F(I(a) & m); }
  [[gnu::always_inline]] static inline unsigned bits(I m) { return By::bits(m); }
  [[gnu::always_inline]] static inline F size(F x) { return F(I(x) & 0x7fffffff); }
  [[gnu::always_inline]] static inline F pick(const float* from, I at) {
    return F(By::pick(reinterpret_cast<const int*>(from), at));
  }
  [[gnu::always_inline]] static inline F whole(I i) { return __builtin_convertvector(i, F); }
  /// Towards zero. Expects |x| < 2^31.
  [[gnu::always_inline]] static inline I truncated(F x) { return __builtin_convertvector(x, I); }
  [[gnu::always_inline]] static inline F floor(F x) { return By::floor(x); }
  [[gnu::always_inline]] static inline F ceiling(F x) { return -By::floor(-x); }
  /// The numbers of the lanes.
  [[gnu::always_inline]] static inline I lanes() {
    I out;
    for (int lane = 0; lane < kLanes; ++lane) out[lane] = lane;
    return out;
  }
  [[gnu::always_inline]] static inline F perRoot(F x) { return 1.0f / By::root(x); }

  /// 2 to the x, for x <= 0; relative error below 4e-6.
  [[gnu::always_inline]] static inline F exp2(F x) {
    x = least(most(x, all(-60)), F{});
    const F i = floor(x), f = x - i;
    const F p =
        1.0f + f * (0.693147f + f * (0.240227f + f * (0.0555041f + f * (0.0096181f + f * 0.0013395f))));
    return p * F((truncated(i) + 127) << 23);
  }
  /// Logarithm to the base 2 of a number from 1 on; error below 0.009.
  [[gnu::always_inline]] static inline F log2(F x) {
    const F f = F((I(x) & 0x7fffff) | 0x3f800000) - 1.0f;
    return whole((I(x) >> 23) - 127) + f * (1.3465f - 0.3465f * f);
  }
};

/// Three numbers in each lane.
template <class F>
struct Triple {
  F x, y, z;
  [[gnu::always_inline]] friend inline Triple operator+(const Triple& a, const Triple& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  [[gnu::always_inline]] friend inline Triple operator-(const Triple& a, const Triple& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[gnu::always_inline]] friend inline Triple operator*(const Triple& a, const Triple& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
  }
  [[gnu::always_inline]] friend inline Triple operator*(const Triple& a, F b) {
    return {a.x * b, a.y * b, a.z * b};
  }
  [[gnu::always_inline]] static inline F dot(const Triple& a, const Triple& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  [[gnu::always_inline]] static inline Triple of(const float* v) {
    return {F{} + v[0], F{} + v[1], F{} + v[2]};
  }
  [[gnu::always_inline]] static inline Triple of(float v) { return {F{} + v, F{} + v, F{} + v}; }
  [[gnu::always_inline]] static inline Triple mix(const Triple& a, const Triple& b, F t) {
    return a + (b - a) * t;
  }
};

}  // namespace
}  // namespace stadion
