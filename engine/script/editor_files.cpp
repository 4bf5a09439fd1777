#include "engine/script/reference.h"
#include "engine/script/schema.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stadion {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kQuotes = "[\"\u201C\u201D\u201E\u201F\u2033]";

/// "\b(a|b|c)\b", the longer words first so that none hides another.
std::string anyOf(std::vector<std::string> words) {
  std::sort(words.begin(), words.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() > b.size() : a < b;
  });
  std::string pattern;
  for (const std::string& word : words) pattern += (pattern.empty() ? "" : "|") + word;
  return "\\b(" + pattern + ")\\b";
}

template <std::size_t N>
std::vector<std::string> wordsOf(const std::array<std::string_view, N>& names) {
  return {names.begin(), names.end()};
}

Json match(const char* scope, const std::string& pattern) {
  return {{"name", scope}, {"match", pattern}};
}

Json attributeEntry(const AttributeSpec& spec) {
  Json entry = {{"name", nameOf(spec.attr)}, {"help", spec.help}, {"form", formOf(spec)}};
  if (!spec.unit.empty()) entry["unit"] = spec.unit;
  if (!spec.standard.empty()) entry["standard"] = spec.standard;
  if (spec.required) entry["required"] = true;
  if (spec.repeatable) entry["repeatable"] = true;
  for (const std::string_view word : spec.choices) entry["values"].push_back(word);
  if (spec.kind == ValueKind::Flag) entry["values"] = {"on", "off"};
  for (std::size_t i = 0; i < kNodeKindCount; ++i)
    if (spec.targets.has(static_cast<NodeKind>(i))) entry["nodes"].push_back(kNodeKindNames[i]);
  return entry;
}

/// "dynobject( name=${1:name}, file=${2:file} )": the name and what is required.
std::string snippetOf(NodeKind kind) {
  std::string snippet = fmt::format("{}( name=${{1:name}}", nameOf(kind));
  int stop = 2;
  for (const AttributeSpec* spec : attributesOf(kind))
    if (spec->required)
      snippet += fmt::format(", {}=\"${{{}:{}}}\"", nameOf(spec->attr), stop++, nameOf(spec->attr));
  return snippet + " )$0";
}

Json nodeEntry(const NodeSpec& node) {
  Json entry = {{"name", nameOf(node.kind)}, {"help", node.help}, {"snippet", snippetOf(node.kind)}};
  for (const AttributeSpec* spec : attributesOf(node.kind))
    entry["attributes"].push_back(attributeEntry(*spec));
  entry["events"] = Json::array();
  for (const Event event : node.events) entry["events"].push_back(nameOf(event));
  entry["commands"] = Json::array();
  for (std::size_t i = 0; i < kVerbCount; ++i)
    if (specOf(static_cast<Verb>(i)).receivers.has(node.kind)) entry["commands"].push_back(kVerbNames[i]);
  return entry;
}

}  // namespace

std::string editorGrammar() {
  const Json quoted = {{"name", "string.quoted.evs"},
                       {"begin", kQuotes},
                       {"end", fmt::format("{}|$", kQuotes)},
                       {"patterns",
                        {match("entity.name.function.event.evs", anyOf(wordsOf(kEventNames))),
                         match("support.function.command.evs", anyOf(wordsOf(kVerbNames))),
                         match("constant.numeric.evs", "[-+]?[0-9]*\\.?[0-9]+([eE][-+]?[0-9]+)?")}}};
  const Json grammar = {
      {"name", "EVS world description"},
      {"scopeName", "source.evs"},
      {"fileTypes", {"evs"}},
      {"patterns",
       {match("comment.line.number-sign.evs", "#.*$"), quoted,
        match("entity.name.type.node.evs", anyOf(wordsOf(kNodeKindNames)) + "(?=\\s*\\()"),
        match("variable.parameter.attribute.evs", anyOf(wordsOf(kAttrNames)) + "(?=\\s*=)"),
        match("constant.language.evs", "\\b(on|off|true|false)\\b"),
        match("constant.numeric.evs", "(?<==)\\s*[-+]?[0-9]*\\.?[0-9]+([eE][-+]?[0-9]+)?")}}};
  return grammar.dump(2) + "\n";
}

std::string editorCompletion() {
  Json list;
  for (std::size_t i = 0; i < kNodeKindCount; ++i)
    list["nodes"].push_back(nodeEntry(specOf(static_cast<NodeKind>(i))));
  for (std::size_t i = 0; i < kEventCount; ++i) {
    const EventSpec& event = specOf(static_cast<Event>(i));
    list["events"].push_back({{"name", nameOf(event.event)}, {"help", event.help}});
  }
  for (std::size_t i = 0; i < kVerbCount; ++i) {
    const CommandSpec& command = specOf(static_cast<Verb>(i));
    list["commands"].push_back(
        {{"name", nameOf(command.verb)}, {"form", command.form}, {"help", command.help}});
  }
  return list.dump(2) + "\n";
}

}  // namespace stadion
