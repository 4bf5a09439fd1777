/// `stadion cluster FILE SHOW`: plays a show on all nodes of a cluster at once, on this machine, for trying
/// out.

#include "cli/cluster/cluster_arguments.h"
#include "cli/cluster/merge_traces.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/run_options.h"
#include "cli/terminal.h"
#include "engine/base/atomic_file.h"
#include "engine/base/plain_file.h"
#include "pipeline/cluster/cluster_leader.h"
#include "pipeline/record/journal.h"
#include "pipeline/supervision/shared_progress.h"
#include "show/cluster/cluster_nodes.h"
#include "show/output/output_folder.h"
#include "show/player/show_check.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <unistd.h>

namespace stadion {
namespace {

struct ClusterOptions {
  std::string file;
  bool once = false;
  RunOptions run;  ///< as the command line says it, for all nodes
};

/// Checks what each host would check. Without this check, each host would report the same error, or wait for
/// the others. Reports the first errors and returns false, or reports the warnings and returns true.
bool canBePlayed(const ClusterOptions& o, const std::vector<std::vector<std::string>>& arguments) {
  const auto isWell = [](const Diagnostics& findings) {
    if (findings.hasErrors()) printFindings(findings);
    return !findings.hasErrors();
  };
  Diagnostics findings;
  for (const std::vector<std::string>& ofNode : arguments) {
    findings = {};
    checkArgumentsOfHost(ofNode, findings);
    if (!isWell(findings)) return false;
  }
  if (!isWell(checkScripts(o.run.settings.show.script, o.run.settings.show.assetRoots,
                           o.run.settings.show.types)))
    return false;
  printFindings(findings);
  return true;
}

/// Makes the folders into which the hosts will write. Returns false, with the reason, if that fails.
bool makeFolders(const std::string& out, const ClusterFile& cluster, Diagnostics& findings) {
  if (out.empty()) return true;
  for (const ClusterNode& node : cluster.nodes)
    if (const auto folder = OutputFolder::open(folderOfHost(out, node.name)); !folder) {
      findings.add(folder.error());
      return false;
    }
  return true;
}

/// Opens the journal of a host, to which its process adds lines as well. Returns null without --journal, or
/// with the reason in the findings.
std::unique_ptr<Journal> openJournal(const std::string& file, const ClusterNode& node,
                                     Diagnostics& findings) {
  if (file.empty()) return nullptr;
  auto journal = Journal::open(fileOfHost(file, node.name));
  if (!journal) {
    findings.error({}, "--journal: " + journal.error().message);
    return nullptr;
  }
  return std::move(journal.value());
}

/// Merges the traces of all hosts into `file` and keeps them. Returns true on success, or if `file` is empty.
bool mergeTracesOf(const ClusterFile& cluster, const std::string& file) {
  if (file.empty()) return true;
  std::vector<TraceOfHost> traces;
  for (const ClusterNode& node : cluster.nodes) traces.push_back({node.name, fileOfHost(file, node.name)});
  return writeMergedTrace(traces, file);
}

/// Writes one object with the summary of each host, as --json prints it. Returns false if that fails.
bool writeSummaries(const ClusterFile& cluster, const std::string& out) {
  if (out.empty()) return true;
  constexpr std::size_t kMostBytes = 64 << 20;
  std::string all;
  for (const ClusterNode& node : cluster.nodes) {
    const auto written = readPlainFile(folderOfHost(out, node.name) + "/summary.json", kMostBytes);
    std::string summary = written ? written.value() : "null";  // it has died before it could write any
    while (summary.ends_with('\n')) summary.pop_back();
    all += fmt::format("{}\"{}\": {}", all.empty() ? "{" : ",\n", node.name, summary);
  }
  const auto wrong = writeFile(out + "/summaries.json", all + "}\n");
  if (wrong) std::fprintf(stderr, "%s\n", format(*wrong).c_str());
  return !wrong;
}

/// Returns the command line of a host's process, which ends with this process. `progress`: receives the
/// frames that the host shows.
std::vector<std::string> programOf(const std::vector<std::string>& arguments,
                                   const SharedProgress* progress) {
  std::vector<std::string> all{std::filesystem::canonical("/proc/self/exe").string(), "run", "--ends-with",
                               std::to_string(getpid())};
  if (progress) all.insert(all.end(), {"--supervised", std::to_string(progress->descriptor())});
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

int playCluster(const ClusterOptions& o, const CLI::App& command) {
  Diagnostics findings;
  const auto cluster = loadCluster(o.file, findings);
  if (!cluster) return exitWith(findings, kBadInput);
  if (command.get_option("--walls")->count() > 0)
    findings.error({}, "--walls is not for clusters: " + o.file + " says which walls there are");
  if (findings.hasErrors()) return exitWith(findings, kBadInput);
  std::vector<std::vector<std::string>> arguments;
  for (std::size_t i = 0; i < cluster->nodes.size(); ++i)
    arguments.push_back(argumentsOfHost(command, o.run, *cluster, i));
  if (!canBePlayed(o, arguments)) return kBadInput;
  if (!makeFolders(o.run.settings.record.out, *cluster, findings)) return exitWith(findings, kBadInput);
  auto progress = SharedProgress::create();
  if (!progress) findings.add(progress.error());
  if (findings.hasErrors()) return exitWith(findings, kBadInput);
  TerminalReporter terminal;
  ClusterNodes nodes(*cluster, o.once, terminal);
  if (!o.run.settings.record.out.empty()) nodes.needAll();
  for (std::size_t i = 0; i < arguments.size(); ++i)
    nodes.add(cluster->nodes[i].name,
              programOf(arguments[i], i == cluster->lead ? progress.value().get() : nullptr),
              openJournal(o.run.settings.supervision.journal, cluster->nodes[i], findings));
  // The leader may wait for a follower that lives and draws nothing (pipeline/cluster/cluster_leader.cpp).
  nodes.watchLead(
      std::move(progress.value()),
      fromSeconds(o.run.settings.supervision.hangAfter + cluster::ClusterLeader::kStuck * cluster->deadline));
  if (findings.hasErrors()) return exitWith(findings, kBadInput);
  const int code = nodes.play();
  const bool written = writeSummaries(*cluster, o.run.settings.record.out);
  const bool merged = written && (code != kOk || mergeTracesOf(*cluster, o.run.trace.file));
  std::fputs((o.run.json ? nodes.saidAsJson() : nodes.said()).c_str(), stdout);
  return merged ? code : kBadInput;
}

constexpr const char* kClusterFooter =
    R"(Each host is a process of its own here. In a hall it is a machine with `stadion run SHOW --cluster FILE --node NAME`. A host
that dies, by a signal or with exit code 3, restarts and continues from the others' scene. SIGINT (Ctrl-C) and SIGTERM go
to all hosts, and the exit code is 130 or 143. A host that has not ended after 10 s is killed.

  ./stadion cluster walls/four.cluster scripts/kick.evs --frames 300 --out pictures
  ./stadion cluster walls/four.cluster scripts/olympia.evs --size 320x240

--out DIR receives a folder for each host. --json prints one object with each host's summary under its name; --out DIR
also receives it, as summaries.json.

docs/cluster.md has the file's format, and what happens when a machine or the network fails.)";

/// What clusters refuse (RunOptions::complete() says why) is not in the help.
const char* groupOf(const RunOptions& run, const std::string& option) {
  if (option == "--help" || option == "--out" || option == "--json") return "Options";
  for (const char* refused :
       {"--walls", "--supervise", "--hang-after", "--late-latch", "--latch-reach", "--spans", "--count-work"})
    if (option == refused) return "";
  if (isLeaderOption(option)) return "Options of `stadion run` for the leader, which sends its input to all";
  if (namesFileOfEachHost(run, option))
    return "Options of `stadion run` for a file of each node (trace.json becomes trace-NODE.json)";
  return "Options of `stadion run` for all nodes";
}

void addRunOptions(RunOptions& run, CLI::App& command) {
  addRunOptions(command, run);
  for (const char* ours : {"--cluster", "--node"}) command.remove_option(command.get_option(ours));
  for (CLI::Option* option : command.get_options())
    if (option->nonpositional() && !option->get_group().empty())
      option->group(groupOf(run, option->get_name()));
}

}  // namespace

void addClusterCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<ClusterOptions>();
  CLI::App* command =
      app.add_subcommand("cluster", "Play a show on all nodes of a cluster at once, on this machine");
  CommandOptions(*command).add("CLUSTER", o->file).required();
  addRunOptions(o->run, *command);
  CommandOptions(*command).add("--once", o->once);
  command->footer(kClusterFooter);
  command->callback([o, command, &code] { code = playCluster(*o, *command); });
}

}  // namespace stadion
