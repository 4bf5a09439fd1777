#include "engine/script/attribute_text.h"
#include "engine/script/reference.h"

#include <algorithm>
#include <set>
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

std::vector<std::string> eventsOf(const NodeRegistry& types) {
  std::vector<std::string> words;
  for (const EventSpec* row : types.events()) words.emplace_back(row->event.name());
  return words;
}

std::vector<std::string> commandsOf(const NodeRegistry& types) {
  std::vector<std::string> words;
  for (const CommandSpec* row : types.commands()) words.emplace_back(row->name);
  return words;
}

std::vector<std::string> attributesOf(const NodeRegistry& types) {
  std::set<std::string> words;
  for (const NodeRegistry::Index i : types.byName())
    for (const AttributeSpec& row : types[i].attributes()) words.emplace(row.name);
  return {words.begin(), words.end()};
}

Json match(const char* scope, const std::string& pattern) {
  return {{"name", scope}, {"match", pattern}};
}

Json attributeEntry(const AttributeSpec& spec, const NodeRegistry& types) {
  Json entry = {{"name", spec.name}, {"help", spec.help}, {"form", formOf(spec)}};
  if (!spec.unit.empty()) entry["unit"] = spec.unit;
  if (!spec.standard.empty()) entry["standard"] = spec.standard;
  if (spec.required) entry["required"] = true;
  if (spec.repeatable) entry["repeatable"] = true;
  for (const std::string_view word : spec.choices) entry["values"].push_back(word);
  if (spec.kind == ValueKind::Flag) entry["values"] = {"on", "off"};
  for (const NodeRegistry::Index i : types.byName())
    if (spec.targets.matches(types[i].type())) entry["nodes"].push_back(types[i].name());
  return entry;
}

/// "dynobject( name=${1:name}, file=${2:file} )": the name and what is required.
std::string snippetOf(const RegisteredType& node) {
  std::string snippet = fmt::format("{}( name=${{1:name}}", node.name());
  int stop = 2;
  for (const AttributeSpec& spec : node.attributes())
    if (spec.required) snippet += fmt::format(", {}=\"${{{}:{}}}\"", spec.name, stop++, spec.name);
  return snippet + " )$0";
}

Json nodeEntry(const RegisteredType& node, const NodeRegistry& types) {
  Json entry = {{"name", node.name()}, {"help", node.type().help}, {"snippet", snippetOf(node)}};
  for (const AttributeSpec& spec : node.attributes())
    entry["attributes"].push_back(attributeEntry(spec, types));
  entry["events"] = Json::array();
  for (const EventSpec& row : node.type().events) entry["events"].push_back(row.event.name());
  entry["commands"] = Json::array();
  for (const CommandSpec& command : node.commands()) entry["commands"].push_back(command.name);
  return entry;
}

}  // namespace

std::string editorGrammar(const NodeRegistry& types) {
  const Json quoted = {{"name", "string.quoted.evs"},
                       {"begin", kQuotes},
                       {"end", fmt::format("{}|$", kQuotes)},
                       {"patterns",
                        {match("entity.name.function.event.evs", anyOf(eventsOf(types))),
                         match("support.function.command.evs", anyOf(commandsOf(types))),
                         match("constant.numeric.evs", "[-+]?[0-9]*\\.?[0-9]+([eE][-+]?[0-9]+)?")}}};
  const Json grammar = {
      {"name", "EVS world description"},
      {"scopeName", "source.evs"},
      {"fileTypes", {"evs"}},
      {"patterns",
       {match("comment.line.number-sign.evs", "#.*$"), quoted,
        match("entity.name.type.node.evs", anyOf(types.names()) + "(?=\\s*\\()"),
        match("variable.parameter.attribute.evs", anyOf(attributesOf(types)) + "(?=\\s*=)"),
        match("constant.language.evs", "\\b(on|off|true|false)\\b"),
        match("constant.numeric.evs", "(?<==)\\s*[-+]?[0-9]*\\.?[0-9]+([eE][-+]?[0-9]+)?")}}};
  return grammar.dump(2) + "\n";
}

std::string editorCompletion(const NodeRegistry& types) {
  Json list;
  for (const NodeRegistry::Index i : types.byName()) list["nodes"].push_back(nodeEntry(types[i], types));
  for (const EventSpec* row : types.events())
    list["events"].push_back({{"name", row->event.name()}, {"help", row->help}});
  for (const CommandSpec* row : types.commands())
    list["commands"].push_back({{"name", row->name}, {"form", row->form}, {"help", row->help}});
  return list.dump(2) + "\n";
}

}  // namespace stadion
