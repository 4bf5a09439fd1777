/// How bodies start, and what they take along when a hand lets go.

#include "dynamics/body/body_axes.h"
#include "dynamics/collision/shape_choice.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/nodes/show_nodes.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

#include <utility>

namespace stadion {
namespace {

using show_nodes::Field;
using show_nodes::Sim;

/// A rod of 2 m along its own x.
class ThrownRod : public DynObjectNode {
public:
  ThrownRod(NodeRef self, std::string name, BodyAttributes body, PlaceAttributes place)
      : DynObjectNode(self, std::move(name), std::move(place), {kNoMesh, true, "cylinder"}, std::move(body),
                      fit()) {}

private:
  static SharedFit fit() {
    ShapeChoice rod;
    rod.shape = CylinderShape{{Vec3::Zero(), det::expRotation({0, M_PI / 2, 0})}, 0.02, 1};
    rod.kind = ShapeKind::Cylinder;
    MassProperties m;
    m.mass = 0.001, m.inertia = {2e-7, 3.3e-4, 3.3e-4};
    return std::make_shared<const FittedShape>(FittedShape{Vec3::Ones(), std::move(rod), m, 0});
  }
};

/// A rod that a wand holds, and a field in the same hand.
struct Throwing : ShowFixture {
  ThrownRod* rod = nullptr;

  explicit Throwing(double framesPerSecond, BodyAttributes body, PlaceAttributes place = {}) {
    rate = framesPerSecond;
    body.hooks = {"gravity", "thrust"};
    loader.files["show"] = [=, this](LoadedScene& load) {
      addNode<Field>(load, "gravity", Vec3(0, 0, -9.81), true);
      auto& parent = addNode<MovingNode>(load, "parent", turned(), false);
      PlaceAttributes below = place;
      below.parent = parent.self();
      rod = &addNode<ThrownRod>(load, "rod", body, below);
      auto& hand = addNode<MovingNode>(load, "hand", PlaceAttributes{}, false);
      PlaceAttributes inHand;
      inHand.parent = hand.self();
      addNode<Field>(load, "thrust", Vec3(20, 0, 0), false, 0, inHand);
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"rod"});
    };
    tracker("wand", Vec3::Zero());
    scene.open("show");
  }
  static PlaceAttributes turned() {
    PlaceAttributes place;
    place.X_PN.linear() = det::expRotation({0, 0, M_PI / 2}).toRotationMatrix() * 3;
    return place;
  }
  void until(double seconds) {
    while (toSeconds(signatureAt(next, rate).time) <= seconds + 1e-9) frame();
  }
  void say(const std::string& node, CommandId command, std::vector<std::string> arguments = {}) {
    scene.command(node, command, std::move(arguments), input.time);
  }
  /// Held from 0.2 s on, pushed from 0.4 s to 0.7 s, let go at 0.8 s while the hand stands still, turned by
  /// `turn`.
  BodyState thrown(const Vec3& turn = Vec3::Zero()) {
    until(0.2);
    say("hand", CommandId::Attach, {"all", "wand"}), say("rod", CommandId::Grab, {"wand"});
    until(0.4);
    say("thrust", CommandId::Enable);
    until(0.7);
    say("thrust", CommandId::Disable);
    until(0.71);
    input.trackers.front().X_RT.q = det::expRotation(turn);
    until(0.8);
    say("rod", CommandId::Release);
    frame();
    return rod->state();
  }
};

TEST(Throw, ABodyStartsWithItsVelocitiesAlongItsParentsAxesAndSoAfterReset) {
  BodyAttributes body;
  body.velocity = {2, 0, 0}, body.angularVelocity = {0, 0, 5};
  Throwing show(60, body);
  show.frame();
  const auto starts = [&](double step) {
    EXPECT_NEAR(show.rod->state().v.y(), 2, 1e-12) << "3 times the scale is not 3 times the speed";
    EXPECT_NEAR(show.rod->state().v.z(), -9.81 * step, 1e-7);
    EXPECT_NEAR(show.rod->state().omega.z(), 5, 1e-12);
  };
  starts(0);
  show.until(0.5);
  show.say("rod", CommandId::Reset);
  show.frame();
  starts(1 / 60.0);
}

TEST(Throw, WhatAFieldInTheHandPushesAddsUpWhileTheBodyIsHeldAtEveryFrameRate) {
  for (const double rate : {20., 50., 100., 200.}) {
    BodyAttributes body;
    body.throwSource = ThrowSource::Field;
    const BodyState s = Throwing(rate, body).thrown();
    EXPECT_NEAR(s.v.x(), 20 * 0.3, 1e-9) << rate;
    EXPECT_NEAR(s.v.y(), 0, 1e-12);
    EXPECT_NEAR(s.v.z(), -9.81 / rate, 1e-9) << "gravity is not in the hand";
  }
}

TEST(Throw, WhatHasAddedUpTurnsWithTheHand) {
  BodyAttributes body;
  body.throwSource = ThrowSource::Field;
  const BodyState s = Throwing(100, body).thrown({0, 0, M_PI / 2});
  EXPECT_NEAR(s.v.y(), 6, 1e-9);
  EXPECT_NEAR(s.v.x(), 0, 1e-9);
  EXPECT_NEAR(s.omega.norm(), 0, 1e-12);
}

TEST(Throw, AHandAloneOrAFieldAloneOrBoth) {
  // The hand goes at 3 m/s along y.
  for (const auto& [source, v] :
       {std::pair(ThrowSource::Hand, Vec3(0, 3, 0)), std::pair(ThrowSource::Field, Vec3(6, 0, 0)),
        std::pair(ThrowSource::Both, Vec3(6, 3, 0))}) {
    BodyAttributes body;
    body.throwSource = source;
    Throwing show(100, body);
    const auto until = [&](double seconds) {
      while (toSeconds(signatureAt(show.next, show.rate).time) <= seconds + 1e-9) {
        show.tracker("wand", Vec3(0, 3 * toSeconds(signatureAt(show.next, show.rate).time), 0));
        show.frame();
      }
    };
    until(0.2);
    show.say("hand", CommandId::Attach, {"all", "wand"}), show.say("rod", CommandId::Grab, {"wand"});
    until(0.4);
    show.say("thrust", CommandId::Enable);
    until(0.7);
    show.say("thrust", CommandId::Disable), show.say("rod", CommandId::Release);
    show.frame();
    EXPECT_LT((show.rod->state().v - v - Vec3(0, 0, -0.0981)).norm(), 1e-6);
  }
}

TEST(Throw, AFieldThatHangsOnTheHeldBodyIsInTheHandToo) {
  for (const double rate : {50., 200.}) {
    BodyAttributes body;
    body.hooks = {"thrust"};
    ShowFixture show;
    show.rate = rate;
    ThrownRod* rod = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      rod = &addNode<ThrownRod>(load, "rod", body, PlaceAttributes{});
      PlaceAttributes onRod;
      onRod.parent = rod->self();
      addNode<Field>(load, "thrust", Vec3(20, 0, 0), true, 0.5, onRod);
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"rod"});
    };
    show.tracker("wand", Vec3::Zero());
    show.scene.open("show");
    show.frame();
    show.scene.command("rod", CommandId::Grab, {"wand"}, show.input.time);
    while (toSeconds(signatureAt(show.next, rate).time) <= 1 + 1e-9) show.frame();
    show.scene.command("rod", CommandId::Release, {}, show.input.time);
    show.frame();
    // 0.5 s bound the push; in the first frame, the rod was not held yet.
    EXPECT_NEAR(rod->state().v.x(), 20 * 0.5, 20 / rate + 1e-9) << rate;
  }
}

TEST(Throw, SpinComesAboutTheAxisOfSymmetryWhenTheHandLetsGo) {
  BodyAttributes body;
  body.throwSource = ThrowSource::Field;
  body.spin = 30;
  PlaceAttributes place;
  place.X_PN.linear() = det::expRotation({0, 0, M_PI / 2}).toRotationMatrix();  // and the parent's 90
  const BodyState s = Throwing(100, body, place).thrown();
  EXPECT_NEAR(s.omega.x(), -30, 1e-9);
  EXPECT_NEAR(s.omega.norm(), 30, 1e-9);
}

TEST(Throw, TheAxisOfSymmetryIsTheOneWhoseMomentStandsAlone) {
  MassProperties m;
  m.inertia = {1, 5, 5.1};
  EXPECT_EQ(symmetryAxis(m), Vec3::UnitX()) << "a rod";
  m.inertia = {3, 3.01, 6};
  EXPECT_EQ(symmetryAxis(m), Vec3::UnitZ()) << "a disc";
  m.inertia = {2, 2, 2};
  m.axes = det::expRotation({1, 1, 0});
  EXPECT_EQ(symmetryAxis(m), Vec3::UnitZ()) << "a ball has none";
  m.inertia = {1, 5, 5};
  m.axes = det::expRotation({0, 0, M_PI});
  EXPECT_NEAR(symmetryAxis(m).x(), 1, 1e-12) << "the way the model's axis points";
}

TEST(Throw, TheTipIsTheForemostPointAndATwentiethBehindIt) {
  const Mesh box = scenes::boxMesh({0.05, 1, 0.05});
  const TipEmbedding s = tipEmbeddingAlong(-Vec3::UnitY(), 60 * kDegree, 0.08, box);
  EXPECT_NEAR(s.tip, 1, 1e-7);
  EXPECT_NEAR(s.reach, 0.1, 1e-7);
  EXPECT_NEAR(s.cosine, 0.5, 1e-12);
  EXPECT_EQ(s.depth, 0.08);
}

constexpr double kDeep = 0.08;  // [m]

/// A spear of 2 m comes down at 10 m/s, `tilt` degrees from upright, nose down.
struct Spear {
  World w;
  FieldId gravity = scenes::addGravity(w);
  ColliderId ground;
  BodyId id = 0;

  enum class Ground { Plane, Mesh };
  Spear(Ground kind, double tilt, bool noseDown = true, bool asMesh = false, double speed = 10) {
    ground =
        kind == Ground::Plane
            ? scenes::addFloor(w, 0.5, 0.3)
            : w.addCollider({w.addShape(MeshShape(TriangleTree(scenes::gridMesh(-20, 20, -20, 20, 8, 8)))),
                             {},
                             {0.5, 0.3, 0.0}});
    const Mesh mesh = scenes::boxMesh({1, 0.02, 0.02});
    BodyDef d;
    d.shape = asMesh ? w.addShape(MeshShape(TriangleTree(mesh))) : w.addShape(BoxShape{{}, {1, 0.02, 0.02}});
    d.mass = massOfBox({}, {1, 0.02, 0.02}, 1).withMass(0.8);
    d.pose = {{0, 0, 3}, det::expRotation({0, (noseDown ? 90 - tilt : tilt - 90) * kDegree, 0})};
    d.v = {0, 0, -speed};
    d.embedding = tipEmbeddingAlong(Vec3::UnitX(), 60 * kDegree, kDeep, mesh);
    id = w.addBody(d);
    w.hook(id, gravity, 0);
  }
};

TEST(Throw, ASpearSticksWhereItsTipComesFirstAndStraightEnough) {
  for (const auto ground : {Spear::Ground::Plane, Spear::Ground::Mesh})
    for (const bool mesh : {false, true}) {
      Spear in(ground, 50, true, mesh);
      scenes::play(in.w, 0.5);
      EXPECT_EQ(in.w.mode(in.id), BodyMode::Stuck);
      const Pose X = in.w.pose(in.id);
      EXPECT_NEAR((X * Vec3(1, 0, 0)).z(), -kDeep, 0.03) << "its tip is in the ground";
      EXPECT_NEAR((X.q * Vec3::UnitX()).z(), -det::cos(50 * kDegree), 1e-9);
      EXPECT_EQ(in.w.state(in.id).v, Vec3(Vec3::Zero()));
      EXPECT_FALSE(in.w.moving(in.id));

      Spear flat(ground, 70, true, mesh), back(ground, 30, false, mesh);
      for (Spear* s : {&flat, &back}) {
        scenes::play(s->w, 0.5);
        EXPECT_NE(s->w.mode(s->id), BodyMode::Stuck) << "too flat, or butt first";
        EXPECT_GT((s->w.state(s->id).v).norm(), 0.1);
      }
    }
}

TEST(Throw, ATipGoesInTheWayItComesAndTheTouchStaysWhereItWas) {
  const auto landed = [](double depth) {
    Spear s(Spear::Ground::Plane, 40);
    BodyDef d;
    d.shape = s.w.addShape(BoxShape{{}, {1, 0.02, 0.02}});
    d.mass = massOfBox({}, {1, 0.02, 0.02}, 1).withMass(0.8);
    d.pose = {{0, 5, 3}, det::expRotation({0, 50 * kDegree, 0})};
    d.v = {12, 0, -16};
    d.embedding = TipEmbedding{Vec3::UnitX(), 1, 0.1, 0.5, depth};
    s.w.removeBody(s.id);
    const BodyId id = s.w.addBody(d);  // nothing pulls at it: it goes straight
    Vec3 touch = Vec3::Zero();
    scenes::play(s.w, 0.5, 60, [&](double) {
      for (const ContactEvent& e : s.w.events()) touch = e.point;
    });
    EXPECT_EQ(s.w.mode(id), BodyMode::Stuck);
    return std::pair{s.w.pose(id).p, touch};
  };
  const auto [onIt, first] = landed(0);
  const auto [in, second] = landed(0.25);
  EXPECT_EQ(first, second) << "what is measured";
  EXPECT_LT((in - onIt - 0.25 * Vec3(0.6, 0, -0.8)).norm(), 1e-12);
}

TEST(Throw, WhatIsPutDownGentlyDoesNotStick) {
  Spear s(Spear::Ground::Plane, 10, true, false, 0);
  s.w.placeBody(s.id, {{0, 0, 1.0}, det::expRotation({0, 80 * kDegree, 0})}, Vec3::Zero(), Vec3::Zero());
  scenes::play(s.w, 0.5);
  EXPECT_NE(s.w.mode(s.id), BodyMode::Stuck);
}

TEST(Throw, WhatSticksStaysUntilItIsTakenOutOrItsGroundGoes) {
  const auto stuck = [] {
    Spear s(Spear::Ground::Plane, 30);
    scenes::play(s.w, 1);
    EXPECT_EQ(s.w.mode(s.id), BodyMode::Stuck);
    EXPECT_EQ(s.w.events().size(), 0U);
    return s;
  };
  const auto on = [](World& w, double seconds) {
    const Nanoseconds t = fromSeconds(1);
    w.advance(t, t + fromSeconds(seconds));
  };
  {
    Spear s = stuck();
    const Pose before = s.w.pose(s.id);
    s.w.switchField(s.gravity, false, 0);
    s.w.push(s.id, {100, 0, 0}, before.p);
    const BodyId stone =
        scenes::addBall(s.w, 0, {.radius = 0.1, .mass = 10, .p = before.p + Vec3(2, 0, 0), .v = {-10, 0, 0}});
    on(s.w, 0.5);
    EXPECT_EQ(s.w.pose(s.id).p, before.p) << "neither fields nor blows move it";
    EXPECT_GT(s.w.state(stone).v.x(), -5) << "what meets it is turned aside";
  }
  {
    Spear s = stuck();
    ASSERT_TRUE(s.w.removeCollider(s.ground));
    on(s.w, 0.5);
    EXPECT_NEAR(s.w.state(s.id).v.z(), -9.81 * 0.5, 1e-9) << "its ground has gone";
  }
  {
    Spear s = stuck();
    ASSERT_TRUE(s.w.holdBody(s.id));
    ASSERT_TRUE(s.w.moveHeld(s.id, {{0, 0, 5}, Quat::Identity()}));
    on(s.w, 0.5);
    ASSERT_TRUE(s.w.releaseBody(s.id, {1, 0, 0}, Vec3::Zero()));
    EXPECT_EQ(s.w.mode(s.id), BodyMode::Flight) << "a hand takes it out";
  }
  {
    Spear s = stuck();
    s.w.moveCollider(s.ground, {{0, 0, -1}, Quat::Identity()});
    on(s.w, 0.5);
    EXPECT_NE(s.w.mode(s.id), BodyMode::Stuck) << "its ground has moved";
  }
  {
    Spear s = stuck();
    s.w.moveCollider(s.ground, {{0.01, 0, 0}, Quat::Identity()});
    on(s.w, 3);
    EXPECT_NE(s.w.mode(s.id), BodyMode::Stuck);
    EXPECT_LT(s.w.state(s.id).v.norm(), 5) << "a tip in the ground is not shot out of it";
    EXPECT_LT(s.w.pose(s.id).p.cwiseAbs().maxCoeff(), 4);
  }
}

TEST(Throw, ASpearTellsOneImpactAndSticksAlikeAtEveryFrameRate) {
  Pose first;
  for (const double rate : {24., 60., 240.}) {
    Spear s(Spear::Ground::Mesh, 45);
    std::size_t impacts = 0;
    scenes::play(s.w, 2, rate, [&](double) { impacts += s.w.events().size(); });
    EXPECT_EQ(impacts, 1U);
    if (rate == 24.) first = s.w.pose(s.id);
    EXPECT_EQ(s.w.pose(s.id).p, first.p) << rate;
    EXPECT_EQ(s.w.pose(s.id).q.coeffs(), first.q.coeffs()) << rate;
  }
}

TEST(Throw, AStickThatIsNoNumberIsRefused) {
  World w;
  BodyDef d;
  d.shape = w.addShape(BallShape{Vec3::Zero(), 0.1});
  d.embedding = TipEmbedding{};
  EXPECT_NE(w.addBody(d), 0U);
  d.embedding->nose = Vec3::Constant(std::nan(""));
  EXPECT_EQ(w.addBody(d), 0U);
}

}  // namespace
}  // namespace stadion
