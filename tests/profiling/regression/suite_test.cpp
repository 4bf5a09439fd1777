#include "profiling/regression/suite.h"
#include "tests/mutations.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace stadion::regression {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = fs::path(STADION_SOURCE_DIR) / "tests/corpus/suites";

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string listing(const Diagnostics& findings, const std::string& folder = {}) {
  std::string all;
  for (const Diagnostic& d : findings.all())
    all += std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + d.message + "\n";
  for (std::size_t at; !folder.empty() && (at = all.find(folder)) != all.npos;) all.erase(at, folder.size());
  return all;
}

std::optional<Suite> parsed(const std::string& text, Diagnostics& out) {
  return parseSuite(text, "suites/t.suite", out);
}

TEST(RegressionSuite, HasWhatItsStatementsSay) {
  Diagnostics out;
  const auto suite = parsed(R"(stadion-suite 1
size 96x72   # of every case
walls desktop
tolerance times 4.5
case kick
  show ../kick.evs
  input ../kick.input
  modes sequential, pipelined
  frames 180
  rate 90
  compare state counts times
  rounds 12
case walk
  show walk.evs
  walls small.walls
  stereo off
  look plain
  size 32x24
  input none
  tolerance instructions 0.1
  asset-root ../models
)",
                            out);
  ASSERT_TRUE(suite) << listing(out);
  ASSERT_EQ(suite->cases.size(), 2u);
  const SuiteCase &kick = suite->cases[0], &walk = suite->cases[1];
  EXPECT_EQ(kick.name, "kick");
  EXPECT_EQ(kick.show, "kick.evs") << "relative to the suite's folder";
  EXPECT_EQ(kick.input, "kick.input");
  EXPECT_EQ(kick.modes, (std::vector<std::string>{"sequential", "pipelined"}));
  EXPECT_EQ(kick.size, "96x72");
  EXPECT_EQ(kick.walls, "desktop");
  EXPECT_EQ(kick.frames, 180u);
  EXPECT_EQ(kick.rate, 90);
  EXPECT_EQ(kick.rounds, 12u);
  EXPECT_TRUE(kick.metrics.state && kick.metrics.counts && kick.metrics.times);
  EXPECT_FALSE(kick.metrics.images || kick.metrics.instructions);
  EXPECT_EQ(kick.tolerances.times, 4.5);
  EXPECT_EQ(walk.show, "suites/walk.evs");
  EXPECT_EQ(walk.walls, "suites/small.walls");
  EXPECT_EQ(walk.input, "none");
  EXPECT_EQ(walk.size, "32x24");
  EXPECT_EQ(walk.stereo, "off");
  EXPECT_EQ(walk.look, "plain");
  EXPECT_EQ(kick.look, "full");
  EXPECT_EQ(walk.modes, std::vector<std::string>{"sequential"});
  EXPECT_EQ(walk.tolerances.instructions, 0.1);
  EXPECT_EQ(walk.tolerances.times, 4.5);
  EXPECT_TRUE(walk.metrics.state && walk.metrics.images && walk.metrics.counts);
  EXPECT_EQ(walk.assetRoots, std::vector<std::string>{"models"});
}

TEST(RegressionSuite, CasesOfAnotherLookHaveAnotherName) {
  Diagnostics out;
  const auto suite =
      parsed("stadion-suite 1\nlook plain\ncase a\nshow a.evs\ncase b\nshow a.evs\nlook full\n", out);
  ASSERT_TRUE(suite) << listing(out);
  EXPECT_EQ(playedName(suite->cases[0], "pipelined"), "a/pipelined/plain") << "of every case";
  EXPECT_EQ(playedName(suite->cases[1], "pipelined"), "b/pipelined");
}

TEST(RegressionSuite, WithMistakesIsToldWhereAndWhatToDo) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(kCorpus)) {
    if (entry.path().extension() != ".suite") continue;
    ++files;
    Diagnostics out;
    const bool looksForFiles = entry.path().stem() == "lost_files";
    EXPECT_FALSE(looksForFiles ? loadSuite(entry.path(), out)
                               : parseSuite(content(entry.path()), entry.path(), out))
        << entry.path();
    const std::string found = listing(out, kCorpus.string() + "/");
    fs::path golden = entry.path();
    golden.replace_extension(".expected");
    // STADION_WRITE_EXPECTED=1 updates the listings; read them before they are committed.
    if (std::getenv("STADION_WRITE_EXPECTED")) std::ofstream(golden) << found;
    EXPECT_EQ(found, content(golden)) << entry.path();
    EXPECT_FALSE(found.empty()) << entry.path();
  }
  EXPECT_GT(files, 10u);
}

TEST(RegressionSuite, ThatIsNotThereOrIsAFolderIsAnError) {
  Diagnostics out;
  EXPECT_FALSE(loadSuite("/there/is/none.suite", out));
  EXPECT_FALSE(loadSuite(kCorpus, out));
  EXPECT_EQ(out.errorCount(), 2u);
}

TEST(RegressionSuite, ThatIsDamagedIsReadOrRefusedButNeverWithoutAReason) {
  std::vector<std::string> seeds;
  for (const auto& entry : fs::directory_iterator(kCorpus))
    if (entry.path().extension() == ".suite") seeds.push_back(content(entry.path()));
  seeds.push_back(
      "stadion-suite 1\nsize 9x9\ncase a\nshow a.evs\nmodes pipelined\ncompare times\nrounds 19\n");
  const test::Mutations asked = test::mutations(2000);
  std::mt19937_64 random(asked.seed);
  constexpr std::string_view kBytes = "\n\n #x0-1.,/casehowmdt\x80\xff\t";
  for (int i = 0; i < asked.count; ++i) {
    std::string text = seeds[random() % seeds.size()];
    for (std::uint64_t n = 1 + random() % 6; n > 0; --n) {
      const std::size_t at = random() % (text.size() + 1);
      if (random() % 3 == 0)
        text.erase(at, random() % 9);
      else
        text.insert(at, 1, kBytes[random() % kBytes.size()]);
    }
    Diagnostics out;
    const auto suite = parsed(text, out);
    EXPECT_EQ(suite.has_value(), !out.hasErrors());
    for (const SuiteCase& c : suite ? suite->cases : std::vector<SuiteCase>()) {
      EXPECT_FALSE(c.name.empty());
      EXPECT_FALSE(c.show.empty());
    }
  }
}

}  // namespace
}  // namespace stadion::regression
