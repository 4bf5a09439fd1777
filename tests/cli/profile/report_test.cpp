/// `stadion profile --out` and `--trace`: the page in a real browser, the trace of a real run.

#include "tests/profiling/trace/trace_checks.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

#include <sstream>

namespace stadion {
namespace {

namespace fs = std::filesystem;

ProgramResult profile(const std::string& show, const std::vector<std::string>& options,
                      const std::string& frames = "45") {
  std::vector<std::string> words = {"profile", show,     "--frames", frames,    "--size",
                                    "96x72",   "--look", "plain",    "--nodes", "0"};
  words.insert(words.end(), options.begin(), options.end());
  return stadionProgram(words);
}
const std::string kKickShow = STADION_SOURCE_DIR "/scripts/kick.evs";

/// A page as a browser shows it.
struct Shown {
  std::string dom, complaints;
};

/// Chromium, without a window. What it says of the page's script is on its standard error.
class ProgramReport : public testing::Test {
protected:
  void SetUp() override {
    if (runProgram({{"chromium", "--version"}}).status != 0)
      GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  }

  ProgramResult browse(const fs::path& page, const std::string& chosen, const std::string& what,
                       int width = 1400) const {
    return runProgram({{"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                        "--no-first-run", "--hide-scrollbars",
                        "--user-data-dir=" + (folder_.path() / "browser").string(), "--enable-logging=stderr",
                        "--virtual-time-budget=4000", "--window-size=" + std::to_string(width) + ",1000",
                        what, "file://" + page.string() + (chosen.empty() ? "" : "#" + chosen)}});
  }
  Shown shown(const fs::path& page, const std::string& chosen = "") const {
    const ProgramResult r = browse(page, chosen, "--dump-dom");
    EXPECT_EQ(r.status, 0) << r.err;
    Shown s{r.out, {}};
    std::stringstream said(r.err);
    for (std::string line; std::getline(said, line);)
      if (line.find("CONSOLE") != std::string::npos) s.complaints += line + "\n";
    return s;
  }
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size()))
      ++n;
    return n;
  }
  /// What stands between the element with this id and the next section.
  static std::string part(const std::string& dom, const std::string& id) {
    const std::size_t from = dom.find("id=\"" + id + "\"");
    EXPECT_NE(from, std::string::npos) << id;
    return from == std::string::npos ? "" : dom.substr(from, dom.find("</section>", from) - from);
  }

  TestFolder folder_;
};

TEST_F(ProgramReport, ABrowserFillsItsTablesAndPlotsWithoutAComplaint) {
  const fs::path page = folder_.path() / "profile.html";
  const ProgramResult r = profile(kKickShow, {"--out", folder_.path().string()}, "90");
  ASSERT_EQ(r.status, 0) << r.err;
  const Shown s = shown(page);
  EXPECT_EQ(s.complaints, "");
  EXPECT_NE(s.dom.find("data-drawn=\"yes\""), std::string::npos) << "the page's script ended early";
  EXPECT_GE(count(part(s.dom, "strip"), "<rect"), 80U) << "a column a frame";
  EXPECT_GE(count(part(s.dom, "timeline-plot"), "<rect"), 90U) << "App, Cull and Draw of some frames";
  EXPECT_GE(count(part(s.dom, "flame-plot"), "<rect"), 4U);
  EXPECT_EQ(count(part(s.dom, "histograms"), "<figure"), 10U) << "frame, App, and four walls' Cull and Draw";
  EXPECT_GE(count(part(s.dom, "nodes-table"), "<tr"), 5U);
  EXPECT_EQ(count(part(s.dom, "heat"), "scope=\"row\"") > 2, true) << "two eyes, and nodes";
  EXPECT_NE(part(s.dom, "dynamics-table").find("ball"), std::string::npos) << "the ball's cost and error";
  EXPECT_NE(part(s.dom, "late-say").find("frames that sampling did not disturb"), std::string::npos);
  EXPECT_GE(count(part(s.dom, "stages-table"), "<tr"), 20U);
  EXPECT_NE(part(s.dom, "counts-table").find("triangles"), std::string::npos);
  const std::string seen = s.dom.substr(0, s.dom.find("<script"));
  EXPECT_EQ(count(seen, "NaN") + count(seen, "undefined") + count(seen, ">null"), 0U);

  const fs::path picture = folder_.path() / "page.png";
  const ProgramResult photo = browse(page, "", "--screenshot=" + picture.string(), 800);
  ASSERT_TRUE(fs::exists(picture)) << photo.err;
  EXPECT_GT(fs::file_size(picture), 40'000U) << "its picture is blank";
}

TEST_F(ProgramReport, WhatIsChosenInTheAddressIsShown) {
  const fs::path page = folder_.path() / "profile.html";
  ASSERT_EQ(profile(kKickShow, {"--out", folder_.path().string(), "--walls", "desktop", "--gl", "none"}, "90")
                .status,
            0);
  const Shown s = shown(page, "stage=app&view=one&sort=path");
  EXPECT_EQ(s.complaints, "");
  EXPECT_NE(part(s.dom, "nodes-table").find("aria-sort=\"ascending\""), std::string::npos);
  EXPECT_NE(part(s.dom, "walls-say").find("Nothing was drawn"), std::string::npos);
  EXPECT_NE(part(s.dom, "flame-plot").find("sim_kick"), std::string::npos);
}

TEST_F(ProgramReport, AScriptsNamesAreShownAsTheyAreWritten) {
  const std::string name = "a<script>alert(1)<b onclick=x>&amp;.evs";
  const std::string show =
      folder_.write(name, "object( name=stone, file=\"football.3ds\", position=\"0, 4, 1\" )\n");
  const fs::path page = folder_.path() / "profile.html";
  const ProgramResult r =
      profile(show, {"--out", folder_.path().string(), "--walls", "desktop", "--asset-root", assetFolder()});
  ASSERT_EQ(r.status, 0) << r.err;
  const Shown s = shown(page);
  EXPECT_EQ(s.complaints, "");
  EXPECT_NE(s.dom.find("a&lt;script&gt;alert(1)&lt;b onclick=x&gt;&amp;amp;.evs</h1>"), std::string::npos);
  EXPECT_EQ(s.dom.find("<b onclick"), std::string::npos);
}

/// Many that stand alike, one on its own.
class ProgramReportOfMany : public ProgramReport {
protected:
  void expectAllInTheTable(int pillars) const;
};
class ProgramFullReportOfMany : public ProgramReportOfMany {};

void ProgramReportOfMany::expectAllInTheTable(int pillars) const {
  std::string script = "object( name=ball, file=football.3ds, position=\"0, 3, 1\" )\n";
  for (int i = 0; i < pillars; ++i)
    script += "object( name=pillar_" + std::to_string(i) +
              ", file=suites/pillar.obj, scale=0.4, position=\"" + std::to_string(0.1 * (i % 50 - 25)) +
              ", " + std::to_string(8 + i / 50) + ", 0\" )\n";
  const fs::path page = folder_.path() / "profile.html";
  const ProgramResult r = profile(folder_.write("many.evs", script),
                                  {"--out", folder_.path().string(), "--walls", "desktop", "--asset-root",
                                   STADION_SOURCE_DIR "/scripts", "--asset-root", assetFolder()});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_LT(fs::file_size(page), 1500U * pillars);
  const Shown s = shown(page, "stage=cull&rows=" + std::to_string(pillars + 1));
  EXPECT_EQ(s.complaints, "");
  const std::string flame = part(s.dom, "flame-plot");
  EXPECT_NE(flame.find("\u00d7 pillar_\u2026"), std::string::npos) << "what is alike is one box";
  EXPECT_NE(flame.find("1 to 100 of pillar_\u2026"), std::string::npos);
  EXPECT_GE(count(part(s.dom, "nodes-table"), "<tr"), std::size_t(pillars));
  const Shown zoomed = shown(page, "stage=cull&node=w:object pillar_:0");
  EXPECT_GE(count(part(zoomed.dom, "flame-plot"), "<rect"), 90U) << "a hundred of them, each to be seen";
}

TEST_F(ProgramReportOfMany, NodesThatStandAlikeAreGatheredAndAllInTheTable) {
  expectAllInTheTable(250);
}

TEST_F(ProgramFullReportOfMany, TwoThousandNodesAreGatheredAndAllInTheTable) {
  expectAllInTheTable(2000);
}

TEST(ProgramTrace, TheTraceOfARunIsTakenByAViewerWithoutAComplaint) {
  const TestFolder folder;
  for (const std::string mode : {"pipelined", "sequential"}) {
    const fs::path file = folder.path() / (mode + ".json");
    const ProgramResult r =
        profile(kKickShow, {"--trace", file.string(), "--mode", mode, "--trace-frames", "10..40"});
    ASSERT_EQ(r.status, 0) << r.err;
    const TraceChecks seen(fileContent(file));
    EXPECT_EQ(seen.complaints(), std::vector<std::string>()) << mode;
    EXPECT_EQ(seen.flows(), 31U * 4);
    EXPECT_EQ(*seen.frames().begin(), 10U);
    EXPECT_EQ(*seen.frames().rbegin(), 40U);
    EXPECT_TRUE(seen.names().contains("dummy_leg") && seen.names().contains("left eye"));
    EXPECT_EQ(seen.threadNames().contains("Cull floor"), mode == "pipelined");
  }
}

TEST(ProgramTrace, ALiveRunIsTracedToo) {
  const TestFolder folder;
  const fs::path file = folder.path() / "live.json";
  const ProgramResult r = stadionProgram({"run", kKickShow, "--frames", "40", "--size", "96x72", "--walls",
                                          "desktop", "--look", "plain", "--trace", file.string()});
  ASSERT_EQ(r.status, 0) << r.err;
  const TraceChecks seen(fileContent(file));
  EXPECT_EQ(seen.complaints(), std::vector<std::string>());
  EXPECT_EQ(seen.flows(), 40U);
}

TEST(ProgramTrace, AShortRunIsTracedFromItsFirstFrameOn) {
  const TestFolder folder;
  for (const char* command : {"profile", "run"})
    for (const char* mode : {"pipelined", "sequential"}) {
      const std::string file = folder.path() / (std::string(command) + mode + ".json");
      const ProgramResult r =
          stadionProgram({command, kKickShow, "--frames", "5", "--size", "32x24", "--walls", "desktop",
                          "--look", "plain", "--mode", mode, "--trace", file});
      ASSERT_EQ(r.status, 0) << r.err;
      const TraceChecks seen(fileContent(file));
      EXPECT_EQ(seen.complaints(), std::vector<std::string>()) << command << mode;
      EXPECT_EQ(seen.frames(), (std::set<std::uint64_t>{0, 1, 2, 3, 4})) << command << mode;
      EXPECT_EQ(seen.flows(), 5U) << command << mode << ": each frame goes through App, Cull and Draw";
    }
}

TEST(ProgramTrace, FramesAfterTheRunsEndAreSaidToBeMissing) {
  const TestFolder folder;
  const std::string file = folder.path() / "trace.json";
  for (const char* command : {"profile", "run"}) {
    const ProgramResult r =
        stadionProgram({command, kKickShow, "--frames", "20", "--size", "32x24", "--walls", "desktop",
                        "--look", "plain", "--trace", file, "--trace-frames", "100..160"});
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.err.find("warning: the trace leaves out frames 100 to 160: the run ended with frame 19"),
              std::string::npos)
        << r.err;
  }
}

TEST(ProgramTrace, WhatCannotBeWrittenIsSaidBeforeAnythingIsPlayed) {
  const ProgramResult r = profile(kKickShow, {"--trace", "/nowhere/trace.json"});
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("/nowhere/trace.json"), std::string::npos) << r.err;
  EXPECT_EQ(profile(kKickShow, {"--out", "/proc/nowhere"}).status, 2);
  EXPECT_EQ(profile(kKickShow, {"--trace", "x.json", "--trace-frames", "9..3"}).status, 2);
  EXPECT_EQ(profile(kKickShow, {"--trace-frames", "3..9"}).status, 2);
}

}  // namespace
}  // namespace stadion
