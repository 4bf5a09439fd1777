#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

TEST(Flight, ABallisticBallFollowsTheParabolaToRounding) {
  World w;
  const FieldId g = addGravity(w);
  const BodyId b = addBall(w, g, {.radius = 0.11, .mass = 0.43, .p = {0, 0, 1.5}, .v = {20, 3, 15}});
  double worst = 0;
  play(w, 2.5, 60, [&](double t) {
    const Vec3 truth(20 * t, 3 * t, 1.5 + 15 * t - 0.5 * kG * t * t);
    worst = std::max(worst, (w.state(b).p - truth).norm());
  });
  EXPECT_LE(worst, 1e-12);
  RecordProperty("error", std::to_string(worst));
}

TEST(Flight, FarFromTheOriginTheParabolaKeepsItsDigits) {
  World w;
  const FieldId g = addGravity(w);
  const BodyId b = addBall(w, g, {.radius = 0.11, .p = {1e5, 0, 1.5}, .v = {20, 3, 15}});
  play(w, 2.5, 60, [&](double t) {
    EXPECT_LE((w.state(b).p - Vec3(1e5 + 20 * t, 3 * t, 1.5 + 15 * t - 0.5 * kG * t * t)).norm(), 1e-9);
  });
}

TEST(Flight, LinearDampingIsExact) {
  World w;
  const FieldId g = addGravity(w);
  const double c = 0.7;
  const BodyId b = addBall(w, g, {.p = {0, 0, 100}, .v = {5, 0, 9}, .damping = c});
  play(w, 3, 60, [&](double t) {
    const double e = std::exp(-c * t), vInf = -kG / c;
    const Vec3 truth(5 * (1 - e) / c, 0, 100 + vInf * t + (9 - vInf) * (1 - e) / c);
    EXPECT_LE((w.state(b).p - truth).norm(), 1e-11) << t;
  });
}

TEST(Flight, ASpinningDiscTurnsAsTheClosedFormSays) {
  for (const double rate : {40.0, 300.0}) {
    World w;
    BodyDef d;
    d.shape = w.addShape(BoxShape{{}, {0.11, 0.11, 0.023}});
    const double m = 2, r = 0.11, h = 0.046, across = m * (3 * r * r + h * h) / 12, along = 0.5 * m * r * r;
    d.mass.mass = m, d.mass.inertia = {across, across, along};
    d.omega = {rate / 10, 0, rate};
    const BodyId b = w.addBody(d);
    const Vec3 L(across * rate / 10, 0, along * rate);
    double worst = 0, drift = 0;
    play(w, 10, 60, [&](double t) {
      const long double precession = L.norm() / across * static_cast<long double>(t);
      const long double own = rate * (1 - along / across) * static_cast<long double>(t);
      const auto turn = [](const Vec3& k, long double a) {
        return Quat(static_cast<double>(cosl(a / 2)), static_cast<double>(sinl(a / 2)) * k.x(),
                    static_cast<double>(sinl(a / 2)) * k.y(), static_cast<double>(sinl(a / 2)) * k.z());
      };
      const Quat truth = turn(L.normalized(), precession) * turn(Vec3::UnitZ(), own);
      worst = std::max(worst, det::logRotation(truth.conjugate() * w.state(b).q).norm());
      drift = std::max(drift, (w.state(b).L - L).norm() / L.norm());
    });
    EXPECT_LE(worst, 1e-9) << rate;
    EXPECT_LE(drift, 1e-15);
    std::printf("  disc %g rad/s: angle error %.2e rad\n", rate, worst);
  }
}

/// Taylor series of order 24 in long double: an independent solution.
Quat tumbling(const Vec3& I, const Vec3& w0, double t) {
  using Exact = long double;
  constexpr int P = 24;
  const int steps = static_cast<int>(t * 480 + 0.5);
  Exact s[7] = {w0.x(), w0.y(), w0.z(), 1, 0, 0, 0};
  const Exact h = static_cast<Exact>(t) / steps;
  const Exact k[3] = {(static_cast<Exact>(I.y()) - I.z()) / I.x(), (static_cast<Exact>(I.z()) - I.x()) / I.y(),
                     (static_cast<Exact>(I.x()) - I.y()) / I.z()};
  for (int n = 0; n < steps; ++n) {
    Exact a[7][P + 1];
    for (int i = 0; i < 7; ++i) a[i][0] = s[i];
    for (int j = 0; j < P; ++j) {
      Exact d[7] = {};
      for (int m = 0; m <= j; ++m) {
        const int o = j - m;
        const Exact x = a[0][m], y = a[1][m], z = a[2][m], qw = a[3][o], qx = a[4][o], qy = a[5][o],
                   qz = a[6][o];
        d[0] += k[0] * y * a[2][o], d[1] += k[1] * z * a[0][o], d[2] += k[2] * x * a[1][o];
        d[3] -= x * qx + y * qy + z * qz, d[4] += qw * x + qy * z - qz * y;
        d[5] += qw * y - qx * z + qz * x, d[6] += qw * z + qx * y - qy * x;
      }
      for (int i = 0; i < 7; ++i) a[i][j + 1] = (i < 3 ? d[i] : d[i] / 2) / (j + 1);
    }
    for (int i = 0; i < 7; ++i) {
      Exact r = a[i][P];
      for (int j = P - 1; j >= 0; --j) r = r * h + a[i][j];
      s[i] = r;
    }
  }
  return Quat(static_cast<double>(s[3]), static_cast<double>(s[4]), static_cast<double>(s[5]),
              static_cast<double>(s[6]))
      .normalized();
}

TEST(Flight, ATumblingBoxMatchesAnIndependentSolution) {
  World w;
  const BodyId b = addBox(w, 0, {.half = {0.15, 0.10, 0.025}, .omega = {0.01, 5, 0.01}});
  const Vec3 I(0.0035416666666666667, 0.0077083333333333333, 0.010833333333333333);
  const double E0 = w.kineticEnergy(b);
  double energy = 0;
  play(w, 10, 60, [&](double) { energy = std::max(energy, std::fabs(w.kineticEnergy(b) / E0 - 1)); });
  const double angle = det::logRotation(tumbling(I, {0.01, 5, 0.01}, 10).conjugate() * w.state(b).q).norm();
  std::printf("  tumbling box: angle %.2e rad, energy %.2e after 10 s\n", angle, energy);
  EXPECT_LE(angle, 1e-8);
  EXPECT_LE(energy, 1e-10);
}

TEST(Flight, AFieldSwitchedInsideFramesGivesExactlyItsMomentum) {
  // 5 g for 0.2 s from 0.5037 s on: both ends inside frames of every rate.
  for (const double rate : {30.0, 60.0, 96.0, 240.0}) {
    World w;
    const BodyId b = addBall(w, 0, {});
    ForceField f;
    f.law = LinearField{{5 * kG, 0, 0}, LinearField::Unit::Acceleration};
    f.duration = fromSeconds(0.2);
    const FieldId kick = w.addField(f);
    w.hook(b, kick, 0);
    w.switchField(kick, true, fromSeconds(0.5037));
    play(w, 1, rate);
    EXPECT_NEAR(w.state(b).v.x(), kG, 1e-12) << rate;
    EXPECT_NEAR(w.state(b).p.x(), kG * 0.1 + kG * (1 - 0.7037), 1e-11) << rate;
    EXPECT_FALSE(w.fieldOn(kick));
  }
}

TEST(Flight, AnActivationShorterThanAFrameCountsToo) {
  World w;
  const BodyId b = addBall(w, 0, {});
  ForceField f;
  f.law = LinearField{{0, 0, 100}, LinearField::Unit::Acceleration};
  f.duration = fromSeconds(0.004);
  const FieldId kick = w.addField(f);
  w.hook(b, kick, 0);
  w.switchField(kick, true, fromSeconds(0.005));
  play(w, 0.1, 60);
  EXPECT_NEAR(w.state(b).v.z(), 0.4, 1e-12);
}

TEST(Flight, AForceDividesByTheMassAnAccelerationDoesNot) {
  World w;
  ForceField f;
  f.law = LinearField{{4, 0, 0}, LinearField::Unit::Force};
  const FieldId force = w.addField(f, true);
  const BodyId b = addBall(w, force, {.mass = 8});
  play(w, 1);
  EXPECT_NEAR(w.state(b).v.x(), 0.5, 1e-14);
}

TEST(Flight, AnOrbitInASphericalFieldConservesItsEnergy) {
  World w;
  ForceField f;
  f.law = SphericalField{-4, 10, SphericalField::Falloff::Linear};
  const FieldId centre = w.addField(f, true);
  const BodyId b = addBall(w, centre, {.p = {3, 0, 0}, .v = {0, 2, 0.5}});
  // Potential of strength s (1 - r/R): s (r - r^2 / 2R).
  const auto energy = [&] {
    const BodyState s = w.state(b);
    const double r = s.p.norm();
    return 0.5 * s.v.squaredNorm() + 4 * (r - r * r / 20);
  };
  const double e0 = energy();
  double worst = 0;
  play(w, 20, 60, [&](double) { worst = std::max(worst, std::fabs(energy() / e0 - 1)); });
  std::printf("  orbit: energy %.2e after 20 s\n", worst);
  EXPECT_LE(worst, 1e-9);
}

TEST(Flight, AUndefinedStateIsQuarantinedAndTheNeighbourGoesOn) {
  World w;
  const FieldId g = addGravity(w);
  ForceField f;
  f.law = LinearField{{1e308, 1e308, 0}, LinearField::Unit::Acceleration};
  const FieldId bad = w.addField(f, true);
  const BodyId a = addBall(w, g, {.p = {0, 0, 5}}), b = addBall(w, g, {.p = {5, 0, 5}});
  w.hook(b, bad, fromSeconds(0.1));
  play(w, 0.5);
  EXPECT_EQ(w.mode(b), BodyMode::Quarantined);
  EXPECT_FALSE(w.quarantineReason(b).empty());
  EXPECT_TRUE(w.pose(b).finite());
  EXPECT_NEAR(w.state(a).p.z(), 5 - 0.5 * kG * 0.25, 1e-12);
}

}  // namespace
}  // namespace stadion
