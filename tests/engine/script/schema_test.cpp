#include "engine/core/shared_rows.h"
#include "engine/script/attribute_text.h"
#include "engine/script/reference.h"
#include "engine/script/script.h"
#include "tests/node_types.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace stadion {
namespace {

/// Calls `look` with every attribute of every type.
template <class Look>
void forEachRow(Look look) {
  for (const NodeRegistry::Index i : testTypes().byName())
    for (const AttributeSpec& row : testTypes()[i].attributes()) look(testTypes()[i], row);
}

TEST(ScriptSchema, SharedCommandsHaveTheNumbersThatStatesHold) {
  const std::string_view words[] = {"enable", "disable", "toggle", "attach", "detach", "show",
                                    "hide",   "reset",   "hook",   "unhook", "grab",   "release",
                                    "load",   "unload",  "say",    "start"};
  for (std::size_t i = 0; i < std::size(words); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(commandNamed(words[i])), i) << words[i];
    EXPECT_NE(testTypes().command(words[i]), nullptr) << words[i];
  }
  EXPECT_GE(static_cast<std::size_t>(commandNamed("tug")), std::size_t{1} << 23);
}

TEST(ScriptSchema, TypesAreListedByName) {
  const std::vector<std::string> names = testTypes().names();
  EXPECT_TRUE(std::ranges::is_sorted(names));
  EXPECT_EQ(names.size(), 30U);
}

TEST(ScriptSchema, NoTypeHasAnAttributeTwice) {
  forEachRow([](const RegisteredType& type, const AttributeSpec& row) {
    EXPECT_EQ(type.find(row.attr), &row) << type.name() << ": " << row.name;
  });
}

TEST(ScriptSchema, RowsAreComplete) {
  forEachRow([](const RegisteredType&, const AttributeSpec& row) {
    EXPECT_FALSE(row.help.empty()) << row.name;
    EXPECT_EQ(row.kind == ValueKind::Choice || row.kind == ValueKind::Choices, !row.choices.empty())
        << row.name;
    EXPECT_EQ(row.kind == ValueKind::Reference, !describe(testTypes(), row.targets).empty()) << row.name;
    EXPECT_FALSE(row.required && !row.standard.empty()) << row.name;
  });
}

/// Each standard value, written out in a script, must be accepted by the checker.
TEST(ScriptSchema, StandardValuesObeyTheirOwnRules) {
  forEachRow([](const RegisteredType& type, const AttributeSpec& row) {
    if (row.standard.empty()) return;
    const std::string script =
        std::string(type.name()) + "(" + std::string(row.name) + "=\"" + std::string(row.standard) + "\")";
    Diagnostics findings;
    checkScript(std::move(SourceText::make("a.evs", script).value()), testTypes(), findings);
    for (const Diagnostic& d : findings.all())  // only what is missing, never the value itself
      EXPECT_TRUE(d.where.column == 1 || d.message.find("it needs") != std::string::npos)
          << script << format(d);
  });
}

TEST(ScriptReference, TheReferenceNamesEveryWordOfTheLanguage) {
  const std::string text = languageReference(testTypes());
  for (const std::string& word : testTypes().names()) EXPECT_NE(text.find(word), text.npos) << word;
  forEachRow([&](const RegisteredType&, const AttributeSpec& row) {
    // With its help, which begins in a column: a command may have the same name.
    std::string line = "\n  " + std::string(row.name);
    line.resize(std::max(line.size(), std::size_t{20}), ' ');
    EXPECT_NE(text.find(line + " " + std::string(row.help.substr(0, 20))), text.npos) << row.name;
  });
  for (const EventSpec* row : testTypes().events())
    EXPECT_NE(text.find(row->event.name()), text.npos) << row->event.name();
  for (const CommandSpec* row : testTypes().commands())
    EXPECT_NE(text.find("\n  " + std::string(row->name)), text.npos) << row->name;
}

TEST(ScriptReference, OneTypeHasItsAttributesEventsAndCommands) {
  const std::string text = languageReference(testTypes(), *testTypes().named("dynobject"));
  for (const char* word :
       {"density", "relative to water", "position", "eventmessage", "unhook FIELD", "0.5 if not"})
    EXPECT_NE(text.find(word), text.npos) << word;
  EXPECT_EQ(text.find("releasedistance"), text.npos);
  EXPECT_NE(languageReference(testTypes(), *testTypes().named("dynamics")).find("onimpact"),
            std::string::npos);
}

TEST(ScriptReference, NoLineIsTooWideToRead) {
  const std::string text = languageReference(testTypes());
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = text.find('\n', start);
    EXPECT_LE(end - start, 127U) << text.substr(start, end - start);
    start = end + 1;
  }
}

TEST(ScriptReference, EditorFilesAreJsonAndComplete) {
  const auto grammar = nlohmann::json::parse(editorGrammar(testTypes()));
  EXPECT_EQ(grammar["scopeName"], "source.evs");
  const auto completion = nlohmann::json::parse(editorCompletion(testTypes()));
  ASSERT_EQ(completion["nodes"].size(), testTypes().size());
  const auto dynobject =
      std::ranges::find_if(completion["nodes"], [](const auto& node) { return node["name"] == "dynobject"; });
  ASSERT_NE(dynobject, completion["nodes"].end());
  EXPECT_EQ((*dynobject)["snippet"], "dynobject( name=${1:name}, file=\"${2:file}\" )$0");
  EXPECT_EQ(completion["commands"].size(), testTypes().commands().size());
}

}  // namespace
}  // namespace stadion
