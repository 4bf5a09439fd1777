#include "cli/options/plugin_option.h"

#include "show/base/plugins.h"

#include <CLI/CLI.hpp>

namespace stadion {

void addPluginOption(CLI::App& command, std::vector<std::string>& files, SharedTypes& types) {
  command
      .add_option_function<std::vector<std::string>>(
          "--plugin",
          [&files, &types](const std::vector<std::string>& given) {
            auto loaded = nodesWith(given);
            if (!loaded) throw CLI::ValidationError("--plugin", loaded.error().message);
            files = given, types = std::move(loaded.value());
          },
          "shared library with further node types; may be repeated")
      ->allow_extra_args(false);  // what follows the file is the script
}

}  // namespace stadion
