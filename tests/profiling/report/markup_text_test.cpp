/// Names that may be anything, in pages and XML.

#include "engine/plain_text/markup_text.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr const char* kReplaced = "\xEF\xBF\xBD";

TEST(MarkupText, WhatIsMarkupIsEscaped) {
  EXPECT_EQ(markupText("<a href=\"x\">'&amp;'"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;amp;&#39;");
}

TEST(MarkupText, CharactersStayAsTheyAre) {
  const std::string text = "Ol\xC3\xBCmpia \xE2\x82\xAC \xF0\x9F\x8F\x9B\n\t";
  EXPECT_EQ(markupText(text), text);
}

TEST(MarkupText, WhatXmlCannotHoldIsReplaced) {
  EXPECT_EQ(markupText(std::string("a\0b\x1B", 4)), "a b ");
  EXPECT_EQ(markupText("\xFFx"), std::string(kReplaced) + "x");
  EXPECT_EQ(markupText("\xC3"), kReplaced) << "cut off";
  EXPECT_EQ(markupText("\xC3<"), std::string(kReplaced) + "&lt;") << "what follows is not swallowed";
  EXPECT_EQ(markupText("\xC0\xAF"), std::string(kReplaced) + kReplaced) << "overlong";
  EXPECT_EQ(markupText("\xE0\x80\xAF"), std::string(kReplaced) + kReplaced + kReplaced) << "overlong";
  EXPECT_EQ(markupText("\xED\xA0\x80"), std::string(kReplaced) + kReplaced + kReplaced) << "surrogate";
  EXPECT_EQ(markupText("\xEF\xBF\xBE"), std::string(kReplaced) + kReplaced + kReplaced) << "no character";
  EXPECT_EQ(markupText("\xF4\x90\x80\x80").substr(0, 3), kReplaced) << "beyond the last one";
}

}  // namespace
}  // namespace stadion
