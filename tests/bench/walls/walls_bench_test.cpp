/// `stadion bench walls`: rows in, verdicts, table and plots out; the scene; pictures compared.

#include "bench/walls/picture_difference.h"
#include "bench/walls/wall_room.h"
#include "bench/walls/walls_judge.h"
#include "bench/walls/walls_plot.h"
#include "bench/walls/walls_program.h"
#include "bench/walls/walls_record.h"
#include "bench/walls/walls_table.h"
#include "tests/fresh_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <unistd.h>

namespace stadion::bench {
namespace {

using Kind = WallsFinding::Kind;

/// A row as it comes from a program.
nlohmann::json row(const WallsCase& c, nlohmann::json figures) {
  return completed(c, std::move(figures));
}

/// The finding whose text begins so.
WallsFinding finding(const std::vector<WallsFinding>& all, const std::string& begin) {
  const auto it = std::ranges::find_if(all, [&](const WallsFinding& f) { return f.what.starts_with(begin); });
  EXPECT_NE(it, all.end()) << begin << "\n" << textOf(all);
  return it == all.end() ? WallsFinding{} : *it;
}

/// Scene a with OpenSceneGraph at 10 (DPC) and 8 frames a second (CTPC).
WallsResults sceneA(double fps, double latency, double processor) {
  WallsResults r;
  r.add(row(osgCase("a", false, "STRICT", "DPC"),
            {{"fps", 10}, {"cpu_cores", 1.6}, {"latency_ms_median", 150}}));
  r.add(row(osgCase("a", false, "STRICT", "CTPC"),
            {{"fps", 8}, {"cpu_cores", 1.6}, {"latency_ms_median", 190}}));
  r.add(
      row(osgCase("a", false, "STRICT", "ST"), {{"fps", 7}, {"cpu_cores", 1.2}, {"latency_ms_median", 140}}));
  r.add(row(ourCase("a", false, "STRICT"),
            {{"fps", fps}, {"latency_ms_median", latency}, {"cpu_ms_per_frame", processor}}));
  return r;
}

TEST(WallsBench, FramesASecondAreComparedWithTheFasterConfiguration) {
  const WallsResults r = sceneA(13.9, 139, 127);
  EXPECT_EQ(bestOsg(r, "a", false, "STRICT"), nameOf(osgCase("a", false, "STRICT", "DPC")));
  const auto all = judgeTable(r, {"a"});
  const WallsFinding speed = finding(all, "a STRICT: frames a second, of OpenSceneGraph's DPC");
  EXPECT_EQ(speed.kind, Kind::Missed);
  EXPECT_NEAR(speed.value, 1.39, 1e-9);
  EXPECT_EQ(finding(judgeTable(sceneA(14, 139, 127), {"a"}), "a STRICT: frames").kind, Kind::Met);
}

TEST(WallsBench, LatencyIsComparedWithTheSingleThreadedOne) {
  EXPECT_EQ(finding(judgeTable(sceneA(14, 140, 127), {"a"}), "a STRICT: latency").kind, Kind::Met);
  EXPECT_EQ(finding(judgeTable(sceneA(14, 141, 127), {"a"}), "a STRICT: latency").kind, Kind::Missed);
}

TEST(WallsBench, ProcessorTimeIsThatOfTheConfigurationThatFramesASecondAreComparedWith) {
  // 1.6 processors at 10 frames a second: 160 ms.
  EXPECT_EQ(finding(judgeTable(sceneA(14, 139, 128), {"a"}), "a STRICT: processor").kind, Kind::Met);
  EXPECT_EQ(finding(judgeTable(sceneA(14, 139, 129), {"a"}), "a STRICT: processor").kind, Kind::Missed);
}

TEST(WallsBench, TheMedianOfTheRoundsCounts) {
  WallsResults r = sceneA(14, 139, 127);
  r.add(row(ourCase("a", false, "STRICT"), {{"fps", 1}}));
  r.add(row(ourCase("a", false, "STRICT"), {{"fps", 15}}));
  EXPECT_EQ(finding(judgeTable(r, {"a"}), "a STRICT: frames").kind, Kind::Met);
}

TEST(WallsBench, WithoutOpenSceneGraphThereIsNothingToMissBesideTheFloor) {
  WallsResults r;
  r.add(row(ourCase("a", false, "STRICT"), {{"fps", 3}, {"cpu_ms_per_frame", 300}}));
  r.add(row(oneWall(ourCase("a", false, "STRICT")), {{"cpu_ms_per_frame", 31}}));
  r.add(row(oneWall(floorCase("a", "STRICT")), {{"cpu_ms_per_frame", 30}}));
  const auto all = judgeTable(r, {"a"});
  EXPECT_EQ(finding(all, "a STRICT: frames").kind, Kind::Void);
  EXPECT_EQ(finding(all, "a STRICT: processor time of one view").kind, Kind::Met);
  EXPECT_TRUE(noneMissed(all));
  r.add(row(oneWall(ourCase("a", false, "STRICT")), {{"cpu_ms_per_frame", 40}}));
  EXPECT_FALSE(noneMissed(judgeTable(r, {"a"})));
}

TEST(WallsBench, CullAndAppAreComparedBetweenProgramsThatUseOneThread) {
  WallsResults r;
  r.add(row(osgCase("c", true, "STRICT", "ST"), {{"cull_ms_sum", 100}}));
  r.add(row(osgCase("c", false, "STRICT", "ST"), {{"cull_ms_sum", 30}}));
  r.add(row(ourCase("c", true, "STRICT", "sequential"), {{"cull_ms_sum", 2}}));
  r.add(row(ourCase("c", false, "STRICT", "sequential"), {{"cull_ms_sum", 2.1}}));
  r.add(row(osgCase("b", false, "STRICT", "ST"), {{"app_ms", 0.8}}));
  r.add(row(ourCase("b", false, "STRICT", "sequential"), {{"app_ms", 0.11}}));
  const auto all = judgeTable(r, {"b", "c"});
  EXPECT_EQ(finding(all, "c flat: Cull").kind, Kind::Met);
  EXPECT_EQ(finding(all, "c grid: Cull").kind, Kind::Missed);
  EXPECT_EQ(finding(all, "b: App").kind, Kind::Missed);
}

TEST(WallsBench, UnevenFramesCountOnlyOnACalmMachine) {
  WallsResults r;
  r.add(row(lockedCase(), {{"frame_ms_median", 33}, {"frame_ms_p99", 50}}));
  EXPECT_EQ(finding(judgeTable(r, {"c"}), "c flat STRICT on ticks").kind, Kind::Void);
  r.add(row(controlCase(), {{"frame_ms_median", 16.6}, {"frame_ms_p99", 16.8}}));
  EXPECT_EQ(finding(judgeTable(r, {"c"}), "c flat STRICT on ticks").kind, Kind::Missed);
  for (int i = 0; i < 2; ++i) r.add(row(controlCase(), {{"frame_ms_median", 16.6}, {"frame_ms_p99", 25}}));
  EXPECT_EQ(finding(judgeTable(r, {"c"}), "c flat STRICT on ticks").kind, Kind::Void);
}

TEST(WallsBench, PicturesMayDifferInOnePixelOfAThousand) {
  WallsResults r;
  r.add({{"case", "pictures a STRICT"}, {"beyond_share", 0.0009}, {"worst", 200}});
  r.add({{"case", "pictures a OPEN"}, {"beyond_share", 0.0011}, {"worst", 3}});
  const auto all = judgeTable(r, {"a"});
  EXPECT_EQ(finding(all, "a STRICT: pixels").kind, Kind::Met);
  EXPECT_EQ(finding(all, "a OPEN: pixels").kind, Kind::Missed);
  EXPECT_NE(picturesOf(r).find("0.1100 %"), std::string::npos) << picturesOf(r);
}

TEST(WallsBench, OfPicturesThatHaveNoThousandPixelsThoseOfAllViewsCountTogether) {
  constexpr double kOne = 1.0 / (32 * 24);
  for (const double views : {6.0, 10.0}) {  // of twelve, that have one such pixel each
    WallsResults r;
    r.add({{"case", "pictures a SUBMIT"},
           {"width", 32},
           {"height", 24},
           {"beyond_share", kOne},
           {"beyond_share_frame", kOne * views / 12},
           {"worst_view", "front_R"},
           {"worst", 45}});
    EXPECT_EQ(finding(judgeTable(r, {"a"}), "a SUBMIT: pixels within 2/255 of OpenSceneGraph's, all").kind,
              views > 9 ? Kind::Missed : Kind::Met);
    EXPECT_NE(picturesOf(r).find("1 of 768 (0.1302 %) of one view, front_R"), std::string::npos)
        << picturesOf(r);
  }
}

TEST(WallsBench, PicturesAreComparedOfWhatIsMeasured) {
  for (const char* drawnBy : {"thread", "process"}) {
    const auto words = wordsFor(ourPictures({"a", "SUBMIT", drawnBy}), {"stadion", "", ""});
    const auto at = std::ranges::find(words, "--wall-workers");
    ASSERT_LT(at + 1, words.end());
    EXPECT_EQ(*(at + 1), drawnBy);
  }
}

TEST(WallsBench, BothLayoutsOfSceneCAreComparedWhereRasterisingIsNotTheLimit) {
  std::set<std::string> names;
  for (const WallsCase& c : tableCases({})) names.insert(nameOf(c));
  for (const bool flat : {true, false})
    for (const WallsCase& c : {ourCase("c", flat, "SUBMIT"), osgCase("c", flat, "SUBMIT", "DPC"),
                               osgCase("c", flat, "SUBMIT", "CTPC")})
      EXPECT_TRUE(names.contains(nameOf(c))) << nameOf(c);
  EXPECT_EQ(finding(judgeTable({}, {"c"}), "c flat SUBMIT: frames a second").limit, 3.5);
}

TEST(WallsBench, AMillionNodesAreJudgedByWhatTheyCostMoreThanAHundredThousand) {
  WallsResults r;
  r.add(row(scalingCase(100'000, "stadion"), {{"held_mb", 100}}));
  r.add(row(scalingCase(1'000'000, "stadion"), {{"held_mb", 290}, {"app_ms", 0.05}, {"cull_ms_sum", 2.5}}));
  const auto all = judgeScaling(r);
  EXPECT_EQ(finding(all, "1 000 000 nodes, 100 moving").kind, Kind::Met);
  EXPECT_EQ(finding(all, "1 000 000 nodes, 1 % seen").kind, Kind::Missed);
  EXPECT_EQ(finding(all, "memory").kind, Kind::Missed);
}

TEST(WallsBench, ARowOfOpenSceneGraphSaysWhatOursSay) {
  const nlohmann::json r =
      row(osgCase("c", false, "SUBMIT", "CTPC"),
          {{"engine", "OSG 3.6.5"}, {"fps", 20}, {"cpu_cores", 1.5}, {"frame_ms_max", 60}});
  EXPECT_EQ(r["engine"], "osg");
  EXPECT_EQ(r["engine_version"], "OSG 3.6.5");
  EXPECT_EQ(r["class"], "SUBMIT");
  EXPECT_EQ(r["mode"], "CTPC");
  EXPECT_EQ(r["width"], 32);
  EXPECT_EQ(r["flat"], 0);
  EXPECT_EQ(r["cpu_ms_per_frame"], 75);
  EXPECT_EQ(r["frame_ms_p99"], 60);
}

TEST(WallsBench, EveryCaseHasANameOfItsOwn) {
  std::set<std::string> names;
  std::size_t count = 0;
  for (const auto& cases : {tableCases({}), scalingCases({})})
    for (const WallsCase& c : cases) names.insert(nameOf(c)), ++count;
  // Scene a with four walls is in the table and on the curves, for each engine; so is the floor of one wall.
  EXPECT_EQ(names.size(), count - 4);
}

TEST(WallsBench, WhatIsNotBuiltIsNotCalled) {
  for (const WallsCase& c : tableCases({{"a", "b", "c"}, false, false, {}}))
    EXPECT_TRUE(c.engine == "stadion" || c.engine == "control") << nameOf(c);
}

const RecordHead kNow{"b1", "a box", "process", 1'800'000'000};

class WallsRecordFile : public ::testing::Test {
protected:
  ~WallsRecordFile() override { std::filesystem::remove(file_); }
  /// What readRecord() says of this content; empty: nothing is wrong.
  std::string wrong(const std::string& content, const RecordHead& now = kNow) {
    std::ofstream(file_) << content;
    const auto read = readRecord(file_, now);
    if (read) rows_ = read.value().rows.size(), begun_ = read.value().head.begun;
    return read ? std::string() : format(read.error());
  }
  const FreshFolder folder_;
  const std::string file_ = folder_ / "record";
  std::size_t rows_ = 0;
  std::int64_t begun_ = 0;
};

TEST_F(WallsRecordFile, IsReadUpToALineThatWasCutOff) {
  const std::string head = lineOf(kNow) + "\n";
  const std::string rows = "{\"case\":\"x\",\"fps\":1}\n{\"case\":\"x\",\"fps\":2}\n";
  EXPECT_EQ(wrong(head + rows + "{\"case\":\"x\","), "");
  EXPECT_EQ(rows_, 2u);
  EXPECT_NE(wrong(head + "{\"case\":\"x\"}\nnonsense\n{\"case\":\"x\"}\n").find(":3"), std::string::npos);
  std::filesystem::remove(file_);
  const auto nothing = readRecord(file_, kNow);
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing.value().rows.empty());
  EXPECT_EQ(lineOf(nothing.value().head), lineOf(kNow));
}

TEST_F(WallsRecordFile, OfAnotherBuildMachineSettingOrDayIsNotGoneOnWith) {
  const std::string rows = "\n{\"case\":\"x\",\"fps\":1}\n";
  RecordHead then = kNow;
  then.begun -= 3600;
  EXPECT_EQ(wrong(lineOf(then) + rows), "");
  EXPECT_EQ(begun_, then.begun) << "when it was begun is not forgotten";
  const auto says = [&](RecordHead other, const std::string& what) {
    const std::string said = wrong(lineOf(other) + rows);
    EXPECT_NE(said.find(what), std::string::npos) << said;
    EXPECT_NE(said.find("give another --record FILE"), std::string::npos) << said;
    EXPECT_NE(said.find(":1"), std::string::npos) << said;
  };
  RecordHead other = kNow;
  other.build = "b2", says(other, "another build");
  other = kNow, other.machine = "a tower", says(other, "another machine (a tower; this one is a box)");
  other = kNow, other.drawnBy = "thread", says(other, "--wall-workers thread, not process");
  other = kNow, other.begun -= 24 * 3600, says(other, "more than half a day");
  EXPECT_NE(wrong(rows.substr(1)).find("is no record"), std::string::npos) << "of a build that wrote no head";
}

/// Every element is closed, in order.
bool wellFormed(const std::string& svg) {
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = svg.substr(at + 1, end - at - 1);
    if (tag.ends_with('/')) continue;
    if (!tag.starts_with('/')) {
      open.push_back(tag.substr(0, tag.find(' ')));
      continue;
    }
    if (open.empty() || open.back() != tag.substr(1)) return false;
    open.pop_back();
  }
  return open.empty();
}

TEST(WallsBench, PlotsAreWellFormedAndShowWhatWasMeasured) {
  WallsResults r = sceneA(14, 139, 127);
  r.add(row(floorCase("a", "STRICT"), {{"fps", 9}, {"cpu_ms_per_frame", 110}}));
  const std::string plot = wallsPlot(r);
  EXPECT_TRUE(wellFormed(plot));
  EXPECT_NE(plot.find(">14.0 fps<"), std::string::npos);
  EXPECT_NE(plot.find(">160.0 ms<"), std::string::npos);
  EXPECT_EQ(plot.find("nan"), std::string::npos);
  r.add(row(scalingCase(1000, "stadion"), {{"app_ms", 0.01}, {"cull_ms_sum", 0.1}, {"draw_ms_sum", 1}}));
  EXPECT_TRUE(wellFormed(scalingPlot(r)));
  EXPECT_TRUE(wellFormed(wallsPlot({})));
  EXPECT_TRUE(wellFormed(scalingPlot({})));
}

TEST(WallsBench, TheTableHasALineForEachCaseWithRatiosToTheBest) {
  const std::string table = tableOf(sceneA(14, 139, 128));
  EXPECT_NE(table.find("stadion a STRICT pipelined"), std::string::npos) << table;
  EXPECT_NE(table.find("1.40   0.80"), std::string::npos) << table;
}

TEST(WallsBench, PicturesAreReadAsTheyWereWritten) {
  const FreshFolder folder;
  const std::string file = folder / "picture.ppm";
  const RgbPicture p{2, 1, {1, 2, 3, 10, 13, 30}};
  ASSERT_TRUE(writePpm(file, p));
  const auto read = readPpm(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(read);
  EXPECT_EQ(read.value().rgb, p.rgb);
  const PictureDifference d = difference(p, {2, 1, {3, 2, 3, 7, 13, 30}});
  EXPECT_EQ(d.beyond, 0.5);
  EXPECT_EQ(d.worst, 3);
  EXPECT_FALSE(readPpm(file));
}

TEST(WallsBench, TheScenesAreThoseOfTheDefinition) {
  const auto nodes = wallNodes({'c'});
  ASSERT_EQ(nodes.size(), 100'000u);
  for (const WallNode& n : nodes) {
    ASSERT_LE(std::abs(n.position.x()), 100);
    ASSERT_LE(std::abs(n.position.z()), 15);
  }
  EXPECT_EQ(wallMesh({'a'}, 3).indices.size(), 300u);
  EXPECT_EQ(wallMesh({'a'}, 3).vertices.size(), 77u);
  EXPECT_EQ(wallMesh({'c'}, 3).vertices.size(), 12u);
  const WallScene b{'b'}, some{'c', 1'000'000, 100, 12};
  std::size_t moving = 0;
  for (std::size_t i = 0; i < b.nodes(); ++i) moving += b.moves(i);
  EXPECT_EQ(moving, 2000u);
  moving = 0;
  for (std::size_t i = 0; i < some.nodes(); ++i) moving += some.moves(i);
  EXPECT_EQ(moving, 100u);
}

TEST(WallsBench, AnEyeSeesTheCornersOfItsWallInTheCornersOfThePicture) {
  const double t = 2.3;
  for (std::size_t wall = 0; wall < 6; ++wall)
    for (const int eye : {0, 1}) {
      const WallView view = wallView({'a'}, wall, eye, t);
      const RoomWall& w = roomWalls()[wall];
      const auto shown = [&](const Vec3& corner) {
        const Vec4 clip = view.projection * view.view * (platformAt(t) * corner).homogeneous();
        return Vec3(clip.head<3>() / clip[3]);
      };
      EXPECT_TRUE(shown(w.lowerLeft).head<2>().isApprox(Vec2(-1, -1), 1e-9)) << w.name;
      EXPECT_TRUE(shown(w.lowerRight).head<2>().isApprox(Vec2(1, -1), 1e-9)) << w.name;
      EXPECT_TRUE(shown(w.upperLeft).head<2>().isApprox(Vec2(-1, 1), 1e-9)) << w.name;
    }
}

}  // namespace
}  // namespace stadion::bench
