#pragma once
/// Arguments for the `stadion run` of each host, made from the command line of `stadion cluster`.

#include "cli/options/run_options.h"
#include "pipeline/cluster/cluster_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// Returns true for an option of `run` ("--osc") that only the leader gets. Trackers and operator are
/// connected to its machine, and it sends their input to the followers.
bool isLeaderOption(std::string_view option);
/// Returns true if the option names a file that each host writes for itself.
bool namesFileOfEachHost(const RunOptions& asked, std::string_view option);

/// Returns the name of the host's own file: trace-front.json for trace.json.
std::string fileOfHost(const std::string& file, const std::string& host);
/// Returns the host's folder in --out DIR.
std::string folderOfHost(const std::string& out, const std::string& host);

/// Returns the arguments that follow `stadion run`. Expects that `command` was parsed and has the options of
/// `asked` (addRunOptions).
std::vector<std::string> argumentsOfHost(const CLI::App& command, const RunOptions& asked,
                                         const ClusterFile& cluster, std::size_t host);

/// Reports the errors and warnings that a host with these arguments would report before it opens anything.
/// So they are reported once. Throws as CLI does if the arguments themselves are wrong.
void checkArgumentsOfHost(std::vector<std::string> arguments, Diagnostics& findings);

}  // namespace stadion
