/// A ball's flight in closed form against looking at every tenth of a millisecond.

#include "dynamics/collision/ball_flight.h"

#include "tests/dynamics/world/scenes.h"

#include <cstring>
#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

using namespace scenes;

struct Draws {
  std::mt19937 bits{7};
  double in(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(bits()) / 4294967296.0); }
  Vec3 vec(double most) { return {in(-most, most), in(-most, most), in(-most, most)}; }
  Pose pose() { return {vec(2), Quat(in(-1, 1), in(-1, 1), in(-1, 1), in(0.1, 1)).normalized()}; }
};

/// A sheet of 10 m of hills and hollows.
Mesh hills(Draws& chance, double height) {
  Mesh m = gridMesh(-5, 5, -5, 5, 12, 12);
  for (auto& p : m.positions) p[2] = static_cast<float>(chance.in(-height, height));
  return m;
}

/// A ball in flight and something that stands still.
struct Pair {
  Shape round, other;
  RigidBody ball;
  Collider thing;

  Pair(Shape shape, const Pose& X, double radius, const BallFlight& f)
      : round(BallShape{Vec3::Zero(), radius}), other(std::move(shape)) {
    ball.id = 1, ball.shape = &round, ball.bound = {Vec3::Zero(), radius}, ball.reach = radius;
    ball.centred = true;
    ball.path = Path::parabola(f.p, f.v, f.a);
    thing.id = 1, thing.shape = &other;
    thing.move(X, X, 0, 0);
  }
  Side a() const { return Side::of(ball); }
  Side b() const { return Side::of(thing); }
};

TEST(BallFlight, MeetsMeshesAndBoxesWhenSmallStepsDo) {
  Draws chance;
  int touches = 0;
  for (int i = 0; i < 240; ++i) {
    Shape shape = i % 2 ? Shape(MeshShape(TriangleTree(hills(chance, 0.4))))
                        : Shape(BoxShape{chance.pose(), {2, 0.5, 1}});
    const Pose X = chance.pose();
    const double radius = chance.in(0.05, 0.3), length = 0.9, step = 1e-4;
    const BallFlight f{X * Vec3(chance.in(-3, 3), chance.in(-3, 3), 4), X.q * (chance.vec(2) - Vec3(0, 0, 4)),
                       Vec3(0, 0, -kG), radius};
    const Pair pair(std::move(shape), X, radius, f);
    double first = -1;
    for (double t = 0; t <= length && first < 0; t += step)
      if (gapBetween(pair.a(), pair.b(), t, {0.01}).distance < 0) first = t;
    if (first == 0) continue;
    std::uint64_t count = 0;
    const auto touch = firstTouch(pair.a(), pair.b(), 0, length, count);
    if (first > 0) {
      ASSERT_TRUE(touch) << i;
      EXPECT_LE(touch->tau, first) << i;
      EXPECT_NEAR(gapBetween(pair.a(), pair.b(), touch->tau).distance, 0, 1e-10) << i;
      EXPECT_NEAR(touch->gap.distance, 0, 1e-10) << i;
      ++touches;
    } else if (touch) {  // a graze between two looks
      EXPECT_NEAR(gapBetween(pair.a(), pair.b(), touch->tau).distance, 0, 1e-6) << i;
    }
  }
  EXPECT_GE(touches, 40);
}

TEST(BallFlight, StaysNearAsLongAsItSaysAndIsFarOffThenIfItIsSure) {
  Draws chance;
  int sure = 0;
  for (int i = 0; i < 200; ++i) {
    const double height = i % 3 ? 0 : 0.3, far = 0.5, radius = 0.1;
    const Shape shape =
        i % 2 ? Shape(MeshShape(TriangleTree(hills(chance, height)))) : Shape(BoxShape{{}, {3, 3, 1}});
    const auto* mesh = std::get_if<MeshShape>(&shape);
    BallFlight f{{chance.in(-2, 2), chance.in(-2, 2), 0}, chance.vec(3), {0, 0, -kG}, radius};
    f.v.z() = chance.in(1, 6);
    f.p.z() = 1 + radius;
    BallFlight::Stay stay;
    if (mesh) {
      ClosestPoint at;
      const std::int32_t below = mesh->tree.nearest(f.p, 9, at);
      f.p = at.point + radius * mesh->tree.triangles()[static_cast<std::size_t>(below)].normal;
      stay = f.stayNear(mesh->tree, below, far);
    } else {
      stay = f.stayNear(std::get<BoxShape>(shape), far);
    }
    for (int k = 0; k <= 20; ++k) {
      const double t = std::min(stay.seconds, 2.0) * k / 20;
      EXPECT_LE(ballGap(f.at(t), radius, shape, {}).distance, far + 1e-9) << i;
    }
    if (!stay.sure || stay.seconds > 2) continue;
    ++sure;
    if (height == 0 || !mesh) {
      EXPECT_NEAR(ballGap(f.at(stay.seconds), radius, shape, {}).distance, far, 1e-9) << i;
    }
  }
  EXPECT_GE(sure, 60);
}

/// While no body is near another, the world looks ahead for up to a second at once.
TEST(BallFlight, LongLooksChangeNothingAtAnyFrameRate) {
  std::vector<double> first;
  for (const double rate : {30., 60., 96., 240.}) {
    World w;
    const FieldId g = addGravity(w), lift = addGravity(w, {0, 1, 20});
    w.switchField(lift, false, 0);
    w.addCollider({w.addShape(MeshShape(TriangleTree(gridMesh(-20, 40, -20, 40, 60, 60)))), {}, {}});
    const BodyId a = addBall(w, g, {.p = {0, 0, 3}, .v = {2, 0, 0}, .restitution = 0.9});
    const BodyId b = addBall(w, g, {.p = {16, 0.05, 1}, .v = {-2, 0, 0}, .restitution = 0.8});
    w.hook(a, lift, 0);
    w.switchField(lift, true, 2'345'678'901);
    w.switchField(lift, false, 2'845'678'901);
    play(w, 9, rate);
    std::vector<double> state;
    for (const BodyId id : {a, b})
      for (const Vec3& x : {w.state(id).p, w.state(id).v}) state.insert(state.end(), x.data(), x.data() + 3);
    if (first.empty()) first = state;
    EXPECT_EQ(std::memcmp(state.data(), first.data(), state.size() * sizeof(double)), 0) << rate;
  }
}

}  // namespace
}  // namespace stadion
