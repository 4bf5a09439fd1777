/// The exact models, the reference flights, and what must hold of the shipped models on them.

#include "bench/flight/flight_report.h"
#include "bench/flight/trajectory_plot.h"
#include "dynamics/flight/split_step.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion::bench {
namespace {

const std::vector<ReferenceFlight>& references() {
  static const auto read = referenceFlights(STADION_SOURCE_DIR "/bench/flight/reference");
  EXPECT_TRUE(read) << format(read.error());
  return read.value();
}

TEST(FlightBench, TheExactModelsFlyTheReferenceFlights) {
  EXPECT_EQ(references().size(), 21U);
  for (const ReferenceFlight& f : references()) {
    const FlightErrors e = errorsOf(flyExactly(f.release), f.path, factsOf(f.release.thing).axis);
    EXPECT_LE(e.landing, 1e-9) << f.release.name;
    EXPECT_LE(e.attitude, 1e-3) << f.release.name;
  }
}

TEST(FlightBench, TheDefaultStepAt60HzKeepsToThem) {
  for (const ReferenceFlight& f : references()) {
    const Throw& t = f.release;
    if (!f.smooth || t.thing == Thing::Ball) continue;
    const ThingFacts& facts = factsOf(t.thing);
    FlightState s{t.start.p, t.start.v, t.start.q, momentumOf(facts.body, facts.axis, t.start.q, t.start.w)};
    const Trajectory path = flyBy(t, 60, [&](RigidFlight& r) {
      splitStep(s, facts.body, facts.axis, t.air(), 1.0 / 60, facts.exact);
      r = {s.p, s.v, s.q, angularVelocityOf(facts.body, facts.axis, s)};
    });
    const FlightErrors e = errorsOf(path, f.path, facts.axis);
    EXPECT_LE(e.landing, t.thing == Thing::Javelin ? 5e-4 : 1e-3) << t.name;
    EXPECT_LE(e.attitude, 0.15) << t.name;
  }
}

TEST(FlightBench, RungeAndKuttaAt960HzReproduceEachSmoothOne) {
  for (const ReferenceFlight& f : references()) {
    if (!f.smooth) continue;
    const auto around = f.release.conditions();
    const AnyModel& model = factsOf(f.release.thing).exact;
    const Trajectory path =
        flyBy(f.release, 960, [&](RigidFlight& r) { runge_kutta::step4(r, 1.0 / 960, around, model); });
    EXPECT_LE(errorsOf(path, f.path, 0).landing, 1e-5) << f.release.name;
  }
}

TEST(FlightBench, TheLadderHoldsOnFlightsItWasNotFittedTo) {
  const auto show = ShowFlights::ofOlympia(STADION_SOURCE_DIR);
  ASSERT_TRUE(show) << format(show.error());
  const Ladder ladder = measureLadder(references(), 30, &show.value());
  const auto inShows = [](const std::string& what) { return what.find("in a show") != std::string::npos; };
  EXPECT_EQ(std::ranges::count_if(ladder.checks, inShows, &Check::what), 8 + 3);
  for (const Check& c : ladder.checks)
    EXPECT_TRUE(c.met()) << c.what << ": " << c.value << ", at most " << c.most;
}

TEST(FlightBench, AScriptFliesWhatTheModelByItselfFlies) {
  const auto show = ShowFlights::ofOlympia(STADION_SOURCE_DIR);
  ASSERT_TRUE(show) << format(show.error());
  for (const Thing thing : {Thing::Javelin, Thing::Discus}) {
    const std::vector<Throw> throws = heldOut(thing, 3);
    const auto flown = show.value().fly(show.value().rungsOf(thing).front(), throws);
    ASSERT_TRUE(flown) << format(flown.error());
    const std::string shipped = thing == Thing::Javelin ? "rod" : "plate";
    for (const Rung& rung : rungsOf(thing))
      for (std::size_t i = 0; rung.name == shipped && i < throws.size(); ++i)
        EXPECT_LT(errorsOf(flown.value()[i], rung.fly(throws[i]), factsOf(thing).axis).landing, 1e-3);
  }
}

TEST(FlightBench, AScriptThatCannotBePlayedIsAMissedLimit) {
  const auto show = ShowFlights::ofOlympia(STADION_SOURCE_DIR);
  ASSERT_TRUE(show) << format(show.error());
  const ShowRung wrong{Thing::Javelin, "wrong", "file=no_such.glb, mass=1"};
  EXPECT_FALSE(show.value().fly(wrong, heldOut(Thing::Javelin, 1)));
  EXPECT_FALSE(ShowFlights::ofOlympia("/nowhere"));
}

TEST(FlightBench, HardCasesAndPublishedThrowsHold) {
  Checks all = measureHardCases();
  const Checks published = measurePublishedThrows().checks;
  all.insert(all.end(), published.begin(), published.end());
  for (const Check& c : all) EXPECT_TRUE(c.met()) << c.what << ": " << c.value;
}

TEST(FlightBench, HeldOutFlightsAreTheSameEveryTime) {
  const std::vector<Throw> a = heldOut(Thing::Javelin, 5), b = heldOut(Thing::Javelin, 7);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].start.v, b[i].start.v);
    EXPECT_EQ(a[i].wind, b[i].wind);
  }
  EXPECT_NE(a[0].start.v, a[1].start.v);
}

TEST(FlightBench, ErrorsAreOfLandingRangeAndAxis) {
  Trajectory exact{{0, {}}, {0.1, {}}, {1, {}}};
  exact.back().at.p = Vec3(50, 0, 0);
  Trajectory flight = exact;
  flight.back().at.p = Vec3(51, 1, 0);
  flight[1].at.q = det::expRotation(Vec3(0, 0.1, 0));
  const FlightErrors e = errorsOf(flight, exact, 0);
  EXPECT_NEAR(e.range, 0.02, 1e-12);
  EXPECT_NEAR(e.landing, std::sqrt(2) / 50, 1e-12);
  EXPECT_NEAR(e.attitude, 0.05 / kDegree, 1e-9);  // mean of 0.1 and 0
}

TEST(FlightBench, AMissedLimitIsSaidAndFails) {
  FlightReport report;
  report.hard = {{"a", 1, 2, 0, "m"}, {"b", 3, 2, 0, "m"}, {"c", NAN, 2, 0, ""}};
  EXPECT_FALSE(allMet(report));
  EXPECT_NE(textOf(report).find("MISSED  b: 3 m, at most 2 m"), std::string::npos);
  EXPECT_NE(textOf(report).find("1 limits met, 2 missed"), std::string::npos);
  const auto json = nlohmann::json::parse(jsonOf(report));
  EXPECT_EQ(json["ok"], false);
  EXPECT_EQ(json["limits"][1]["met"], false);
}

TEST(FlightBench, PlotsShowEveryFlightFromTwoSides) {
  Trajectory path{{0, {}}, {1, {}}};
  path[0].at.p = Vec3(0, 0, 2), path[1].at.p = Vec3(50, 3, 0);
  const std::string svg = trajectoryPlot("flights", {{"exact", path}, {"rod", path}}, 0);
  std::size_t lines = 0;
  for (std::size_t at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1))
    ++lines;
  EXPECT_EQ(lines, 4U);
  EXPECT_NE(svg.find("rod 50.1 m"), std::string::npos);
}

}  // namespace
}  // namespace stadion::bench
