/// What `--json` prints in the commands that check and measure: one object, or one a line.

#include "tests/cli/short_run.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <iterator>
#include <map>
#include <sstream>

namespace stadion {
namespace {

using nlohmann::json;

/// Each line is an object by itself.
std::vector<json> objectsIn(const std::string& out) {
  std::vector<json> objects;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    const json object = json::parse(line, nullptr, false);
    EXPECT_TRUE(object.is_object()) << line.substr(0, 200);
    objects.push_back(object);
  }
  return objects;
}

TEST(ProgramJson, CheckTellsTheFindingsOfEachScript) {
  const TestFolder folder;
  const std::string wrong = folder.write("wrong.evs", "dynobject( name=a, densty=2 )\n");
  const ProgramResult r =
      stadionProgram({"check", wrong, testShow("bodies.evs"), "--asset-root", assetFolder(), "--json"});
  EXPECT_EQ(r.status, 2);
  const std::vector<json> objects = objectsIn(r.out);
  ASSERT_EQ(objects.size(), 1U) << r.out;
  EXPECT_EQ(objects[0].at("ok"), false);
  const json& shows = objects[0].at("shows");
  ASSERT_EQ(shows.size(), 2U);
  EXPECT_EQ(shows[0].at("file"), wrong);
  EXPECT_TRUE(std::ranges::any_of(shows[0].at("findings"), [](const json& finding) {
    return finding.at("severity") == "error" && finding.at("line") == 1 && finding.at("column") == 20;
  })) << r.out;
  EXPECT_EQ(shows[1].at("ok"), true);
}

TEST(ProgramJson, WallsTellsCornersAndThreads) {
  const std::vector<json> objects = objectsIn(stadionProgram({"walls", "cave4", "--json"}).out);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].at("walls").size(), 4U);
  EXPECT_EQ(objects[0].at("walls")[0].at("lower_left_m").size(), 3U);
  EXPECT_EQ(objects[0].at("threads").at("cull"), 4);
  const ProgramResult wrong = stadionProgram({"walls", "/nowhere.walls", "--json"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(objectsIn(wrong.out).at(0).at("ok"), false) << wrong.out;
}

TEST(ProgramJson, HashPrintsAnObjectALine) {
  const std::vector<std::string> words{
      "hash", testShow("bodies.evs"), "--asset-root", assetFolder(), "--frames", "3"};
  std::vector<std::string> asked = words;
  asked.emplace_back("--json");
  std::string lines;
  for (const json& object : objectsIn(stadionProgram(asked).out))
    lines +=
        std::to_string(object.at("frame").get<int>()) + " " + object.at("hash").get<std::string>() + "\n";
  EXPECT_EQ(lines, stadionProgram(words).out);
}

TEST(ProgramJson, SoakTellsItsVerdicts) {
  const ProgramResult r =
      stadionProgram({"soak", "--frames", "1000", "--visit", "1000", "--no-memory", "--json"});
  EXPECT_EQ(r.status, 0) << r.err;
  const std::vector<json> objects = objectsIn(r.out);
  ASSERT_EQ(objects.size(), 1U) << r.out;
  EXPECT_EQ(objects[0].at("ok"), true);
  EXPECT_EQ(objects[0].at("frames"), 1000);
  EXPECT_GE(objects[0].at("verdicts").size(), 2U);
}

TEST(ProgramJson, BenchFlightPrintsAnObjectALine) {
  const ProgramResult r = stadionProgram({"bench", "flight", "--flights", "1", "--rounds", "1", "--json"});
  const std::vector<json> objects = objectsIn(r.out);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].at("bench"), "flight");
}

TEST(ProgramJson, BenchBudgetsPrintsAnObjectALine) {
  const ProgramResult r = stadionProgram(
      {"bench", "budgets", "--stall-time", "0.5", "--recovery", "1", "--quiet", "1", "--json"});
  EXPECT_TRUE(r.status == 0 || r.status == 1) << r.err;  // a busy machine may miss its limits
  const std::vector<json> objects = objectsIn(r.out);
  EXPECT_GT(objects.size(), 5U) << r.out;
  for (const json& object : objects) EXPECT_EQ(object.value("bench", ""), "budgets");
}

TEST(ProgramJson, EveryBenchTakesIt) {
  const std::string page = fileContent(STADION_SOURCE_DIR "/docs/options.md");
  const std::size_t row = page.find("| `--json` |");
  ASSERT_NE(row, std::string::npos);
  const std::string line = page.substr(row, page.find('\n', row) - row);
  for (const char* bench : {"overlap", "dynamics", "flight", "detection", "plan", "budgets", "attribution",
                            "prediction", "recording", "walls", "scale"})
    EXPECT_TRUE(has(line, std::string("bench ") + bench)) << bench;
}

/// All that have --json, by the page of options.
std::vector<std::string> commandsWithJson() {
  const std::string page = fileContent(STADION_SOURCE_DIR "/docs/options.md");
  const std::size_t row = page.find("| `--json` |"), end = page.find(" |\n", row);
  std::istringstream names(page.substr(page.rfind("| ", end - 1) + 2, end - page.rfind("| ", end - 1) - 2));
  std::vector<std::string> commands;
  for (std::string name; std::getline(names, name, ',');)
    commands.push_back(name.substr(name.starts_with(' ')));
  return commands;
}

// Those without an input get an option that they do not have.
TEST(ProgramJson, AMissingFileIsOneObjectInEachCommand) {
  const TestFolder folder;
  const std::string missing = folder.path() / "nosuch";
  const std::map<std::string, std::vector<std::string>> inputs{{"run", {missing}},
                                                               {"check", {missing}},
                                                               {"hash", {missing}},
                                                               {"walls", {missing}},
                                                               {"projectors", {missing, "status"}},
                                                               {"tracker", {"--tracker", "nosuch"}},
                                                               {"cluster", {missing, missing}},
                                                               {"doctor", {"--for", missing}},
                                                               {"profile", {missing}},
                                                               {"plan", {missing}},
                                                               {"regress", {missing}},
                                                               {"soak", {missing}},
                                                               {"calibrate", {"--walls", missing}},
                                                               {"bench dynamics", {"nosuch"}},
                                                               {"bench plan", {missing}},
                                                               {"bench prediction", {missing}}};
  const std::vector<std::string> commands = commandsWithJson();
  ASSERT_GT(commands.size(), 20U);
  for (const auto& [command, none] : inputs) EXPECT_NE(std::ranges::find(commands, command), commands.end());
  for (const std::string& command : commands) {
    std::istringstream parts(command);
    std::vector<std::string> words{std::istream_iterator<std::string>(parts), {}};
    const auto input = inputs.find(command);
    for (const std::string& word :
         input != inputs.end() ? input->second : std::vector<std::string>{"--nosuch"})
      words.push_back(word);
    words.emplace_back("--json");
    words.insert(words.begin(), stadionPath());
    const ProgramResult r = runProgram({words, {"STADION_CALIBRATION=" + missing + ".json"}});
    EXPECT_EQ(r.status, 2) << command << ": " << r.err;
    const std::vector<json> objects = objectsIn(r.out);
    ASSERT_EQ(objects.size(), 1U) << command << ": " << r.out << r.err;
    if (command == "check" || command == "walls")
      EXPECT_EQ(objects[0].at("ok"), false);
    else
      EXPECT_TRUE(objects[0].size() == 1 && has(objects[0].value("error", ""), "nosuch"))
          << command << ": " << r.out << r.err;
  }
}

// Each names its cause.
TEST(ProgramJson, AWrongRunIsOneObject) {
  const std::string kick = STADION_SOURCE_DIR "/scripts/kick.evs";
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--walls", "nosuch"}, "nosuch"},
      {{"--input", "nosuch"}, "nosuch"},
      {{"--out", "/proc/x"}, "/proc/x"},
      {{"--mode", "sequential", "--latency", "2"}, "--latency"},
      {{"--guard", "--wall-workers", "process"}, "--guard"}};
  for (const auto& [more, cause] : cases) {
    std::vector<std::string> words{"run", kick, "--json", "--frames", "2"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << cause;
    const std::vector<json> objects = objectsIn(r.out);
    ASSERT_EQ(objects.size(), 1U) << cause << ": " << r.out << r.err;
    EXPECT_TRUE(has(objects[0].value("error", ""), cause)) << r.out << r.err;
  }
}

TEST(ProgramJson, AWrongCommandLineIsAnObjectToo) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"bench", "--json", "flight", "x.json"},
                                             {"hash", "--json"},
                                             {"run", "show.evs", "--json", "--wals", "cave4"},
                                             {"run", "show.evs", "--json", "--guard=off"}}) {
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << words[0];
    const std::vector<json> objects = objectsIn(r.out);
    ASSERT_EQ(objects.size(), 1U) << r.out;
    EXPECT_FALSE(objects[0].at("error").get<std::string>().empty());
  }
}

}  // namespace
}  // namespace stadion
