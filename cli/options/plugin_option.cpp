#include "cli/options/plugin_option.h"

#include "cli/options/command_options.h"
#include "show/base/plugins.h"

#include <CLI/CLI.hpp>

namespace stadion {

void addPluginOption(CLI::App& command, std::vector<std::string>& files, SharedTypes& types) {
  CommandOptions(command).addFunction("--plugin", [&files, &types](const std::vector<std::string>& given) {
    auto loaded = nodesWith(given);
    if (!loaded) throw CLI::ValidationError("--plugin", loaded.error().message);
    files = given;
    types = std::move(loaded.value());
  });
}

}  // namespace stadion
