/// Fits find the numbers that flights were made with, and the cheapest model that is good enough.

#include "dynamics/flight/fit.h"

#include "bench/flight/bodies.h"
#include "dynamics/flight/least_squares.h"
#include "engine/maths/angles.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace stadion {
namespace {

/// Flights of this model at several angles, as a camera would see them.
FitTask flownBy(const FlightModel& model, const FlightBody& body, const FlightShape& shape, int axis,
                const Vec3& w) {
  FitTask task;
  task.body = body, task.shape = shape;
  task.air = {Vec3(0, 0, -9.81), Vec3(1, 2, 0), 1.2};
  Vec3 inertia = Vec3::Constant(body.across);
  inertia[axis] = body.along;
  const auto air = [&model](const Vec3& u, const Vec3& turning) {
    return aerodynamics(model, 1.2, u, turning);
  };
  for (const double more : {-8.0, 3.0, 9.0}) {
    RigidFlight f;
    f.p = Vec3(0, 0, 2), f.v = Vec3(20, 0, 14), f.w = w;
    f.q = det::expRotation(Vec3(0, -(35 + more) * kDegree, 0));
    Trajectory flight{{0, f}};
    for (int i = 1; f.p.z() > 0; ++i) {
      for (int k = 0; k < 10; ++k)
        runge_kutta::step4(f, .005, {body.mass, inertia, task.air.gravity, task.air.wind}, air);
      flight.push_back({.05 * i, f});
    }
    task.flights.push_back(std::move(flight));
  }
  return task;
}

const FlightBody kJavelin{.806, 1.5e-4, .42}, kDiscus{2.0, .0131, .0073};

const FittedRung& rungOf(const std::vector<FittedRung>& rungs, FlightKind kind) {
  return *std::ranges::find(rungs, kind, &FittedRung::kind);
}

TEST(FlightFit, ARodIsFoundAgain) {
  RodFlight truth = javelinFlight();
  truth.crossArea *= 1.3, truth.axialArea *= 0.8, truth.crossArm *= 1.2;
  const FitTask task =
      flownBy(truth, kJavelin, measureShape(bodies::javelin(), Vec3(-1.05, 0, 0)), 0, Vec3(0, .2, 0));
  const std::vector<FittedRung> rungs = fitRungs(task, {0.01, 1});
  const FittedRung& rod = rungOf(rungs, FlightKind::Rod);
  EXPECT_TRUE(rod.good);
  EXPECT_LE(rod.errors.landing, 5e-4);
  EXPECT_LE(rod.errors.attitude, 0.2);
  EXPECT_NEAR(std::get<RodFlight>(rod.model).axialArea / truth.axialArea, 1, 0.05);
  EXPECT_FALSE(rungOf(rungs, FlightKind::Ballistic).good);
  EXPECT_GT(rungOf(rungs, FlightKind::Bias).bias.rate, 0.1);
}

TEST(FlightFit, APlateIsFoundAgainAndSoIsItsTable) {
  PlateFlight truth = discusFlight();
  truth.liftArea *= 0.8, truth.momentVolume *= 1.3;
  const FitTask task =
      flownBy(truth, kDiscus, measureShape(bodies::discus(), Vec3::Zero()), 2, Vec3(0, 0, -40));
  const std::vector<FittedRung> rungs = fitRungs(task, {0.01, 1});
  EXPECT_LE(rungOf(rungs, FlightKind::Plate).errors.landing, 1e-3);
  EXPECT_LE(rungOf(rungs, FlightKind::Table).errors.landing, 3e-3);
  EXPECT_NEAR(std::get<PlateFlight>(rungOf(rungs, FlightKind::Plate).model).momentVolume / truth.momentVolume,
              1, 0.1);
}

TEST(FlightFit, WithoutAirTheCheapestIsNone) {
  const FitTask task = flownBy(BallisticFlight{}, kJavelin,
                               measureShape(bodies::javelin(), Vec3(-1.05, 0, 0)), 0, Vec3(0, .2, 0));
  const std::vector<FittedRung> rungs = fitRungs(task, {0.001, 0.5});
  EXPECT_EQ(rungs.front().kind, FlightKind::Ballistic);
  EXPECT_TRUE(rungs.front().good);
}

TEST(FlightFit, ABallIsABallAndItsAxisIsNotAsked) {
  SportsBall truth = footballFlight();
  truth.dragLow = 0.2;
  const FlightBody body{.43, .0035, .0035};
  const FitTask task =
      flownBy(truth, body, measureShape(bodies::ball(.11), Vec3::Zero()), 0, Vec3(3, 20, 50));
  const std::vector<FittedRung> rungs = fitRungs(task, {0.01, 1e-6});
  ASSERT_EQ(rungs.size(), 2U);
  EXPECT_TRUE(rungs[1].good) << rungs[1].errors.landing;
}

TEST(LeastSquares, FindTheBottomOfACurvedValley) {
  const Residuals valley = [](const Eigen::VectorXd& x) {  // Rosenbrock's
    Eigen::VectorXd r(2);
    r << 1 - x[0], 10 * (x[1] - x[0] * x[0]);
    return r;
  };
  const Eigen::Vector2d at = leastSquares(valley, Eigen::Vector2d(-1.2, 1), Eigen::Vector2d(1, 1), 200);
  EXPECT_NEAR(at.x(), 1, 1e-6);
  EXPECT_NEAR(at.y(), 1, 1e-6);
}

TEST(LeastSquares, ATrialThatIsNotFiniteIsNotTaken) {
  const Residuals edge = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, x[0] > 2 ? NAN : x[0] - 3));
  };
  const Eigen::VectorXd at = leastSquares(edge, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1), 50);
  EXPECT_TRUE(at.allFinite());
  EXPECT_LE(at[0], 2);
}

}  // namespace
}  // namespace stadion
