/// Hitches: frames that are longer than before although the typical frame is not.

#include "profiling/regression/baseline.h"
#include "profiling/regression/spans/planted_delay.h"
#include "profiling/regression/statistics/hitch_comparison.h"
#include "profiling/regression/spans/span_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

namespace stadion::regression {
namespace {

/// What is planted in the runs of "now".
struct Hitch {
  std::string where = "draw";  ///< a stage, "ball" (a node of App), or "between" the stages
  std::size_t every = 0;       ///< frames; 0: none
  bool asleep = false, atRandom = false;
  double us = 20000;
};

/// Runs on a machine that interrupts: other frames in each run, in some runs more often than in others.
class NoisyMachine {
public:
  explicit NoisyMachine(unsigned seed) : random_(seed) {}

  std::vector<SpanRow> run(const Hitch& hitch, std::size_t frames = 120) {
    const double level = 1 + 0.01 * normal_(random_), busy = 0.05 * (0.5 + uniform_(random_));
    std::map<std::string, SpanRow> rows;
    for (std::size_t n = 0; n < frames; ++n) {
      const bool hitches =
          hitch.every > 0 && (hitch.atRandom ? uniform_(random_) * static_cast<double>(hitch.every) < 1
                                             : n % hitch.every == hitch.every - 1);
      double whole = hitches && hitch.where == "between" ? hitch.us : 0;
      for (const auto& [stage, usual] : {std::pair{"app", 300.0}, {"cull", 60.0}, {"draw", 4000.0}}) {
        double processor = usual * level * (1 + 0.2 * std::sin(0.1 * static_cast<double>(n))) *
                           (1 + 0.03 * std::fabs(normal_(random_)));
        if (uniform_(random_) < 0.02) processor *= 1.5;
        double elapsed = processor;
        if (uniform_(random_) < busy * usual / 4000) elapsed += -6000 * std::log(1 - uniform_(random_));
        const bool inNode = hitch.where == "ball" && std::string(stage) == "app";
        const bool here = hitches && (hitch.where == stage || inNode);
        if (here) elapsed += hitch.us, processor += hitch.asleep ? 0 : hitch.us;
        add(rows, stage, "", n, processor, elapsed);
        if (std::string(stage) == "app") {
          add(rows, "app", "ball", n, 40 + (inNode && here && !hitch.asleep ? hitch.us : 0),
              40 + (inNode && here ? hitch.us : 0));
          add(rows, "app", "lane", n, 60, 60);
        }
        whole += elapsed;
      }
      add(rows, "frame", "", n, 0, whole);
    }
    std::vector<SpanRow> all;
    for (auto& [key, row] : rows) all.push_back(std::move(row));
    return all;
  }

  std::vector<Round> rounds(const Hitch& hitch, std::size_t count = 12) {
    std::vector<Round> all;
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<SpanRow> before = run({});
      all.push_back({std::move(before), run(hitch)});
    }
    return all;
  }

private:
  static void add(std::map<std::string, SpanRow>& rows, const std::string& stage, const std::string& node,
                  std::size_t frame, double processor, double elapsed) {
    SpanRow& row = rows[stage + node];
    row.stage = stage, row.path = node, row.line = node.empty() ? 0 : 7;
    row.file = node.empty() ? "" : "show.evs";
    row.wall = stage == "cull" || stage == "draw" ? "front" : "";
    if (processor > 0) row.frames[frame] = processor;
    row.elapsed[frame] = elapsed;
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<> uniform_;
  std::normal_distribution<> normal_;
};

constexpr RunDesign kTwelvePairs{12, 12, true};

std::vector<Check> checksOfRounds(const std::vector<Round>& rounds) {
  const auto found = compareFrames(seriesOf(rounds, 1e6 / 60), kTwelvePairs, {});
  std::vector<std::string> culprits;
  for (const StageFrames& f : found) culprits.push_back(f.worse() ? culpritOf(f, rounds) : "");
  return checksOf(found, culprits, "the other build", rounds.size());
}

const Check* failedIn(const std::vector<Check>& checks, const std::string& metric) {
  for (const Check& c : checks)
    if (c.metric == metric && c.outcome == Outcome::Failed) return &c;
  return nullptr;
}

TEST(RegressionHitches, InTheSameFramesAreFoundAndNamedWithFramesStageAndNode) {
  const auto check = [](const Hitch& hitch, unsigned seed, const std::string& metric,
                        const std::string& frames, const std::string& culprit) {
    const auto checks = checksOfRounds(NoisyMachine(seed).rounds(hitch));
    const Check* stage = failedIn(checks, metric);
    ASSERT_TRUE(stage) << metric << " seed " << seed;
    EXPECT_NE(stage->said.find(frames), std::string::npos) << stage->said;
    EXPECT_EQ(stage->culprit, culprit);
    EXPECT_TRUE(failedIn(checks, "whole frames"));
    for (const char* other :
         {"frames of app", "frames of cull of wall front", "frames of draw of wall front"})
      EXPECT_EQ(failedIn(checks, other) != nullptr, metric == other) << other;
  };
  const std::string draw = "draw of wall front", ofDraw = "frames of " + draw;
  check({"draw", 100, false}, 1, ofDraw, "frame 99 longer by 2", draw);
  check({"draw", 50, true}, 2, ofDraw, "frames 49, 99 longer by", draw);
  check({"draw", 10, true}, 3, ofDraw, "frames 9, 19, 29, 39, 49, 59, 69, 79 and 4 more longer by", draw);
  check({"cull", 100, true}, 4, "frames of cull of wall front", "frame 99 ", "cull of wall front");
  check({"ball", 100, true}, 5, "frames of app", "frame 99 ", "ball (show.evs:7) in app");
  check({"ball", 50, false}, 6, "frames of app", "frames 49, 99 ", "ball (show.evs:7) in app");
  check({"between", 100, true}, 7, "whole frames", "frame 99 ", "frame, between the stages");
}

TEST(RegressionHitches, InOtherFramesOfEachRunAreFoundByTheFigures) {
  for (const bool asleep : {false, true}) {
    const auto checks = checksOfRounds(NoisyMachine(11).rounds({"draw", 10, asleep, true}));
    const Check* stage = failedIn(checks, "frames of draw of wall front");
    ASSERT_TRUE(stage) << asleep;
    EXPECT_NE(stage->said.find("p95 "), std::string::npos) << stage->said;
    const Check* whole = failedIn(checks, "whole frames");
    ASSERT_TRUE(whole);
    EXPECT_NE(whole->said.find("late frames "), std::string::npos) << whole->said;
    EXPECT_EQ(whole->culprit, "draw of wall front");
  }
}

TEST(RegressionHitches, OfTheSameBuildRaiseNoAlarm) {
  int alarms = 0;
  for (unsigned seed = 100; seed < 112; ++seed)
    for (const Check& c : checksOfRounds(NoisyMachine(seed).rounds({})))
      alarms += c.outcome == Outcome::Failed ? 1 : 0;
  EXPECT_LE(alarms, 1);
}

TEST(RegressionHitches, ThatWentAwayAreNoFailure) {
  std::vector<Round> rounds = NoisyMachine(21).rounds({"draw", 10});
  for (Round& r : rounds) std::swap(r.before, r.now);
  for (const Check& c : checksOfRounds(rounds)) EXPECT_EQ(c.outcome, Outcome::Passed) << c.said;
}

TEST(RegressionHitches, OfABuildThatTellsProcessorTimeAloneAreComparedByThat) {
  std::vector<Round> rounds = NoisyMachine(22).rounds({"draw", 50});
  for (Round& r : rounds)
    for (SpanRow& row : r.before) row.elapsed.clear();
  const auto checks = checksOfRounds(rounds);
  EXPECT_TRUE(failedIn(checks, "frames of draw of wall front"));
  EXPECT_FALSE(failedIn(checks, "whole frames"));
}

TEST(RegressionHitches, AreFoundAgainstWhatABaselineFileKeeps) {
  const std::vector<double> calibration(12, 10.0), faster(12, 5.0);
  const auto runsOf = [](unsigned seed, const Hitch& hitch) { return NoisyMachine(seed).rounds(hitch); };
  BaselineCase kept;
  kept.frames = keep(seriesOfNow(runsOf(31, {}), 1e6 / 60), calibration);
  const std::string file = testing::TempDir() + "hitches.baseline.json";
  std::ofstream(file) << toJson({{"made/sequential", kept}});
  const auto read = readBaseline(file);
  ASSERT_TRUE(read) << read.error().message;
  const KeptStages& frames = read.value().at("made/sequential").frames;
  EXPECT_EQ(roundsIn(frames), 12u);
  const auto alarms = [&](const std::vector<Round>& rounds, const std::vector<double>& ms) {
    std::vector<std::string> all;
    for (const StageFrames& f :
         compareFrames(joined(frames, seriesOfNow(rounds, 1e6 / 60), ms), {12, 12, false}, {}))
      if (f.worse()) all.push_back(f.name);
    return all;
  };
  EXPECT_TRUE(alarms(runsOf(32, {}), calibration).empty());
  EXPECT_EQ(alarms(runsOf(33, {"draw", 100, true}), calibration),
            (std::vector<std::string>{"draw of wall front", "frame"}));
  EXPECT_FALSE(alarms(runsOf(34, {"ball", 50, false}), calibration).empty());
  // On a machine of twice the speed the same takes half the time.
  std::vector<Round> half = runsOf(35, {});
  for (Round& r : half)
    for (SpanRow& row : r.now) {
      for (auto& [n, us] : row.frames) us /= 2;
      for (auto& [n, us] : row.elapsed) us /= 2;
    }
  EXPECT_TRUE(alarms(half, faster).empty());
}

TEST(RegressionHitches, OfAnOlderBaselineAreUnknownAndANewerOneIsRefused) {
  const std::string file = testing::TempDir() + "versions.baseline.json";
  const auto write = [&](const char* version) {
    std::ofstream(file) << R"({"format": "stadion-baseline )" << version << R"(", "cases": {}})";
  };
  write("1");
  EXPECT_TRUE(readBaseline(file));
  write("3");
  const auto read = readBaseline(file);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("this build reads versions 1 and 2"), std::string::npos)
      << read.error().message;
  EXPECT_EQ(roundsIn({}), 0u);
}

TEST(RegressionHitches, FailOnlyIfASecondMeasurementAgrees) {
  std::vector<Check> checks{{"frames of app", Outcome::Failed, "p99", "app", {"app"}},
                            {"frames of draw", Outcome::Failed, "p99", "draw", {"draw"}},
                            {"times of cull", Outcome::Failed, "too few rounds"}};
  confirm(
      checks,
      {{"frames of app", Outcome::Failed, "p95", "app", {"app"}}, {"frames of draw", Outcome::Passed, ""}},
      12);
  EXPECT_EQ(checks[0].outcome, Outcome::Failed);
  EXPECT_EQ(checks[0].said, "p99; again in 12 more rounds");
  EXPECT_EQ(checks[1].outcome, Outcome::Passed);
  EXPECT_EQ(checks[1].said, "p99; not in 12 more rounds: by chance");
  EXPECT_EQ(checks[2].outcome, Outcome::Failed) << "no measurement can mend that";
}

TEST(RegressionFigures, AreThoseOfAllFramesButTheFirst) {
  std::vector<double> us(5, 1e9);
  for (int i = 100; i >= 1; --i) us.push_back(i);
  const RunFigures f = figuresOf(us, 98);
  EXPECT_EQ(f, (RunFigures{{"mean", 50.5}, {"p95", 95}, {"p99", 99}, {"longest", 100}, {"late frames", 2}}));
  EXPECT_FALSE(figuresOf(us, 0).contains("late frames"));
  EXPECT_TRUE(figuresOf({1, 2, 3}, 1).empty());
}

TEST(RegressionLabellings, AreAllOfFewPairsAndSomeOfMany) {
  const auto few = labellingsOf({12, 12, true}), many = labellingsOf({80, 80, true}),
             free = labellingsOf({12, 14, false});
  EXPECT_EQ(few.size(), 4096u);
  EXPECT_EQ(few.front(), (RunDesign{12, 12, true}.trueNow()));
  EXPECT_EQ(many.front(), (RunDesign{80, 80, true}.trueNow()));
  EXPECT_EQ(free.front(), (RunDesign{12, 14, false}.trueNow()));
  for (const auto* all : {&few, &many})
    for (const RunSet& now : *all) EXPECT_EQ(now.count(), all == &few ? 12u : 80u);
  for (const RunSet& now : free) EXPECT_EQ(now.count(), 14u);
}

TEST(RegressionPlanted, AmountsAndFramesAreReadFromTheOption) {
  const auto sleep = PlantedDelay::parse("simulate:ball=sleep20ms/10+3");
  ASSERT_TRUE(sleep);
  EXPECT_TRUE(sleep->asleep);
  EXPECT_EQ(sleep->milliseconds, 20u);
  EXPECT_FALSE(sleep->isIn(2));
  EXPECT_TRUE(sleep->isIn(3) && sleep->isIn(13));
  EXPECT_FALSE(sleep->isIn(12));
  const auto work = PlantedDelay::parse("draw:west=5000");
  ASSERT_TRUE(work);
  EXPECT_EQ(work->iterations, 5000u);
  EXPECT_TRUE(work->isIn(0) && work->isIn(1));
  EXPECT_TRUE(PlantedDelay::parse("frame:=20ms~50"));
  for (const char* wrong : {"draw:west=", "draw:west=sleep20", "draw:west=20ms/0", "draw:west=20ms/",
                            "frame:x=1", "draw:=1", "swap:west=1", "draw:west=20ms/5x", "draw:west"})
    EXPECT_FALSE(PlantedDelay::parse(wrong)) << wrong;
}

TEST(RegressionSpans, HaveTheDurationOfEachFrameAndOfTheWholeFrame) {
  auto planted = PlantedDelay::parse("simulate:ball=sleep2ms/3");
  ASSERT_TRUE(planted);
  planted->node = {1, 0};
  SpanTimes times({*planted});
  for (std::uint64_t frame = 0; frame < 6; ++frame) {
    times.began(Span::App, frame, kNoWall);
    times.began(Span::Simulate, NodeRef{1, 0});
    times.ended(Span::Simulate);
    times.ended(Span::App);
    times.began(Span::Swap, frame, kNoWall);
    times.ended(Span::Swap);
  }
  const auto rows =
      spanRows(toJson(times.rows({}, [](NodeRef, SpanRow& row) { row.path = "ball", row.line = 7; })));
  for (const SpanRow& r : rows) {
    if (r.stage == "swap") continue;
    ASSERT_EQ(r.elapsed.size(), 6u) << r.name();
    for (const std::uint64_t n : {0, 3}) EXPECT_GE(r.elapsed.at(n), 2000) << r.name();
    EXPECT_EQ(r.frames.empty(), r.stage == "frame");
  }
  EXPECT_EQ(rows.back().name(), "frame");
}

}  // namespace
}  // namespace stadion::regression
