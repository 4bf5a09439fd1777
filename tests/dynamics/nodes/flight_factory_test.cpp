/// From what a script says of a body's flight to how it flies.

#include "dynamics/nodes/flight_factory.h"
#include "engine/script/script.h"
#include "tests/dynamics/world/scenes.h"
#include "tests/fresh_folder.h"
#include "tests/node_types.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace stadion {
namespace {

using namespace scenes;
using Flight = std::shared_ptr<const BodyFlight>;

/// A spear along x whose thick end is at +x.
Mesh spear() {
  std::vector<Vec3> p;
  for (const auto& [x, r] : {std::pair(-1.2, 0.01), std::pair(1.0, 0.03)})
    for (int i = 0; i < 4; ++i) p.emplace_back(x, (i & 1 ? r : -r), (i & 2 ? r : -r));
  return meshOf(p, {{0, 2, 1},
                    {1, 2, 3},
                    {4, 5, 6},
                    {5, 7, 6},
                    {0, 1, 4},
                    {1, 5, 4},
                    {2, 6, 3},
                    {3, 6, 7},
                    {0, 4, 2},
                    {2, 4, 6},
                    {1, 3, 5},
                    {3, 7, 5}});
}

struct MadeFlight {
  std::string why;  ///< empty if it could be made and nothing is odd
  Flight flight;
};

MadeFlight made(const std::string& words, const Mesh& mesh = spear(), const AssetRoots* roots = nullptr) {
  Diagnostics findings;
  const Document document =
      parseScript(SourceText::make("a.evs", "dynobject( name=a, file=a.obj" + words + " )\n").value(),
                  testTypes(), findings);
  if (findings.hasErrors()) return {format(findings.all().front()), nullptr};
  const std::function<NodeRef(const NodeReference&)> resolve;
  const std::function<std::optional<PlacedModel>(const NodeReference&)> model;
  NodeServices services;
  const NodeRequest request{document[0], {}, "a", {}, {}, &mesh, resolve, model, findings, services};
  auto flight = flightOf(request, massOfMesh(mesh, 100).value(), roots);
  if (!flight) return {format(flight.error()), nullptr};
  return {findings.all().empty() ? "" : format(findings.all().front()), flight.value()};
}

TEST(FlightFactory, WithoutAWordABodyIsAPoint) {
  EXPECT_EQ(made("").flight, nullptr);
  EXPECT_EQ(made(", flight=point").why, "");
}

TEST(FlightFactory, EachWordGivesItsModel) {
  EXPECT_TRUE(made(", flight=ballistic").flight->inVacuum);
  EXPECT_TRUE(std::holds_alternative<RodFlight>(made(", flight=rod").flight->model));
  EXPECT_TRUE(std::holds_alternative<PlateFlight>(made(", flight=plate").flight->model));
  EXPECT_TRUE(std::holds_alternative<SportsBall>(made(", flight=ball").flight->model));
  const Flight bias = made(", flight=bias, bias=covariance, biasrate=0.2").flight;
  EXPECT_EQ(bias->bias.form, BiasForm::Covariance);
  EXPECT_EQ(bias->bias.rate, 0.2);
  EXPECT_FALSE(bias->hasModel());
  EXPECT_EQ(made(", flight=bias").flight->bias.rate, 1.8);
  EXPECT_EQ(made(", flight=bias, bias=paper").flight->bias.rate, 0.03);
}

TEST(FlightFactory, CoefficientsAreNumbersOrAName) {
  const auto rod = std::get<RodFlight>(made(", flight=rod, coefficients=\"1, 2, 3, 4, 5, 6\"").flight->model);
  EXPECT_EQ(rod.axialArea, 1);
  EXPECT_EQ(rod.damping, 6);
  const auto named = std::get<RodFlight>(made(", flight=rod, coefficients=javelin").flight->model);
  EXPECT_NEAR(named.crossArea, javelinFlight(2.2).crossArea, 1e-6) << "of its own length";
  EXPECT_TRUE(made(", flight=rod, coefficients=discus")
                  .why.starts_with("a.evs:1:57: error: flight=rod knows no \"discus\"; it knows javelin\n"));
  EXPECT_NE(
      made(", flight=rod, coefficients=\"1, 2\"").why.find("flight=rod takes 6 numbers: axial area [m2], "),
      std::string::npos);
  EXPECT_NE(made(", flight=rod, coefficients=\"1, 1e3, 3, 4, 5, 6\"")
                .why.find("cross area is 1000 m2; a body of 2.2 m has"),
            std::string::npos)
      << "stiff for nothing";
  EXPECT_NE(made(", flight=rod, coefficients=\"-1, 2, 3, 4, 5, 6\"").why.find("axial area must be from 0"),
            std::string::npos);
}

TEST(FlightFactory, TheNoseIsTheHeavyEndOrWhereTheScriptSays) {
  const Flight own = made(", flight=rod").flight, back = made(", flight=rod, nose=\"-1, 0, 0\"").flight;
  EXPECT_GT((own->q_NA * Vec3::UnitX()).x(), 0.99);
  EXPECT_LT((back->q_NA * Vec3::UnitX()).x(), -0.99);
  const auto a = std::get<RodFlight>(own->model), b = std::get<RodFlight>(back->model);
  EXPECT_NEAR(a.crossArm, -b.crossArm, 1e-9) << "what was behind is before";
  EXPECT_EQ(a.crossArea, b.crossArea);
}

TEST(FlightFactory, ABallHasNoBiasWhateverTheScriptSays) {
  EXPECT_EQ(made(", flight=bias, biasrate=9", ballMesh(0.1, 24, 48)).flight->bias.rate, 0);
}

TEST(FlightFactory, ATableIsReadAndItsMistakesAreToldWithFileAndLine) {
  const auto folder = makeFreshFolder();
  std::ofstream(folder / "good.csv")
      << "# area = 0.01\n# length = 0.2\nalpha_deg,CD,CL,CM\n0,0.1,0,0\n45,0.5,0.6,0.1\n"
         "90,1,0,0\n";
  std::ofstream(folder / "bad.csv")
      << "# area = 0.01\nalpha_deg,CD,CL,CM\n0,0.1,0,0\n45,much,0.6,0.1\n90,1,0,0\n";
  AssetRoots roots;
  ASSERT_TRUE(roots.add(folder));
  const MadeFlight good = made(", flight=table, flighttable=good.csv", spear(), &roots);
  ASSERT_EQ(good.why, "");
  EXPECT_FALSE(std::get<TableFlight>(good.flight->model).pieces.empty());
  const std::string bad = made(", flight=table, flighttable=bad.csv", spear(), &roots).why;
  EXPECT_TRUE(bad.starts_with("a.evs:1:")) << bad << " is where the script names it";
  EXPECT_NE(bad.find("bad.csv:4:4: \"much\" is not a finite number"), std::string::npos) << bad;
  EXPECT_EQ(made(", flight=table, flighttable=none.csv", spear(), &roots).why.substr(0, 6), "a.evs:");
  EXPECT_EQ(made(", flight=table, flighttable=none.csv").why.substr(0, 6), "a.evs:");
  std::filesystem::remove_all(folder);
}

TEST(FlightFactory, AModelForPlainlyAnotherFormIsWarnedOf) {
  EXPECT_EQ(made(", flight=rod").why, "");
  EXPECT_TRUE(
      made(", flight=plate")
          .why.starts_with("a.evs:1:39: warning: flight=plate is for flat bodies; \"a\" is long (2.2 x "))
      << made(", flight=plate").why;
  EXPECT_EQ(made(", flight=plate", ballMesh(0.1, 24, 48)).why, "") << "neither long nor flat";
  const auto folder = makeFreshFolder();
  std::ofstream(folder / "z.csv")
      << "# area = 0.01\n# length = 0.2\n# axis = z\nalpha_deg,CD,CL,CM\n0,0.1,0,0\n"
         "45,0.5,0.6,0.1\n90,1,0,0\n";
  AssetRoots roots;
  ASSERT_TRUE(roots.add(folder));
  EXPECT_NE(made(", flight=table, flighttable=z.csv", spear(), &roots)
                .why.find("axis = z in this table is for flat bodies; \"a\" is long"),
            std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace stadion
