#include "engine/display/wall_file.h"
#include "engine/input/input_log.h"
#include "engine/input/rig_file.h"
#include "engine/script/script.h"
#include "engine/unicode/characters.h"
#include "engine/plain_text/suggestion.h"
#include "tests/node_types.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

using unicode::hiddenIn;
using unicode::skeleton;

Diagnostics findingsOf(std::string_view script) {
  Diagnostics findings;
  checkScript(std::move(SourceText::make("a.evs", script).value()), testTypes(), findings);
  return findings;
}

std::string utf8(char32_t code) {
  std::string text;
  unicode::append(text, code);
  return text;
}

/// Characters that cannot be seen, and what they are called.
struct Hidden {
  char32_t code;
  const char* name;
};
constexpr Hidden kHidden[] = {{0x200B, "U+200B ZERO WIDTH SPACE"},
                              {0xFEFF, "U+FEFF ZERO WIDTH NO-BREAK SPACE"},
                              {0xA0, "U+00A0 NO-BREAK SPACE"},
                              {0x202F, "U+202F NARROW NO-BREAK SPACE"},
                              {0x3000, "U+3000 IDEOGRAPHIC SPACE"},
                              {0x2003, "U+2003 EM SPACE"},
                              {0x2800, "U+2800 BRAILLE PATTERN BLANK"},
                              {0xAD, "U+00AD SOFT HYPHEN"},
                              {0x200C, "U+200C ZERO WIDTH NON-JOINER"},
                              {0x200D, "U+200D ZERO WIDTH JOINER"},
                              {0x200E, "U+200E LEFT-TO-RIGHT MARK"},
                              {0x202E, "U+202E RIGHT-TO-LEFT OVERRIDE"},
                              {0x2066, "U+2066 LEFT-TO-RIGHT ISOLATE"},
                              {0x2060, "U+2060 WORD JOINER"},
                              {0x2028, "U+2028 LINE SEPARATOR"},
                              {0x61C, "U+061C ARABIC LETTER MARK"},
                              {0x34F, "U+034F COMBINING GRAPHEME JOINER"},
                              {0x115F, "U+115F HANGUL CHOSEONG FILLER"},
                              {0x3164, "U+3164 HANGUL FILLER"},
                              {0x180E, "U+180E MONGOLIAN VOWEL SEPARATOR"},
                              {0xFE0F, "U+FE0F VARIATION SELECTOR-16"},
                              {0xE0100, "U+E0100 VARIATION SELECTOR-17"},
                              {0xE0041, "U+E0041 (a tag character)"},
                              {0x7, "U+0007 ALERT"},
                              {0x1B, "U+001B ESCAPE"},
                              {0x7F, "U+007F DELETE"},
                              {0x85, "U+0085 NEXT LINE"},
                              {0x90, "U+0090 (a control character)"},
                              {0xFFFE, "U+FFFE"}};

TEST(HiddenCharacters, InANameEachIsAnErrorWithItsCodePointAndColumn) {
  for (const auto& [code, name] : kHidden)
    for (const std::string before : {"", "b", "bä", "крап"}) {
      const std::string script = "object( file=b.obj,\n  name=\"" + before + utf8(code) + "all\" )";
      const Diagnostics findings = findingsOf(script);
      ASSERT_EQ(findings.all().size(), 1U) << name << " after " << before;
      const Diagnostic& d = findings.all()[0];
      EXPECT_NE(d.message.find(fmt::format("has {}, which cannot be seen; leave it out", name)),
                std::string::npos)
          << d.message;
      EXPECT_EQ(d.where.line, 2U);
      const std::size_t letters = before == "крап" ? 4 : before == "bä" ? 2 : before.size();
      EXPECT_EQ(d.where.column, 9 + letters) << name;
    }
}

TEST(HiddenCharacters, WhereverANameStandsTheyAreFound) {
  const std::string zero = utf8(0x200B);
  const struct {
    std::string text;
    std::uint32_t column;
  } kPlaces[] = {
      {"object( name=ba" + zero + "ll, file=b.obj )", 16},
      {"object( file=b.obj, parent=ba" + zero + "ll )", 30},
      {"object( file=b.obj, parent=\"hall/ba" + zero + "ll\" )", 36},
      {"wandtrigger( sphere=\"0 0 0 1\", tracker=wa" + zero + "nd )", 42},
      {"timer( period=1, eventmessage=\"timesup, ba" + zero + "ll, hide\" )", 43},
      {"timer( period=1, eventmessage=\"times" + zero + "up, ball, hide\" )", 37},
      {"timer( period=1, eventmessage=\"timesup, ball, hi" + zero + "de\" )", 49},
      {"timer( period=1, eventmessage=\"timesup, ball, attach all wa" + zero + "nd\" )", 60},
      {"timer( period=1, eventmessage=\"timesup, ball, hook win" + zero + "d\" )", 55},
      {"timer( period=1, eventmessage=\"timesup, ball, hide, delay=1" + zero + "\" )", 60},
      {"object( file=b.obj, draw=o" + zero + "n )", 27},
      {"object( file=b.obj, position=\"1," + zero + " 2, 3\" )", 33},
      {"obj" + zero + "ect( file=b.obj )", 4},
      {"object(" + zero + " file=b.obj )", 8},
      {"object( fi" + zero + "le=b.obj )", 11},
  };
  for (const auto& [text, column] : kPlaces) {
    const Diagnostics findings = findingsOf(text);
    ASSERT_FALSE(findings.all().empty()) << text;
    const Diagnostic& d = findings.all()[0];
    EXPECT_NE(d.message.find("U+200B ZERO WIDTH SPACE"), std::string::npos) << text << ": " << d.message;
    EXPECT_EQ(d.where.column, column) << text;
  }
}

TEST(HiddenCharacters, ANodeWhoseNameHasOneIsNotMissedAsWell) {
  const Diagnostics findings =
      findingsOf("object( name=ba\u200Bll, file=b.obj )\nobject( file=b.obj, parent=ball )");
  EXPECT_EQ(findings.all().size(), 1U);
}

TEST(HiddenCharacters, NamesMayBeAnyOtherText) {
  for (const char* name : {"bäll", "мяч", "μπάλα", "球", "ボール", "공", "كرة", "כדור", "गेंद", "⚽", "e\u0301",
                           "Ǆ", "a\u20DD", "\U0001F3C0", "ﬁ", "ＡＢ",
                           "\u0600"
                           "1",
                           // Joiners that a script needs: Persian, Hindi, Sinhala, Malayalam.
                           "می\u200Cخواهم", "क्\u200Dष", "ශ්\u200Dරී", "ന്\u200D\u0D31"}) {
    const Diagnostics findings = findingsOf(fmt::format("object( name=\"{0}\", file=b.obj )\n"
                                                        "object( file=b.obj, parent=\"{0}\" )",
                                                        name));
    for (const Diagnostic& d : findings.all()) ADD_FAILURE() << format(d);
  }
}

TEST(HiddenCharacters, AJoinerStandsOnlyWhereAScriptNeedsIt) {
  EXPECT_FALSE(hiddenIn("می\u200Cخ"));
  EXPECT_EQ(hiddenIn("می\u200C"), 4U) << "at the end";
  EXPECT_EQ(hiddenIn("\u200Cمی"), 0U);
  EXPECT_EQ(hiddenIn("می\u200C\u200Cخ"), 4U) << "twice";
  EXPECT_EQ(hiddenIn("ba\u200Dll"), 2U);
  EXPECT_EQ(hiddenIn("\U0001F468\u200D\U0001F469"), 4U) << "a family is no word";
  EXPECT_FALSE(hiddenIn("plain-name_9"));
  EXPECT_FALSE(hiddenIn("two words\tand a tab")) << "these blanks are for others";
}

TEST(HiddenCharacters, WhatIsWrittenForPeopleMayHaveAnyBlanks) {
  const Diagnostics findings =
      findingsOf("text( text=\"Bonjour\u00A0!\", name=t )\n"
                 "timer( period=1, eventmessage=\"timesup, t, say a\u00A0b\u200Bc\" )\n"
                 "# a comment\u00A0too\u200B");
  for (const Diagnostic& d : findings.all()) EXPECT_EQ(d.severity, Severity::Warning) << format(d);
}

TEST(HiddenCharacters, AByteOrderMarkMayBeginAFileAndNothingElse) {
  EXPECT_TRUE(findingsOf("\uFEFFobject( file=b.obj )").all().empty());
  const Diagnostics again = findingsOf("\uFEFF\uFEFFobject( file=b.obj )");
  ASSERT_EQ(again.all().size(), 1U);
  EXPECT_EQ(again.all()[0].where.column, 1U);
  EXPECT_NE(again.all()[0].message.find("U+FEFF ZERO WIDTH NO-BREAK SPACE"), std::string::npos);
}

TEST(HiddenCharacters, AnUnresolvedNameThatLooksLikeAnotherSaysHowTheyDiffer) {
  const struct {
    const char *there, *asked, *difference;
  } kPairs[] = {
      {"ball", "b\u0430ll",
       "this one has U+0430 CYRILLIC SMALL LETTER A, that one U+0061 LATIN SMALL LETTER A"},
      {"b\u0430ll", "ball",
       "this one has U+0061 LATIN SMALL LETTER A, that one U+0430 CYRILLIC SMALL LETTER A"},
      {"omo", "\u03BFmo", "U+03BF GREEK SMALL LETTER OMICRON"},
      {"кот", "ко\u0074", "U+0074 LATIN SMALL LETTER T"},
      {"café", "cafe\u0301", "U+0065 LATIN SMALL LETTER E with U+0301 COMBINING ACUTE ACCENT"},
      {"cafe\u0301", "café", "U+0301 COMBINING ACUTE ACCENT"},
      {"ball", "ｂａｌｌ", "U+FF42"},
      {"ball", "ba11", "U+0031 DIGIT ONE"},
      {"O2", "02", "U+0030 DIGIT ZERO"},
      {"left-wall", "left\u2011wall", "U+2011 NON-BREAKING HYPHEN"},
      {"ball", "𝐛𝐚𝐥𝐥", "U+1D41B"},
      {"Hall", "\u041D\u0430\u0049l", "U+041D CYRILLIC CAPITAL LETTER EN"},
      {"می\u200Cخ", "میخ", "that one has U+200C ZERO WIDTH NON-JOINER, which cannot be seen"},
  };
  for (const auto& [there, asked, difference] : kPairs) {
    const Diagnostics findings = findingsOf(fmt::format("object( name=\"{}\", file=b.obj )\n"
                                                        "object( file=b.obj, parent=\"{}\" )",
                                                        there, asked));
    ASSERT_EQ(findings.all().size(), 1U) << there;
    const std::string& message = findings.all()[0].message;
    EXPECT_NE(message.find("; did you mean \""), std::string::npos) << message;
    EXPECT_NE(message.find(" They look alike: "), std::string::npos) << message;
    EXPECT_NE(message.find(difference), std::string::npos) << message;
  }
}

TEST(HiddenCharacters, WordsThatLookDifferentAreNotSaidToLookAlike) {
  EXPECT_NE(skeleton("ball"), skeleton("bell"));
  EXPECT_NE(skeleton("мяч"), skeleton("меч"));
  EXPECT_NE(skeleton("é"), skeleton("e"));
  EXPECT_NE(skeleton("Ё"), skeleton("Е"));
  EXPECT_EQ(skeleton("Ё"), skeleton("E\u0308"));
  EXPECT_EQ(didYouMeanOne("bell", "ball"), "did you mean \"ball\"?");
}

TEST(HiddenCharacters, TheCaretStandsUnderTheCharacter) {
  const auto below = [](const std::string& line, std::uint32_t column) {
    const std::string text = format({Severity::Error, {"a", 1, column}, "m", line});
    return text.substr(text.find('\n') + 1);
  };
  EXPECT_EQ(below("ab\u200Bc", 3), "ab?c\n  ^");
  EXPECT_EQ(below("ab\u202Ec", 4), "ab?c\n   ^") << "the direction of the terminal stays";
  EXPECT_EQ(below("e\u0301x", 3), "e\u0301x\n ^") << "an accent has no width";
  EXPECT_EQ(below("球x", 2), "球x\n  ^") << "and some letters two";
  EXPECT_EQ(below("a\u00A0b", 2), "a\u00A0b\n ^");
  EXPECT_EQ(below("a\u200Cb", 2), "a?b\n ^");
  EXPECT_EQ(below("a\u200Cb", 3), "a\u200Cb\n ^");
  EXPECT_EQ(below("\x1b[2J", 1), "?[2J\n^");
}

TEST(HiddenCharacters, TheOtherFilesNameThemToo) {
  const auto first = [](const Diagnostics& findings) {
    return findings.all().empty() ? "" : format(findings.all()[0]);
  };
  for (const auto& [code, name] : kHidden) {
    if (code < 0x20) continue;
    const std::string h = utf8(code);
    Diagnostics rig, walls, log;
    EXPECT_FALSE(parseRigFile("stadion-rig 1\ntracker wä" + h + "nd", "a.rig", rig));
    EXPECT_NE(first(rig).find(fmt::format("a.rig:2:11: error: ")), std::string::npos) << first(rig);
    EXPECT_NE(first(rig).find(fmt::format("has {}, which cannot be seen; leave it out", name)),
              std::string::npos)
        << first(rig);
    EXPECT_FALSE(parseWalls("wall fr" + h + "ont lower-left -1 1 0 lower-right 1 1 0 upper-left -1 1 2\n",
                            "a.walls", walls));
    EXPECT_NE(first(walls).find("a.walls:1:8: error: "), std::string::npos) << first(walls);
    EXPECT_NE(first(walls).find(name), std::string::npos) << first(walls);
    EXPECT_FALSE(parseInputLog("stadion-input 1\nlost head" + h + " 1", "a.input", log));
    EXPECT_NE(first(log).find("a.input:2:10: error: "), std::string::npos) << first(log);
  }
}

TEST(HiddenCharacters, AForeignLetterInAPlainNameIsNamed) {
  Diagnostics findings;
  EXPECT_FALSE(parseRigFile("stadion-rig 1\ntracker w\u0430nd", "a.rig", findings));
  ASSERT_EQ(findings.all().size(), 1U);
  EXPECT_NE(findings.all()[0].message.find("; it has U+0430 CYRILLIC SMALL LETTER A"), std::string::npos)
      << findings.all()[0].message;
}

}  // namespace
}  // namespace stadion
