/// Balls that roll and bounce over hills and through valleys of a mesh: folds of every size and direction.

#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr double kTileSide = 3;  // half the terrain's width [m]

double heightAt(double x, double y, double steep) {
  return steep * (0.3 * std::sin(1.7 * x + 0.4) * std::cos(1.3 * y) + 0.07 * std::sin(6.1 * x + 2.3 * y) +
                  0.01 * std::sin(23 * y - 17 * x));
}

Mesh terrain(int n, double steep) {
  Mesh m = gridMesh(-kTileSide, kTileSide, -kTileSide, kTileSide, n, n);
  for (auto& p : m.positions) p[2] = static_cast<float>(heightAt(p[0], p[1], steep));
  return m;
}

struct Roller {
  World world;
  FieldId gravity;
  BodyId ball;
  Roller(const Mesh& ground, const BallSpec& spec, double restitution) {
    gravity = addGravity(world);
    world.addCollider({world.addShape(MeshShape(TriangleTree(ground))), {}, {0.5, restitution, 0.01}});
    ball = addBall(world, gravity, spec);
  }
  double energy() const {
    const BodyState s = world.state(ball);
    return 0.5 * s.v.squaredNorm() + kG * s.p.z() + 0.5 * s.L.squaredNorm() / 0.004;  // 1 kg, 0.1 m
  }
};

BallSpec dropped(Chance& chance, double steep) {
  BallSpec s;
  const double x = chance.between(-1.5, 1.5), y = chance.between(-1.5, 1.5);
  s.p = {x, y, heightAt(x, y, steep) + 0.25};
  s.v = {chance.between(-1, 1), chance.between(-1, 1), 0};
  s.friction = 0.5, s.rolling = 0.01;
  return s;
}

/// No frame is cut short, no energy comes of folds, and no ball falls through.
TEST(RollingTerrain, BallsRollOverFoldsOfEveryKind) {
  Chance chance(412);
  for (const double steep : {0.02, 0.2, 1.0})
    for (const int cells : {9, 30})
      for (const double restitution : {0.0, 0.3, 0.8}) {
        const Mesh ground = terrain(cells, steep);
        for (int i = 0; i < 4; ++i) {
          Roller r(ground, dropped(chance, steep), restitution);
          const double start = r.energy();
          std::uint64_t cut = 0;
          bool fellThrough = false;
          play(r.world, 4, 60, [&](double) {
            cut += r.world.counters().limited;
            const Vec3 p = r.world.state(r.ball).p;
            const bool over = std::fabs(p.x()) < kTileSide - 0.2 && std::fabs(p.y()) < kTileSide - 0.2;
            fellThrough = fellThrough || (over && p.z() < heightAt(p.x(), p.y(), steep) - 0.15 * steep);
          });
          EXPECT_FALSE(fellThrough) << steep << " " << cells << " " << restitution << " " << i;
          EXPECT_EQ(cut, 0u) << steep << " " << cells << " " << restitution << " " << i;
          EXPECT_LE(r.energy(), start + 1e-4) << steep << " " << cells << " " << restitution << " " << i;
        }
      }
}

/// A ball that slides or rolls goes on from face to face as it does at other frame rates.
TEST(RollingTerrain, TheFrameRateDoesNotMatter) {
  Chance chance(413);
  const Mesh ground = terrain(20, 0.3);
  for (int i = 0; i < 6; ++i) {
    const BallSpec spec = dropped(chance, 0.3);
    Roller slow(ground, spec, 0.3), fast(ground, spec, 0.3);
    play(slow.world, 2, 30), play(fast.world, 2, 240);
    EXPECT_LE((slow.world.state(slow.ball).p - fast.world.state(fast.ball).p).norm(), 1e-6) << i;
  }
}

}  // namespace
}  // namespace stadion
