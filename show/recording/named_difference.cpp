#include "show/recording/named_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace stadion {
namespace {

struct NamedValue {
  std::string key;          ///< the same node in another state has the same
  std::string node, where;  ///< its path; file and line
  std::string name, value;

  std::string told() const {
    return fmt::format("{}{}, {}", node, where.empty() ? "" : " (" + where + ")", name);
  }
};

/// "usertrigger:19" without the line. The names of a script have no colon.
std::string withoutLine(const std::string& path) {
  const std::size_t colon = path.rfind(':');
  const bool hasLine = colon != path.npos && colon + 1 < path.size() &&
                       path.find_first_not_of("0123456789", colon + 1) == path.npos;
  return hasLine ? path.substr(0, colon + 1) : path;
}

std::vector<NamedValue> valuesOf(const std::string& text) {
  std::vector<NamedValue> all;
  std::map<std::string, int> seen;
  NamedValue at;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t tab = std::min(line.find('\t'), line.size());
    const std::string first = line.substr(0, tab), second = tab < line.size() ? line.substr(tab + 1) : "";
    if (!line.starts_with('@')) {
      at.name = first;
      at.value = second;
      all.push_back(at);
      continue;
    }
    const std::string path = first.substr(1), same = withoutLine(path);
    const int number = ++seen[same];
    at.key = fmt::format("{} #{}", same, number);
    at.where = second;
    at.node = number > 1 && same == path ? at.key : path;
  }
  return all;
}

/// "place.position" is a part of "place".
std::string wholeOf(const std::string& name) {
  return name.substr(0, name.find('.'));
}

}  // namespace

std::optional<SavedStateDifference> namedDifference(const std::string& here, const std::string& there) {
  const std::vector<NamedValue> ours = valuesOf(here), theirs = valuesOf(there);
  std::map<std::pair<std::string, std::string>, std::string> left;
  std::set<std::pair<std::string, std::string>> wholes;  // an older build has one value where ours has parts
  for (const NamedValue& v : theirs) left[{v.key, v.name}] = v.value;
  for (const NamedValue& v : ours)
    if (const std::string whole = wholeOf(v.name); whole != v.name && left.contains({v.key, whole}))
      wholes.insert({v.key, whole});
  for (const auto& whole : wholes) left.erase(whole);
  for (const NamedValue& v : ours) {
    if (wholes.contains({v.key, wholeOf(v.name)})) continue;
    const auto at = left.find({v.key, v.name});
    const std::string other = at == left.end() ? "0" : at->second;
    if (other != v.value) return SavedStateDifference{v.told(), v.value, other};
    if (at != left.end()) left.erase(at);
  }
  for (const NamedValue& v : theirs)
    if (left.contains({v.key, v.name})) return SavedStateDifference{v.told(), "0", v.value};
  return {};
}

std::string frameOf(const std::string& fields) {
  for (const NamedValue& v : valuesOf(fields))
    if (v.node == "the scene" && v.name == "frame") return v.value;
  return "0";
}

}  // namespace stadion
