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

/// Nodes with the same name.
struct ListedNodes {
  std::string name, where;  ///< where the last one stands
  int count = 0;
};

/// In the order of the list.
std::vector<ListedNodes> listedNodes(const std::string& text) {
  std::vector<ListedNodes> all;
  std::map<std::string, std::size_t> places;
  std::istringstream lines(text);
  const std::string begin = std::string("@") + kListedNode;
  for (std::string line; std::getline(lines, line) && line.starts_with(begin);) {
    const std::size_t tab = std::min(line.find('\t'), line.size());
    const std::string name = withoutLine(line.substr(begin.size(), tab - begin.size()));
    const auto [at, isNew] = places.emplace(name, all.size());
    if (isNew) all.push_back({name, "", 0});
    ListedNodes& nodes = all[at->second];
    nodes.where = tab < line.size() ? line.substr(tab + 1) : "";
    ++nodes.count;
  }
  return all;
}

SavedStateDifference differenceIn(const ListedNodes& nodes, int here, int there) {
  const std::string name =
      nodes.name.ends_with(':') ? nodes.name.substr(0, nodes.name.size() - 1) : nodes.name;
  return {
      fmt::format("the number of nodes \"{}\"{}", name, nodes.where.empty() ? "" : " (" + nodes.where + ")"),
      std::to_string(here), std::to_string(there)};
}

std::optional<SavedStateDifference> differenceOfNodes(const std::string& here, const std::string& there) {
  const std::vector<ListedNodes> ours = listedNodes(here), theirs = listedNodes(there);
  if (ours.empty() || theirs.empty()) return {};
  const auto countIn = [](const std::vector<ListedNodes>& all, const std::string& name) {
    const auto at = std::ranges::find(all, name, &ListedNodes::name);
    return at == all.end() ? 0 : at->count;
  };
  for (const ListedNodes& nodes : ours)
    if (const int other = countIn(theirs, nodes.name); other != nodes.count)
      return differenceIn(nodes, nodes.count, other);
  for (const ListedNodes& nodes : theirs)
    if (countIn(ours, nodes.name) == 0) return differenceIn(nodes, 0, nodes.count);
  return {};
}

/// "place.position" is a part of "place".
std::string wholeOf(const std::string& name) {
  return name.substr(0, name.find('.'));
}

}  // namespace

std::optional<SavedStateDifference> namedDifference(const std::string& here, const std::string& there) {
  if (auto nodes = differenceOfNodes(here, there)) return nodes;
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
