/// Bodies that fly by a model of the air, or by a bias, in a world.

#include "dynamics/flight/flight_shape.h"
#include "dynamics/motion/body_flight.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

struct Thrown {
  BodyFlight flight;
  double mass = 1;
  Vec3 inertia = Vec3::Ones();  ///< along A's axes
  Pose pose;
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();  ///< w in A
};

Quat pitched(double degrees) {
  return det::expRotation({0, -degrees * kDegree, 0});
}

/// The published javelin and discus.
Thrown javelin(double speed = 30, double gamma = 34, double alpha = 0) {
  Thrown t;
  t.flight.model = javelinFlight(), t.mass = 0.806, t.inertia = {1.5e-4, 0.42, 0.42};
  t.pose = {{0, 0, 2}, pitched(gamma + alpha)};
  t.v = pitched(gamma) * Vec3(speed, 0, 0);
  return t;
}
Thrown discus(double speed = 25, double gamma = 35, double alpha = -5, double spin = -40) {
  Thrown t;
  t.flight.model = discusFlight(), t.mass = 2, t.inertia = {.0073, .0073, .0131};
  t.pose = {{0, 0, 1.8}, pitched(gamma + alpha)};
  t.v = pitched(gamma) * Vec3(speed, 0, 0), t.w = {0, 0, spin};
  return t;
}

struct Sky {
  World w;
  FieldId gravity = addGravity(w), air = 0;

  explicit Sky(const Vec3& wind = Vec3::Zero(), double density = 1.2) {
    ForceField f;
    f.law = MediumField{.density = density, .wind = wind};
    air = w.addField(f, true);
  }
  /// A point of matter to all but the air, unless it has a shape.
  BodyId add(const Thrown& t, bool hooked = true, ShapeId shape = 0) {
    BodyDef d;
    d.shape = shape ? shape : w.addShape(BoxShape{{}, Vec3::Constant(1e-3)});
    d.mass.mass = t.mass, d.mass.inertia = t.inertia;
    d.pose = t.pose, d.v = t.v, d.omega = t.pose.q * t.w;
    d.flight = std::make_shared<BodyFlight>(t.flight);
    const BodyId id = w.addBody(d);
    w.hook(id, gravity, 0);
    if (hooked) w.hook(id, air, 0);
    return id;
  }
};

/// The same by classical Runge-Kutta steps of the equations as they stand in the books.
struct Reference {
  struct State {
    Vec3 p, v;
    Eigen::Vector4d q;  // w, x, y, z
    Vec3 w;             // in A
  };
  static State add(const State& s, const State& d, double h) {
    return {s.p + h * d.p, s.v + h * d.v, s.q + h * d.q, s.w + h * d.w};
  }
  static State rate(const Thrown& t, const State& s, const Vec3& wind, double density) {
    const Quat q = Quat(s.q[0], s.q[1], s.q[2], s.q[3]).normalized();
    const Wrench a = aerodynamics(t.flight.model, density, q.conjugate() * (s.v - wind), s.w);
    const Quat dq = q * Quat(0, s.w.x(), s.w.y(), s.w.z());
    const Vec3 L = t.inertia.cwiseProduct(s.w);
    return {s.v, q * a.force / t.mass - Vec3(0, 0, kG), 0.5 * Eigen::Vector4d(dq.w(), dq.x(), dq.y(), dq.z()),
            (a.torque - s.w.cross(L)).cwiseQuotient(t.inertia)};
  }
  static State after(const Thrown& t, double seconds, const Vec3& wind = Vec3::Zero(), double density = 1.2) {
    State s{t.pose.p, t.v, {t.pose.q.w(), t.pose.q.x(), t.pose.q.y(), t.pose.q.z()}, t.w};
    const int n = static_cast<int>(seconds * 4000 + 0.5);
    const double h = seconds / n;
    for (int i = 0; i < n; ++i) {
      const State a = rate(t, s, wind, density), b = rate(t, add(s, a, h / 2), wind, density);
      const State c = rate(t, add(s, b, h / 2), wind, density), d = rate(t, add(s, c, h), wind, density);
      s = add(s, a, h / 6), s = add(s, b, h / 3), s = add(s, c, h / 3), s = add(s, d, h / 6);
    }
    return s;
  }
};

double between(const Vec3& a, const Vec3& b) {
  return det::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(WorldAir, JavelinDiscusAndBallFlyAsFineStepsOfTheirModelsSay) {
  Thrown ball;
  ball.flight.model = footballFlight(), ball.mass = 0.43, ball.inertia.setConstant(2.0 / 3 * 0.43 * 0.0121);
  ball.pose.p = {0, 0, 0.11}, ball.v = pitched(20) * Vec3(25, 0, 0), ball.w = {0, 0, 60};
  const Vec3 wind(-4, 3, 0);
  for (const Thrown& t :
       {javelin(), javelin(30, 34, 8), discus(), discus(25, 35, -15), discus(21, 30, 8, 0), ball}) {
    Sky sky(wind);
    const BodyId id = sky.add(t);
    play(sky.w, 3.5, 60);
    const BodyState s = sky.w.state(id);
    const Reference::State r = Reference::after(t, 3.5, wind);
    EXPECT_LT((s.p - r.p).norm(), 2e-6) << "3e-8 of its range";
    EXPECT_LT((s.v - r.v).norm(), 1e-6);
    const Quat q = Quat(r.q[0], r.q[1], r.q[2], r.q[3]).normalized();
    EXPECT_LT(det::logRotation(s.q.conjugate() * q).norm(), 1e-5);
    EXPECT_LT((s.q.conjugate() * s.omega - r.w).norm(), 1e-5);
    EXPECT_EQ(s.flight, FlightClass::Steps);
  }
}

/// Where it comes down to z = 0, with a floor that it strikes with a corner of a millimetre.
Vec3 landing(const Thrown& t, double rate, const Vec3& wind = Vec3::Zero()) {
  Sky sky(wind);
  addFloor(sky.w);
  const BodyId id = sky.add(t);
  Vec3 at = Vec3::Constant(1e9);
  play(sky.w, 6, rate, [&](double) {
    for (const ContactEvent& e : sky.w.events())
      if (at.x() > 1e8) at = e.point;
  });
  EXPECT_NE(sky.w.mode(id), BodyMode::Quarantined);
  return at;
}

TEST(WorldAir, ThePublishedFlightsComeDownWhereTheyDo) {
  // Landings of the full models that the cheap ones are fitted to.
  const auto near = [](const Vec3& at, double x, double y) {
    EXPECT_LT((at - Vec3(x, y, at.z())).norm(), 0.0045 * x);
  };
  near(landing(discus(), 60), 65.528, 4.668);
  near(landing(discus(25, 35, -10), 60, {-5, 0, 0}), 64.836, 9.620);
  near(landing(javelin(), 60), 88.564, 0);
  near(landing(javelin(), 60, {0, 5, 0}), 88.303, 2.180);
}

TEST(WorldAir, LandsOnTheSameBitAtEveryFrameRate) {
  for (const Thrown& t : {javelin(30, 34, 5), discus(25, 35, -10)}) {
    std::vector<BodyState> ends;
    for (const double rate : {24., 60., 240.}) {
      Sky sky({-2, 1, 0});
      addFloor(sky.w, 0.5, 0.3);
      const BodyId id = sky.add(t, true, sky.w.addShape(CylinderShape{{}, 0.11, 0.02}));
      play(sky.w, 5, rate);
      ends.push_back(sky.w.state(id));
    }
    for (const BodyState& s : ends) {
      EXPECT_EQ(s.p, ends.front().p);
      EXPECT_EQ(s.q.coeffs(), ends.front().q.coeffs());
      EXPECT_EQ(s.v, ends.front().v);
    }
  }
}

TEST(WorldAir, WithoutAMediumThereIsNoAirAndBallisticBodiesFeelNone) {
  Thrown free = discus();
  free.flight.model = BallisticFlight{}, free.flight.inVacuum = true;
  for (const bool ballistic : {false, true}) {
    Sky sky;
    const BodyId id = sky.add(ballistic ? free : discus(), ballistic);
    play(sky.w, 2, 60);
    const BodyState s = sky.w.state(id);
    EXPECT_NEAR(s.p.z(), 1.8 + 2 * free.v.z() - kG / 2 * 4, 1e-9);
    EXPECT_NEAR(s.p.x(), 2 * free.v.x(), 1e-9);
    EXPECT_LT(between(s.q * Vec3::UnitZ(), free.pose.q * Vec3::UnitZ()), 1e-9) << "a top keeps its axis";
  }
}

TEST(WorldAir, WhatTheWindCarriesAlongFeelsNone) {
  const Vec3 wind(3, -2, 1);
  Sky still, windy(wind);
  Thrown moving = javelin();
  moving.v += wind;
  const BodyId a = still.add(javelin()), b = windy.add(moving);
  play(still.w, 3), play(windy.w, 3);
  EXPECT_LT((windy.w.state(b).p - still.w.state(a).p - 3 * wind).norm(), 1e-6);
}

TEST(WorldAir, AirThatIsSwitchedOffLetsItFlyOnAsItIs) {
  Sky sky;
  const BodyId id = sky.add(discus(25, 35, -15));
  play(sky.w, 1, 60);
  const BodyState s = sky.w.state(id);
  ASSERT_TRUE(sky.w.switchField(sky.air, false, fromSeconds(1)));
  sky.w.advance(fromSeconds(1), fromSeconds(2));
  const BodyState e = sky.w.state(id);
  EXPECT_LT((e.p - s.p - s.v + Vec3(0, 0, kG / 2)).norm(), 1e-9);
  EXPECT_LT((e.L - s.L).norm(), 1e-12);
}

TEST(WorldAir, HardCasesStayFiniteAndOnTheirAxes) {
  Thrown fast = discus(25, 35, -5, -300), tail = javelin(), dropped = javelin(), gust = javelin();
  tail.pose.q = tail.pose.q * det::expRotation({0, 0, M_PI});
  tail.v = -(tail.pose.q * Vec3(30, 0, 0));  // exactly backwards
  dropped.v.setZero();
  Thrown ball = dropped;
  ball.flight.model = footballFlight(), ball.inertia.setConstant(1e-3);
  for (const Thrown& t : {fast, tail, dropped, gust, ball})
    for (const double rate : {30., 60.}) {
      Sky sky(&t == &gust ? Vec3(0, 100, 0) : Vec3(0, 0, 0));
      const BodyId id = sky.add(t);
      Watch watch(sky.w, {id});
      play(sky.w, 3, watch, rate);
      EXPECT_TRUE(watch.finite);
      EXPECT_EQ(watch.limited, 0U);
    }
  Sky sky;
  const BodyId id = sky.add(fast);
  play(sky.w, 3, 30);
  const BodyState s = sky.w.state(id);
  EXPECT_LT(between(s.q * Vec3::UnitZ(), fast.pose.q * Vec3::UnitZ()), 5 * kDegree);
  EXPECT_LT(between(s.omega, -(s.q * Vec3::UnitZ())), 0.5 * kDegree) << "it spins about its axis";

  Sky storm({100, 0, 0});
  const BodyId blown = storm.add(javelin());
  play(storm.w, 2);
  EXPECT_LT(storm.w.state(blown).v.norm(), 110);
}

TEST(WorldAir, AFeatherInWaterSinksAtItsLastSpeedFromTheFirstMillisecondOn) {
  // A milligram with a javelin's faces: what would stop it within micrometres and turn it in microseconds.
  Thrown t = javelin(30, 0, 20);
  t.mass = 1e-6, t.inertia = {1e-10, 1e-7, 1e-7};
  for (const double rate : {30., 240.}) {
    Sky sky(Vec3::Zero(), 1000);
    const BodyId id = sky.add(t);
    Watch watch(sky.w, {id});
    play(sky.w, 2, watch, rate);
    EXPECT_TRUE(watch.finite);
    EXPECT_EQ(watch.limited, 0U);
    EXPECT_LT(watch.fastest, 30.1);
    EXPECT_LT(sky.w.state(id).v.norm(), 0.01) << "it sinks slowly";
    EXPECT_LT((sky.w.state(id).p - t.pose.p).norm(), 0.5);
  }
}

TEST(WorldAir, ABodyOfThreeMomentsIsTurnedAsItIs) {
  Thrown t = javelin(20, 30, 10);
  t.inertia = {0.1, 0.3, 0.42}, t.w = {1, -0.5, 2};
  Sky sky;
  const BodyId id = sky.add(t);
  play(sky.w, 2, 60);
  const Reference::State r = Reference::after(t, 2);
  EXPECT_LT((sky.w.state(id).p - r.p).norm(), 1e-5);
  const Quat q = Quat(r.q[0], r.q[1], r.q[2], r.q[3]).normalized();
  EXPECT_LT(det::logRotation(sky.w.state(id).q.conjugate() * q).norm(), 1e-5);
}

Thrown biasedRod(BiasForm form, double rate) {
  Thrown t = javelin();
  t.flight.model = BallisticFlight{};
  t.flight.bias = {form, rate, {1, 1e-4, 1e-4}};
  t.pose.q = pitched(60);
  return t;
}

TEST(WorldAir, ABiasTurnsAlikeAtEveryFrameRateAndNearlyAsTheFlowDoes) {
  for (const auto& [form, rate] : {std::pair(BiasForm::Flow, 1.8), std::pair(BiasForm::Covariance, 0.07)})
    for (const bool air : {false, true}) {
      std::vector<Vec3> noses;
      for (const double hz : {30., 60., 1000.}) {
        Sky sky;
        const BodyId id = sky.add(biasedRod(form, rate), air);
        play(sky.w, 2, hz);
        noses.push_back(sky.w.state(id).q * Vec3::UnitX());
      }
      EXPECT_EQ(noses[0], noses[1]);
      EXPECT_EQ(noses[0], noses[2]);
      // The flow itself, in steps of 0.1 ms.
      Quat q = pitched(60);
      const Thrown t = biasedRod(form, rate);
      for (int i = 0; i < 20000; ++i)
        q = biased(t.flight.bias, q, t.v - Vec3(0, 0, kG) * (i + 0.5) * 1e-4, 1e-4);
      if (!air) {
        EXPECT_LT(between(noses[0], q * Vec3::UnitX()), 0.01 * kDegree);
      }
    }
}

TEST(WorldAir, ThePapersBiasTurnsAShareOfTheAngleInEveryFrame) {
  for (const double hz : {30., 120.}) {
    World w;
    Thrown t = biasedRod(BiasForm::Paper, 0.05);
    BodyDef d;
    d.shape = w.addShape(BoxShape{{}, Vec3::Constant(1e-3)});
    d.mass.mass = 1, d.mass.inertia = t.inertia;
    d.pose.q = pitched(60), d.v = {10, 0, 0};
    d.flight = std::make_shared<BodyFlight>(t.flight);
    const BodyId id = w.addBody(d);
    play(w, 1, hz);
    EXPECT_NEAR(between(w.state(id).q * Vec3::UnitX(), Vec3::UnitX()), 60 * kDegree * std::pow(0.95, hz),
                1e-6);
  }
}

TEST(WorldAir, ABallIsTurnedByNoBias) {
  const FlightShape round = measureShape(ballMesh(0.11, 24, 48), Vec3::Zero());
  const Bias none = biasFor(round, BiasForm::Flow, 5);
  EXPECT_EQ(none.rate, 0);
  Thrown t = biasedRod(BiasForm::Flow, 0);
  t.flight.bias = none, t.inertia.setConstant(0.01);
  Sky sky;
  const BodyId id = sky.add(t);
  play(sky.w, 2);
  EXPECT_EQ(sky.w.state(id).q.coeffs(), t.pose.q.coeffs());
}

TEST(WorldAir, ABiasedBodyThatBouncesGoesOnTurningToWhereItFlies) {
  Sky sky;
  addFloor(sky.w, 0, 0.8);
  Thrown t = biasedRod(BiasForm::Flow, 20);
  t.pose = {{0, 0, 3}, Quat::Identity()}, t.v = {5, 0, 0};
  const BodyId id = sky.add(t, false, sky.w.addShape(BallShape{Vec3::Zero(), 0.1}));
  play(sky.w, 1.2);
  const BodyState s = sky.w.state(id);
  EXPECT_GT(s.v.z(), 0);
  EXPECT_LT(between(s.q * Vec3::UnitX(), s.v), 40 * kDegree);
}

TEST(WorldAir, AModelOfManyFacetsBecomesABodyOfRevolutionAndABoxStaysOne) {
  BodyFlight rod;
  rod.model = javelinFlight();
  MassProperties m;
  m.inertia = {1e-4, 0.420001, 0.42}, m.axes = det::expRotation({1e-4, 0, 0});
  const MassProperties round = revolved(m, rod);
  EXPECT_EQ(round.inertia.y(), round.inertia.z());
  EXPECT_EQ(round.axes.coeffs(), rod.q_NA.coeffs());
  m.inertia = {0.1, 0.3, 0.4};
  EXPECT_EQ(revolved(m, rod).inertia, m.inertia);
}

}  // namespace
}  // namespace stadion
