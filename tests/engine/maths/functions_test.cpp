#include "engine/maths/functions.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace stadion {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// Error of `got` in units of the last place of the true value.
double ulps(double got, long double truth) {
  const double t = static_cast<double>(truth);
  if (got == t) return 0;
  const double next = std::nextafter(std::fabs(t), kInf);
  return static_cast<double>(std::fabs((static_cast<long double>(got) - truth) / (next - std::fabs(t))));
}

double worst(const std::function<double(double)>& f, const std::function<long double(long double)>& truth,
             double lo, double hi, int n = 200000) {
  std::mt19937_64 g(42);
  std::uniform_real_distribution<double> u(lo, hi);
  double w = 0;
  for (int i = 0; i < n; ++i) {
    const double x = u(g);
    w = std::max(w, ulps(f(x), truth(x)));
  }
  return w;
}

double worstLog(const std::function<double(double)>& f, const std::function<long double(long double)>& truth,
                double lo, double hi) {
  return worst([&](double e) { return f(std::exp2(e)); },
               [&](long double e) { return truth(std::exp2(static_cast<double>(e))); }, lo, hi);
}

TEST(MathsFunctions, SineAndCosineAreGoodToAnUlpOverTheStatedRange) {
  const auto s = [](long double x) { return sinl(x); };
  const auto c = [](long double x) { return cosl(x); };
  for (const double range : {0.5, 4.0, 100.0, 1e6, 1e9}) {
    EXPECT_LE(worst(det::sin, s, -range, range), 1.0) << range;
    EXPECT_LE(worst(det::cos, c, -range, range), 1.0) << range;
    EXPECT_LE(worst(
                  det::tan, [](long double x) { return tanl(x); }, -range, range),
              2.2)
        << range;
  }
}

TEST(MathsFunctions, SineKeepsItsDigitsNextToMultiplesOfHalfPi) {
  for (int n = 1; n < 2000000; n += 37) {
    const double x = static_cast<double>(n * 1.57079632679489661923132169163975144L);
    EXPECT_LE(ulps(n % 2 ? det::cos(x) : det::sin(x), n % 2 ? cosl(x) : sinl(x)), 1.0) << n;
  }
}

TEST(MathsFunctions, ArcFunctionsAreGoodToAnUlpOrTwo) {
  for (const double range : {0.1, 0.3, 1.5, 20.0, 1e6})
    EXPECT_LE(worst(
                  det::atan, [](long double x) { return atanl(x); }, -range, range),
              1.1)
        << range;
  EXPECT_LE(worst(
                det::asin, [](long double x) { return asinl(x); }, -1, 1),
            2.0);
  EXPECT_LE(worst(
                det::acos, [](long double x) { return acosl(x); }, -1, 1),
            2.0);
  std::mt19937_64 g(1);
  std::uniform_real_distribution<double> u(-1, 1), e(-300, 300);
  double w = 0;
  for (int i = 0; i < 200000; ++i) {
    const double k = std::exp2(e(g) * 3), y = k * u(g), x = k * u(g);
    w = std::max(w, ulps(det::atan2(y, x), atan2l(y, x)));
  }
  EXPECT_LE(w, 1.5);
}

TEST(MathsFunctions, ExponentialAndLogarithmAreGoodToAnUlp) {
  EXPECT_LE(worst(
                det::exp, [](long double x) { return expl(x); }, -1, 1),
            1.0);
  EXPECT_LE(worst(
                det::exp, [](long double x) { return expl(x); }, -708, 709),
            1.0);
  EXPECT_LE(worst(
                det::expm1, [](long double x) { return expm1l(x); }, -1.5, 1.5),
            1.5);
  EXPECT_LE(worst(
                det::expm1, [](long double x) { return expm1l(x); }, -50, 700),
            1.0);
  EXPECT_LE(worst(
                det::log, [](long double x) { return logl(x); }, 0.5, 2),
            1.0);
  EXPECT_LE(worstLog(
                det::log, [](long double x) { return logl(x); }, -1073, 1023),
            1.0);
}

TEST(MathsFunctions, PowersAndCubeRootsAreGoodToAnUlp) {
  EXPECT_LE(worstLog(
                det::cbrt, [](long double x) { return cbrtl(x); }, -1060, 1023),
            1.0);
  std::mt19937_64 g(3);
  std::uniform_real_distribution<double> u(0, 10), e(-60, 60);
  double w = 0;
  for (int i = 0; i < 200000; ++i) {
    const double x = u(g), y = e(g);
    const long double t = powl(x, y);
    if (t > 1e300L || t < 1e-300L) continue;
    w = std::max(w, ulps(det::pow(x, y), t));
  }
  EXPECT_LE(w, 1.0);
}

TEST(MathsFunctions, EdgeValuesAreWhatTheStandardSays) {
  for (const auto f : {det::sin, det::cos, det::tan, det::atan, det::asin, det::acos, det::exp, det::expm1,
                       det::log, det::cbrt})
    EXPECT_TRUE(std::isnan(f(kNotANumber)));
  EXPECT_TRUE(std::isnan(det::sin(kInf)));
  EXPECT_TRUE(std::isnan(det::log(-1)));
  EXPECT_EQ(det::log(0), -kInf);
  EXPECT_EQ(det::log(kInf), kInf);
  EXPECT_EQ(det::log(1), 0);
  EXPECT_EQ(det::exp(0), 1);
  EXPECT_EQ(det::exp(-kInf), 0);
  EXPECT_EQ(det::exp(1000), kInf);
  EXPECT_EQ(det::expm1(-kInf), -1);
  EXPECT_EQ(det::expm1(1e-300), 1e-300);
  EXPECT_EQ(det::sin(0), 0);
  EXPECT_TRUE(std::signbit(det::sin(-0.0)));
  EXPECT_EQ(det::cos(0), 1);
  EXPECT_EQ(det::atan(kInf), std::atan(kInf));
  EXPECT_EQ(det::atan2(0.0, -1.0), std::atan2(0.0, -1.0));
  EXPECT_EQ(det::atan2(-0.0, -1.0), std::atan2(-0.0, -1.0));
  EXPECT_EQ(det::atan2(0.0, 0.0), 0);
  EXPECT_EQ(det::atan2(kInf, -kInf), std::atan2(kInf, -kInf));
  EXPECT_EQ(det::atan2(1e-320, 1e300), 0);
  EXPECT_EQ(det::asin(2), std::asin(1.0));
  EXPECT_EQ(det::acos(-2), std::acos(-1.0));
  EXPECT_EQ(det::pow(0, 2), 0);
  EXPECT_EQ(det::pow(2, 10), 1024);
  EXPECT_EQ(det::pow(5, 0), 1);
  EXPECT_TRUE(std::isnan(det::pow(-1, 0.5)));
  EXPECT_EQ(det::cbrt(-27), -3);
  EXPECT_EQ(det::cbrt(0), 0);
  EXPECT_EQ(det::cbrt(kInf), kInf);
}

TEST(MathsFunctions, HugeAnglesGiveBoundedResults) {
  for (double x = 1e9; x < 1e308; x *= 3.7) {
    const auto [s, c] = det::sincos(x);
    EXPECT_NEAR(s * s + c * c, 1, 1e-15) << x;
  }
  EXPECT_TRUE(std::isfinite(det::sin(std::numeric_limits<double>::max())));
}

TEST(MathsRotations, ExponentialAndLogarithmAreInverse) {
  std::mt19937_64 g(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 w = Vec3(u(g), u(g), u(g)).normalized() * (3.14159 * std::pow(std::fabs(u(g)), 8));
    const Quat q = det::expRotation(w);
    EXPECT_NEAR(q.norm(), 1, 4e-16);
    EXPECT_LE((det::logRotation(q) - w).norm(), 2e-15 * (1 + w.norm()));
    EXPECT_LE((det::logRotation(Quat(-q.coeffs())) - w).norm(), 2e-15 * (1 + w.norm()));
  }
  EXPECT_EQ(det::expRotation(Vec3::Zero()).coeffs(), Quat::Identity().coeffs());
  EXPECT_EQ(det::logRotation(Quat::Identity()), Vec3::Zero());
}

TEST(MathsRotations, ExponentialMatchesTheAngleAxisForm) {
  for (double a = 1e-9; a < 50; a *= 1.7) {
    const Vec3 k = Vec3(1, -2, 0.5).normalized();
    const Quat truth(Eigen::AngleAxisd(a, k));
    EXPECT_LE((det::expRotation(a * k).coeffs() - truth.coeffs()).norm(), 1e-15) << a;
  }
}

TEST(MathsRotations, SlerpTurnsAtConstantSpeedTheShortWay) {
  const Quat a = det::fromEuler(0.1, 0.2, 0.3), turn = det::expRotation(Vec3(0, 0, 1));
  const Quat b(-(a * turn).coeffs());  // the same rotation from the other side of the sphere
  for (double s = 0; s <= 1; s += 0.125)
    EXPECT_LE(det::logRotation(a.conjugate() * det::slerp(a, b, s)).z() - s, 1e-15);
  const Pose m = det::interpolate({Vec3(0, 0, 0), a}, {Vec3(2, 4, 6), b}, 0.5);
  EXPECT_EQ(m.p, Vec3(1, 2, 3));
}

TEST(MathsRotations, EulerAnglesTurnAboutFixedAxesXThenYThenZ) {
  const double r = 0.4, p = -0.7, y = 2.1;
  const Mat3 truth = (Eigen::AngleAxisd(y, Vec3::UnitZ()) * Eigen::AngleAxisd(p, Vec3::UnitY()) *
                      Eigen::AngleAxisd(r, Vec3::UnitX()))
                         .toRotationMatrix();
  EXPECT_LE((det::fromEuler(r, p, y).toRotationMatrix() - truth).norm(), 1e-15);
}

}  // namespace
}  // namespace stadion
