#pragma once
/// Arithmetic that reads the same for one number and for several side by side. Internal to dynamics/flight/.
///
/// Bits     by element, in the same order, nothing fused: each lane has the bits of plain arithmetic.
/// Linkage  internal, and nothing is included: files compiled for other processors use this, too.

namespace stadion {
namespace {

typedef double Two __attribute__((vector_size(16)));
typedef double Four __attribute__((vector_size(32)));

[[gnu::always_inline]] inline double root(double x) {
  return __builtin_sqrt(x);
}
[[gnu::always_inline]] inline Two root(const Two& x) {
  return __builtin_ia32_sqrtpd(x);
}
#ifdef __AVX2__
[[gnu::always_inline]] inline Four root(const Four& x) {
  return __builtin_ia32_sqrtpd256(x);
}
#endif

/// All bits of a number, to be counted with.
template <class S>
struct BitsOf {
  typedef long long Lanes __attribute__((vector_size(sizeof(S))));
};
template <>
struct BitsOf<double> {
  using Lanes = long long;
};

template <class S>
[[gnu::always_inline]] inline typename BitsOf<S>::Lanes bitsOf(const S& x) {
  return __builtin_bit_cast(typename BitsOf<S>::Lanes, x);
}
template <class S, class L>
[[gnu::always_inline]] inline S fromBits(const L& x) {
  return __builtin_bit_cast(S, x);
}

/// Returns x in every lane.
template <class S>
[[gnu::always_inline]] inline S all(double x) {
  return S{} + x;
}

template <class S>
[[gnu::always_inline]] inline S atLeast(const S& x, double least) {
  return x > least ? x : all<S>(least);
}
template <class S>
[[gnu::always_inline]] inline S atMost(const S& x, double most) {
  return x < most ? x : all<S>(most);
}
template <class S>
[[gnu::always_inline]] inline S size(const S& x) {
  return x < 0.0 ? -x : x;
}

/// A vector of three.
template <class S>
struct V3 {
  S x, y, z;
};
template <class S>
[[gnu::always_inline]] inline V3<S> operator+(const V3<S>& a, const V3<S>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class S>
[[gnu::always_inline]] inline V3<S> operator-(const V3<S>& a, const V3<S>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class S>
[[gnu::always_inline]] inline V3<S> operator*(const S& s, const V3<S>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class S>
[[gnu::always_inline]] inline S dot(const V3<S>& a, const V3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
[[gnu::always_inline]] inline V3<S> cross(const V3<S>& a, const V3<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A quaternion, body to World.
template <class S>
struct Q4 {
  S w, x, y, z;
};
template <class S>
[[gnu::always_inline]] inline Q4<S> operator*(const Q4<S>& a, const Q4<S>& b) {
  return {
      (a.w * b.w - a.x * b.x) - (a.y * b.y + a.z * b.z), (a.w * b.x + a.x * b.w) + (a.y * b.z - a.z * b.y),
      (a.w * b.y - a.x * b.z) + (a.y * b.w + a.z * b.x), (a.w * b.z + a.x * b.y) + (a.z * b.w - a.y * b.x)};
}
/// Where the body's x (0) or z (2) axis points.
template <int Axis, class S>
[[gnu::always_inline]] inline V3<S> axisOf(const Q4<S>& q) {
  if constexpr (Axis == 0)
    return {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)};
  else
    return {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)};
}

/// Polynomial of eight coefficients, in pairs: less to wait for than Horner's.
template <class S>
[[gnu::always_inline]] inline S octet(const S& z, const double (&c)[8]) {
  const S z2 = z * z;
  return ((c[0] + c[1] * z) + (c[2] + c[3] * z) * z2) +
         ((c[4] + c[5] * z) + (c[6] + c[7] * z) * z2) * (z2 * z2);
}
/// sin(sqrt z) / sqrt z and cos(sqrt z) for 0 <= z <= 0.7 (Taylor, remainders below 1e-17).
template <class S>
[[gnu::always_inline]] inline S sincOf(const S& z) {
  constexpr double c[8] = {1.0,          -1.0 / 6,          1.0 / 120,          -1.0 / 5040,
                           1.0 / 362880, -1.0 / 39916800.0, 1.0 / 6227020800.0, -1.0 / 1307674368000.0};
  return octet(z, c);
}
template <class S>
[[gnu::always_inline]] inline S cosOf(const S& z) {
  constexpr double c[8] = {-1.0 / 2,         1.0 / 24,          -1.0 / 720,           1.0 / 40320,
                           -1.0 / 3628800.0, 1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0};
  return 1.0 + z * octet(z, c);
}

template <class S>
struct Turn {
  S sine, cosine;
};
/// Sine and cosine of any angle below 2^20 or so; beyond that they are somewhere on the circle.
template <class S>
[[gnu::always_inline]] inline Turn<S> turn(const S& angle) {
  constexpr double kShift = 0x1.8p52;
  const S shifted = angle * 0x1.45f306dc9c883p-1 + kShift;  // 2 / pi
  const auto quadrant = bitsOf(shifted);
  const S n = shifted - kShift;
  const S a = ((angle - n * 0x1.921fb54400000p+0) - n * 0x1.0b4611a600000p-34) - n * 0x1.3198a2e037073p-69;
  const S z = atMost(S(a * a), 0.7);
  const S s = sincOf(z) * a, c = cosOf(z);
  const auto odd = (quadrant & 1) != 0;
  const S sine = odd ? c : s, cosine = odd ? s : c;
  return {(quadrant & 2) != 0 ? -sine : sine, ((quadrant + 1) & 2) != 0 ? -cosine : cosine};
}

/// exp x to 1e-15 of itself, x clamped to +-700.
template <class S>
[[gnu::always_inline]] inline S expOf(const S& exponent) {
  constexpr double kShift = 0x1.8p52;
  const S x = atMost(atLeast(exponent, -700), 700);
  const S shifted = x * 0x1.71547652b82fep+0 + kShift;  // 1 / ln 2
  const S n = shifted - kShift;
  const S r = (x - n * 0x1.62e42fee00000p-1) - n * 0x1.a39ef35793c76p-33;
  S p = all<S>(1.0 / 6227020800.0);
  p = p * r + 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800;
  p = p * r + 1.0 / 362880;
  p = p * r + 1.0 / 40320;
  p = p * r + 1.0 / 5040;
  p = p * r + 1.0 / 720;
  p = p * r + 1.0 / 120;
  p = p * r + 1.0 / 24;
  p = p * r + 1.0 / 6;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  return p * fromBits<S>((bitsOf(shifted) + 1023) << 52);
}

}  // namespace
}  // namespace stadion
