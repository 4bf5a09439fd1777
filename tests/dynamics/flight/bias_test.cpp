/// The bias turns what has a direction, as fast as its rate says, whatever the frame rate.

#include "dynamics/flight/bias.h"

#include "bench/flight/bodies.h"
#include "engine/maths/functions.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

const double kDegree = kPi / 180;

Quat pitched(double degrees) {
  return det::expRotation(Vec3(0, -degrees * kDegree, 0));
}
double angleTo(const Quat& q, const Vec3& v) {
  const Vec3 a = q * Vec3::UnitX();
  return det::atan2(a.cross(v).norm(), a.dot(v)) / kDegree;
}

/// The nose's direction when a body thrown at 30 m/s, 34 degrees, pitched 20 more, has flown 3 s in frames.
Quat flown(const Bias& bias, int hz) {
  Quat q = pitched(54);
  Vec3 v(30 * std::cos(34 * kDegree), 0, 30 * std::sin(34 * kDegree));
  const double h = 1.0 / hz;
  for (int i = 0; i < 3 * hz; ++i) {
    q = biased(bias, q, v, h / 2);
    v.z() -= 9.81 * h;
    q = biased(bias, q, v, h / 2);
  }
  return q;
}

TEST(FlightBias, TheAngleFallsExponentially) {
  const Bias bias{BiasForm::Flow, 2, Vec3(1, 0, 0)};
  const Vec3 v(1e6, 0, 0);  // far from where it fades
  EXPECT_NEAR(angleTo(biased(bias, pitched(60), v, 0.7), v), 60 * std::exp(-1.4), 1e-9);
  const Quat halves = biased(bias, biased(bias, pitched(60), v, 0.35), v, 0.35);
  EXPECT_NEAR(angleTo(halves, v), 60 * std::exp(-1.4), 1e-9);
}

TEST(FlightBias, AttitudeDoesNotDependOnTheFrameRate) {
  const Bias bias{BiasForm::Flow, biasRate(0.0205, 60), Vec3(1, 0, 0)};
  const Quat fine = flown(bias, 1000);
  for (const int hz : {30, 60, 144})
    EXPECT_LE(det::logRotation(fine.conjugate() * flown(bias, hz)).norm() / kDegree, 0.05) << hz;
}

TEST(FlightBias, ThePapersOwnFormDoesDependOnIt) {
  const Bias bias{BiasForm::Paper, 0.03, Vec3(1, 0, 0)};
  const Vec3 v = 20 * Vec3::UnitX();
  for (const auto& [hz, left] : {std::pair{30, 24.06}, {60, 9.65}, {120, 1.55}}) {  // 60 degrees, 1 s later
    Quat q = pitched(60);
    for (int i = 0; i < hz; ++i) q = biased(bias, q, v, 1.0 / hz);
    EXPECT_NEAR(angleTo(q, v), left, 0.01) << hz;
  }
}

TEST(FlightBias, APerFrameShareAndARateAreTheSameAtThatRate) {
  EXPECT_NEAR(1 - std::exp(-biasRate(0.03, 60) / 60), 0.03, 1e-15);
}

TEST(FlightBias, RoundBodiesAreNotTurned) {
  for (const BiasForm form : {BiasForm::Flow, BiasForm::Paper, BiasForm::Covariance}) {
    const Bias bias = biasFor(measureShape(bodies::ball(0.11), Vec3::Zero()), form, 3);
    EXPECT_EQ(bias.rate, 0);
    EXPECT_EQ(biased(bias, pitched(20), Vec3(3, 4, 5), 1).coeffs(), pitched(20).coeffs());
  }
}

TEST(FlightBias, NoVelocityTurnsNothingAndNoneIsUndefined) {
  for (const BiasForm form : {BiasForm::Flow, BiasForm::Paper, BiasForm::Covariance}) {
    const Bias bias{form, 0.5, Vec3(1, 0.1, 0.1)};
    EXPECT_EQ(biased(bias, pitched(20), Vec3::Zero(), 1).coeffs(), pitched(20).coeffs());
    for (const double speed : {1e-12, 1e-8, 1e-3, 1e3})
      EXPECT_TRUE(biased(bias, pitched(20), Vec3(0, speed, 0), 1).coeffs().allFinite()) << speed;
  }
}

TEST(FlightBias, ABodyThatFliesBackwardsTurnsRound) {
  const Vec3 v(-10, 0, 0);
  Quat q = Quat::Identity();
  const Bias bias{BiasForm::Flow, 2, Vec3(1, 0.1, 0.1)};
  for (int i = 0; i < 600; ++i) q = biased(bias, q, v, 1.0 / 60);
  EXPECT_LE(angleTo(q, v), 1e-5);
  EXPECT_NEAR(angleTo(biased({BiasForm::Paper, 0.5, Vec3(1, 0, 0)}, Quat::Identity(), v, 0), v), 90, 1e-9);
}

TEST(FlightBias, TheCovarianceTurnsRodsAlongTheFlightAndLaysDiscsFlat) {
  const Vec3 v(0, 0, 10);
  Bias rod = biasFor(measureShape(bodies::javelin(), Vec3(-1.05, 0, 0)), BiasForm::Covariance, 0.5);
  // Exactly: tan of the angle falls as exp(-rate |v| (1 - l2 / l1) t).
  const double tangent = std::tan(60 * kDegree) * std::exp(-0.5 * 10 * (1 - rod.spread.y()) * 0.3);
  EXPECT_NEAR(angleTo(biased(rod, pitched(30), v, 0.3), v), std::atan(tangent) / kDegree, 1e-4);
  const Bias disc = biasFor(measureShape(bodies::discus(), Vec3::Zero()), BiasForm::Covariance, 0.5);
  const Quat q = biased(disc, det::expRotation(Vec3(0.4, 0, 0)), v, 5);
  EXPECT_NEAR((q * Vec3::UnitZ()).dot(Vec3::UnitZ()), 0, 1e-6);
}

}  // namespace
}  // namespace stadion
