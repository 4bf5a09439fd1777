/// Colliders that a path or a bone swings move on the true curve: impacts at the exact time, with the velocity
/// that the motion has there.

#include "engine/nodes/bone_node.h"
#include "engine/nodes/figure_node.h"
#include "engine/nodes/object_node.h"
#include "engine/nodes/path_node.h"
#include "tests/dynamics/nodes/show_nodes.h"
#include "tests/engine/figure/figures.h"

#include <cmath>
#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace show_nodes;

constexpr double kHalf = 0.1;    ///< of all cubes [m]
constexpr double kReach = 1;     ///< from the axis to the middle of what swings [m]
constexpr double kOmega = 20;    ///< [rad/s]
constexpr double kHeight = 0.8;  ///< of the face that is hit, along +Y [m]
constexpr std::array kRates{25.0, 60.0, 90.0};

/// The outer leading edge of a cube that swings about the z-axis, and when it meets the plane y = kHeight.
struct Swing {
  double radius = std::hypot(kReach + kHalf, kHalf), ahead = std::atan2(kHalf, kReach + kHalf);
  double angle = std::asin(kHeight / radius);  ///< of the edge at that moment
  double time = (angle - ahead) / kOmega;
  double x = radius * std::cos(angle);
  double speed = kOmega * x;  ///< along +Y
};

PlaceAttributes placeAt(const Vec3& p, NodeRef parent = {}) {
  PlaceAttributes place;
  place.X_PN.translation() = p;
  if (parent.valid()) place.parent = parent;
  return place;
}

Quat aboutZ(double angle) {
  return Quat(std::cos(0.5 * angle), 0, 0, std::sin(0.5 * angle));
}

SharedFit cubeFit() {
  const Vec3 half = Vec3::Constant(kHalf);
  ShapeChoice box;
  box.shape = BoxShape{{}, half}, box.kind = ShapeKind::Box;
  return std::make_shared<const FittedShape>(
      FittedShape{Vec3::Ones(), std::move(box), massOfBox({}, half, 1), 0});
}

/// A cube that floats with its lower face at kHeight, above the point that is hit.
class Target : public DynObjectNode {
public:
  Target(NodeRef self, std::string name, MeshId mesh)
      : DynObjectNode(self, std::move(name), placeAt({Swing().x, kHeight + kHalf, 0}), {mesh, true, "box"},
                      smooth(), cubeFit()) {}

private:
  static BodyAttributes smooth() {
    BodyAttributes b;
    b.surface.restitution = 1, b.surface.friction = 0;
    return b;
  }
};

class Hand : public ObjectNode {
public:
  Hand(NodeRef self, std::string name, MeshId mesh, NodeRef axis)
      : ObjectNode(kObjectType, self, std::move(name), placeAt({kReach, 0, 0}, axis), {mesh, true, "box"}) {}
};

enum class Mover { Path, Bone };

struct SwingShow : ShowFixture {
  NodeRef sim;
  DynObjectNode* target = nullptr;
  std::vector<Nanoseconds> impacts;

  SwingShow(double framesPerSecond, Mover mover) {
    rate = framesPerSecond;
    const MeshId mesh = meshes.add(cube(kHalf));
    loader.files["show"] = [=, this](LoadedScene& load) {
      const NodeRef axis = mover == Mover::Path ? addPath(load, mesh) : addBone(load, mesh);
      addNode<Hand>(load, "hand", mesh, axis);
      target = &addNode<Target>(load, "target", mesh);
      sim = addNode<Sim>(load, "sim", std::vector<std::string>{"hand"}, std::vector<std::string>{"target"})
                .self();
    };
    scene.open("show");
  }

  void play(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) {
      frame();
      for (const EventRecord& e : scene.events())
        if (e.node == sim && e.event == Event("onimpact")) impacts.push_back(e.when);
    }
  }

private:
  NodeRef addPath(LoadedScene& load, MeshId mesh) {
    const Block& axis = addNode<Block>(load, "axis", mesh, Vec3::Zero());
    std::vector<Keyframe> keys;
    for (int k = 0; k <= 4; ++k) keys.push_back({k / kOmega, {Vec3::Zero(), aboutZ(k)}});
    addNode<PathNode>(load, "path", PlaceAttributes{}, axis.self(), keys, false, false, true);
    return axis.self();
  }
  /// A bone with keys 24 times a second, as an animator delivers them.
  NodeRef addBone(LoadedScene& load, MeshId mesh) {
    auto skeleton = std::make_shared<Skeleton>(test::chain(1));
    std::vector<float> times, turns;
    for (int k = 0; k <= 8; ++k) {
      const Quat q = aboutZ(kOmega * k / 24);
      times.push_back(static_cast<float>(k / 24.0));
      for (const double x : {q.x(), q.y(), q.z(), q.w()}) turns.push_back(static_cast<float>(x));
    }
    Clip clip{"swing", 8 / 24.0, {}};
    clip.channels.push_back(test::channel(0, ChannelTarget::Rotation, Interpolation::Linear, times, turns));
    skeleton->clips.push_back(clip);
    ClipPlayer::Start start;
    start.length = clip.length, start.loop = false;
    const auto& figure =
        addNode<FigureNode>(load, "figure", PlaceAttributes{}, Appearance{mesh, false, "box"}, skeleton,
                            ClipPlayer::Start(), start);
    return addNode<BoneNode>(load, "bone", placeAt(Vec3::Zero(), figure.self()), 0U).self();
  }
};

/// A cube that a figure with a root bone carries along y at 3.25 m/s, pass after pass, and a target above its way.
struct WalkShow : ShowFixture {
  static constexpr double kSpeed = 3.25;
  NodeRef sim;
  DynObjectNode* target = nullptr;
  std::vector<Nanoseconds> impacts;

  explicit WalkShow(double framesPerSecond) {
    rate = framesPerSecond;
    const MeshId mesh = meshes.add(cube(kHalf));
    loader.files["show"] = [=, this](LoadedScene& load) {
      auto skeleton = std::make_shared<Skeleton>(test::chain(1));
      Clip clip{"walk", 0.125, {}};
      clip.channels.push_back(test::channel(0, ChannelTarget::Translation, Interpolation::Linear, {0, 0.125f},
                                            {0, 0, 0, 0, 0.40625f, 0}));
      skeleton->clips.push_back(clip);
      ClipPlayer::Start start;
      start.length = clip.length;
      FigureExtras extras;
      extras.root = 0;
      const auto& figure =
          addNode<FigureNode>(load, "figure", placeAt({Swing().x - kReach, 0, 0}),
                              Appearance{mesh, false, "box"}, skeleton, ClipPlayer::Start(), start, extras);
      addNode<Hand>(load, "hand", mesh, figure.self());
      target = &addNode<Target>(load, "target", mesh);
      sim = addNode<Sim>(load, "sim", std::vector<std::string>{"hand"}, std::vector<std::string>{"target"})
                .self();
    };
    scene.open("show");
  }
  void play(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) {
      frame();
      for (const EventRecord& e : scene.events())
        if (e.node == sim && e.event == Event("onimpact")) impacts.push_back(e.when);
    }
  }
};

TEST(WalkingFigure, WhatItCarriesHitsAtTheExactTimeWithItsVelocity) {
  const double time = (kHeight - kHalf) / WalkShow::kSpeed;  // in the second pass
  for (const double rate : kRates) {
    WalkShow show(rate);
    show.play(time + 1 / rate);
    ASSERT_EQ(show.impacts.size(), 1U) << rate;
    EXPECT_NEAR(toSeconds(show.impacts[0]), time, 1e-7) << rate;
    EXPECT_NEAR(show.target->state().v.y(), 2 * WalkShow::kSpeed, 1e-5) << rate;
  }
}

TEST(SwingingHand, ItHitsAtTheExactTimeWithItsTrueVelocity) {
  const Swing truth;
  for (const Mover mover : {Mover::Path, Mover::Bone})
    for (const double rate : kRates) {
      SwingShow show(rate, mover);
      show.play(truth.time + 1 / rate);
      ASSERT_EQ(show.impacts.size(), 1U) << rate;
      EXPECT_NEAR(toSeconds(show.impacts[0]), truth.time, 1e-7) << rate;
      const Vec3 v = show.target->state().v;
      EXPECT_NEAR(v.y(), 2 * truth.speed, 1e-5) << rate;
      EXPECT_NEAR(v.x(), 0, 1e-9) << rate;
    }
}

/// A frame that does not last a whole number of 8 ns ends the last curve of its motion between quarters that lie
/// between nanoseconds.
TEST(SwingingHand, AnImpactAtTheEndOfAFrameHasItsTrueVelocity) {
  const Swing truth;
  for (const Mover mover : {Mover::Path, Mover::Bone})
    for (const int frames : {2, 3, 5, 7}) {
      SwingShow show(frames / truth.time, mover);
      show.play(truth.time * (1 + 1.5 / frames));
      ASSERT_EQ(show.impacts.size(), 1U) << frames;
      EXPECT_NEAR(toSeconds(show.impacts[0]), truth.time, 1e-7) << frames;
      EXPECT_NEAR(show.target->state().v.y(), 2 * truth.speed, 1e-5) << frames;
    }
}

TEST(WalkingFigure, AnImpactAtTheEndOfAFrameHasItsVelocity) {
  const double time = (kHeight - kHalf) / WalkShow::kSpeed;
  for (const int frames : {7, 11, 13}) {
    WalkShow show(frames / time);
    show.play(time * (1 + 1.5 / frames));
    ASSERT_EQ(show.impacts.size(), 1U) << frames;
    EXPECT_NEAR(toSeconds(show.impacts[0]), time, 1e-7) << frames;
    EXPECT_NEAR(show.target->state().v.y(), 2 * WalkShow::kSpeed, 1e-5) << frames;
  }
}

}  // namespace
}  // namespace stadion
