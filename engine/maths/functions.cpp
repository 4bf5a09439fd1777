#include "engine/maths/functions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace stadion::det {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kHalfPi = 0x1.921fb54442d18p+0, kHalfPiLow = 0x1.1a62633145c07p-54;
constexpr double kPi = 2 * kHalfPi;
// ln 2 in parts of 32, 32 and 53 bits: multiples of the first two by |k| < 2^20 are exact.
constexpr double kLn2[3] = {0x1.62e42fee00000p-1, 0x1.a39ef35600000p-33, 0x1.93c7673007e5fp-65};
constexpr double kInvLn2 = 0x1.71547652b82fep+0;

/// An unevaluated sum, |lo| <= ulp(hi) / 2.
struct Sum {
  double hi, lo;
};

/// a + b without error (Knuth).
Sum addExact(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// a b without error (Dekker's splitting; no fused multiply-add, which not every machine has).
Sum multiplyExact(double a, double b) {
  constexpr double split = 0x1p27 + 1;
  const double ca = split * a, ah = ca - (ca - a), al = a - ah;
  const double cb = split * b, bh = cb - (cb - b), bl = b - bh;
  const double p = a * b;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

Sum multiply(const Sum& a, const Sum& b) {
  const Sum p = multiplyExact(a.hi, b.hi);
  return addExact(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// The nearest integer for |x| < 2^51.
double nearest(double x) {
  constexpr double shift = 0x1.8p52;
  return (x + shift) - shift;
}

/// 2^k for k in the range of normal numbers.
double powerOfTwo(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

/// x 2^k, rounding once into the subnormal range.
double scale(double x, int k) {
  if (k > 1023) return x * 0x1p1023 * powerOfTwo(std::min(k - 1023, 1023));
  if (k < -1022) return x * powerOfTwo(std::max(k + 1022 - 54, -1022) + 54) * 0x1p-1022;
  return x * powerOfTwo(k);
}

/// Polynomial with coefficients in rising order (Horner).
template <int N>
double polynomial(const double (&c)[N], double x) {
  double r = c[N - 1];
  for (int i = N - 2; i >= 0; --i) r = r * x + c[i];
  return r;
}

struct Angle {
  double hi, lo;  ///< in [-pi/4, pi/4]
  int quadrant;   ///< 0..3
};

/// x - n pi/2 with pi/2 in parts that have exact multiples by n (Cody and Waite).
Angle reduceBy(double x, double n, const double* parts, int count) {
  double hi = x - n * parts[0], lo = 0;
  for (int i = 1; i < count; ++i) {
    const Sum s = addExact(hi, -n * parts[i]);
    hi = s.hi;
    lo += s.lo;
  }
  const Sum s = addExact(hi, lo);
  return {s.hi, s.lo, static_cast<int>(static_cast<std::int64_t>(n) & 3)};
}

Angle reduce(double x) {
  // 33 bits a part serve |n| < 2^20; 22 bits a part serve |n| < 2^31 and arguments close to a multiple of
  // pi/2.
  static constexpr double coarse[] = {0x1.921fb54400000p+0, 0x1.0b4611a600000p-34, 0x1.3198a2e037073p-69};
  static constexpr double fine[] = {0x1.921fb00000000p+0,  0x1.5110b00000000p-22, 0x1.1846980000000p-44,
                                    0x1.3198a00000000p-69, 0x1.701b800000000p-92, 0x1.cd12900000000p-115};
  const double n = nearest(x / kHalfPi);
  if (n == 0) return {x, 0, 0};
  if (std::fabs(n) < 0x1p20) {
    const Angle a = reduceBy(x, n, coarse, 3);
    if (std::fabs(a.hi) > 0x1p-20) return a;
  }
  return reduceBy(x, n, fine, 6);
}

/// Beyond 2^30 an angle carries too few bits to mean much; bring it down so that the result stays bounded.
double wrap(double x) {
  while (std::fabs(x) >= 0x1p30) {
    const int e = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) - 1023;
    const double unit = 2 * kPi * powerOfTwo(e - 28);
    x -= nearest(x / unit) * unit;
  }
  return x;
}

/// sin(a + b) for |a| <= pi/4, |b| tiny: Taylor to a^17, remainder 1e-19.
double sinKernel(double a, double b) {
  static constexpr double c[] = {-1.0 / 6,
                                 1.0 / 120,
                                 -1.0 / 5040,
                                 1.0 / 362880,
                                 -1.0 / 39916800.0,
                                 1.0 / 6227020800.0,
                                 -1.0 / 1307674368000.0,
                                 1.0 / 355687428096000.0};
  const double z = a * a;
  return a + (a * z * polynomial(c, z) + b * (1 - 0.5 * z));
}

/// cos(a + b) for |a| <= pi/4, |b| tiny: Taylor to a^18, remainder 1e-20.
double cosKernel(double a, double b) {
  static constexpr double c[] = {1.0 / 24,
                                 -1.0 / 720,
                                 1.0 / 40320,
                                 -1.0 / 3628800,
                                 1.0 / 479001600.0,
                                 -1.0 / 87178291200.0,
                                 1.0 / 20922789888000.0,
                                 -1.0 / 6402373705728000.0};
  const double z = a * a, half = 0.5 * z, w = 1 - half;
  return w + (((1 - w) - half) + (z * z * polynomial(c, z) - a * b));
}

/// exp(r) - 1 - r for |r| <= 0.35: Taylor to r^15.
double expTail(double r) {
  static constexpr double c[] = {1.0 / 2,
                                 1.0 / 6,
                                 1.0 / 24,
                                 1.0 / 120,
                                 1.0 / 720,
                                 1.0 / 5040,
                                 1.0 / 40320,
                                 1.0 / 362880,
                                 1.0 / 3628800,
                                 1.0 / 39916800.0,
                                 1.0 / 479001600.0,
                                 1.0 / 6227020800.0,
                                 1.0 / 87178291200.0,
                                 1.0 / 1307674368000.0};
  return r * r * polynomial(c, r);
}

struct ExpParts {
  double hi, lo;  ///< exp(x) - 1 after the factor 2^k is taken out
  int k;
};

ExpParts expParts(double x) {
  const double k = nearest(x * kInvLn2);
  const Sum r = addExact(x - k * kLn2[0], -k * kLn2[1]);
  const double rest = r.lo - k * kLn2[2];
  return {r.hi, expTail(r.hi) + rest * (1 + r.hi), static_cast<int>(k)};
}

struct Binary {
  double m;  ///< in [sqrt(1/2), sqrt 2)
  int k;     ///< x = m 2^k
};

/// Expects x > 0, finite.
Binary decompose(double x) {
  int k = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    k = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  k += static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  if (m >= 0x1.6a09e667f3bcdp+0) {
    m *= 0.5;
    ++k;
  }
  return {m, k};
}

/// 2 (s^2/3 + s^4/5 + ...): what atanh(s) adds to s, doubled and divided by s. |s| <= 0.1716, remainder
/// 1e-20.
double atanhTail(double z) {
  static constexpr double c[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11, 2.0 / 13,
                                 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21, 2.0 / 23, 2.0 / 25};
  return z * polynomial(c, z);
}

/// log x to about 65 bits, for pow.
Sum logSum(double x) {
  const auto [m, k] = decompose(x);
  const double f = m - 1, d = 2 + f, dLow = f - (d - 2);  // 2 + f = d + dLow
  const double s0 = f / d;
  const Sum p = multiplyExact(s0, d);
  const Sum s = addExact(s0, ((f - p.hi) - p.lo - s0 * dLow) / d);
  const Sum z = multiply(s, s), cube = multiply(multiply(z, s), {2.0 / 3, 0x1.5555555555555p-55});
  static constexpr double c[] = {2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11, 2.0 / 13, 2.0 / 15,
                                 2.0 / 17, 2.0 / 19, 2.0 / 21, 2.0 / 23, 2.0 / 25};
  const double tail = z.hi * z.hi * s.hi * polynomial(c, z.hi);
  Sum t = addExact(2 * s.hi, cube.hi);
  const double small = t.lo + 2 * s.lo + cube.lo + tail;
  t = addExact(t.hi, small);
  const double n = k;
  Sum whole = addExact(n * kLn2[0], n * kLn2[1]);
  const Sum all = addExact(whole.hi, t.hi);
  return addExact(all.hi, all.lo + (whole.lo + n * kLn2[2] + t.lo));
}

/// atan(t) for |t| < 3/16: odd Taylor polynomial to t^25.
double atanKernel(double t) {
  static constexpr double c[] = {-1.0 / 3,  1.0 / 5,  -1.0 / 7,  1.0 / 9,  -1.0 / 11, 1.0 / 13,
                                 -1.0 / 15, 1.0 / 17, -1.0 / 19, 1.0 / 21, -1.0 / 23, 1.0 / 25};
  const double z = t * t;
  return t * z * polynomial(c, z);
}

/// atan(y / x) for 0 <= y <= x, x > 0, scaled so that nothing overflows. About the nearest k/8:
/// atan(y/x) = atan(c) + atan((y - c x) / (x + c y)).
Sum atanRatio(double y, double x) {
  static constexpr double hi[] = {0,
                                  0x1.fd5ba9aac2f6ep-4,
                                  0x1.f5b75f92c80ddp-3,
                                  0x1.6f61941e4def1p-2,
                                  0x1.dac670561bb4fp-2,
                                  0x1.1e00babdefeb4p-1,
                                  0x1.4978fa3269ee1p-1,
                                  0x1.700a7c5784634p-1,
                                  0x1.921fb54442d18p-1};
  static constexpr double lo[] = {0,
                                  -0x1.cd37686760c17p-59,
                                  0x1.8ab6e3cf7afbdp-57,
                                  -0x1.c63aae6f6e918p-56,
                                  0x1.a2b7f222f65e2p-56,
                                  -0x1.928df287a668fp-58,
                                  0x1.2419a87f2a458p-56,
                                  -0x1.8c34d25aadef6p-56,
                                  0x1.1a62633145c07p-55};
  const double q = y / x;
  if (q < 0x1p-500) return {q, 0};
  if (q < 0.1875) {
    const Sum p = multiplyExact(q, x);
    return {q, atanKernel(q) + ((y - p.hi) - p.lo) / x};
  }
  const double k = nearest(8 * q), c = k / 8;
  const Sum cx = multiplyExact(c, x);
  const double t = ((y - cx.hi) - cx.lo) / (x + c * y);
  const int i = static_cast<int>(k);
  const Sum s = addExact(hi[i], t);
  return {s.hi, s.lo + (lo[i] + atanKernel(t))};
}

int exponentOf(double x) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) - 1023;
}

}  // namespace

SinCos sincos(double x) {
  if (!(std::fabs(x) <= std::numeric_limits<double>::max())) return {kNaN, kNaN};
  if (std::fabs(x) < 0x1p-27) return {x, 1};
  const Angle a = reduce(wrap(x));
  const double s = sinKernel(a.hi, a.lo), c = cosKernel(a.hi, a.lo);
  switch (a.quadrant) {
  case 0: return {s, c};
  case 1: return {c, -s};
  case 2: return {-s, -c};
  default: return {-c, s};
  }
}

double sin(double x) {
  return sincos(x).sin;
}

double cos(double x) {
  return sincos(x).cos;
}

double tan(double x) {
  const SinCos a = sincos(x);
  return a.sin / a.cos;
}

double atan(double x) {
  return atan2(x, 1);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNaN;
  double ay = std::fabs(y), ax = std::fabs(x);
  const bool left = std::signbit(x);
  double angle;
  if (ay == 0) {
    angle = left ? kPi : 0;
  } else if (ax == kInf) {
    const double quarter = 0.5 * kHalfPi;
    angle = ay == kInf ? (left ? 3 * quarter : quarter) : (left ? kPi : 0);
  } else if (ay == kInf || ax == 0) {
    angle = kHalfPi;
  } else {
    // Keep products of the two inside the range of normal numbers.
    const int e = exponentOf(std::max(ax, ay));
    if (e > 400 || e < -400) {
      ay = scale(ay, -e);
      ax = scale(ax, -e);
    }
    const bool steep = ay > ax;
    const Sum a = steep ? atanRatio(ax, ay) : atanRatio(ay, ax);
    // The angle from the nearest axis is a; from there to the positive x axis:
    if (steep) {
      const double sign = left ? 1 : -1;
      const Sum s = addExact(kHalfPi, sign * a.hi);
      angle = s.hi + (s.lo + (kHalfPiLow + sign * a.lo));
    } else if (left) {
      const Sum s = addExact(kPi, -a.hi);
      angle = s.hi + (s.lo + (2 * kHalfPiLow - a.lo));
    } else {
      angle = a.hi + a.lo;
    }
  }
  return std::signbit(y) ? -angle : angle;
}

double asin(double x) {
  x = std::isnan(x) ? x : std::clamp(x, -1.0, 1.0);
  return atan2(x, std::sqrt((1 - x) * (1 + x)));
}

double acos(double x) {
  x = std::isnan(x) ? x : std::clamp(x, -1.0, 1.0);
  return atan2(std::sqrt((1 - x) * (1 + x)), x);
}

double exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 709.8) return kInf;
  if (x < -745.2) return 0;
  const ExpParts e = expParts(x);
  return scale(1 + (e.hi + e.lo), e.k);
}

double expm1(double x) {
  if (std::isnan(x)) return x;
  if (x > 709.8) return kInf;
  if (x < -745.2) return -1;
  if (std::fabs(x) < 0x1p-54) return x;
  const ExpParts e = expParts(x);
  if (e.k == 0) return e.hi + e.lo;
  if (e.k > 56) return scale(1 + (e.hi + e.lo), e.k);
  if (e.k < -56) return -1;
  const double two = powerOfTwo(e.k);
  const Sum s =
      addExact(two - 1, two * e.hi);  // two - 1 is exact here for k > -53, else rounds to -1 harmlessly
  return s.hi + (s.lo + two * e.lo);
}

double log(double x) {
  if (std::isnan(x) || x < 0) return kNaN;
  if (x == 0) return -kInf;
  if (x == kInf) return x;
  const auto [m, k] = decompose(x);
  const double f = m - 1, s = f / (2 + f), half = 0.5 * f * f, n = k;
  // log(1 + f) = f - f^2/2 + s (f^2/2 + R): f is exact, so only small terms round.
  const double correction = s * (half + atanhTail(s * s));
  if (k == 0) return f - (half - correction);
  const Sum a = addExact(n * kLn2[0], f);
  return a.hi + (a.lo + (n * kLn2[1] + (correction - half) + n * kLn2[2]));
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y) || x < 0) return kNaN;
  if (x == 0) return y > 0 ? 0 : kInf;
  if (x == kInf) return y > 0 ? kInf : 0;
  if (std::fabs(y) == kInf) return (x > 1) == (y > 0) ? kInf : 0;
  const Sum l = logSum(x);
  const double rough = y * l.hi;
  if (rough > 710) return kInf;
  if (rough < -746) return 0;
  if (std::fabs(rough) < 0x1p-60) return 1 + rough;
  const Sum p = multiplyExact(y, l.hi);
  const double low = p.lo + y * l.lo;
  const ExpParts e = expParts(p.hi);
  return scale(1 + (e.hi + (e.lo + low * (1 + e.hi + e.lo))), e.k);
}

double cbrt(double x) {
  if (!(std::fabs(x) <= std::numeric_limits<double>::max()) || x == 0) return x;
  double a = std::fabs(x);
  int k = 0;
  if (a < 0x1p-1022) {
    a *= 0x1p54;
    k = -18;
  }
  const int e = exponentOf(a), third = (e >= 0 ? e : e - 2) / 3;  // rounded down
  a = scale(a, -3 * third);                                       // in [1, 8)
  double r = 0.75 + 0.19 * a;
  if (a > 4) r = 1.0 + 0.127 * a;
  for (int i = 0; i < 3; ++i) {  // Halley: tripling the digits each time
    const double c = r * r * r;
    r *= (c + 2 * a) / (2 * c + a);
  }
  const Sum square = multiplyExact(r, r), cube = multiplyExact(square.hi, r);
  r -= ((cube.hi - a) + (cube.lo + square.lo * r)) / (3 * square.hi);
  r = scale(r, third + k);
  return std::signbit(x) ? -r : r;
}

}  // namespace stadion::det
