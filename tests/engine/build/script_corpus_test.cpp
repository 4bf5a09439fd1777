/// Every wrong script of tests/corpus/scripts/wrong gives the first error line in the .expected file beside
/// it, and damaged scripts of every sort are refused or read, quickly, but never bring the program down.

#include "engine/build/lint.h"
#include "engine/script/script.h"
#include "tests/mutations.h"
#include "tests/node_types.h"

#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace stadion {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = STADION_SOURCE_DIR;

std::string contentOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<fs::path> wrongScripts() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(kSource / "tests/corpus/scripts/wrong"))
    if (entry.path().extension() == ".evs") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

Diagnostics findingsOf(const std::string& name, const std::string& bytes) {
  Diagnostics findings;
  auto source = SourceText::make(name, bytes);
  if (!source) {
    findings.add(source.error());
    return findings;
  }
  const Document document = checkScript(std::move(source.value()), testTypes(), findings);
  lint(document, true, findings);
  return findings;
}

std::string firstErrorLine(const Diagnostics& findings) {
  for (const Diagnostic& d : findings.all())
    if (d.severity == Severity::Error) return format(d).substr(0, format(d).find('\n'));
  return "no error";
}

TEST(ScriptCorpus, EachWrongScriptGivesItsErrorLine) {
  const auto scripts = wrongScripts();
  ASSERT_GE(scripts.size(), 45U);
  for (const fs::path& path : scripts) {
    fs::path sidecar = path;
    std::string expected = contentOf(sidecar.replace_extension(".expected"));
    expected = expected.substr(0, expected.find('\n'));
    EXPECT_EQ(firstErrorLine(findingsOf(path.filename().string(), contentOf(path))), expected);
  }
}

TEST(ScriptCorpus, ThePapersScriptHasNeitherErrorNorWarning) {
  const auto findings = findingsOf("kick.evs", contentOf(kSource / "scripts/kick.evs"));
  for (const Diagnostic& d : findings.all()) ADD_FAILURE() << format(d);
}

/// Damages a text in one of many ways, the same for the same state of `random`.
class ScriptMutator {
public:
  explicit ScriptMutator(std::uint64_t seed) : random_(seed) {}

  std::string mutate(std::string text, const std::vector<std::string>& others) {
    const std::size_t changes = 1 + below(8);
    for (std::size_t i = 0; i < changes; ++i) change(text, others);
    return text;
  }

private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

  void change(std::string& text, const std::vector<std::string>& others) {
    static const std::vector<std::string> kPieces = {"(",
                                                     ")",
                                                     ",",
                                                     "=",
                                                     "\"",
                                                     "\u201C",
                                                     "\u201D",
                                                     "#",
                                                     "\n",
                                                     "\r",
                                                     "\t",
                                                     "/",
                                                     "..",
                                                     "\\",
                                                     "0",
                                                     "-",
                                                     "1e308",
                                                     "nan",
                                                     "inf",
                                                     "-1e999",
                                                     "0x10",
                                                     "on",
                                                     "object",
                                                     "path",
                                                     "key",
                                                     "dynamics",
                                                     "eventmessage",
                                                     "hook ",
                                                     "a/b",
                                                     "\xE2",
                                                     "\xFF",
                                                     "\xE2\x80",
                                                     std::string(1, '\0'),
                                                     std::string(5000, '('),
                                                     std::string(5000, 'x'),
                                                     std::string(3000, '"'),
                                                     "\"1 2 3 4 5 6 7 8 9\""};
    const std::size_t at = below(text.size() + 1);
    switch (below(6)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(below(256));
      break;
    case 1: text.erase(at, below(40)); break;
    case 2: text.insert(at, kPieces[below(kPieces.size())]); break;
    case 3: text.insert(at, text.substr(below(text.size() + 1), below(200))); break;
    case 4: text.resize(at); break;
    default: {
      const std::string& other = others[below(others.size())];
      text.insert(at, other.substr(below(other.size() + 1)));
    }
    }
  }

  std::mt19937_64 random_;
};

TEST(ScriptCorpus, DamagedScriptsAreAnsweredWithinASecond) {
  const auto [count, seed] = test::mutations(300);
  std::vector<std::string> texts = {contentOf(kSource / "scripts/kick.evs")};
  for (const fs::path& path : wrongScripts()) texts.push_back(contentOf(path));

  int refused = 0;
  for (int i = 0; i < count; ++i) {
    ScriptMutator mutator(seed * 1'000'003 + static_cast<std::uint64_t>(i));
    const std::string& base = i % 2 == 0 ? texts[0] : texts[static_cast<std::size_t>(i) % texts.size()];
    const std::string text = mutator.mutate(base, texts);
    const std::clock_t start = std::clock();  // of the processor: others may be at work, too
    const Diagnostics findings = findingsOf("damaged.evs", text);
    for (const Diagnostic& d : findings.all()) EXPECT_FALSE(format(d).empty());
    const double took = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(took, 1.0) << "mutation " << i;
    if (findings.hasErrors()) ++refused;
  }
  EXPECT_GT(refused, count / 2);
}

}  // namespace
}  // namespace stadion
