/// `stadion profile --fidelity`, on bodies of which it is known which models do.

#include "tests/programs/program.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

ProgramResult profile(const std::vector<std::string>& options) {
  std::vector<std::string> words = {
      "profile", testShow("models.evs"), "--asset-root", assetFolder(), "--seconds", "1", "--rounds", "1"};
  words.insert(words.end(), options.begin(), options.end());
  return stadionProgram(words);
}

nlohmann::json named(const nlohmann::json& list, const std::string& key, const std::string& name) {
  const auto at = std::find_if(list.begin(), list.end(), [&](const auto& j) { return j[key] == name; });
  EXPECT_NE(at, list.end()) << name;
  return at == list.end() ? nlohmann::json() : *at;
}

bool advises(const nlohmann::json& body, const std::string& model) {
  const auto& advice = body["advice"];
  return std::find(advice.begin(), advice.end(), model) != advice.end();
}

TEST(ProgramFidelity, ABodyThatTouchesNothingMayCollideAsAnything) {
  const ProgramResult r = profile({"--fidelity", "--json", "--body", "free"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto show = nlohmann::json::parse(r.out);
  EXPECT_EQ(show["bodies"].size(), 4u);
  const auto body = named(show["bodies"], "name", "free");
  EXPECT_EQ(body["shape"], "mesh");
  EXPECT_EQ(body["line"], 5);
  EXPECT_EQ(body["flight_frames"]["exact"], 61);
  EXPECT_LT(body["error_m"].get<double>(), 1e-9);
  EXPECT_GT(body["cost_us"].get<double>(), 0);
  for (const char* shape : {"shape=sphere", "shape=box", "shape=capsule", "shape=cylinder", "shape=convex"})
    EXPECT_TRUE(advises(body, shape)) << shape;
  EXPECT_TRUE(named(show["bodies"], "name", "lies")["models"].empty()) << "it was not asked for";
  EXPECT_EQ(named(show["bodies"], "name", "lies")["frames"]["rest"], 61);
}

TEST(ProgramFidelity, LeavingDragOutIsAModelToo) {
  const auto models = [](const char* millimetres) {
    const ProgramResult r = profile({"--fidelity", "--json", "--body", "drags", "--tolerance", millimetres});
    EXPECT_EQ(r.status, 0) << r.err;
    return named(nlohmann::json::parse(r.out)["bodies"], "name", "drags");
  };
  const auto strict = models("1"), lenient = models("500");
  EXPECT_GE(strict["flight_frames"]["order 16"], 58);
  const auto without = named(strict["models"], "model", "without air");
  EXPECT_GT(without["error_m"].get<double>(), 0.2);
  EXPECT_NEAR(without["beyond_from_s"].get<double>(), 0.25, 0.05);
  EXPECT_FALSE(advises(strict, "without air"));
  EXPECT_TRUE(advises(lenient, "without air"));
}

TEST(ProgramFidelity, TheContactSchemeOfThePaperIsAModel) {
  const ProgramResult r = profile({"--fidelity", "--json", "--body", "bounces"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto body = named(nlohmann::json::parse(r.out)["bodies"], "name", "bounces");
  const auto paper = named(body["models"], "model", "impact=paper");
  EXPECT_GT(paper["error_m"].get<double>(), 1e-5);
  EXPECT_LT(paper["error_m"].get<double>(), 0.05);
}

TEST(ProgramFidelity, AShapeThatBouncesOtherwiseIsBeyondTheTolerance) {
  const ProgramResult r = profile({"--fidelity", "--json", "--body", "bounces"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto body = named(nlohmann::json::parse(r.out)["bodies"], "name", "bounces");
  EXPECT_TRUE(body["models"][0]["finest"].get<bool>());
  EXPECT_EQ(body["models"][0]["error_m"], 0);
  EXPECT_LT(body["error_m"].get<double>(), 1e-6);
  EXPECT_GT(named(body["models"], "model", "shape=box")["error_m"].get<double>(), 0.01);
}

TEST(ProgramFidelity, TheTableSaysItInWords) {
  const ProgramResult r = profile({"--fidelity", "--most", "1"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out.find("61 frames at 60 Hz, 4 bodies"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("the finest"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("As it is it stays within 1 mm"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("Not played with other models"), std::string::npos) << r.out;
}

TEST(ProgramFidelity, MistakesAreReportedWithTheirMend) {
  const ProgramResult misspelt = profile({"--fidelity", "--body", "lise"});
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_NE(misspelt.err.find("did you mean \"lies\"?"), std::string::npos) << misspelt.err;
  EXPECT_EQ(misspelt.out, "");
}

}  // namespace
}  // namespace stadion
