/// Situations in which a show went wrong somewhere, played as a user would: tests/corpus/field.

#include "tests/programs/played_cluster.h"
#include "tests/programs/program.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <unistd.h>

namespace stadion {
namespace {

/// How a case is played.
struct FieldWay {
  const char *mode, *rate;
};
constexpr std::array kWays{FieldWay{"sequential", "60"}, FieldWay{"pipelined", "30"},
                           FieldWay{"pipelined", "144"}};

/// Where a body was in each frame.
struct BodyTrack {
  struct Row {
    double time, x, y, z;
    std::string mode;
  };
  std::vector<Row> rows;

  const Row& end() const { return rows.back(); }
  double highest() const {
    double z = rows.front().z;
    for (const Row& row : rows) z = std::max(z, row.z);
    return z;
  }
  /// The frame in which it has come to rest for good.
  double stops() const {
    double stopped = rows.back().time;
    for (std::size_t i = rows.size(); i-- > 0 && rows[i].mode == "rest";) stopped = rows[i].time;
    return stopped;
  }
};

/// One case, played in one way.
class PlayedCase {
public:
  PlayedCase(const FieldWay& way, const std::string& show, const std::string& seconds,
             const std::string& body = {}) {
    const std::string field = STADION_SOURCE_DIR "/tests/corpus/field/";
    const std::string log = field + show + ".input";
    std::vector<std::string> words{"run",        field + show + ".evs",
                                   "--walls",    "desktop",
                                   "--stereo",   "off",
                                   "--size",     "16x12",
                                   "--look",     "plain",
                                   "--mode",     way.mode,
                                   "--rate",     way.rate,
                                   "--seconds",  seconds,
                                   "--out",      folder_.path(),
                                   "--input",    std::filesystem::exists(log) ? log : "none",
                                   "--pictures", "none"};
    if (!body.empty()) words.insert(words.end(), {"--track", body});
    result_ = stadionProgram(words);
    EXPECT_EQ(result_.status, 0) << result_.err;
    if (!body.empty()) read(folder_.path() / ("track-" + body + ".csv"));
  }
  const BodyTrack& track() const { return track_; }
  /// When each node told of something, as the report says it [s].
  std::map<std::string, double> told(const std::string& event) const {
    std::map<std::string, double> times;
    std::istringstream lines(result_.out + result_.err);
    const std::regex form("\\s*([0-9.]+) s\\s+" + event + "\\s+(\\S+)");
    std::smatch found;
    for (std::string line; std::getline(lines, line);)
      if (std::regex_match(line, found, form)) times.emplace(found[2], std::stod(found[1]));
    return times;
  }

private:
  void read(const std::filesystem::path& file) {
    std::istringstream lines(fileContent(file));
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);) {
      std::vector<std::string> cells;
      std::istringstream in(line);
      for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
      ASSERT_GE(cells.size(), 5U) << line;
      track_.rows.push_back(
          {std::stod(cells[0]), std::stod(cells[1]), std::stod(cells[2]), std::stod(cells[3]), cells.back()});
    }
    ASSERT_FALSE(track_.rows.empty()) << file;
  }

  TestFolder folder_;
  ProgramResult result_;
  BodyTrack track_;
};

class ProgramFieldCase : public testing::TestWithParam<FieldWay> {};

INSTANTIATE_TEST_SUITE_P(Program, ProgramFieldCase, testing::ValuesIn(kWays), [](const auto& way) {
  return fmt::format("{}_{}", way.param.mode, way.param.rate);
});

TEST_P(ProgramFieldCase, ACrateSlidesOverASeamAsOverOneSlab) {
  const PlayedCase played(GetParam(), "seam", "5", "crate");
  constexpr double kGravity = 9.80665;
  EXPECT_NEAR(played.track().end().y, 0.5 + 36 / (2 * 0.2 * kGravity), 1e-4);
  EXPECT_NEAR(played.track().end().x, 0, 1e-6);
  EXPECT_NEAR(played.track().end().z, 0.25, 1e-6);
  EXPECT_LT(played.track().highest(), 0.25 + 1e-6);
  EXPECT_TRUE(played.told("onimpact").empty());
}

TEST_P(ProgramFieldCase, ACrateWithoutFrictionKeepsItsSpeedOverTiles) {
  const PlayedCase played(GetParam(), "tiles", "5", "crate");
  EXPECT_NEAR(played.track().end().y, 15, 1e-4);
  EXPECT_NEAR(played.track().end().x, 0.1, 1e-6);
  EXPECT_LT(played.track().highest(), 0.25 + 1e-6);
  EXPECT_TRUE(played.told("onimpact").empty());
}

TEST_P(ProgramFieldCase, SensorsSeeFastBodiesAtTheExactTime) {
  const PlayedCase played(GetParam(), "fast", "0.5");
  const auto meets = played.told("onimpact"), parts = played.told("onrelease");
  const std::map<std::string, double> half{{"c_thick", 2.5}, {"c_thin", 0.5}};
  ASSERT_EQ(meets.size(), 2U);
  ASSERT_EQ(parts.size(), 2U);
  for (const auto& [sensor, thick] : half) {
    EXPECT_NEAR(meets.at(sensor), (20 - thick - 0.1) / 70, 6e-5) << sensor;
    EXPECT_NEAR(parts.at(sensor), (20 + thick + 0.1 + 0.5) / 70, 6e-5) << sensor;
  }
}

TEST_P(ProgramFieldCase, ACrateFallsWhenAHandTakesAwayTheOneBelow) {
  const PlayedCase played(GetParam(), "grab", "6", "upper");
  EXPECT_NEAR(played.track().end().z, 0.25, 1e-4);
  EXPECT_EQ(played.track().end().mode, "rest");
}

TEST_P(ProgramFieldCase, FlatThingsThatSpinStopAsUnderEvenPressure) {
  const double frame = 1 / std::stod(GetParam().rate);
  // Angular deceleration 4 mu g / 3 R of the disc; 0.3826 is the mean radius of a square of side 1.
  const std::map<std::string, double> stops{{"disc", 0.765}, {"slab", 0.888}};
  for (const auto& [body, time] : stops) {
    const double seen = PlayedCase(GetParam(), "spin", "2", body).track().stops();
    EXPECT_GT(seen, 0.99 * time) << body;
    EXPECT_LT(seen, 1.01 * time + frame) << body;
  }
}

TEST_P(ProgramFieldCase, ATowerOfCratesOfOneAndAHundredKilogramsStands) {
  const PlayedCase played(GetParam(), "tower", "60", "s9");
  EXPECT_NEAR(played.track().end().z, 4.75, 1e-3);
  EXPECT_NEAR(played.track().end().x, 0, 1e-3);
  EXPECT_NEAR(played.track().end().y, 3, 1e-3);
}

TEST_P(ProgramFieldCase, FieldsPostTheirEventsAtTheExactTime) {
  const PlayedCase played(GetParam(), "expiry", "1", "ball");
  const std::map<std::string, double> enabled = played.told("enabled"), disabled = played.told("disabled"),
                                      expired = played.told("expired");
  const double gust = 0.1037 + 0.05, over = gust + 0.25, off = gust + 0.05, on = over + 0.05;
  ASSERT_EQ(enabled.size(), 2U);
  ASSERT_EQ(disabled.size(), 1U);
  ASSERT_EQ(expired.size(), 1U);
  EXPECT_NEAR(enabled.at("gust"), gust, 6e-5);
  EXPECT_NEAR(expired.at("gust"), over, 6e-5);
  EXPECT_NEAR(disabled.at("lull"), off, 6e-5);
  EXPECT_NEAR(enabled.at("lull"), on, 6e-5);
  const BodyTrack::Row& end = played.track().end();
  EXPECT_NEAR(end.x, 0.5 * 10 * 0.25 * 0.25 + 10 * 0.25 * (end.time - over), 1e-6);
  EXPECT_NEAR(end.y,
              1 + 0.5 * 10 * off * off + 10 * off * (end.time - off) +
                  0.5 * 10 * (end.time - on) * (end.time - on),
              1e-6);
}

TEST_P(ProgramFieldCase, BodiesWithShieldsThatMeetHeadOnStayOnTheirLine) {
  for (const char* body : {"a", "b"}) {
    const PlayedCase played(GetParam(), "shields", "8", body);
    for (const BodyTrack::Row& row : played.track().rows) {
      ASSERT_NEAR(row.y, 0, 1e-6) << body << " at " << row.time;
      ASSERT_NEAR(row.z, 0, 1e-6) << body << " at " << row.time;
    }
    EXPECT_GT(played.track().end().x, *body == 'a' ? 2 : 6) << "the one stops, the other takes its speed";
  }
}

TEST(ProgramFieldEvents, AreTheSameOnTwoHosts) {
  const TestFolder folder;
  const std::string show = STADION_SOURCE_DIR "/tests/corpus/field/expiry.evs", out = folder.path() / "out";
  const std::string hosts =
      folder.write("two.cluster", "walls cave4\nnode front front left right\nnode floor floor\n"
                                  "hash-every 1\npartition f" +
                                      std::to_string(getpid()) + "\n");
  const ProgramResult r =
      stadionProgram({"cluster", hosts, show, "--out", out, "--size", "16x12", "--look", "plain", "--frames",
                      "60", "--pictures", "none", "--input", "none"});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json lead = summaryOf(out + "/front"), other = summaryOf(out + "/floor");
  EXPECT_EQ(lead["happened"].size(), 5U) << lead["happened"];
  EXPECT_EQ(lead["happened"], other["happened"]);
  EXPECT_EQ(lead["state_hash"], other["state_hash"]);
  EXPECT_EQ(lead["cluster"]["differed"], 0);
}

TEST(ProgramFieldAnchor, AtTheOriginIsOffTheCentreOfMass) {
  const TestFolder folder;
  std::string show = fileContent(STADION_SOURCE_DIR "/tests/corpus/field/shields.evs");
  for (std::size_t at = 0; (at = show.find("mode=repel", at)) != show.npos; at += 30)
    show.replace(at, 10, "mode=repel, anchor=origin");
  const ProgramResult r = stadionProgram({"run",          folder.write("origin.evs", show),
                                          "--asset-root", assetFolder(),
                                          "--walls",      "desktop",
                                          "--size",       "16x12",
                                          "--look",       "plain",
                                          "--seconds",    "8",
                                          "--out",        folder.path() / "out",
                                          "--input",      "none",
                                          "--pictures",   "none",
                                          "--track",      "a"});
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string track = fileContent(folder.path() / "out" / "track-a.csv");
  std::istringstream last(track.substr(track.rfind('\n', track.size() - 2) + 1));
  std::string cell;
  for (int i = 0; i < 4; ++i) std::getline(last, cell, ',');
  EXPECT_GT(std::stod(cell), 0.05) << "it rises";
}

TEST(ProgramFieldEvents, CheckWarnsOfWhatNeverHappens) {
  const TestFolder folder;
  const ProgramResult r = stadionProgram(
      {"check",
       folder.write("never.evs",
                    "forcespherical( name=f, radius=1, anchor=origin, eventmessage=\"expired, b, hide\" )\n"
                    "dynobject( name=b, file=football.3ds, hook=f )\ndynamics( collidee=b )\n"),
       "--asset-root", assetFolder()});
  EXPECT_EQ(r.status, 0) << r.err;
  for (const char* warning :
       {"without a duration, this field never posts expired", "the anchor has no effect without attach"})
    EXPECT_NE((r.out + r.err).find(warning), std::string::npos) << r.out << r.err;
}

TEST(ProgramFieldEvents, CheckWarnsOfAnAnchorInTheMassOfWhatIsNoBody) {
  const TestFolder folder;
  const std::string show = folder.write(
      "anchor.evs", "object( name=lamp, file=football.3ds )\n"
                    "dynobject( name=b, file=football.3ds, hook=f, hook=g, hook=h )\ndynamics( collidee=b )\n"
                    "forcespherical( name=f, radius=1, attach=lamp, anchor=mass )\n"
                    "forcespherical( name=g, radius=1, attach=b, anchor=mass )\n"
                    "forcespherical( name=h, radius=1, attach=lamp, anchor=origin )\n");
  const ProgramResult r = stadionProgram({"check", show, "--asset-root", assetFolder()});
  EXPECT_EQ(r.status, 0) << r.err;
  const std::string said = r.out + r.err,
                    warning = "anchor=mass has no effect: the object \"lamp\" is no body";
  EXPECT_NE(said.find("anchor.evs:4:55: warning: " + warning), std::string::npos) << said;
  EXPECT_EQ(said.find("no effect", said.find(warning) + warning.size()), std::string::npos) << said;
}

}  // namespace
}  // namespace stadion
