/// `stadion fit` and `stadion bench flight` as a user meets them.

#include "dynamics/flight/flight_table.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

const std::string kFlights = STADION_ROOT "/profiling/bench/flight/reference/";

/// An eight-sided discus about the z axis (OBJ is +Y up: our z is its y).
std::string discus() {
  constexpr double kHalf = 0.70710678118654752;
  const double ring[8][2] = {{1, 0},  {kHalf, kHalf},   {0, 1},  {-kHalf, kHalf},
                             {-1, 0}, {-kHalf, -kHalf}, {0, -1}, {kHalf, -kHalf}};
  std::string obj;
  for (const double y : {-.0225, .0225})
    for (const auto& [x, z] : ring) obj += fmt::format("v {} {} {}\n", .11 * x, y, -.11 * z);
  for (int i = 1; i <= 8; ++i) {
    const int next = i % 8 + 1;
    obj += fmt::format("f {} {} {} {}\n", i, next, next + 8, i + 8);
  }
  return obj + "f 8 7 6 5 4 3 2 1\nf 9 10 11 12 13 14 15 16\n";
}

std::vector<std::string> fitWords(const std::string& object, const std::string& flight) {
  return {"fit",       object, "--mass",    "2",   "--inertia",   "0.0131",         "0.0073",
          "--gravity", "9.81", "--density", "1.2", "--reference", kFlights + flight};
}

TEST(ProgramFit, FindsAPlateForADiscusAndSaysWhatToWrite) {
  const TemporaryFolder folder;
  auto words = fitWords(folder.write("discus.obj", discus()), "disc_25_35_s40_a-10.csv");
  words.insert(words.end(), {"--tolerance", "0.5", "--attitude", "2"});
  const ProgramResult r = stadionProgram(words);
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("flat, 2 kg, 1 flight"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("flight=plate, coefficients=\""), std::string::npos) << r.out;
}

TEST(ProgramFit, WritesATableThatCanBeReadWhereNothingCheaperIsGoodEnough) {
  const TemporaryFolder folder;
  auto words = fitWords(folder.write("discus.obj", discus()), "disc_25_35_s40_a-10_head5.csv");
  const std::string table = (folder.path() / "air.csv").string();
  words.insert(words.end(),
               {"--wind", "-5", "0", "0", "--tolerance", "0.5", "--attitude", "0.05", "--table", table});
  const ProgramResult r = stadionProgram(words);
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("flight=table, flighttable=\"" + table), std::string::npos) << r.out;
  const auto read = readFlightTable(fileContent(table), table, 2);
  EXPECT_TRUE(read) << format(read.error());
}

TEST(ProgramFit, ADynobjectOfAScriptIsMeantByItsName) {
  const TemporaryFolder folder;
  folder.write("discus.obj", discus());
  const std::string script =
      folder.write("throw.evs", "dynobject(name=disc, file=discus.obj, mass=2)\ndynamics(collidee=disc)\n");
  auto words = fitWords(script + ":disc", "disc_25_35_s40_a-10.csv");
  EXPECT_EQ(stadionProgram(words).status, 0);
  words[1] = script + ":disk";
  const ProgramResult wrong = stadionProgram(words);
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("has no dynobject \"disk\"; did you mean \"disc\"?"), std::string::npos)
      << wrong.err;
  words[1] = script;
  EXPECT_NE(stadionProgram(words).err.find("throw.evs:NAME"), std::string::npos);
}

TEST(ProgramFit, BadInputIsSaidWithItsPlace) {
  const TemporaryFolder folder;
  const std::string object = folder.write("discus.obj", discus());
  const std::string flight = folder.write("bad.csv", "t,px\n0,1\n");
  const ProgramResult columns = stadionProgram({"fit", object, "--reference", flight});
  EXPECT_EQ(columns.status, 2);
  EXPECT_NE(columns.err.find("bad.csv:2: error: there is no column \"py\""), std::string::npos)
      << columns.err;
  EXPECT_EQ(stadionProgram({"fit", object, "--reference", "missing.csv"}).status, 2);
  EXPECT_EQ(stadionProgram({"fit", "missing.obj", "--reference", kFlights + "jav_30_34_a0.csv"}).status, 2);
  EXPECT_EQ(stadionProgram({"fit", object}).status, 2);
  EXPECT_EQ(stadionProgram({"fit", object, "--reference", flight, "--mass", "nan"}).status, 2);
}

TEST(ProgramBenchFlight, PrintsItsLimitsAndWritesNumbersAndPlots) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "flight.json").string(),
                    plots = (folder.path() / "plots").string();
  const ProgramResult r = stadionProgram(
      {"bench", "flight", "--flights", "20", "--rounds", "20", "--json", json, "--out", plots});
  EXPECT_TRUE(r.status == 0 || r.status == 1) << r.err;  // its costs may miss their limits on a busy machine
  const auto all = nlohmann::json::parse(fileContent(json));
  std::size_t missed = 0;
  for (const auto& limit : all["limits"]) {
    const bool cost = limit["what"].get<std::string>().find(" / ") != std::string::npos;
    EXPECT_TRUE(cost || limit["met"]) << limit;
    missed += !limit["met"];
  }
  EXPECT_EQ(r.status, missed > 0 ? 1 : 0);
  EXPECT_GE(all["ladder"].size(), 16U);
  for (const char* name :
       {"flights-javelin.svg", "flights-discus.svg", "flights-ball.svg", "work-precision-discus.svg"})
    EXPECT_NE(fileContent(std::filesystem::path(plots) / name).find("</svg>"), std::string::npos) << name;
  EXPECT_NE(r.out.find("limits met, "), std::string::npos);
}

}  // namespace
}  // namespace stadion
