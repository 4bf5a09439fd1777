#include "cli/options/show_options.h"

#include "cli/options/command_options.h"
#include "cli/options/plugin_option.h"

#include <CLI/CLI.hpp>

namespace stadion {

void addShowOptions(CLI::App& command, ShowOptions& o) {
  CommandOptions options(command);
  options.add("SHOW", o.script).required();
  options.add("--walls", o.walls);
  options.add("--mode", o.mode, {.words = "pipelined|sequential"});
  options.add("--size", o.size);
  options.add("--look", o.look);
  options.add("--samples", o.samples);
  addLengthOptions(command, o);
}

void addLengthOptions(CLI::App& command, ShowOptions& o) {
  CommandOptions options(command);
  options.add("--rate", o.rate).notes(o.rateGiven);
  options.add("--frames", o.frames, {.most = 1e9});
  options.add("--seconds", o.seconds).excludes("--frames");
  options.add("--input", o.input);
  options.add("--asset-root", o.assetRoots);
  addPluginOption(command, o.plugins, o.types);
  options.add("--app-threads", o.appThreads);
}

}  // namespace stadion
