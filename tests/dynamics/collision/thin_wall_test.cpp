#include "dynamics/collision/convex_touch.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

using namespace scenes;
using Real = long double;

/// When the lowest point of a disc (radius r, half height h), flying at v towards a wall at x = -wall and
/// turning at w about an axis square to its own, first meets the wall: its reach along x at the angle a is
/// r |cos a| + h |sin a|. Bisection below the first sample that is beyond.
Real discHits(Real r, Real h, Real wall, Real x0, Real v, Real w) {
  const auto gap = [&](Real t) {
    return -wall - x0 - v * t - r * std::fabs(std::cos(w * t)) - h * std::fabs(std::sin(w * t));
  };
  const Real longest = (-x0) / v, dt = std::min<Real>(longest / 20000, 1e-4L / std::max<Real>(w, 1));
  Real t = 0;
  while (gap(t + dt) > 0) t += dt;
  Real lo = t, hi = t + dt;
  for (int i = 0; i < 100; ++i) {
    const Real m = (lo + hi) / 2;
    (gap(m) > 0 ? lo : hi) = m;
  }
  return lo;
}

Mesh sheetMesh() {
  return meshOf({{0, -10, -10}, {0, 10, -10}, {0, 10, 30}, {0, -10, 30}}, {{0, 2, 1}, {0, 3, 2}});
}

BodyId addDisc(World& w, const Vec3& p, const Vec3& v, const Vec3& omega) {
  const double r = 0.11, h = 0.012, m = 2;
  BodyDef d;
  // About y, as in the published case.
  d.shape =
      w.addShape(CylinderShape{{Vec3::Zero(), Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY())}, r, h});
  d.mass.mass = m;
  d.mass.inertia = {m * (3 * r * r + 4 * h * h) / 12, 0.5 * m * r * r, m * (3 * r * r + 4 * h * h) / 12};
  d.pose.p = p, d.v = v, d.omega = omega;
  d.surface = {0.0, 0.5, 0.0};
  return w.addBody(d);
}

TEST(ThinWall, NoDiscAndNoBallGetsThroughAndTheyMeetTheWallWhenTheyShould) {
  for (const bool mesh : {false, true}) {
    for (const double v : {5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
      double worstTime = 0, worstPlace = 0, worstBall = 0;
      for (const int kind : {0, 1, 2}) {  // ball, flat disc, tumbling disc
        for (int phase = 0; phase < 8; ++phase) {
          World w;
          const double wall = mesh ? 0 : 0.0005, x0 = -1 - v / 60 * phase / 8.0;
          w.addCollider({mesh ? w.addShape(MeshShape(TriangleTree(sheetMesh())))
                              : w.addShape(BoxShape{{{0, 0, 10}, Quat::Identity()}, {wall, 10, 20}}),
                         {},
                         {0.0, 0.5, 0.0}});
          const double spin = kind == 0 ? 0 : 40;
          BodyId b;
          if (kind == 0) {
            b = addBall(
                w, 0, {.radius = 0.02, .mass = 0.05, .p = {x0, 0.3, 2}, .v = {v, 0, 0}, .restitution = 0.5});
          } else {
            b = addDisc(w, {x0, 0.3, 2}, {v, 0, 0}, kind == 1 ? Vec3(0, spin, 0) : Vec3(0, 0, spin));
          }
          const Real r = kind == 0 ? 0.02L : 0.11L;
          const Real hit =
              kind == 2 ? discHits(r, 0.012L, wall, x0, v, spin) : (-r - Real(wall) - Real(x0)) / Real(v);
          double impact = -1;
          const int frames = static_cast<int>(std::ceil((1 + v / 60) / v * 60)) + 6;
          play(w, frames / 60.0, 60, [&](double) {
            for (const ContactEvent& e : w.events())
              if (e.kind == ContactEvent::Kind::Impact && impact < 0) impact = toSeconds(e.time);
          });
          const BodyState s = w.state(b);
          ASSERT_LT(s.p.x(), 0) << "through: v " << v << " kind " << kind << " phase " << phase << " mesh "
                                << mesh;
          ASSERT_GE(impact, 0);
          // Event times are whole nanoseconds.
          worstTime = std::max(worstTime, double(std::fabs(Real(impact) - hit)));
          if (kind == 2) continue;
          const Real T = toSeconds(signatureAt(static_cast<std::uint64_t>(frames), 60).time),
                     x = -r - wall - 0.5L * v * (T - hit);
          (kind == 0 ? worstBall : worstPlace) =
              std::max(kind == 0 ? worstBall : worstPlace, double(std::fabs(Real(s.p.x()) - x)));
        }
      }
      std::printf("  %s %6.0f m/s: time %.1e s, ball %.1e m, flat disc %.1e m\n", mesh ? "sheet" : "wall ", v,
                  worstTime, worstBall, worstPlace);
      EXPECT_LE(worstTime, 1e-9);
      EXPECT_LE(worstBall, 1e-6);
      EXPECT_LE(worstPlace, 1e-6);
    }
  }
}

/// The time at which a tumbling disc meets a wall is exact below the nanosecond: asked directly.
TEST(ThinWall, ATumblingDiscIsWithinATenthOfANanometreOfTheWallWhenItTouches) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  double worst = 0;
  for (int k = 0; k < 400; ++k) {
    const double v = std::pow(10, 1.5 + 1.5 * u(random)), spin = 150 * (1 + u(random)), h = 0.012, r = 0.11;
    const Shape disc = CylinderShape{{}, r, h}, wall = BoxShape{{}, {0.0005, 10, 20}};
    RigidBody b;
    b.id = 1, b.shape = &disc, b.bound = boundingSphere(disc), b.reach = b.bound.radius;
    b.inertia = {1, 1, 1.5};
    const Quat q(det::fromEuler(3 * u(random), 3 * u(random), 3 * u(random)));
    const Vec3 omega = spin * Vec3(u(random), u(random), u(random)).normalized();
    b.path = Path::parabola({-1, 0.3 * u(random), u(random)}, {v, u(random), u(random)}, {0, 0, -9.81});
    b.spin = Spin::free(q, q * b.inertia.cwiseProduct(q.conjugate() * omega), b.inertia);
    Collider c;
    c.id = 1, c.shape = &wall, c.bound = boundingSphere(wall);
    std::uint64_t looks = 0;
    const auto touch = firstTouch(Side::of(b), Side::of(c), 0, std::min(2.0, b.spin.horizon), looks);
    if (!touch) {
      EXPECT_GT(1 / v, std::min(2.0, b.spin.horizon) * 0.8);
      continue;
    }
    // The reach of the disc along x at that time, from its own orientation alone.
    const auto gapAt = [&](double tau) {
      const Vec3 axis = b.orientation(tau) * Vec3::UnitZ();
      const Real ax = axis.x(), ay = axis.y(), az = axis.z(), across = std::sqrt(ay * ay + az * az);
      return -Real(0.0005L) - Real(b.position(tau).x()) - r * across - h * std::fabs(ax);
    };
    worst = std::max(worst, double(std::fabs(gapAt(touch->tau))));
    for (int i = 1; i < 200; ++i) EXPECT_GT(double(gapAt(touch->tau * i / 200)), -1e-10);
    EXPECT_NEAR(touch->gap.normal.x(), -1, 1e-12);
  }
  std::printf("  greatest distance at the touch %.1e m\n", worst);
  EXPECT_LE(worst, 1e-10);
}

}  // namespace
}  // namespace stadion
