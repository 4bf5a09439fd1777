#include "cli/options/show_options.h"

#include "cli/options/number_option.h"
#include "cli/options/plugin_option.h"

#include <CLI/CLI.hpp>

namespace stadion {
namespace {

/// No run lasts longer: some 31 years of show time [s].
constexpr double kLongestRun = 1e9;

}  // namespace

void addShowOptions(CLI::App& command, ShowOptions& o) {
  command.add_option("SHOW", o.script, "the script to play (.evs)")->required();
  command.add_option("--walls", o.walls, "cave4, cave6, powerwall, desktop, or a wall file of your own")
      ->capture_default_str();
  command
      .add_option("--mode", o.mode, "pipelined (App, Cull and Draw overlap) or sequential: the same pictures")
      ->check(CLI::IsMember({"pipelined", "sequential"}))
      ->capture_default_str();
  command.add_option(
      "--size", o.size,
      "WIDTHxHEIGHT in pixels of one eye's picture (default: what the wall file says, else 800x600)");
  addLookOption(command, o);
  addLengthOptions(command, o);
}

void addLookOption(CLI::App& command, ShowOptions& o) {
  command
      .add_option(
          "--look", o.look,
          "full, or plain: light at the corners of triangles, one sample a pixel, no shadows, as OpenGL "
          "drew without shaders; several times as fast in software")
      ->check(CLI::IsMember({"full", "plain"}))
      ->capture_default_str();
}

void addLengthOptions(CLI::App& command, ShowOptions& o) {
  command.add_option("--rate", o.rate, "frames per second of show time")
      ->check(numberFrom(1, 1000))
      ->each([&o](const std::string&) { o.rateGiven = true; })
      ->capture_default_str();
  CLI::Option* count = command.add_option("--frames", o.frames, "stop after so many frames")
                           ->check(wholeNumberFrom(1, 1'000'000'000));
  command.add_option("--seconds", o.seconds, "stop after so much show time")
      ->check(numberFrom(1e-3, kLongestRun))
      ->excludes(count);
  command.add_option("--input", o.input,
                     "input log to replay (default: SHOW's name with .input, if there is one), or none");
  command.add_option("--asset-root", o.assetRoots, "further folder to look for assets in; may be repeated")
      ->allow_extra_args(false);  // what follows the folder is the script
  addPluginOption(command, o.plugins, o.types);
  command
      .add_option(
          "--app-threads", o.appThreads,
          "threads on which dynamics nodes that do not meet simulate side by side; their number changes no "
          "result (default: one for each processor, 8 at most)")
      ->check(wholeNumberFrom(1, 64));
}

}  // namespace stadion
