/// Programs, threads and nodes are no persons: comments, messages and names say which of them acts.

#include <cctype>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <string>
#include <string_view>

namespace {

namespace fs = std::filesystem;

const fs::path kSourceFolder = STADION_SOURCE_DIR;

/// Returns the word that hides an actor: "nobody" or "whoever", also as a part of a name, or "who" without a
/// person before it. Empty if there is none.
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

/// Returns a word of the line that another word has replaced: "restarts" stands for "begins anew", an actor
/// for "it is told", and a type's new name for its old one. Empty if there is none.
std::string replacedWord(const std::string& line) {
  static constexpr std::string_view kReplaced[] = {
      "anew",           "Anew",          "begin again",   "begins again",    "began again",
      "begun again",    "BeginAgain",    "BeginsAgain",   "beginAgain",      "is told at once",
      "are told apart", "is told of",    "are told of",   "of the one that", "DrawingHere",
      "InWorkers",      "CpuWalls",      "TriangleSieve", "SmallThings",     "LoneClock",
      "OperatorDesk",   "CrowdStep",     "CrowdBody",     "CrowdContact",    "CrowdSolver",
      "CrowdEnergy",    "ContactChoice", "WayOut",        "ReliefPolicy",    "Concession",
      "Verb::",         "verbNamed",     "WallWorker",    "worker process",  "dearest",
      "leaps",          "ways out"};
  const auto isLetter = [&](std::size_t at) {
    return at < line.size() && std::islower(static_cast<unsigned char>(line[at])) != 0;
  };
  for (const std::string_view word : kReplaced)
    for (std::size_t at = line.find(word); at != line.npos; at = line.find(word, at + 1)) {
      const bool begins =
          std::isupper(static_cast<unsigned char>(word.front())) || at == 0 || !isLetter(at - 1);
      if (begins && !isLetter(at + word.size())) return std::string(word);
    }
  return "";
}

TEST(Prose, WordsThatWereReplacedAreFound) {
  EXPECT_EQ(replacedWord("the show begins anew"), "anew");
  EXPECT_EQ(replacedWord("void beginAnew();"), "Anew");
  EXPECT_EQ(replacedWord("left ended and begins again"), "begins again");
  EXPECT_EQ(replacedWord("each is told at once"), "is told at once");
  EXPECT_EQ(replacedWord("class ViewsInWorkers {"), "InWorkers");
  EXPECT_EQ(replacedWord("case Verb::Load:"), "Verb::");
  EXPECT_EQ(replacedWord("class ThrowMeasureNode : public PlacedNode {"), "");
  EXPECT_EQ(replacedWord("A crowd begins to cheer, and renews it again."), "");
}

/// Returns false for bytes, for this test's examples, and for shows whose hashes the fuzz corpus holds.
bool isProse(const fs::path& file) {
  static const std::set<std::string> kinds{".h", ".cpp", ".md", ".evs", ".txt", ".patch", ".expected", ""};
  const std::string path = file.string();
  return kinds.contains(file.extension()) && file.filename() != "prose_test.cpp" &&
         path.find("/tests/fuzz/corpus/") == path.npos && path.find("/tests/fuzz/shows/") == path.npos;
}

TEST(Prose, NoActorIsHiddenAndNoReplacedWordIsBack) {
  for (const char* folder : {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "tests",
                             "docs", "examples", "scripts", "assets/generator", "packaging"})
    for (const auto& entry : fs::recursive_directory_iterator(kSourceFolder / folder)) {
      if (!entry.is_regular_file() || !isProse(entry.path())) continue;
      std::ifstream in(entry.path());
      std::string line;
      for (std::size_t n = 1; std::getline(in, line); ++n) {
        const auto where = [&] {
          return fs::relative(entry.path(), kSourceFolder).string() + ":" + std::to_string(n);
        };
        EXPECT_EQ(hiddenActor(line), "") << where() << ": name the actor: " << line;
        EXPECT_EQ(replacedWord(line), "") << where() << ": use the word that replaced it: " << line;
      }
    }
}

}  // namespace
