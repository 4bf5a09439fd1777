/// `stadion fit` and `stadion bench flight` as a user meets them.

#include "engine/maths/angles.h"
#include "tests/show/player/played_show.h"

#include "dynamics/flight/flight_table.h"
#include "dynamics/flight/trajectory.h"
#include "dynamics/nodes/dyn_object_node.h"
#include "tests/programs/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace stadion {
namespace {

const std::string kFlights = STADION_ROOT "/bench/flight/reference/";

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

TEST(ProgramFit, WritesItsTableOverNothingThatItReads) {
  const TestFolder folder;
  const std::string object = folder.write("discus.obj", discus()),
                    flight = folder.write("flight.csv", fileContent(kFlights + "disc_25_35_s40_a-10.csv"));
  for (const std::string& read : {object, flight}) {
    const std::string before = fileContent(read);
    const std::string out = folder.path() / ("over-" + std::filesystem::path(read).stem().string());
    std::filesystem::create_directory(out);
    std::filesystem::create_symlink(read, out + "/discus-flight.csv");
    const ProgramResult r = stadionProgram({"fit", object, "--reference", flight, "--out", out});
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_NE(r.err.find("and --out's discus-flight.csv name the same file"), std::string::npos) << r.err;
    EXPECT_EQ(fileContent(read), before);
  }
}

TEST(ProgramFit, FindsAPlateForADiscusAndSaysWhatToWrite) {
  const TestFolder folder;
  auto words = fitWords(folder.write("discus.obj", discus()), "disc_25_35_s40_a-10.csv");
  words.insert(words.end(), {"--within", "0.5", "--attitude", "2"});
  const ProgramResult r = stadionProgram(words);
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("flat, 2 kg, 1 flight"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("flight=plate, coefficients=\""), std::string::npos) << r.out;
}

TEST(ProgramFit, WritesATableThatCanBeReadWhereNothingCheaperIsGoodEnough) {
  const TestFolder folder;
  auto words = fitWords(folder.write("discus.obj", discus()), "disc_25_35_s40_a-10_head5.csv");
  const std::string table = (folder.path() / "discus-flight.csv").string();
  words.insert(words.end(),
               {"--wind", "-5", "0", "0", "--within", "0.5", "--attitude", "0.05", "--out", folder.path()});
  const ProgramResult r = stadionProgram(words);
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("flight=table, flighttable=\"discus-flight.csv\""), std::string::npos) << r.out;
  const auto read = readFlightTable(fileContent(table), table, 2);
  EXPECT_TRUE(read) << format(read.error());
}

TEST(ProgramFit, ADynobjectOfAScriptIsMeantByItsName) {
  const TestFolder folder;
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

std::string olympia(const std::string& part) {
  return std::filesystem::path(assetFolder()).parent_path() / ("scripts/olympia/" + part);
}

TEST(ProgramFit, ADynobjectOfASceneIsReadWithTheShowsAssetsAndAsItStatesItself) {
  for (const char* name : {"discus", "javelin"}) {
    const std::string flight = name[0] == 'd' ? "disc_25_35_s40_a-10.csv" : "jav_30_34_a0.csv";
    const ProgramResult r =
        stadionProgram({"fit", olympia(fmt::format("game_{0}.evs:{0}", name)), "--reference",
                        kFlights + flight, "--gravity", "9.81", "--density", "1.2"});
    EXPECT_EQ(r.status, 0) << r.out << r.err;
    EXPECT_NE(r.out.find("within the tolerance"), std::string::npos) << r.out;
    EXPECT_EQ(r.out.find("inertia="), std::string::npos) << "the script says it already";
  }
}

/// What a body did that a script lets fly as a recording began, on its way down to where that ends.
RigidFlight landingOf(const std::string& script, double height) {
  const auto player = openShow(script);
  RigidFlight before, now;
  for (std::uint64_t frame = 0; player && frame < 600; ++frame) {
    ChangeSet changes;
    Scene& scene = player->scene();
    scene.advance(signatureAt(frame, 60), {}, changes, nullptr);
    const auto* body = dynamic_cast<DynObjectNode*>(scene.find(scene.tree().resolve("thing", {1, 0})));
    if (!body) break;
    before = now;
    now.p = body->state().p, now.v = body->state().v;
    if (frame == 0 || now.p.z() > height) continue;
    now.p += (height - now.p.z()) / (before.p.z() - now.p.z()) * (before.p - now.p);
    break;
  }
  return now;
}

struct FlownThing {
  const char* model;
  const char* flight;
  std::vector<std::string> matter;
};

void expectThePromiseOf(const FlownThing& thing, const std::string& tolerance) {
  const TestFolder folder;
  std::vector<std::string> words{"fit",         assetFolder() + "/" + thing.model,
                                 "--gravity",   "9.81",
                                 "--density",   "1.2",
                                 "--out",       folder.path(),
                                 "--within",    tolerance,
                                 "--reference", kFlights + thing.flight};
  words.insert(words.end(), thing.matter.begin(), thing.matter.end());
  const ProgramResult fitted = stadionProgram(words);
  ASSERT_EQ(fitted.status, 0) << fitted.out << fitted.err;
  double promised = -1;
  std::string line, attributes;
  for (std::istringstream lines(fitted.out); std::getline(lines, line);) {
    if (line.find("within the tolerance") != std::string::npos && promised < 0)
      promised = std::stod(line.substr(line.find_first_of("0123456789")));
    if (line.starts_with("  mass=")) attributes = line;
  }
  ASSERT_FALSE(attributes.empty()) << fitted.out;

  const auto recorded = readTrajectory(fileContent(kFlights + thing.flight), thing.flight);
  ASSERT_TRUE(recorded);
  const RigidFlight start = recorded.value().front().at, end = recorded.value().back().at;
  const auto three = [](const Vec3& v) { return fmt::format("\"{}, {}, {}\"", v.x(), v.y(), v.z()); };
  // The references are pitched about -y alone.
  const Vec3 pitch(0, 2 * std::atan2(start.q.y(), start.q.w()) / kDegree, 0);
  const std::string script = folder.write(
      "throw.evs",
      fmt::format(
          "forcelinear( name=gravity, direction=\"0, 0, -9.81\", unit=m/s2 )\n"
          "medium( name=air, density=0.0012 )\n"
          "dynobject( name=thing, file={}, position={}, orientation={}, velocity={}, angularvelocity={},\n"
          "hook=gravity, hook=air, {} )\ndynamics( collidee=thing )\n",
          thing.model, three(start.p), three(pitch), three(start.v), three(start.q * start.w / kDegree),
          attributes));
  const Vec3 off = landingOf(script, end.p.z()).p - end.p;
  const double range = (end.p - start.p).head<2>().norm();
  EXPECT_NEAR(100 * off.head<2>().norm() / range, promised, 0.02) << attributes;
}

TEST(ProgramFit, AShowWithThePrintedLineFliesAsWellAsItPromises) {
  const std::vector<std::string> javelin{"--mass",   "0.806", "--inertia", "1.5e-4", "0.42",
                                         "--centre", "0",     "0",         "0"},
      discus{"--mass", "2", "--inertia", "0.0131", "0.0073"};
  expectThePromiseOf({"javelin.glb", "jav_30_34_a5.csv", javelin}, "0.2");
  expectThePromiseOf({"discus.glb", "disc_25_35_s40_a-10.csv", discus}, "0.5");
  expectThePromiseOf({"discus.glb", "disc_25_35_s40_a-10.csv", discus}, "0.003");  // by a table
}

TEST(ProgramFit, MomentsThatNoBodyHasAreRefused) {
  const TestFolder folder;
  const ProgramResult r = stadionProgram({"fit", folder.write("discus.obj", discus()), "--inertia", "3", "1",
                                          "--reference", kFlights + "disc_25_35_s40_a-10.csv"});
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("--inertia: no body has such moments"), std::string::npos) << r.err;
}

TEST(ProgramFit, BadInputIsSaidWithItsPlace) {
  const TestFolder folder;
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

TEST(ProgramFit, MatterThatNoScriptMayStateIsRefusedHereToo) {
  const std::string flight = kFlights + "jav_30_34_a0.csv", model = assetFolder() + "/javelin.glb";
  struct Case {
    std::vector<std::string> words;
    const char* said;
  };
  for (const Case& c :
       {Case{{"--centre", "100", "0", "0"}, "--centre: the centre of mass lies outside of the model"},
        Case{{"--inertia", "1e-9", "0.42"}, "--inertia: the moments must be at least"}}) {
    std::vector<std::string> words{"fit", model, "--mass", "0.806", "--reference", flight};
    words.insert(words.end(), c.words.begin(), c.words.end());
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_NE(r.err.find(c.said), std::string::npos) << r.err;
  }
}

/// The first rows of a recorded flight.
std::string beginningOf(const std::string& flight, int rows) {
  std::istringstream all(fileContent(kFlights + flight));
  std::string text, line;
  while (rows >= 0 && std::getline(all, line)) text += line + "\n", rows -= !line.starts_with('#');
  return text;
}

TEST(ProgramFit, AFlightThatEndsInTheAirOrHasHardlyARowIsRefused) {
  const TestFolder folder;
  const std::string object = folder.write("discus.obj", discus());
  const auto said = [&](int rows) {
    const std::string flight = folder.write("part.csv", beginningOf("disc_25_35_s40_a-10.csv", rows));
    const ProgramResult r = stadionProgram({"fit", object, "--mass", "2", "--reference", flight});
    EXPECT_EQ(r.status, 2) << r.out;
    return r.err;
  };
  EXPECT_NE(said(20).find("part.csv: error: the last row is no landing"), std::string::npos) << said(20);
  EXPECT_NE(said(50).find("the last row is no landing"), std::string::npos) << "it falls, but from above";
  EXPECT_NE(said(4).find("fewer than five rows"), std::string::npos) << said(4);
}

TEST(ProgramFit, TheFlightOfAnotherBodyIsSuspected) {
  const ProgramResult r = stadionProgram({"fit", assetFolder() + "/javelin.glb", "--mass", "0.806",
                                          "--reference", kFlights + "disc_25_35_s40_a-10.csv"});
  EXPECT_NE(
      r.out.find(
          "Are these its flights? In them it turns at 40 rad/s across its long axis, as a flat one may"),
      std::string::npos)
      << r.out;
}

TEST(ProgramFit, ADynobjectOfASubSceneIsNamedWithItsFile) {
  const std::string show = olympia("../olympia.evs");
  const ProgramResult r =
      stadionProgram({"fit", show + ":javelin", "--reference", kFlights + "jav_30_34_a0.csv"});
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("has no dynobject \"javelin\"; "), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("olympia/game_javelin.evs:javelin"), std::string::npos) << r.err;
}

TEST(ProgramCheck, WhatFliesAsIfMatterFilledItEvenlyIsToldWithTheNumbers) {
  const TestFolder folder;
  const auto told = [&](const std::string& words) {
    const std::string script = folder.write(
        "throw.evs", "medium( name=air )\ndynobject( name=spear, file=javelin.glb, mass=0.8, hook=air" +
                         words + " )\ndynamics( collidee=spear )\n");
    return stadionProgram({"check", script, "--asset-root", assetFolder()}).out;
  };
  const std::string even = told(", flight=rod");
  EXPECT_NE(even.find("\"spear\" flies as if matter filled its model evenly: centre=\"-0.15"),
            std::string::npos)
      << even;
  for (const char* words : {"", ", flight=ball", ", flight=bias", ", flight=rod, centre=\"0, 0, 0\""})
    EXPECT_EQ(told(words).find("evenly"), std::string::npos) << words;
}

TEST(ProgramBenchFlight, PrintsItsLimitsAndWritesNumbersAndPlots) {
  const TestFolder folder;
  const std::string plots = folder.path() / "plots";
  const ProgramResult r =
      stadionProgram({"bench", "flight", "--flights", "20", "--rounds", "20", "--json", "--out", plots});
  EXPECT_TRUE(r.status == 0 || r.status == 1) << r.err;  // its costs may miss their limits on a busy machine
  const auto all = nlohmann::json::parse(r.out);
  EXPECT_EQ(nlohmann::json::parse(fileContent(plots + "/flight.json")), all);
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
  EXPECT_NE(r.err.find("limits met, "), std::string::npos);
}

}  // namespace
}  // namespace stadion
