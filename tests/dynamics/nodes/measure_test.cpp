#include "engine/nodes/measure_node.h"
#include "engine/nodes/text_node.h"
#include "tests/dynamics/nodes/show_nodes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion {
namespace {

using namespace show_nodes;

constexpr double kShotRadius = 0.1;  // of a Ball

/// A field with two balls, which fall where the test puts them, and a measure for each.
struct Field2 : ShowFixture {
  ThrowMeasureNode *visitor = nullptr, *athlete = nullptr;
  TextNode* board = nullptr;
  ThrowMeasureAttributes ours, theirs;
  PlaceAttributes line;
  Vec3 first{1, 43.017, 2}, second{0, 41.2, 3};
  std::vector<EventRecord> told;

  Field2() {
    ours.body = "ball", ours.label = "Visitor", ours.text = "board";
    theirs.body = "stone", theirs.label = "Athlete";
  }
  void open() {
    const MeshId box = meshes.add(cube(100));
    loader.files["show"] = [this, box](LoadedScene& load) {
      addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true);
      addNode<Block>(load, "floor", box, Vec3(0, 0, -100));
      addNode<Ball>(load, "ball", first, std::vector<std::string>{"gravity"});
      addNode<Ball>(load, "stone", second, std::vector<std::string>{"gravity"});
      visitor = &addNode<ThrowMeasureNode>(load, "tape", line, ours);
      athlete = &addNode<ThrowMeasureNode>(load, "other-tape", PlaceAttributes{}, theirs);
      board = &addNode<TextNode>(load, "board", PlaceAttributes{}, "", TextStyle{});
      addNode<Sim>(load, "sim", std::vector<std::string>{"floor"}, std::vector<std::string>{"ball", "stone"});
    };
    scene.open("show");
    frame();
    loader.files.erase("show");  // it refers to what ends here
  }
  void start(const std::string& name) { scene.command(name, CommandId::Start, {}, input.time); }
  void play(double seconds) {
    for (auto n = static_cast<int>(seconds * rate); n > 0; --n) {
      frame();
      for (const EventRecord& e : scene.events())
        if (e.event != Event("onimpact") && e.event != Event("onrelease")) told.push_back(e);
    }
  }
  std::vector<Event> events(const ThrowMeasureNode* of) const {
    std::vector<Event> out;
    for (const EventRecord& e : told)
      if (e.node == of->self()) out.push_back(e.event);
    return out;
  }
};

TEST(Measure, TakesTheDistanceSquareFromTheLineAtTheTimeOfTheFirstTouchAtAnyFrameRate) {
  for (const double rate : {30.0, 60.0, 240.0}) {
    Field2 show;
    show.rate = rate;
    show.open();
    show.start("tape");
    show.play(2);
    ASSERT_EQ(show.told.size(), 1u) << rate;
    EXPECT_EQ(show.told[0].event, Event("measured"));
    EXPECT_NEAR(show.told[0].value.value_or(0), 43.017, 1e-9) << rate;
    EXPECT_NEAR(toSeconds(show.told[0].when), std::sqrt(2 * (2 - kShotRadius) / kStandardGravity), 1e-8)
        << rate;
    EXPECT_EQ(show.board->words(), "Visitor 43.01 m") << "whole centimetres, rounded down";
  }
}

TEST(Measure, TheLineMayLieAnyhow) {
  Field2 show;
  show.line.X_PN = Affine(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));  // +Y downfield is World's -X
  show.line.X_PN.translation() = Vec3(10, 5, 0);
  show.line.X_PN.linear() *= 3;  // its scale does not count
  show.first = {-20, 17, 2};
  show.open();
  show.start("tape");
  show.play(2);
  ASSERT_TRUE(show.visitor->result());
  EXPECT_NEAR(show.visitor->result()->metres, 30, 1e-9);
  EXPECT_FALSE(show.visitor->result()->foul);
}

TEST(Measure, FromAPointCountsTheWayFromThere) {
  Field2 show;
  show.first = {3, 4, 2};
  show.ours.from = MeasureFrom::Point;
  show.open();
  show.start("tape");
  show.play(2);
  ASSERT_TRUE(show.visitor->result());
  EXPECT_NEAR(show.visitor->result()->metres, 5, 1e-9);
}

TEST(Measure, BehindTheLineAndOutsideTheSectorIsAFoul) {
  const auto eventsOf = [](const Vec3& where, double cosHalfSector) {
    Field2 show;
    show.first = where;
    show.ours.cosHalfSector = cosHalfSector;
    show.open();
    show.start("tape");
    show.play(2);
    EXPECT_TRUE(show.told.empty() || show.told[0].event != Event("foul") || !show.told[0].value);
    return show.events(show.visitor);
  };
  EXPECT_EQ(eventsOf({0, -1, 2}, -1), std::vector<Event>{Event("foul")});
  EXPECT_EQ(eventsOf({50, 1, 2}, -1), std::vector<Event>{Event("measured")});
  const double sector = std::cos(17.46 / 180 * M_PI);
  EXPECT_EQ(eventsOf({12, 40, 2}, sector), std::vector<Event>{Event("measured")});
  EXPECT_EQ(eventsOf({13, 40, 2}, sector), std::vector<Event>{Event("foul")});
}

TEST(Measure, OnlyTheFirstImpactAfterItsStartCounts) {
  Field2 show;
  show.open();
  show.play(0.7);  // it has touched already, and bounces
  show.start("tape");
  show.play(2);
  ASSERT_EQ(show.told.size(), 1u);
  EXPECT_GT(toSeconds(show.told[0].when), 0.7);
}

TEST(Measure, WithoutAStartNothingIsMeasuredAndItIsNotVisited) {
  Field2 show;
  show.open();
  show.play(6);
  EXPECT_TRUE(show.told.empty());
  EXPECT_EQ(show.scene.counters().nodesVisited, 0u);
  EXPECT_FALSE(show.scene.impacts().wanted());
}

TEST(Measure, TheFartherThrowWinsOnceBothAreMeasuredWhicheverComesLast) {
  for (const bool ourselvesLast : {true, false}) {
    Field2 show;
    if (ourselvesLast) std::swap(show.first.z(), show.second.z());
    show.ours.against = "other-tape";
    show.open();
    show.start("tape"), show.start("other-tape");
    show.play(2);
    EXPECT_EQ(show.events(show.visitor), (std::vector<Event>{Event("measured"), Event("won")}))
        << ourselvesLast;
    EXPECT_NEAR(toSeconds(show.told.back().when), std::sqrt(2 * (3 - kShotRadius) / kStandardGravity), 1e-8)
        << "told for the time of the later touch";
    EXPECT_EQ(show.board->words(), "Visitor 43.01 m\nAthlete 41.20 m\nVisitor wins by 1.81 m");
  }
}

TEST(Measure, TheSameCentimetreIsADrawAndAFoulLosesToAnyDistance) {
  const auto verdict = [](double our, double their) {
    Field2 show;
    show.first.y() = our, show.second.y() = their;
    show.ours.against = "other-tape";
    show.open();
    show.start("tape"), show.start("other-tape");
    show.play(2);
    return show.events(show.visitor).back();
  };
  EXPECT_EQ(verdict(30.011, 30.019), Event("drawn"));
  EXPECT_EQ(verdict(30.009, 30.011), Event("lost"));
  EXPECT_EQ(verdict(-1, 0.5), Event("lost"));
  EXPECT_EQ(verdict(0.5, -1), Event("won"));
  EXPECT_EQ(verdict(-2, -1), Event("drawn"));
}

TEST(Measure, AnotherStartMeasuresAgainAndResetForgets) {
  Field2 show;
  show.open();
  show.start("tape");
  show.play(1);
  Field2 remembers;
  remembers.open();
  remembers.start("tape");
  remembers.play(2);
  show.scene.command("tape", CommandId::Reset, {}, show.input.time);
  show.play(1);
  EXPECT_FALSE(show.visitor->result());
  EXPECT_NE(show.scene.stateHash(), remembers.scene.stateHash()) << "the result is state";
  show.scene.command("ball", CommandId::Reset, {}, show.input.time);
  show.start("tape");
  show.play(2);
  ASSERT_TRUE(show.visitor->result());
  EXPECT_NEAR(show.visitor->result()->metres, 43.017, 1e-9);
}

TEST(Measure, AThrowThatComesToRestWithoutAnImpactThatCountsIsAFoulAtThatTime) {
  Field2 show;
  show.ours.ground = "stone";
  show.ours.against = "other-tape";
  show.second = {0, -1, 2};
  show.open();
  show.start("tape"), show.start("other-tape");
  show.play(8);
  EXPECT_EQ(show.events(show.visitor), (std::vector<Event>{Event("foul"), Event("drawn")}));
  ASSERT_TRUE(show.visitor->result() && show.athlete->result());
  EXPECT_GT(show.visitor->result()->when, show.athlete->result()->when) << "after its last bounce";
  EXPECT_EQ(show.board->words(), "Visitor foul\nAthlete foul\na draw");
}

TEST(Measure, WhatTouchesInTheVeryFrameOfTheStartCounts) {
  for (const double rate : {30.0, 240.0}) {
    Field2 show;
    show.rate = rate;
    show.open();
    const double lands = std::sqrt(2 * (2 - kShotRadius) / kStandardGravity);
    show.scene.command("tape", CommandId::Start, {}, fromSeconds(lands - 0.002));
    show.play(2);
    ASSERT_TRUE(show.visitor->result()) << rate;
    EXPECT_NEAR(toSeconds(show.visitor->result()->when), lands, 1e-8) << rate << ": not the next bounce";
  }
}

/// A ball that sticks in whatever it falls on.
class Dart : public DynObjectNode {
public:
  Dart(NodeRef self, std::string name, const DynObjectNode& like, MeshId mesh, const Vec3& p)
      : DynObjectNode(self, std::move(name), at(p), {mesh, true, "box"}, body(), like.fit()) {}

private:
  static PlaceAttributes at(const Vec3& p) {
    PlaceAttributes place;
    place.X_PN.translation() = p;
    return place;
  }
  static BodyAttributes body() {
    BodyAttributes b;
    b.hooks = {"gravity"};
    b.nose = -Vec3::UnitZ(), b.sticks = 1, b.tipDepth = 0.05;
    return b;
  }
};

TEST(Measure, WhatSticksHasTouchedBeforeItEndsWhateverTheNanosecond) {
  for (int i = 0; i < 24; ++i) {
    ShowFixture show;
    auto tiny = cube(kShotRadius);
    tiny->hash = 8;
    const MeshId box = show.meshes.add(cube(100)), small = show.meshes.add(std::move(tiny));
    ThrowMeasureNode* tape = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true);
      addNode<Block>(load, "floor", box, Vec3(0, 0, -100));
      const Ball& like = addNode<Ball>(load, "ball", Vec3(5, 0, 9), std::vector<std::string>{});
      addNode<Dart>(load, "dart", like, small, Vec3(0, 20, 1 + 0.0137 * i));
      ThrowMeasureAttributes of;
      of.body = "dart";
      tape = &addNode<ThrowMeasureNode>(load, "tape", PlaceAttributes{}, of);
      addNode<Sim>(load, "sim", std::vector<std::string>{"floor"}, std::vector<std::string>{"dart"});
    };
    show.scene.open("show");
    show.frame();
    show.loader.files.erase("show");  // it refers to what ends here
    show.scene.command("tape", CommandId::Start, {}, show.input.time);
    for (int n = 0; n < 60; ++n) show.frame();
    ASSERT_TRUE(tape->result()) << i;
    EXPECT_FALSE(tape->result()->foul) << i;
    EXPECT_NEAR(tape->result()->metres, 20, 1e-9) << i;
  }
}

TEST(Measure, AThrowThatTouchesNothingForItsDurationIsAFoulThen) {
  Field2 show;
  show.first.z() = 1e5;
  show.ours.duration = fromSeconds(1.5);
  show.open();
  show.start("tape");
  show.play(3);
  ASSERT_EQ(show.told.size(), 1u);
  EXPECT_EQ(show.told[0].event, Event("foul"));
  EXPECT_EQ(show.told[0].when, show.visitor->result()->when);
  EXPECT_NEAR(toSeconds(show.told[0].when), 1.5, 0.04) << "from its start on";
}

TEST(Measure, OnlyTheGroundCountsIfOneIsStated) {
  Field2 show;
  show.second = {1.05, 43.017, 1};  // the stone lies where the ball falls
  show.first.z() = 5;
  show.ours.ground = "floor";
  show.open();
  show.play(0.9);
  show.start("tape");
  show.play(4);
  ASSERT_TRUE(show.visitor->result());
  Field2 any;
  any.second = show.second, any.first = show.first;
  any.open();
  any.play(0.9);
  any.start("tape");
  any.play(4);
  ASSERT_TRUE(any.visitor->result());
  EXPECT_LT(any.visitor->result()->when, show.visitor->result()->when);
}

}  // namespace
}  // namespace stadion
