/// What the product consists of is listed, and the list is right.

#include "tests/proc.h"
#include "tests/programs/desk.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace stadion {
namespace {

using Json = nlohmann::json;

const std::string kSourceRoot = STADION_SOURCE_DIR;

TEST(SupplyChain, EveryPackageThatTheLauncherInstallsIsListedWithItsLicence) {
  const std::string launcher = fileContent(kSourceRoot + "/stadion");
  const std::size_t from = launcher.find("packages=\"") + 10;
  std::string packages = launcher.substr(from, launcher.find('"', from) - from);
  packages = std::regex_replace(packages, std::regex("\\\\"), " ");
  std::set<std::string> listed;
  std::istringstream table(fileContent(kSourceRoot + "/docs/dependencies.md"));
  for (std::string line; std::getline(table, line);) {
    if (!line.starts_with("| ")) continue;
    std::istringstream names(line.substr(2, line.find(" |") - 2));
    for (std::string name; names >> name;)
      listed.insert(name.ends_with(',') ? name.substr(0, name.size() - 1) : name);
    EXPECT_EQ(std::ranges::count(line, '|'), 5) << line;
  }
  std::istringstream words(packages);
  for (std::string package; words >> package;) EXPECT_TRUE(listed.contains(package)) << package;
}

/// The packages that have these files, and of each one of them; files of no package are left out.
std::map<std::string, std::string> packagesOf(const std::set<std::string>& files) {
  ProgramRun query{{"dpkg-query", "-S"}};
  for (const std::string& file : files) {
    // What is below /lib may be known as below /usr/lib, and the other way round.
    query.words.push_back(file);
    query.words.push_back(file.starts_with("/usr/") ? file.substr(4) : "/usr" + file);
  }
  std::map<std::string, std::string> packages;
  std::istringstream answer(runProgram(query).out);
  for (std::string line; std::getline(answer, line);)
    if (const std::size_t path = line.find(": /"); path != line.npos)
      packages[line.substr(0, line.find(':'))] = line.substr(path + 2);
  return packages;
}

/// What a run that draws has loaded is in it.
void expectLoadedLibrariesIn(const std::set<std::string>& names) {
  std::set<std::string> libraries;
  RunningProgram run({{stadionPath(), "run", kSourceRoot + "/scripts/olympia.evs", "--size", "32x24",
                       "--walls", "desktop", "--input", "none", "--gl", "osmesa"},
                      {"ALSOFT_DRIVERS=null"}});
  ASSERT_TRUE(run.says("sound: OpenAL")) << run.err();
  std::istringstream maps(procText(run.pid(), "maps"));
  for (std::string line; std::getline(maps, line);)
    if (line.find(".so") != std::string::npos) libraries.insert(line.substr(line.find('/')));
  EXPECT_TRUE(std::ranges::any_of(libraries, [](const std::string& l) { return has(l, "libOSMesa"); }));
  EXPECT_TRUE(std::ranges::any_of(libraries, [](const std::string& l) { return has(l, "libopenal"); }));
  const auto packages = packagesOf(libraries);
  EXPECT_GT(packages.size(), 20U);
  for (const auto& [package, library] : packages)
    EXPECT_TRUE(names.contains(package)) << library << " is of " << package;
}

TEST(ProgramSupplyChain, TheBillOfMaterialsIsWellFormedAndNamesWhatIsLinkedOrLoaded) {
  const ProgramResult r = runProgram({{kSourceRoot + "/packaging/sbom.sh", STADION_BINARY_DIR}});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json bill = Json::parse(r.out, nullptr, false);
  ASSERT_TRUE(bill.is_object()) << r.out;
  EXPECT_EQ(bill["spdxVersion"], "SPDX-2.3");
  EXPECT_EQ(bill["dataLicense"], "CC0-1.0");
  EXPECT_EQ(bill["SPDXID"], "SPDXRef-DOCUMENT");
  EXPECT_TRUE(std::regex_match(bill["creationInfo"]["created"].get<std::string>(),
                               std::regex("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ")));
  std::set<std::string> ids{"SPDXRef-DOCUMENT"}, names;
  for (const Json& p : bill["packages"]) {
    const std::string id = p["SPDXID"];
    EXPECT_TRUE(std::regex_match(id, std::regex("SPDXRef-[A-Za-z0-9.-]+"))) << id;
    EXPECT_TRUE(ids.insert(id).second) << id << " twice";
    EXPECT_FALSE(p["versionInfo"].get<std::string>().empty()) << id;
    for (const char* field : {"downloadLocation", "licenseConcluded", "licenseDeclared", "copyrightText"})
      EXPECT_TRUE(p.contains(field)) << id << field;
    names.insert(p["name"].get<std::string>());
  }
  for (const Json& relation : bill["relationships"]) {
    EXPECT_TRUE(ids.contains(relation["spdxElementId"].get<std::string>()));
    EXPECT_TRUE(ids.contains(relation["relatedSpdxElement"].get<std::string>()));
  }
  for (const char* linked : {"libc6", "libfmt9", "libassimp5", "libdraco7", "libopenexr-3-1-30", "libwebp7",
                             "libfcl0.7", "libmd0", "libsndfile1", "libosmesa6"})
    EXPECT_TRUE(names.contains(linked)) << linked;
  expectLoadedLibrariesIn(names);
}

}  // namespace
}  // namespace stadion
