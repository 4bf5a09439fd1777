#include "engine/script/choice.h"
#include "engine/script/reference.h"
#include "engine/script/schema.h"
#include "engine/script/script.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace stadion {
namespace {

TEST(ScriptSchema, TheTablesAreInTheOrderOfTheirEnumerations) {
  for (std::size_t i = 0; i < kNodeKindCount; ++i)
    EXPECT_EQ(specOf(static_cast<NodeKind>(i)).kind, static_cast<NodeKind>(i)) << kNodeKindNames[i];
  for (std::size_t i = 0; i < kVerbCount; ++i)
    EXPECT_EQ(specOf(static_cast<Verb>(i)).verb, static_cast<Verb>(i)) << kVerbNames[i];
  for (std::size_t i = 0; i < kEventCount; ++i)
    EXPECT_EQ(specOf(static_cast<Event>(i)).event, static_cast<Event>(i)) << kEventNames[i];
}

TEST(ScriptSchema, EveryWordHasANameOfItsOwn) {
  std::set<std::string_view> words;
  for (const auto word : kAttrNames) EXPECT_TRUE(!word.empty() && words.insert(word).second) << word;
  for (std::size_t i = 0; i < kAttrCount; ++i) EXPECT_EQ(attrNamed(kAttrNames[i]), static_cast<Attr>(i));
  EXPECT_EQ(nameOf(Attr::Zenith), "zenith");
  EXPECT_EQ(nameOf(Attr::ReleaseDistance), "releasedistance");
  EXPECT_EQ(nameOf(Verb::Unload), "unload");
  EXPECT_EQ(nameOf(Event::OnRelease), "onrelease");
  EXPECT_EQ(nameOf(NodeKind::Rig), "rig");
}

TEST(ScriptSchema, EveryAttributeIsUsedAndNoneTwiceInAKind) {
  std::set<Attr> used;
  for (std::size_t i = 0; i < kNodeKindCount; ++i) {
    std::set<Attr> inKind;
    for (const AttributeSpec* spec : attributesOf(static_cast<NodeKind>(i))) {
      EXPECT_TRUE(inKind.insert(spec->attr).second) << kNodeKindNames[i] << ": " << nameOf(spec->attr);
      EXPECT_EQ(specOf(static_cast<NodeKind>(i), spec->attr), spec);
      used.insert(spec->attr);
    }
  }
  EXPECT_EQ(used.size(), kAttrCount);
}

TEST(ScriptSchema, RowsAreComplete) {
  for (std::size_t i = 0; i < kNodeKindCount; ++i)
    for (const AttributeSpec* spec : attributesOf(static_cast<NodeKind>(i))) {
      EXPECT_FALSE(spec->help.empty()) << nameOf(spec->attr);
      EXPECT_EQ(spec->kind == ValueKind::Choice || spec->kind == ValueKind::Choices, !spec->choices.empty())
          << nameOf(spec->attr);
      EXPECT_EQ(spec->kind == ValueKind::Reference, !spec->targets.empty()) << nameOf(spec->attr);
      EXPECT_FALSE(spec->required && !spec->standard.empty()) << nameOf(spec->attr);
    }
}

/// Each standard value, written out in a script, must be accepted by the checker.
TEST(ScriptSchema, StandardValuesObeyTheirOwnRules) {
  for (std::size_t i = 0; i < kNodeKindCount; ++i)
    for (const AttributeSpec* spec : attributesOf(static_cast<NodeKind>(i))) {
      if (spec->standard.empty()) continue;
      std::string script = std::string(kNodeKindNames[i]) + "(" + std::string(nameOf(spec->attr)) + "=\"" +
                           std::string(spec->standard) + "\")";
      Diagnostics findings;
      checkScript(std::move(SourceText::make("a.evs", script).value()), findings);
      for (const Diagnostic& d : findings.all())  // only what is missing, never the value itself
        EXPECT_TRUE(d.where.column == 1 || d.message.find("it needs") != std::string::npos)
            << script << format(d);
    }
}

TEST(ScriptSchema, ChoicesFollowTheirEnumerations) {
  const auto word = [](NodeKind kind, Attr attr, auto choice) {
    return specOf(kind, attr)->choices[static_cast<std::size_t>(choice)];
  };
  EXPECT_EQ(word(NodeKind::Light, Attr::Type, LightType::Spot), "spot");
  EXPECT_EQ(word(NodeKind::Object, Attr::Shape, ShapeWord::Plane), "plane");
  EXPECT_EQ(word(NodeKind::Object, Attr::Up, UpAxis::Z), "z");
  EXPECT_EQ(word(NodeKind::ForceLinear, Attr::Unit, ForceUnit::Acceleration), "m/s2");
  EXPECT_EQ(word(NodeKind::ForceSpherical, Attr::Unit, ForceUnit::Newton), "N");
  EXPECT_EQ(word(NodeKind::ForceSpherical, Attr::Mode, FieldMode::Repel), "repel");
  EXPECT_EQ(word(NodeKind::ForceSpherical, Attr::Falloff, FieldFalloff::Square), "square");
  EXPECT_EQ(word(NodeKind::Navigator, Attr::Mode, NavigatorMode::Fly), "fly");
}

TEST(ScriptReference, TheReferenceNamesEveryWordOfTheLanguage) {
  const std::string text = languageReference();
  for (const auto word : kNodeKindNames) EXPECT_NE(text.find(word), text.npos) << word;
  for (const auto word : kAttrNames)
    EXPECT_NE(text.find("\n  " + std::string(word) + " "), text.npos) << word;
  for (const auto word : kEventNames) EXPECT_NE(text.find(word), text.npos) << word;
  for (const auto word : kVerbNames) EXPECT_NE(text.find("\n  " + std::string(word)), text.npos) << word;
}

TEST(ScriptReference, OneTypeHasItsAttributesEventsAndCommands) {
  const std::string text = languageReference(NodeKind::DynObject);
  for (const char* word :
       {"density", "relative to water", "position", "eventmessage", "unhook FIELD", "0.5 if not"})
    EXPECT_NE(text.find(word), text.npos) << word;
  EXPECT_EQ(text.find("releasedistance"), text.npos);
  EXPECT_NE(languageReference(NodeKind::Dynamics).find("onimpact"), std::string::npos);
}

TEST(ScriptReference, NoLineIsTooWideToRead) {
  const std::string text = languageReference();
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = text.find('\n', start);
    EXPECT_LE(end - start, 125U) << text.substr(start, end - start);
    start = end + 1;
  }
}

TEST(ScriptReference, EditorFilesAreJsonAndComplete) {
  const auto grammar = nlohmann::json::parse(editorGrammar());
  EXPECT_EQ(grammar["scopeName"], "source.evs");
  const auto completion = nlohmann::json::parse(editorCompletion());
  ASSERT_EQ(completion["nodes"].size(), kNodeKindCount);
  EXPECT_EQ(completion["nodes"][4]["name"], "dynobject");
  EXPECT_EQ(completion["nodes"][4]["snippet"], "dynobject( name=${1:name}, file=\"${2:file}\" )$0");
  EXPECT_EQ(completion["commands"].size(), kVerbCount);
}

}  // namespace
}  // namespace stadion
