#pragma once
/// `--plugin FILE`: node types of others.

#include "show/base/standard_nodes.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stadion {

/// Files as they are given; the types follow while the command line is read. Both must stay where they are
/// until then.
void addPluginOption(CLI::App& command, std::vector<std::string>& files, SharedTypes& types);

}  // namespace stadion
