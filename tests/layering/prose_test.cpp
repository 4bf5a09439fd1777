/// Programs, threads and nodes are no persons: comments, messages and names say which of them acts.

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

const fs::path kHouse = STADION_SOURCE_DIR;

/// Returns the word that hides an actor: "nobody" or "whoever", also as a part of a name, or "who" without a person
/// before it. Empty if there is none.
std::string hiddenActor(const std::string& line) {
  if (line.find("who") == line.npos && line.find("Who") == line.npos && line.find("obody") == line.npos)
    return "";
  static const std::regex never("[Nn]obody(?![a-z])|[Ww]hoever|Who[A-Z]", std::regex::optimize);
  static const std::regex who("\\b[Ww]hom?\\b", std::regex::optimize);
  static const std::regex person(
      "(visitor|operator|reader|author|user|person|athlete|people|engineer|developer)s?"
      "( [a-z]+)?,? (for |to )?$",
      std::regex::optimize);
  std::smatch found;
  if (std::regex_search(line, found, never)) return found.str();
  for (std::sregex_iterator at(line.begin(), line.end(), who), end; at != end; ++at)
    if (!std::regex_search(at->prefix().first, at->prefix().second, person)) return at->str();
  return "";
}

TEST(Prose, AnActorThatIsHiddenIsFound) {
  EXPECT_EQ(hiddenActor("/// Nobody waits for it."), "Nobody");
  EXPECT_EQ(hiddenActor("constexpr int kNobody = 255;"), "Nobody");
  EXPECT_EQ(hiddenActor("so that whoever asks gets one"), "whoever");
  EXPECT_EQ(hiddenActor("TEST(Cluster, WhoLeadsEnds) {"), "WhoL");
  EXPECT_EQ(hiddenActor("text += \", who leads\";"), "who");
  EXPECT_EQ(hiddenActor("/// A visitor who walks, and who is asked first."), "who");
  EXPECT_EQ(hiddenActor("/// A visitor who walks sees the whole; a file whose name is long."), "");
  EXPECT_EQ(hiddenActor("bool isWhole(const NoBody& body);"), "");
}

/// Returns false for bytes, for this test's examples, and for shows whose hashes the fuzz corpus holds.
bool isProse(const fs::path& file) {
  static const std::set<std::string> kinds{".h", ".cpp", ".md", ".evs", ".txt", ".patch", ".expected", ""};
  const std::string path = file.string();
  return kinds.contains(file.extension()) && file.filename() != "prose_test.cpp" &&
         path.find("/tests/fuzz/corpus/") == path.npos && path.find("/tests/fuzz/shows/") == path.npos;
}

TEST(Prose, NoActorIsHidden) {
  for (const char* folder : {"engine", "pipeline", "dynamics", "profiling", "show", "cli", "tests", "docs",
                             "examples", "scripts", "assets/generator", "packaging"})
    for (const auto& entry : fs::recursive_directory_iterator(kHouse / folder)) {
      if (!entry.is_regular_file() || !isProse(entry.path())) continue;
      std::ifstream in(entry.path());
      std::string line;
      for (std::size_t n = 1; std::getline(in, line); ++n)
        EXPECT_EQ(hiddenActor(line), "")
            << fs::relative(entry.path(), kHouse).string() << ":" << n << ": name the actor: " << line;
    }
}

}  // namespace
