/// A world that is put back from what was written down of it goes on to the bit, whatever its bodies are
/// doing: in heaps, on slopes, in the air, in a hand, with commands that are still to come.

#include "dynamics/world/world.h"
#include "engine/core/state_fields.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <functional>
#include <gtest/gtest.h>
#include <memory>

namespace stadion {
namespace {

using namespace scenes;

std::vector<std::uint8_t> saved(World& w) {
  SavedState out;
  w.visitState(out);
  return out.take();
}

/// With the shapes of the other, which must outlive it.
std::unique_ptr<World> copyOf(World& w, const std::vector<std::uint8_t>& state, const ImpactScheme& impacts) {
  auto copy = std::make_unique<World>();
  copy->setImpactScheme(impacts);
  RestoredState in(state);
  copy->visitState(in);
  EXPECT_TRUE(in.complete());
  for (ShapeId id = 1; id < 200; ++id)
    if (const Shape* shape = w.shape(id))
      copy->restoreShape(id, std::shared_ptr<const Shape>(std::shared_ptr<void>(), shape));
  EXPECT_TRUE(copy->complete());
  return copy;
}

/// The first field in which the two differ.
std::string differenceOf(World& a, World& b) {
  const std::vector<std::uint8_t> there = saved(b);
  StateDifference d(there);
  a.visitState(d);
  return d.first() ? d.first()->name + ": " + d.first()->here + " and " + d.first()->there : "";
}

struct StateCase {
  const char* name;
  std::function<void(World&)> build;
  std::function<void(World&, std::uint64_t frame)> act = [](World&, std::uint64_t) {};
  std::uint64_t frames = 200;
  ImpactScheme impacts{};
};

Pose at(double x, double y, double z) {
  return {Vec3(x, y, z), Quat::Identity()};
}

void heap(World& w) {
  const FieldId g = addGravity(w);
  addFloor(w, 0.5, 0.2);
  for (int i = 0; i < 18; ++i) {
    const double x = 0.13 * (i % 3) + 0.01 * i, y = 0.12 * (i / 3 % 3), z = 0.4 + 0.25 * (i / 9) + 0.03 * i;
    BoxSpec box;
    box.half = Vec3(0.06, 0.05, 0.04), box.pose = at(x, y, z), box.friction = 0.6, box.restitution = 0.1;
    BallSpec ball;
    ball.radius = 0.05, ball.p = Vec3(x, y, z), ball.friction = 0.5, ball.restitution = 0.3;
    i % 2 ? addBall(w, g, ball) : addBox(w, g, box);
  }
}

void slope(World& w) {
  const FieldId g = addGravity(w, Vec3(1.5, 0.3, -9.7));
  w.addCollider({w.addShape(MeshShape(TriangleTree(gridMesh(-4, 4, -4, 4, 8, 8)))), {}, {0.4, 0.3, 0.02}});
  for (int i = 0; i < 6; ++i) {
    BallSpec ball;
    ball.p = Vec3(-2 + 0.5 * i, 0.4 * i - 1, 0.1 + 0.2 * i), ball.v = Vec3(0, 1, 0), ball.friction = 0.4;
    ball.restitution = 0.5, ball.rolling = 0.01;
    addBall(w, g, ball);
    BoxSpec box;
    box.half = Vec3(0.1, 0.2, 0.05), box.pose = at(-2 + 0.5 * i, -2, 0.3), box.omega = Vec3(3, 1, i);
    box.friction = 0.3, box.restitution = 0.4;
    addBox(w, g, box);
  }
}

void air(World& w) {
  const FieldId g = addGravity(w);
  addFloor(w, 0.4, 0.6);
  ForceField wind, whirl, push;
  MediumField medium;
  medium.wind = Vec3(3, 1, 0);
  wind.law = medium;
  whirl.law = VortexField{4, 0.5, 0.2, 6, LinearField::Unit::Acceleration};
  whirl.start = whirl.end = at(1, 0, 1);
  push.law = SphericalField{20, 2};
  push.duration = 300'000'000;
  const FieldId blows = w.addField(wind, true), turns = w.addField(whirl, true), pushes = w.addField(push);
  for (int i = 0; i < 8; ++i) {
    BallSpec ball;
    ball.p = Vec3(0.5 * i - 2, 0.1 * i, 1 + 0.3 * i), ball.v = Vec3(2, -1, 5), ball.restitution = 0.7;
    const BodyId id = addBall(w, g, ball);
    if (i % 2) w.hook(id, blows, 0);
    if (i % 3 == 0) w.hook(id, turns, 100'000'000 * (i + 1));
    w.hook(id, pushes, 0);
    BoxSpec box;
    box.half = Vec3(0.1, 0.2, 0.3), box.pose = at(0.7 * i - 2, 2, 2), box.omega = Vec3(0.1, 7, 0.2 * i);
    addBox(w, g, box);
  }
  for (const Nanoseconds when : {500'000'000, 1'200'000'000, 2'100'000'000})
    w.switchField(pushes, true, when);
}

/// A hand that takes a box, swings it through balls, and lets it go.
void swing(World& w, std::uint64_t frame) {
  const double t = static_cast<double>(frame) / 60;
  if (frame == 20) w.holdBody(1);
  if (frame >= 20 && frame < 120) {
    const det::SinCos a = det::sincos(4 * t);
    w.moveHeld(1, {Vec3(0.6 * a.sin, 0.6 * a.cos, 0.15), det::expRotation(Vec3(0, 0, -4 * t))});
  }
  if (frame == 120) w.releaseBody(1, Vec3(1, 0, 2), Vec3(0, 0, -4));
}

TEST(WorldState, GoesOnToTheBit) {
  const ImpactScheme stepped{ImpactScheme::Kind::Paper};
  const std::vector<StateCase> cases{
      {"a heap", heap},
      {"a heap with the paper's impacts", heap, swing, 200, stepped},
      {"a slope with the paper's impacts", slope, [](World&, std::uint64_t) {}, 200, stepped},
      {"a slope", slope},
      {"air", air},
      {"a hand", heap, swing},
      {"a hand on a slope", slope, swing}};
  for (const StateCase& c : cases) {
    World w;
    w.setImpactScheme(c.impacts);
    c.build(w);
    std::vector<std::pair<std::uint64_t, std::unique_ptr<World>>> copies;
    const auto step = [&](World& x, std::uint64_t n) {
      c.act(x, n);
      const TimeSignature s = signatureAt(n, 60);
      x.advance(s.time - s.step, s.time);
    };
    for (std::uint64_t n = 1; n <= c.frames; ++n) {
      step(w, n);
      for (auto& [from, copy] : copies) {
        step(*copy, n);
        ASSERT_EQ(differenceOf(*copy, w), "") << c.name << ", frame " << n << ", put back after " << from;
      }
      if (n % 13 != 4) continue;
      if (copies.size() > 2) copies.erase(copies.begin());
      copies.emplace_back(n, copyOf(w, saved(w), c.impacts));
    }
  }
}

}  // namespace
}  // namespace stadion
