#pragma once
/// What `stadion cluster` plays each node with: what its own command line says, as far as that is the node's
/// affair.

#include "cli/options/run_options.h"
#include "pipeline/cluster/cluster_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// Whether an option of `run` ("--osc") is for the node that leads alone: trackers and operator are where
/// that machine is, and all have the input that it has.
bool isOfWhoLeads(std::string_view option);
/// Whether it names a file that each node writes for itself.
bool namesFileOfEach(const RunOptions& asked, std::string_view option);

/// What the node's own file is called: trace.json becomes trace-front.json.
std::string fileOfNode(const std::string& file, const std::string& node);
/// Its part of --out DIR.
std::string folderOfNode(const std::string& out, const std::string& node);

/// The words after `stadion run`. `command` has been parsed, with `asked`'s options (addRunOptions) among
/// its own.
std::vector<std::string> wordsOfNode(const CLI::App& command, const RunOptions& asked,
                                     const ClusterFile& cluster, std::size_t node);

/// What a node that is started with these words would refuse, or warn of, before it opens anything; each
/// would tell it for itself. Throws as CLI does, if the words are wrong themselves.
void checkWordsOfNode(std::vector<std::string> words, Diagnostics& findings);

}  // namespace stadion
