#include "cli/cluster/cluster_arguments.h"

#include "cli/options/run_options.h"
#include "show/cluster/cluster_session.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace stadion {
namespace {

/// Returns the name; CLI itself does not tell it for options that the help leaves out.
std::string nameOf(const CLI::Option& option) {
  return "--" + option.get_lnames().front();
}

/// Returns true if the host's `run` gets the option.
bool isOfRun(const CLI::Option& option) {
  constexpr std::array<std::string_view, 3> kOurs{"--help", "--once", "--out"};
  return option.nonpositional() && std::ranges::find(kOurs, nameOf(option)) == kOurs.end();
}

void addArguments(const CLI::Option& option, const std::vector<std::string>& values,
                  std::vector<std::string>& arguments) {
  const std::string name = nameOf(option);
  const bool isFlag = option.get_items_expected_max() == 0;
  if (isFlag && option.as<bool>()) arguments.push_back(name);
  if (isFlag) return;
  const auto each = static_cast<std::size_t>(std::max(1, option.get_items_expected_min()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (each == 1 && values[i].starts_with('-')) {
      arguments.push_back(name + "=" + values[i]);
      continue;
    }
    if (i % each == 0) arguments.push_back(name);
    arguments.push_back(values[i]);
  }
}

}  // namespace

bool isLeaderOption(std::string_view option) {
  constexpr std::array<std::string_view, 9> kOptions{"--tracker", "--rig",       "--predict",
                                                     "--osc",     "--wait",      "--record-input",
                                                     "--web",     "--web-token", "--web-name"};
  return std::ranges::find(kOptions, option) != kOptions.end();
}

bool namesFileOfEachHost(const RunOptions& asked, std::string_view option) {
  const auto isIt = [&](const NamedFile& f) { return f.option == option && f.written; };
  return std::ranges::any_of(asked.namedFiles(), isIt) && !isLeaderOption(option);
}

std::string fileOfHost(const std::string& file, const std::string& host) {
  std::filesystem::path path = file;
  const std::string ending = path.extension();
  return path.replace_extension().string() + "-" + host + ending;
}

std::string folderOfHost(const std::string& out, const std::string& host) {
  return out + "/" + host;
}

std::vector<std::string> argumentsOfHost(const CLI::App& command, const RunOptions& asked,
                                         const ClusterFile& cluster, std::size_t host) {
  const std::string& name = cluster.nodes[host].name;
  const bool leads = host == cluster.lead;
  const SessionSettings& settings = asked.settings;
  std::vector<std::string> arguments{settings.show.script, "--cluster", cluster.file, "--node", name};
  if (!settings.record.out.empty())
    arguments.insert(arguments.end(), {"--out", folderOfHost(settings.record.out, name)});
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || !isOfRun(*option) || (!leads && isLeaderOption(nameOf(*option)))) continue;
    std::vector<std::string> values = option->results();
    if (namesFileOfEachHost(asked, nameOf(*option))) values = {fileOfHost(values.back(), name)};
    addArguments(*option, values, arguments);
  }
  // Trackers replace the log beside the show. A follower gets no --tracker, so it needs --input none.
  if (!leads && !settings.console.trackers.device.empty() && settings.show.input.empty())
    arguments.insert(arguments.end(), {"--input", "none"});
  // All hosts run on this machine: only the leader plays sound.
  if (!leads && !settings.console.noSound) arguments.push_back("--no-sound");
  return arguments;
}

void checkArgumentsOfHost(std::vector<std::string> arguments, Diagnostics& findings) {
  CLI::App run;
  RunOptions o;
  addRunOptions(run, o);
  std::ranges::reverse(arguments);  // as CLI takes them
  run.parse(std::move(arguments));
  if (!o.complete(findings)) return;
  refuseUnwritable(o.namedFiles(), findings);
  SessionSettings& s = o.settings;
  ClusterSession::create(
      s.cluster, s.show, s.draw.layout, [](const std::string&) {}, findings);
}

}  // namespace stadion
