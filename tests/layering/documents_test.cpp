/// Documents stay true where a program can tell: links lead somewhere, and what they list exists.

#include <cctype>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kPages = STADION_SOURCE_DIR;

std::string textOfPage(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The page without fenced code, in which `#` begins no heading and brackets are no links.
std::vector<std::string> proseLines(const fs::path& file) {
  std::vector<std::string> lines;
  std::istringstream in(textOfPage(file));
  bool isCode = false;
  for (std::string line; std::getline(in, line);) {
    const bool isFence = line.starts_with("```");
    if (isFence) isCode = !isCode;
    lines.push_back(isFence || isCode ? "" : line);
  }
  return lines;
}

/// The anchor that GitHub gives a heading: small letters, a dash for each blank, no other signs.
std::string anchorOf(const std::string& heading) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  std::string anchor;
  for (const char c : std::regex_replace(heading, link, "$1")) {
    const auto u = static_cast<unsigned char>(c);
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(u) != 0 || c == '-' || c == '_' || u >= 0x80)
      anchor += static_cast<char>(std::tolower(u));
  }
  return anchor;
}

std::set<std::string> anchorsOf(const fs::path& file) {
  std::set<std::string> anchors;
  for (const std::string& line : proseLines(file)) {
    const std::size_t level = line.find_first_not_of('#');
    if (level == 0 || level == line.npos || line[level] != ' ') continue;
    const std::string anchor = anchorOf(line.substr(level + 1));
    std::string numbered = anchor;
    for (int n = 1; !anchors.insert(numbered).second; ++n) numbered = anchor + "-" + std::to_string(n);
  }
  return anchors;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(kPages))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  for (const char* folder : {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "tests",
                             "docs", "examples", "scripts", "walls", "assets"})
    for (const auto& entry : fs::recursive_directory_iterator(kPages / folder))
      if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

/// Returns what is wrong with a link of the page; empty if it leads somewhere. Links to other sites count as
/// right.
std::string faultOfLink(const fs::path& page, const std::string& link) {
  if (link.find("://") != link.npos) return "";
  const std::size_t hash = link.find('#');
  const std::string path = link.substr(0, hash);
  fs::path target = path.empty() ? page : page.parent_path() / path;
  if (!fs::exists(target)) return "no such file";
  if (hash == link.npos) return "";
  if (fs::is_directory(target)) target /= "README.md";
  return anchorsOf(target).contains(link.substr(hash + 1)) ? "" : "no such heading";
}

TEST(Documents, AnAnchorIsMadeOfItsHeading) {
  EXPECT_EQ(anchorOf("A tracker's jump"), "a-trackers-jump");
  EXPECT_EQ(anchorOf("`--supervise` and [links](x.md#y)"), "--supervise-and-links");
  EXPECT_EQ(anchorOf("C++ interface"), "c-interface");
}

TEST(Documents, ALinkThatLeadsNowhereIsFound) {
  const fs::path page = kPages / "docs/architecture.md";
  EXPECT_EQ(faultOfLink(page, "#threads"), "");
  EXPECT_EQ(faultOfLink(page, "../README.md#licence"), "");
  EXPECT_EQ(faultOfLink(page, "nowhere.md"), "no such file");
  EXPECT_EQ(faultOfLink(page, "glossary.md#nothing"), "no such heading");
}

TEST(Documents, EachLinkLeadsToAFileAndAHeading) {
  const std::regex link(R"(\]\(([^)\s]+)\))");
  for (const fs::path& page : pages()) {
    std::size_t number = 0;
    for (const std::string& line : proseLines(page)) {
      ++number;
      for (std::sregex_iterator at(line.begin(), line.end(), link), end; at != end; ++at)
        EXPECT_EQ(faultOfLink(page, (*at)[1]), "")
            << fs::relative(page, kPages).string() << ":" << number << ": " << (*at)[1];
    }
  }
}

/// Returns "Suite.Name" of each test in the sources.
std::set<std::string> testsInSources() {
  std::set<std::string> tests;
  const std::regex declared(R"(\nTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\))");
  for (const auto& entry : fs::recursive_directory_iterator(kPages / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = textOfPage(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), declared), end; at != end; ++at)
      tests.insert((*at)[1].str() + "." + (*at)[2].str());
  }
  return tests;
}

TEST(Documents, EachTestThatTheTablesOfFaultsNameExists) {
  const std::set<std::string> tests = testsInSources();
  const std::string page = textOfPage(kPages / "docs/faults.md");
  const std::regex named(R"(`(?:Program/)?([A-Z]\w+\.\w*)(?:\.\.\.|\*)?`)");
  std::size_t count = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), named), end; at != end; ++at, ++count) {
    const std::string name = (*at)[1];
    const auto first = tests.lower_bound(name);
    EXPECT_TRUE(first != tests.end() && first->starts_with(name)) << name;
  }
  EXPECT_GT(count, 40U);
}

/// Returns what the first group of the pattern matches in the file.
std::set<std::string> namedIn(const fs::path& file, const std::regex& pattern) {
  std::set<std::string> names;
  const std::string text = textOfPage(file);
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
    names.insert((*at)[1]);
  return names;
}

TEST(Documents, ExamplesIncludeOnlyHeadersOfThePublicInterface) {
  const std::set<std::string> open = namedIn(
      kPages / "docs/compatibility.md", std::regex(R"(`((?:engine|pipeline|dynamics|show)/[\w/]+\.h)`)"));
  EXPECT_GT(open.size(), 10U);
  for (const std::string& header : open) EXPECT_TRUE(fs::exists(kPages / header)) << header;
  std::size_t count = 0;
  const std::regex include(R"(#include <stadion/([\w/]+\.h)>)");
  std::vector<fs::path> files = pages();
  for (const auto& entry : fs::recursive_directory_iterator(kPages / "examples"))
    if (entry.path().extension() == ".cpp") files.push_back(entry.path());
  for (const fs::path& file : files)
    for (const std::string& header : namedIn(file, include)) {
      EXPECT_TRUE(open.contains(header)) << fs::relative(file, kPages).string() << ": " << header;
      ++count;
    }
  EXPECT_GT(count, 5U);
}

/// The page of a folder, or of the nearest folder above that has one.
fs::path pageOf(fs::path folder) {
  while (!fs::exists(folder / "README.md")) folder = folder.parent_path();
  return folder / "README.md";
}

/// Returns true if the page names the folder below it as code.
bool names(const fs::path& page, const fs::path& folder) {
  const std::string text = textOfPage(page);
  const std::string name = "`" + fs::relative(folder, page.parent_path()).string();
  return text.find(name + "`") != text.npos || text.find(name + "/") != text.npos;
}

TEST(Documents, EachFolderIsOnThePageOfItsLayer) {
  for (const char* layer : {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli"}) {
    std::set<fs::path> folders;
    for (const auto& entry : fs::recursive_directory_iterator(kPages / layer))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
        folders.insert(entry.path().parent_path());
    folders.erase(kPages / layer);
    for (const fs::path& folder : folders) {
      const fs::path page = pageOf(folder.parent_path());
      EXPECT_TRUE(names(page, folder) || names(kPages / layer / "README.md", folder))
          << fs::relative(folder, kPages).string() << " is not on " << fs::relative(page, kPages).string();
    }
  }
}

}  // namespace
