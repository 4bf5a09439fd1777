/// Each patch of tests/faults fits the sources, and the tests that it names exist. So a change of a source that a patch
/// touches is noticed at once, and not when tests/faults/run is started months later.

#include <algorithm>
#include <filesystem>
#include <fnmatch.h>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kSources = STADION_SOURCE_DIR;

std::vector<std::string> linesOfFile(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// One place of a file that a patch changes.
struct Hunk {
  std::string file;
  std::vector<std::string> before;  ///< the lines that have to be there
};

std::vector<Hunk> hunksOf(const fs::path& patch) {
  std::vector<Hunk> hunks;
  std::string file;
  for (const std::string& line : linesOfFile(patch))
    if (line.starts_with("--- a/"))
      file = line.substr(6);
    else if (line.starts_with("@@ "))
      hunks.push_back({file, {}});
    else if (!hunks.empty() && (line.starts_with(" ") || line.starts_with("-")))
      hunks.back().before.push_back(line.substr(1));
  return hunks;
}

std::vector<std::string> namesOfTestsBelow(const fs::path& folder) {
  const std::regex definition(R"(^TEST(_F|_P)?\((\w+), *(\w+)\))");
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".cpp") continue;
    for (const std::string& line : linesOfFile(entry.path())) {
      std::smatch found;
      if (std::regex_search(line, found, definition)) names.push_back(found.str(2) + "." + found.str(3));
    }
  }
  return names;
}

std::vector<fs::path> patches() {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(kSources / "tests/faults"))
    if (entry.path().extension() == ".patch") all.push_back(entry.path());
  return all;
}

TEST(FaultPatches, EachFitsTheSources) {
  EXPECT_FALSE(patches().empty());
  for (const fs::path& patch : patches()) {
    const std::vector<Hunk> hunks = hunksOf(patch);
    EXPECT_FALSE(hunks.empty()) << patch;
    for (const Hunk& hunk : hunks) {
      const std::vector<std::string> lines = linesOfFile(kSources / hunk.file);
      const auto found = std::search(lines.begin(), lines.end(), hunk.before.begin(), hunk.before.end());
      EXPECT_NE(found, lines.end()) << patch << ": " << hunk.file << " no longer has the lines around \""
                                    << (hunk.before.empty() ? "" : hunk.before.front()) << '"';
    }
  }
}

TEST(FaultPatches, TheTestsThatTheyNameExist) {
  const std::regex named(R"(^tests: (\w+)_tests (\S+))");
  for (const fs::path& patch : patches()) {
    std::size_t filters = 0;
    for (const std::string& line : linesOfFile(patch)) {
      std::smatch found;
      if (!std::regex_search(line, found, named)) continue;
      ++filters;
      const std::vector<std::string> names = namesOfTestsBelow(kSources / "tests" / found.str(1));
      const std::string filter = found.str(2);
      EXPECT_TRUE(
          std::any_of(names.begin(), names.end(),
                      [&](const std::string& name) { return fnmatch(filter.c_str(), name.c_str(), 0) == 0; }))
          << patch << ": no test is called " << filter;
    }
    EXPECT_EQ(filters, 1u) << patch;
  }
}

}  // namespace
