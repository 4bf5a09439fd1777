#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// Height of the bottom of a ball dropped from h0 with restitution e; k bounces so far.
double bounceHeight(double h0, double e, double t, int& k) {
  double tc = std::sqrt(2 * h0 / kG), v = kG * tc;
  k = 0;
  if (t < tc) return h0 - 0.5 * kG * t * t;
  t -= tc;
  for (k = 1; k < 10000; ++k) {
    v *= e;
    const double T = 2 * v / kG;
    if (T < 1e-9) return 0;
    if (t < T) return v * t - 0.5 * kG * t * t;
    t -= T;
  }
  return 0;
}

double bounceTime(double h0, double e, int k) {
  double s = std::sqrt(2 * h0 / kG), v = kG * s;
  for (int i = 1; i < k; ++i) v *= e, s += 2 * v / kG;
  return s;
}

TEST(BallContact, BouncesMatchTheClosedFormForEveryRestitution) {
  for (const double e : {1.0, 0.8, 0.5}) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w);
    const BodyId b = addBall(w, g, {.p = {0, 0, 1.1}, .restitution = e});
    double sum = 0, timeError = 0;
    int count = 0, bounce = 0;
    play(w, e == 1 ? 20 : 6, 60, [&](double t) {
      int k;
      const double h = bounceHeight(1, e, t, k), v = std::sqrt(2 * kG) * std::pow(e, k);
      for (const ContactEvent& event : w.events()) {
        if (event.kind != ContactEvent::Kind::Impact) continue;
        ++bounce;
        timeError = std::max(timeError, std::fabs(toSeconds(event.time) - bounceTime(1, e, bounce)));
      }
      if (2 * v / kG < 3.0 / 60) return;
      const double error = w.state(b).p.z() - 0.1 - h;
      sum += error * error, ++count;
    });
    const double rms = std::sqrt(sum / count);
    std::printf("  e %.1f: rms %.2e m, bounce times %.2e s (events are whole ns), %d bounces\n", e, rms,
                timeError, bounce);
    EXPECT_LE(rms, 1e-9);
    EXPECT_LE(timeError, 2e-9);
    if (e < 1) {
      EXPECT_EQ(w.mode(b), BodyMode::Rest);
      EXPECT_NEAR(w.state(b).p.z(), 0.1, 1e-9);
    }
  }
}

TEST(BallContact, BouncingOverAFineMeshIsBouncingOnThePlane) {
  World w;
  const FieldId g = addGravity(w);
  const ColliderId mesh = w.addCollider(
      {w.addShape(MeshShape(TriangleTree(gridMesh(-5, 45, -5, 35, 80, 64)))), {}, {0.0, 0.8, 0.0}});
  ASSERT_NE(mesh, 0u);
  const BodyId b = addBall(w, g, {.p = {0, 0, 1.1}, .v = {5, 1.3, 0}, .restitution = 0.8});
  double rms = 0, lateral = 0;
  int n = 0;
  play(w, 3, 60, [&](double t) {
    int k;
    const double h = bounceHeight(1, 0.8, t, k);
    if (2 * std::sqrt(2 * kG) * std::pow(0.8, k) / kG < 3.0 / 60) return;
    const Vec3 p = w.state(b).p;
    rms += (p.z() - 0.1 - h) * (p.z() - 0.1 - h), ++n;
    lateral = std::max(lateral, std::hypot(p.x() - 5 * t, p.y() - 1.3 * t));
  });
  std::printf("  mesh: rms %.2e m, lateral %.2e m\n", std::sqrt(rms / n), lateral);
  EXPECT_LE(std::sqrt(rms / n), 1e-6);
  EXPECT_LE(lateral, 1e-9);
}

TEST(BallContact, ASlidingBallGripsAndRollsAtFiveSevenths) {
  for (const bool mesh : {false, true}) {
    World w;
    const FieldId g = addGravity(w);
    if (mesh) {
      w.addCollider(
          {w.addShape(MeshShape(TriangleTree(gridMesh(-5, 45, -5, 35, 80, 64)))), {}, {0.3, 0.0, 0.0}});
    } else {
      addFloor(w, 0.3);
    }
    const double v0 = 5, mu = 0.3, t1 = 2 * v0 / (7 * mu * kG);
    const BodyId b =
        addBall(w, g, {.radius = 0.11, .mass = 0.43, .p = {0, 0, 0.11}, .v = {v0, 0, 0}, .friction = 0.3});
    double worst = 0, hop = 0;
    play(w, 2, 60, [&](double t) {
      const double x = t < t1 ? v0 * t - 0.5 * mu * kG * t * t
                              : v0 * t1 - 0.5 * mu * kG * t1 * t1 + 5.0 / 7 * v0 * (t - t1);
      worst = std::max(worst, std::hypot(w.state(b).p.x() - x, w.state(b).p.y()));
      hop = std::max(hop, std::fabs(w.state(b).p.z() - 0.11));
      EXPECT_TRUE(w.events().empty());
    });
    std::printf("  slip to roll (%s): position %.2e m, hop %.2e m, t1 %.4f\n", mesh ? "mesh" : "plane", worst,
                hop, t1);
    EXPECT_LE(worst, 1e-9);
    EXPECT_LE(hop, 1e-9);
    EXPECT_NEAR(w.state(b).v.x(), 5.0 / 7 * v0, 1e-9);
    EXPECT_EQ(w.mode(b), BodyMode::Roll);
  }
}

TEST(BallContact, RollingResistanceStopsTheBallWhereItShould) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5);
  const double c = 0.02, v0 = 1;
  const BodyId b = addBall(
      w, g, {.p = {0, 0, 0.1}, .v = {v0, 0, 0}, .omega = {0, v0 / 0.1, 0}, .friction = 0.5, .rolling = c});
  play(w, 10);
  EXPECT_EQ(w.mode(b), BodyMode::Rest);
  EXPECT_NEAR(w.state(b).p.x(), v0 * v0 / (2 * c * kG / 1.4), 1e-9);
}

TEST(BallContact, ATouchingBallLiesStillAndFiresNothing) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5, 0.5);
  const BodyId b =
      addBall(w, g, {.radius = 0.11, .p = {0, 0, 0.11 - 3e-9}, .restitution = 0.5, .friction = 0.5});
  const Vec3 p = w.state(b).p;
  play(w, 2, 60, [&](double) {
    EXPECT_TRUE(w.events().empty());
    EXPECT_EQ(w.state(b).p, p);
  });
  EXPECT_EQ(w.mode(b), BodyMode::Rest);
}

TEST(BallContact, ABallRollsOffTheEdgeOfASheet) {
  World w;
  const FieldId g = addGravity(w);
  w.addCollider({w.addShape(PlaneShape{{}, {1, 1}}), {}, {0.5, 0.0, 0.0}});
  const BodyId b = addBall(w, g, {.p = {0, 0, 0.1}, .v = {4, 0, 0}, .omega = {0, 40, 0}, .friction = 0.5});
  play(w, 0.24);
  EXPECT_NEAR(w.state(b).p.z(), 0.1, 1e-12);
  for (int i = 15; i < 45; ++i)
    w.advance(signatureAt(static_cast<std::uint64_t>(i), 60).time -
                  signatureAt(static_cast<std::uint64_t>(i), 60).step,
              signatureAt(static_cast<std::uint64_t>(i), 60).time);
  const double fall = toSeconds(signatureAt(44, 60).time) - 0.25;
  EXPECT_NEAR(w.state(b).p.x(), 4 * (fall + 0.25), 1e-9);
  EXPECT_NEAR(w.state(b).p.z(), 0.1 - 0.5 * kG * fall * fall, 1e-9);
}

TEST(BallContact, NoSpeedTunnelsThroughAThinWall) {
  for (const bool sheet : {false, true}) {
    for (const double v : {5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
      for (int phase = 0; phase < 8; ++phase) {
        World w;
        const double half = sheet ? 0 : 0.0005;
        if (sheet) {
          const Mesh m =
              meshOf({{0, -10, -10}, {0, 10, -10}, {0, 10, 30}, {0, -10, 30}}, {{0, 2, 1}, {0, 3, 2}});
          w.addCollider({w.addShape(MeshShape(TriangleTree(m))), {}, {0.0, 0.5, 0.0}});
        } else {
          w.addCollider({w.addShape(BoxShape{{}, {half, 10, 20}}), {}, {0.0, 0.5, 0.0}});
        }
        const double x0 = -1 - v / 60 * phase / 8;
        const BodyId b = addBall(
            w, 0, {.radius = 0.02, .mass = 0.05, .p = {x0, 0.3, 1}, .v = {v, 0, 0}, .restitution = 0.5});
        const double seconds = std::ceil((1 + v / 60) / v * 60 + 6) / 60;
        play(w, seconds);
        const double hit = (-0.02 - half - x0) / v,
                     n = toSeconds(signatureAt(static_cast<std::uint64_t>(seconds * 60 + 0.5), 60).time);
        EXPECT_NEAR(w.state(b).p.x(), -0.02 - half - 0.5 * v * (n - hit), 1e-10 * (1 + v / 100))
            << v << " " << sheet << " " << phase;
        EXPECT_NEAR(w.state(b).v.x(), -0.5 * v, 1e-9 * v);
      }
    }
  }
}

TEST(BallContact, BallsPassMomentumDownTheRow) {
  for (const double gap : {0.0, 1e-3}) {
    World w;
    std::vector<BodyId> row;
    for (int i = 0; i < 5; ++i)
      row.push_back(addBall(w, 0,
                            {.radius = 0.05,
                             .p = {i == 0 ? -0.3 : (0.1 + gap) * i, 0, 0},
                             .v = {i == 0 ? 1.0 : 0.0, 0, 0},
                             .restitution = 1}));
    play(w, 1.5);
    for (int i = 0; i < 5; ++i)
      EXPECT_NEAR(w.state(row[static_cast<std::size_t>(i)]).v.x(), i == 4 ? 1 : 0, 1e-12) << gap;
  }
}

TEST(BallContact, BallsInAClosedBoxKeepTheirEnergy) {
  World w;
  for (int k = 0; k < 6; ++k) {
    Vec3 half = Vec3::Constant(0.75), p = Vec3::Constant(0.12);
    half[k / 2] = 0.15, p[k / 2] += (k & 1 ? 1 : -1) * 0.65;
    w.addCollider({w.addShape(BoxShape{{p, Quat::Identity()}, half}), {}, {0.0, 1.0, 0.0}});
  }
  std::vector<BodyId> balls;
  unsigned seed = 1;
  const auto random = [&] {
    seed = seed * 1664525u + 1013904223u;
    return static_cast<double>(seed >> 8) / (1 << 23) - 1;
  };
  for (int i = 0; i < 27; ++i) {
    const Vec3 v(3 * random(), 3 * random(), 3 * random());
    balls.push_back(addBall(w, 0,
                            {.radius = 0.05,
                             .p = {0.12 * (i % 3), 0.12 * (i / 3 % 3), 0.12 * (i / 9)},
                             .v = v,
                             .restitution = 1}));
  }
  const auto energy = [&] {
    double e = 0;
    for (const BodyId b : balls) e += w.kineticEnergy(b);
    return e;
  };
  const double e0 = energy();
  play(w, 5);
  std::printf("  27 balls: energy %.2e\n", std::fabs(energy() / e0 - 1));
  EXPECT_NEAR(energy() / e0, 1, 1e-10);
  for (const BodyId b : balls) EXPECT_LE((w.state(b).p - Vec3::Constant(0.12)).cwiseAbs().maxCoeff(), 0.5);
}

TEST(BallContact, TheSameMotionAtEveryFrameRate) {
  Vec3 first = Vec3::Zero();
  for (const double rate : {30.0, 60.0, 120.0, 240.0}) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.4);
    const BodyId b = addBall(w, g,
                             {.p = {0, 0, 2},
                              .v = {3, 1, 0},
                              .omega = {5, 0, 9},
                              .restitution = 0.7,
                              .friction = 0.4,
                              .rolling = 0.02});
    play(w, 5, rate);
    if (rate == 30) first = w.state(b).p;
    EXPECT_LE((w.state(b).p - first).norm(), 1e-9) << rate;
  }
}

}  // namespace
}  // namespace stadion
