#include "cli/cluster/node_words.h"

#include "cli/options/run_options.h"
#include "show/cluster/cluster_part.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace stadion {
namespace {

/// CLI itself does not tell the names of options that help leaves out.
std::string nameOf(const CLI::Option& option) {
  return "--" + option.get_lnames().front();
}

/// Whether the node's `run` is to be told of it at all.
bool isOfRun(const CLI::Option& option) {
  constexpr std::array<std::string_view, 3> kOurs{"--help", "--once", "--out"};
  return option.nonpositional() && std::ranges::find(kOurs, nameOf(option)) == kOurs.end();
}

void addWords(const CLI::Option& option, const std::vector<std::string>& values,
              std::vector<std::string>& words) {
  const std::string name = nameOf(option);
  const bool isFlag = option.get_items_expected_max() == 0;
  if (isFlag && option.as<bool>()) words.push_back(name);
  if (isFlag) return;
  const auto each = static_cast<std::size_t>(std::max(1, option.get_items_expected_min()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (each == 1 && values[i].starts_with('-')) {
      words.push_back(name + "=" + values[i]);
      continue;
    }
    if (i % each == 0) words.push_back(name);
    words.push_back(values[i]);
  }
}

}  // namespace

bool isOfWhoLeads(std::string_view option) {
  constexpr std::array<std::string_view, 6> kOptions{"--tracker", "--rig",  "--predict",
                                                     "--osc",     "--wait", "--record-input"};
  return std::ranges::find(kOptions, option) != kOptions.end();
}

bool namesFileOfEach(const RunOptions& asked, std::string_view option) {
  const auto isIt = [&](const NamedFile& f) { return f.option == option && f.written; };
  return std::ranges::any_of(asked.namedFiles(), isIt) && !isOfWhoLeads(option);
}

std::string fileOfNode(const std::string& file, const std::string& node) {
  std::filesystem::path path = file;
  const std::string ending = path.extension();
  return path.replace_extension().string() + "-" + node + ending;
}

std::string folderOfNode(const std::string& out, const std::string& node) {
  return out + "/" + node;
}

std::vector<std::string> wordsOfNode(const CLI::App& command, const RunOptions& asked,
                                     const ClusterFile& cluster, std::size_t node) {
  const std::string& name = cluster.nodes[node].name;
  const bool leads = node == cluster.lead;
  const SessionSettings& settings = asked.settings;
  std::vector<std::string> words{settings.show.script, "--cluster", cluster.file, "--node", name};
  if (!settings.record.out.empty())
    words.insert(words.end(), {"--out", folderOfNode(settings.record.out, name)});
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || !isOfRun(*option) || (!leads && isOfWhoLeads(nameOf(*option)))) continue;
    std::vector<std::string> values = option->results();
    if (namesFileOfEach(asked, nameOf(*option))) values = {fileOfNode(values.back(), name)};
    addWords(*option, values, words);
  }
  // With trackers no log beside the show counts; the others do not know that there are any.
  if (!leads && !settings.console.trackers.device.empty() && settings.show.input.empty())
    words.insert(words.end(), {"--input", "none"});
  // All are on this machine: once is loud enough.
  if (!leads && !settings.console.noSound) words.push_back("--no-sound");
  return words;
}

void checkWordsOfNode(std::vector<std::string> words, Diagnostics& findings) {
  CLI::App run;
  RunOptions o;
  addRunOptions(run, o);
  std::ranges::reverse(words);  // as CLI takes them
  run.parse(std::move(words));
  if (!o.settle(findings)) return;
  refuseUnwritable(o.namedFiles(), findings);
  SessionSettings& s = o.settings;
  ClusterPart::create(
      s.cluster, s.show, s.draw.layout, [](const std::string&) {}, findings);
}

}  // namespace stadion
