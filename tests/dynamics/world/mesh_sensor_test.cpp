/// What passes through a closed mesh without being stopped: one impact where it comes in and one release
/// behind, as through a box, however thick the mesh and at every frame rate.

#include "tests/dynamics/world/sampled.h"
#include "tests/dynamics/world/seams_scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

enum class Passer { Ball, Box, Capsule, Mesh };

struct Passage {
  double thick = 1, tilt = 0, speed = 1, rate = 60, aside = 0, chord = 0;
  Passer passer = Passer::Ball;
  bool sensorMoves = false;
};

struct Seen {
  std::vector<double> impacts, releases;  // [s]
};

Seen pass(const Passage& p, bool mesh) {
  World w;
  const Vec3 half(2, 0.5 * p.thick, 2);
  Patchwork box;
  box.box(-half, half);
  const ShapeId shape = mesh ? w.addShape(box.shape()) : w.addShape(BoxShape{{}, half});
  const Quat turn(Eigen::AngleAxisd(p.tilt, Vec3::UnitX()));
  const ColliderId sensor = w.addCollider({shape, {{0, 20, 1}, turn}, {}});
  BodyDef d;
  const Vec3 size(0.1, 0.15, 0.2);
  switch (p.passer) {
  case Passer::Ball: d.shape = w.addShape(BallShape{Vec3::Zero(), 0.1}); break;
  case Passer::Box: d.shape = w.addShape(BoxShape{{}, size}); break;
  case Passer::Capsule: d.shape = w.addShape(CapsuleShape{{}, 0.1, 0.1}); break;
  case Passer::Mesh: d.shape = w.addShape(MeshShape(TriangleTree(boxMesh(size)))); break;
  }
  const Vec3 start(p.aside, 17.5, 1);
  d.pose.p = start;
  d.releaseDistance = 0.5;
  const BodyId body = w.addBody(d);
  w.holdBody(body);
  Seen seen;
  for (std::uint64_t i = 1; i <= static_cast<std::uint64_t>(5.5 / p.speed * p.rate) + 2; ++i) {
    const TimeSignature frame = signatureAt(i, p.rate);
    const Nanoseconds part = p.chord > 0 ? fromSeconds(p.chord) : frame.step;
    bool continues = false;
    for (Nanoseconds from = frame.time - frame.step; from < frame.time; continues = true) {
      const Nanoseconds to = std::min(frame.time, (from / part + 1) * part);
      const Vec3 way(0, p.speed * toSeconds(to), 0);
      if (p.sensorMoves)
        EXPECT_TRUE(w.moveCollider(sensor, {Vec3(0, 20, 1) - way, turn}, false));
      else
        w.moveHeld(body, {start + way, Quat::Identity()}, false);
      w.advance(from, to, continues);
      from = to;
    }
    for (const ContactEvent& e : w.events())
      (e.kind == ContactEvent::Kind::Impact ? seen.impacts : seen.releases).push_back(toSeconds(e.time));
  }
  return seen;
}

TEST(MeshSensor, IsPassedAsABoxIs) {
  Chance chance(11);
  constexpr std::array kRates{25.0, 30.0, 60.0, 240.0};
  for (int i = 0; i < 480; ++i) {
    Passage p;
    p.passer = std::array{Passer::Ball, Passer::Box, Passer::Capsule, Passer::Mesh}[i % 4];
    p.rate = kRates[i / 4 % 4];
    p.chord = i / 16 % 2 ? 0.002 : 0;
    p.sensorMoves = i / 32 % 3 == 0;
    p.thick = chance.scale(0.005, 2);
    p.speed = chance.scale(0.5, 60);
    p.aside = chance.between(0, 1.6);
    p.tilt = i / 96 % 2 ? chance.between(-0.6, 0.6) : 0;
    if (!isPlayed(i)) continue;
    SCOPED_TRACE("run " + std::to_string(i));
    const Seen mesh = pass(p, true), box = pass(p, false);
    ASSERT_EQ(box.impacts.size(), 1u);
    ASSERT_EQ(box.releases.size(), 1u);
    ASSERT_EQ(mesh.impacts.size(), 1u);
    ASSERT_EQ(mesh.releases.size(), 1u);
    // Two meshes count as touching a micrometre before.
    const double same = p.passer == Passer::Mesh ? 2e-6 / p.speed + 2e-8 : 2e-8;
    EXPECT_NEAR(mesh.impacts[0], box.impacts[0], same);
    EXPECT_NEAR(mesh.releases[0], box.releases[0], same);
  }
}

TEST(MeshSensor, AThinOneReleasesBehindAtTheExactTime) {
  for (const double rate : {25.0, 60.0, 240.0}) {
    Passage p;
    p.thick = 0.01, p.rate = rate;
    const Seen seen = pass(p, true);
    ASSERT_EQ(seen.releases.size(), 1u);
    EXPECT_NEAR(seen.releases[0], 2.5 + 0.005 + 0.1 + 0.5, 2e-9) << rate;
  }
}

}  // namespace
}  // namespace stadion
