#include "engine/nodes/text_node.h"
#include "engine/text/glyph_outline.h"
#include "engine/text/glyphs.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

std::size_t trianglesOf(const std::string& text, const TextStyle& style = {}) {
  const auto mesh = textMesh(text, style);
  return mesh ? mesh->indices.size() / 3 : 0;
}

/// A show of one text, which another node can be told of.
struct TextShow : ShowFixture {
  TextNode* board = nullptr;
  explicit TextShow(const std::string& words) {
    loader.files["show"] = [this, words](LoadedScene& load) {
      board = &addNode<TextNode>(load, "board", PlaceAttributes{}, words, TextStyle{});
    };
    scene.open("show");
    frame();
  }
  void say(const std::string& words) {
    scene.command("board", CommandId::Say, {words}, input.time);
    frame();
  }
};

TEST(Text, StandsOnItsPlaceAsHighAsItsSizeAndIsReadAlongY) {
  TextStyle style;
  style.size = 2, style.align = TextAlign::Left;
  const auto mesh = textMesh("HE", style);
  ASSERT_TRUE(mesh);
  EXPECT_NEAR(mesh->bounds.lo.z(), 0, 1e-6);
  EXPECT_NEAR(mesh->bounds.hi.z(), 2, 1e-6);
  EXPECT_GT(mesh->bounds.lo.x(), 0);
  EXPECT_LT(mesh->bounds.hi.x(), 3.3);
  EXPECT_EQ(mesh->bounds.lo.y(), 0);
  EXPECT_EQ(mesh->bounds.hi.y(), 0);
  for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      const auto& p = mesh->positions[mesh->indices[i + k]];
      return Vec3(p[0], p[1], p[2]);
    };
    EXPECT_LT((at(1) - at(0)).cross(at(2) - at(0)).y(), 0) << "triangle " << i / 3 << " faces away";
  }
}

TEST(Text, LinesAreAlignedAtTheirBeginningTheirMiddleOrTheirEnd) {
  TextStyle style;
  style.size = 1;
  const auto boundsOf = [&](TextAlign align) {
    style.align = align;
    return textMesh("I\nHHH", style)->bounds;
  };
  const Aabb left = boundsOf(TextAlign::Left), centre = boundsOf(TextAlign::Centre),
             right = boundsOf(TextAlign::Right);
  EXPECT_GT(left.lo.x(), 0);
  EXPECT_LT(right.hi.x(), 0);
  EXPECT_NEAR(centre.lo.x(), -centre.hi.x(), 1e-6);
  EXPECT_NEAR(left.lo.z(), -kLineHeight / 100, 1e-6) << "the second line lies below the first";
}

TEST(Text, EscapesAreLineEndsAndCommasAndNothingElse) {
  EXPECT_EQ(unescaped(R"(a\nb\, c\d\\, e, f\)"), "a\nb, c\\d\\, e, f\\");
}

TEST(Text, ThickLettersEncloseTheirVolume) {
  TextStyle style;
  style.depth = 0.1;
  const std::string every =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.,:-+()/%°?!&ΓΔΘΛΞΠΣΦΨΩé";
  for (const char32_t c : charactersOf(every)) {
    double volume = 0;  // a sum of strokes, so that overlaps count twice
    for (const Band& band : bandsOf(drawn(c).glyph->path)) {
      EXPECT_EQ(band.left.size(), band.right.size());
      volume += static_cast<double>(band.left.size());
    }
    EXPECT_GT(volume, 0) << static_cast<std::uint32_t>(c);
  }
  const auto mesh = textMesh(every, style);
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> edges;
  for (std::size_t i = 0; i < mesh->indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = mesh->positions[mesh->indices[i + k]],
                 b = mesh->positions[mesh->indices[i + (k + 1) % 3]];
      ++edges[{a, b}], --edges[{b, a}];
    }
  for (const auto& [edge, balance] : edges) ASSERT_EQ(balance, 0);
}

TEST(Text, EveryGlyphLiesWithinItsLine) {
  for (char32_t c = 0x20; c < 0x2200; ++c) {
    const Glyph* glyph = findGlyph(c);
    if (!glyph) continue;
    EXPECT_GT(glyph->advance, 20) << static_cast<std::uint32_t>(c);
    for (const Band& band : bandsOf(glyph->path))
      for (const auto* rail : {&band.left, &band.right})
        for (const GlyphPoint& p : *rail) {
          EXPECT_GT(p.x, -8) << static_cast<std::uint32_t>(c);
          EXPECT_LT(p.x, glyph->advance + 8) << static_cast<std::uint32_t>(c);
          EXPECT_GT(p.y, -kDescent - 1) << static_cast<std::uint32_t>(c);
          EXPECT_LT(p.y, 125) << static_cast<std::uint32_t>(c);
        }
  }
}

TEST(Text, AnUnknownCharacterIsABoxAndIsNamed) {
  EXPECT_EQ(missingFrom("Ζ\nЖ and Ж"), std::vector<char32_t>{U'Ж'});
  EXPECT_TRUE(missingFrom("Visitor 43.01 m, ΟΛΥΜΠΙΑ, 20 °C: 100 % (über)").empty());
  EXPECT_EQ(trianglesOf("Ж"), trianglesOf("Щ"));
  EXPECT_GT(trianglesOf("Ж"), 0u);
  EXPECT_EQ(charactersOf("\xff\xc3"), (std::vector<char32_t>{0xFFFD, 0xFFFD}));
}

TEST(Text, NothingAndBlanksDrawNothing) {
  EXPECT_EQ(trianglesOf(""), 0u);
  EXPECT_EQ(trianglesOf(" \n "), 0u);
  EXPECT_EQ(trianglesOf(std::string(2 * kLongestWords, 'I')), 2 * kLongestWords);
}

TEST(Text, SaysWhatItIsToldAndTheMeshOfTheOldWordsIsFreedOnceItHasBeenShown) {
  TextShow show("0.00 m");
  EXPECT_EQ(show.meshes.size(), 1u);
  TextShow silent("0.00 m");
  silent.frame();
  show.say("43.01 m");
  EXPECT_EQ(show.board->words(), "43.01 m");
  EXPECT_NE(show.scene.stateHash(), silent.scene.stateHash()) << "the words are state";
  ASSERT_EQ(show.changes.instances.size(), 1u);
  const MeshId shown = show.changes.instances[0].record.mesh;
  ASSERT_NE(show.meshes.find(shown), nullptr);
  EXPECT_EQ(show.meshes.size(), 2u) << "the frame before may still be drawn";
  show.meshes.collect(show.next);
  EXPECT_EQ(show.meshes.size(), 1u);
  EXPECT_NE(show.meshes.find(shown), nullptr);
}

TEST(Text, ResetBringsItsFirstWordsBackAndTheSameWordsCostNothing) {
  TextShow show("ready");
  show.say("ready");
  EXPECT_TRUE(show.changes.instances.empty());
  show.say("");
  ASSERT_EQ(show.changes.instances.size(), 1u);
  EXPECT_LT(show.changes.instances[0].record.radius, 0) << "nothing is there to be drawn";
  show.scene.command("board", CommandId::Reset, {}, show.input.time);
  show.frame();
  EXPECT_EQ(show.board->words(), "ready");
}

}  // namespace
}  // namespace stadion
