/// Pairs part at their exact time: the same at every frame rate, and as the closed form of a free flight
/// says.

#include "tests/dynamics/world/watch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

namespace stadion {
namespace {

using namespace scenes;

constexpr std::array kRates{24., 25., 30., 48., 60., 72., 77., 90., 100., 120., 144., 240., 360.};
constexpr double kReleaseDistance = 0.5;  ///< the usual release distance [m]

enum class ReleaseGround { Plane, BoundedPlane, Box, Mesh };
constexpr std::array kReleaseGrounds{ReleaseGround::Plane, ReleaseGround::BoundedPlane, ReleaseGround::Box, ReleaseGround::Mesh};

ShapeId groundShape(World& w, ReleaseGround kind) {
  switch (kind) {
  case ReleaseGround::Plane: return w.addShape(PlaneShape{});
  case ReleaseGround::BoundedPlane: {
    PlaneShape plane;
    plane.half = {50, 50};
    return w.addShape(plane);
  }
  case ReleaseGround::Box: return w.addShape(BoxShape{{{0, 0, -1}, Quat::Identity()}, {50, 50, 1}});
  case ReleaseGround::Mesh: return w.addShape(MeshShape(TriangleTree(gridMesh(-50, 50, -50, 50, 4, 4))));
  }
  return {};
}

std::vector<Nanoseconds> releasesOf(World& w, BodyId body, double seconds, double rate) {
  std::vector<Nanoseconds> times;
  play(w, seconds, rate, [&](double) {
    for (const ContactEvent& e : w.events())
      if (e.kind == ContactEvent::Kind::Release && e.body == body) times.push_back(e.time);
  });
  return times;
}

/// When a body whose underside begins at height `h` has bounced to kReleaseDistance for the first and the
/// second time. Expects that it does not turn. [ns]
std::vector<double> closedForm(double h, double restitution) {
  const double fall = std::sqrt(2 * h / kG);
  double speed = kG * fall * restitution, start = fall;
  std::vector<double> times;
  while (speed * speed > 2 * kG * kReleaseDistance) {
    times.push_back(1e9 * (start + (speed - std::sqrt(speed * speed - 2 * kG * kReleaseDistance)) / kG));
    start += 2 * speed / kG, speed *= restitution;
  }
  return times;
}

void expectSame(const std::vector<Nanoseconds>& found, const std::vector<double>& expected, double within,
                const std::string& where) {
  ASSERT_EQ(found.size(), expected.size()) << where;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(static_cast<double>(found[i]), expected[i], within) << where << ", release " << i;
}

TEST(Release, IsAtItsExactTimeOverEveryGroundAtEveryFrameRate) {
  for (const ReleaseGround ground : kReleaseGrounds)
    for (const double rate : kRates)
      for (const double h : {2.3, 2.89, 3.7}) {
        World w;
        const FieldId g = addGravity(w);
        w.addCollider({groundShape(w, ground), {}, {0.0, 0.7, 0.0}});
        const BodyId b = addBall(w, g, {.p = {0.3, 0.1, 0.1 + h}, .restitution = 0.7});
        expectSame(releasesOf(w, b, 4, rate), closedForm(h, 0.7), 3,
                   fmt::format("ground {}, {} Hz, from {} m", static_cast<int>(ground), rate, h));
      }
}

/// A point below the middle is what touches, so that no solid turns.
TEST(Release, OfEverySolidIsTheSameAtEveryFrameRate) {
  for (const bool turning : {false, true})
    for (const Solid kind : kSolids)
      for (const ReleaseGround ground : {ReleaseGround::BoundedPlane, ReleaseGround::Box, ReleaseGround::Mesh}) {
        std::vector<Nanoseconds> first;
        for (const double rate : kRates) {
          World w;
          const FieldId g = addGravity(w);
          w.addCollider({groundShape(w, ground), {}, {0.3, 0.9, 0.0}});
          BodyDef d = solidBody(w, kind, 0.2, 3);
          d.pose.p = {0.3, 0.1, 3}, d.surface = {0.3, 0.9, 0.0};
          if (turning) d.v = {0.4, 0.2, 0}, d.omega = {1.3, 0.7, 0.2};
          const BodyId b = addSolid(w, g, d);
          const auto found = releasesOf(w, b, 1.6, rate);
          const std::string where = fmt::format("{} on {}, {} Hz, turning {}", nameOf(kind),
                                                static_cast<int>(ground), rate, turning);
          if (rate == kRates[0]) first = found;
          EXPECT_FALSE(found.empty()) << where;
          ASSERT_EQ(found.size(), first.size()) << where;
          for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(static_cast<double>(found[i]), static_cast<double>(first[i]), 5) << where;
        }
      }
}

/// A box that lies and sleeps, waiting for its release, is struck from below and flies off within a frame.
/// `far`: the release distance of the ball that strikes it.
std::vector<Nanoseconds> releasesOfAStruckSleeper(double rate, double far) {
  World w;
  const FieldId g = addGravity(w);
  const ColliderId floor = w.addCollider({groundShape(w, ReleaseGround::BoundedPlane), {}, {0.0, 0.0, 0.0}});
  const BodyId box = addBox(w, g, {.half = {0.2, 0.2, 0.1}, .pose = {{0, 0, 1}, Quat::Identity()}});
  BodyDef ball;
  ball.shape = w.addShape(BallShape{Vec3::Zero(), 0.05});
  ball.mass = massOfSphere(Vec3::Zero(), 0.05, 1).withMass(5);
  ball.pose.p = {0, 0, -30.0123}, ball.v = {0, 0, 10}, ball.releaseDistance = far;
  const BodyId shot = w.addBody(ball);
  w.ignorePair({true, shot}, {false, floor}, true);
  return releasesOf(w, box, 4, rate);
}

TEST(Release, OfASleeperThatIsStruckIsAtItsExactTime) {
  for (const double far : {0.5, std::numeric_limits<double>::infinity()}) {
    const auto first = releasesOfAStruckSleeper(kRates[0], far);
    EXPECT_EQ(first.size(), 1u);
    for (const double rate : kRates) {
      const auto found = releasesOfAStruckSleeper(rate, far);
      ASSERT_EQ(found.size(), first.size()) << rate;
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(static_cast<double>(found[i]), static_cast<double>(first[i]), 5) << rate;
    }
  }
}

}  // namespace
}  // namespace stadion
