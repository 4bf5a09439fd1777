/// Names of tests stand in lists, logs and files: none is too long for a line.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

/// As ctest knows them, of all test programs that have been built.
std::set<std::string> namesOfTests() {
  std::set<std::string> names;
  const std::regex registered(R"(add_test\(\[(=*)\[([^\]]+)\]\1\])");
  for (const auto& entry : fs::directory_iterator(fs::path(STADION_BINARY_DIR) / "tests")) {
    if (!entry.path().filename().string().ends_with("_tests.cmake")) continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch found;
      if (std::regex_search(line, found, registered)) names.insert(found[2]);
    }
  }
  return names;
}

TEST(TestNames, AreShorterThanAHundredCharacters) {
  constexpr std::size_t kMost = 99;
  const std::set<std::string> names = namesOfTests();
  EXPECT_TRUE(names.contains("TestNames.AreShorterThanAHundredCharacters"));
  for (const std::string& name : names) EXPECT_LE(name.size(), kMost) << name;
}

}  // namespace
