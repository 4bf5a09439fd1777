#include "engine/base/diagnostic.h"
#include "engine/plain_text/suggestion.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

Diagnostic at(std::uint32_t line, std::uint32_t column, std::string excerpt) {
  return {Severity::Error, {"a.evs", line, column}, "no", std::move(excerpt)};
}

TEST(Diagnostic, APositionIsWrittenAsCompilersDo) {
  EXPECT_EQ(format(at(12, 7, "")), "a.evs:12:7: error: no");
  Diagnostic odd = at(0, 0, "");
  odd.severity = Severity::Warning;
  EXPECT_EQ(format(odd), "a.evs: warning: no");
  Diagnostic nowhere;
  nowhere.severity = Severity::Note;
  nowhere.message = "by the way";
  EXPECT_EQ(format(nowhere), "note: by the way");
}

TEST(Diagnostic, TheCaretStandsUnderTheColumn) {
  EXPECT_EQ(format(at(1, 3, "abcd\r\n")), "a.evs:1:3: error: no\nabcd\n  ^");
  EXPECT_EQ(format(at(1, 5, "abcd")), "a.evs:1:5: error: no\nabcd\n    ^");
}

TEST(Diagnostic, ATabAboveIsATabBelow) {
  EXPECT_EQ(format(at(1, 4, "\ta\tb")), "a.evs:1:4: error: no\n\ta\tb\n\t \t^");
}

TEST(Diagnostic, ColumnsCountCharactersNotBytes) {
  EXPECT_EQ(format(at(1, 3, "\u201Ca\u201Db")), "a.evs:1:3: error: no\n\u201Ca\u201Db\n  ^");
}

TEST(Diagnostic, ALongLineIsCutAroundTheCaret) {
  const std::string text = format(at(1, 5001, std::string(5000, 'x') + "y" + std::string(5000, 'z')));
  EXPECT_LT(text.size(), 400U);
  const std::size_t lineStart = text.find('\n') + 1;
  const std::size_t caretStart = text.find('\n', lineStart) + 1;
  EXPECT_EQ(text.find('y') - lineStart, text.find('^') - caretStart);
}

TEST(Diagnostic, ControlCharactersNeverReachTheTerminal) {
  EXPECT_EQ(format(at(1, 1, "\x1B[2Jx")).find('\x1B'), std::string::npos);
}

TEST(Diagnostic, ErrorsAreCountedAndWarningsAreNot) {
  Diagnostics d;
  d.warning({}, "w");
  EXPECT_FALSE(d.hasErrors());
  d.error({}, "e");
  Diagnostics both;
  both.note({}, "n");
  both.append(d);
  EXPECT_EQ(both.errorCount(), 1U);
  EXPECT_EQ(both.all().size(), 3U);
}

TEST(Diagnostic, ASlipIsRecognisedAndANewWordIsNot) {
  const std::vector<std::string> words = {"density", "friction", "draw", "hook"};
  EXPECT_EQ(closest("densty", words), "density");
  EXPECT_EQ(closest("hokk", words), "hook");
  EXPECT_EQ(closest("draw", words), "draw");
  EXPECT_EQ(closest("frition", words), "friction");
  EXPECT_EQ(closest("banana", words), std::nullopt);
  EXPECT_EQ(closest("", words), std::nullopt);
  EXPECT_EQ(closest("x", words), std::nullopt);
}

TEST(Diagnostic, TheSearchForASuggestionIsBounded) {
  // Long words that differ in every third letter are the most expensive to compare. The right one comes too late.
  std::vector<std::string> candidates(20000, std::string(64, 'a'));
  std::string word(64, 'a');
  for (std::size_t i = 0; i < word.size(); i += 2) word[i] = 'b';
  candidates.push_back(word);
  EXPECT_FALSE(closest(word, candidates));
  candidates.insert(candidates.begin(), word);
  EXPECT_TRUE(closest(word, candidates));
}

TEST(Diagnostic, TheNearestCandidateWins) {
  EXPECT_EQ(closest("wall", {"ball", "walls", "wall"}), "wall");
  EXPECT_EQ(closest("onrelase", {"onimpact", "release", "onrelease"}), "onrelease");
}

}  // namespace
}  // namespace stadion
