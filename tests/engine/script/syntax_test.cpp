#include "engine/script/syntax.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ctime>

namespace stadion {
namespace {

struct Parsed {
  std::vector<std::string> declarations;  // "type name=[value] ..."
  std::vector<std::string> errors;        // "LINE:COLUMN message"
};

Parsed parse(std::string_view text) {
  const auto source = SourceText::make("a.evs", text);
  const SourceText& s = source.value();
  Parsed result;
  parseSyntax(
      s,
      [&](const RawDeclaration& d) {
        std::string line(s.slice(d.type.offset, d.type.length));
        for (const RawAttribute& a : d.attributes)
          line += fmt::format(" {}=[{}]", s.slice(a.name.offset, a.name.length),
                              s.slice(a.value.offset, a.value.length));
        result.declarations.push_back(line + (d.complete ? "" : " ..."));
      },
      [&](std::uint32_t offset, std::string message) {
        const SourcePosition at = s.position(offset);
        result.errors.push_back(fmt::format("{}:{} {}", at.line, at.column, message));
        return true;
      });
  return result;
}

using Lines = std::vector<std::string>;

TEST(ScriptSyntax, BareAndQuotedValuesAreRead) {
  const Parsed p = parse("group(name=a, position = \"1, 2, 3\" , scale=2)");
  EXPECT_EQ(p.declarations, Lines{"group name=[a] position=[1, 2, 3] scale=[2]"});
  EXPECT_TRUE(p.errors.empty());
}

TEST(ScriptSyntax, AnyQuoteOpensAndAnyQuoteCloses) {
  const Parsed p = parse("g(a=\u201Dx\u201D, b=\u201Cy, z\u201D, c=\"w\u201C, d=\u201Ev\u201F)");
  EXPECT_EQ(p.declarations, Lines{"g a=[x] b=[y, z] c=[w] d=[v]"});
  EXPECT_TRUE(p.errors.empty());
}

TEST(ScriptSyntax, CommentsMayStandAnywhere) {
  const Parsed p = parse("# first\ng( # open\n a=1, # after a value\n b=on# close by\n)# end\n#");
  EXPECT_EQ(p.declarations, Lines{"g a=[1] b=[on]"});
  EXPECT_TRUE(p.errors.empty());
}

TEST(ScriptSyntax, ASharpInQuotesIsNoComment) {
  EXPECT_EQ(parse("g(a=\"x # y\")").declarations, Lines{"g a=[x # y]"});
}

TEST(ScriptSyntax, EmptyDeclarationsAndATrailingCommaAreAllowed) {
  const Parsed p = parse("g() h( ) k(a=1,) m(a=\"\" , )");
  EXPECT_EQ(p.declarations, (Lines{"g", "h", "k a=[1]", "m a=[]"}));
  EXPECT_TRUE(p.errors.empty());
}

TEST(ScriptSyntax, ByteOrderMarkAndAnyLineEndsAreAccepted) {
  const Parsed p = parse("\xEF\xBB\xBFg(a=1)\r\nh(\r\nb=2)\r# old\rk(c=3)");
  EXPECT_EQ(p.declarations, (Lines{"g a=[1]", "h b=[2]", "k c=[3]"}));
  EXPECT_TRUE(p.errors.empty());
}

TEST(ScriptSyntax, AfterAnErrorReadingGoesOnAtTheNextDeclaration) {
  const Parsed p = parse("g(a=1, b\nh(a=2)\nk(a=\"3)\nm(a=4)\n  n (a=5)");
  EXPECT_EQ(p.declarations, (Lines{"g a=[1] ...", "h a=[2]", "k ...", "m a=[4]", "n a=[5]"}));
  ASSERT_EQ(p.errors.size(), 2U);
  EXPECT_EQ(p.errors[0].substr(0, 4), "2:1 ");
  EXPECT_EQ(p.errors[1].substr(0, 4), "3:5 ");
}

TEST(ScriptSyntax, AttributesBeforeAnErrorAreKept) {
  EXPECT_EQ(parse("g(name=a, b=1 c=2)").declarations, Lines{"g name=[a] b=[1] ..."});
}

TEST(ScriptSyntax, ReadingEndsWhenTheReaderHasHeardEnough) {
  const auto source = SourceText::make("a.evs", "g\nh(\nk\nm(\n");
  int errors = 0;
  parseSyntax(
      source.value(), [](const RawDeclaration&) {},
      [&](std::uint32_t, const std::string&) {
        ++errors;
        return false;
      });
  EXPECT_EQ(errors, 1);
}

TEST(ScriptSyntax, WhatIsNotTextIsRefused) {
  EXPECT_FALSE(SourceText::make("a", std::string_view("g(\0)", 4)));
  EXPECT_FALSE(SourceText::make("a", "g(\xFF)"));
  EXPECT_FALSE(SourceText::make("a", "g(\xED\xA0\x80)"));  // a surrogate
  EXPECT_FALSE(SourceText::make("a", std::string((std::size_t{64} << 20) + 1, ' ')));
  EXPECT_FALSE(SourceText::read("/nonexistent/a.evs"));
  EXPECT_FALSE(SourceText::read(STADION_SOURCE_DIR));
  const auto model = SourceText::read(STADION_SOURCE_DIR "/assets/discus.glb");
  ASSERT_FALSE(model);
  EXPECT_NE(model.error().message.find("stadion view"), std::string::npos) << model.error().message;
  EXPECT_TRUE(SourceText::make("a", ""));
}

TEST(ScriptSyntax, PositionsCountLinesAndCharacters) {
  const auto source = SourceText::make("a.evs", "\u00E9\u00E9x\r\ny" + std::string(5000, 'z') + "q");
  const SourcePosition x = source.value().position(4);
  EXPECT_EQ(x.line, 1U);
  EXPECT_EQ(x.column, 3U);
  const SourcePosition q = source.value().position(7 + 1 + 5000);
  EXPECT_EQ(q.line, 2U);
  EXPECT_EQ(q.column, 5002U);
}

/// Doubling hostile text doubles the time, or a little more; a square law would quadruple it.
TEST(ScriptSyntax, HostileTextTakesLinearTime) {
  const auto repeated = [](std::string_view piece, std::size_t n) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i) text += piece;
    return text;
  };
  // Of processor time, and the least of some: on a busy machine caches are cold, and more are needed.
  const auto secondsFor = [](const std::string& text, double least) {
    const std::clock_t start = std::clock();
    parse(text);
    return std::min(least, double(std::clock() - start) / CLOCKS_PER_SEC);
  };
  for (const char* piece : {"g(", "a=b,", "\"", "g(a=\n", "\u201C", "#", "(", "g(a=1 ", "g\n", "\n("}) {
    const std::string shorter = repeated(piece, 25'000), longer = repeated(piece, 100'000);
    double quick = 1e300, slow = 1e300;
    for (int i = 0; i < 20 && (i < 3 || slow >= 0.01 + 9 * quick); ++i)
      quick = secondsFor(shorter, quick), slow = secondsFor(longer, slow);
    EXPECT_LT(slow, 0.01 + 9 * quick) << piece;
  }
}

}  // namespace
}  // namespace stadion
