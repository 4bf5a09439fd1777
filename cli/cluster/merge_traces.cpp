/// `stadion merge-traces TRACE...`: the traces of the hosts of a cluster in one file.

#include "cli/cluster/merge_traces.h"

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "show/output/output_names.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace stadion {
namespace {

struct MergeOptions {
  std::vector<std::string> files;
  std::string trace;
};

/// A trace that is named twice would be two hosts.
void refuseRepeated(const std::vector<std::string>& files, Diagnostics& findings) {
  std::error_code none;
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (std::filesystem::equivalent(files[i], files[k], none))
        return findings.error({files[i], 0, 0}, "is named twice; name the trace of each host once");
}

int mergeFiles(const MergeOptions& o) {
  Diagnostics findings;
  refuseRepeated(o.files, findings);
  std::vector<NamedFile> named{{"--trace", o.trace}};
  for (const std::string& file : o.files) named.push_back({"TRACE", file, false});
  refuseSameFiles(named, findings);
  if (findings.hasErrors()) return exitWith(findings, kBadInput);
  return writeMergedTrace(tracesOf(o.files), o.trace) ? kOk : kBadInput;
}

constexpr const char* kMergeFooter =
    R"(Each host that played with --trace wrote a trace of its own, by its own clock. Here they become one trace, a process for
each host, named after its file (trace-front.json: front). All hosts show a frame together, so their clocks are aligned
by the ends of their swaps. `stadion cluster --trace FILE` does this by itself.

  stadion merge-traces trace-front.json trace-left.json --trace hall.json)";

}  // namespace

bool writeMergedTrace(const std::vector<TraceOfHost>& traces, const std::string& file) {
  const auto merged = mergeTraces(traces, file);
  Diagnostics findings;
  if (!merged) {
    findings.add(merged.error());
    printFindings(findings);
    return false;
  }
  for (const AlignedHost& host : merged.value())
    if (host.commonFrames == 0)
      findings.warning({file, 0, 0}, "no frame of " + host.host + " was shown by " +
                                         merged.value().front().host + ", too: its clock is not aligned");
  printFindings(findings);
  return true;
}

void addMergeTracesCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<MergeOptions>();
  CLI::App* command =
      app.add_subcommand("merge-traces", "Merge the traces of a cluster's hosts into one file");
  CommandOptions options(*command);
  options.add("TRACE", o->files).required();
  options.add("--trace", o->trace).required();
  command->footer(kMergeFooter);
  command->callback([o, &code] { code = mergeFiles(*o); });
}

}  // namespace stadion
