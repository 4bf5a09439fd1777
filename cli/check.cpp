/// `stadion check SHOW...`: everything that can be found wrong without playing; `--assets DIR`: every model
/// below a folder.

#include "engine/asset/check.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/plugin_option.h"
#include "show/player/show_check.h"
#include "show/player/show_of_part.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <unistd.h>

namespace stadion {
namespace {

/// Returns the findings that concern one of these files, or no file.
Diagnostics inFiles(const std::set<std::filesystem::path>& files, const Diagnostics& findings) {
  Diagnostics own;
  std::error_code error;
  for (const Diagnostic& d : findings.all())
    if (d.where.file.empty() || files.contains(std::filesystem::weakly_canonical(d.where.file, error)))
      own.add(d);
  return own;
}

/// Returns the findings of one script. A script that a show loads (`around`) is checked as a part of that
/// show, because it may use the show's names and assets.
Diagnostics findingsOf(const std::string& file, const std::optional<std::string>& around,
                       const std::vector<std::string>& roots, const SharedTypes& types) {
  if (!around) return checkShow(file, roots, types);
  return inFiles(filesOf(file, *around, roots, *types), checkShow(*around, roots, types));
}

int checkEach(const std::vector<std::string>& files, const std::vector<std::string>& roots,
              const SharedTypes& types) {
  bool wrong = false;
  for (const std::string& file : files) {
    const bool watched = isatty(2) == 1;
    if (watched) std::fprintf(stderr, "checking %s ...", file.c_str());
    const std::optional<std::string> around = showAround(file, roots, *types);
    const Diagnostics findings = findingsOf(file, around, roots, types);
    if (watched) std::fprintf(stderr, "\r\x1b[K");
    for (const Diagnostic& d : findings.all()) std::printf("%s\n", format(d).c_str());
    wrong |= findings.hasErrors();
    if (!findings.hasErrors())
      std::printf("%s: ok%s\n", file.c_str(), around ? (", as a part of " + *around).c_str() : "");
    else if (around)
      std::printf("%s: checked as a part of %s\n", file.c_str(), around->c_str());
  }
  return wrong ? kBadInput : kOk;
}

int checkModels(const std::string& folder) {
  const auto counts = checkAssets(Importer::installedProgram(), folder, [](const AssetFinding& f) {
    if (f.verdict == AssetVerdict::Loaded)
      std::printf("loaded   %s: %zu triangles\n", f.file.c_str(), f.mesh->indices.size() / 3);
    else
      std::printf("%s  %s: %s\n", f.verdict == AssetVerdict::Refused ? "refused" : "failed ", f.file.c_str(),
                  f.message.c_str());
    for (const Diagnostic& d : f.notes.all()) std::printf("         %s\n", d.message.c_str());
  });
  if (!counts) {
    std::fprintf(stderr, "%s\n", format(counts.error()).c_str());
    return kBadInput;
  }
  const AssetCounts& c = counts.value();
  std::printf(
      "%zu loaded, %zu refused by name, %zu failed (%zu of them took the importer down or timed out)\n",
      c.loaded, c.refused, c.failed, c.faults);
  return kOk;
}

}  // namespace

void addCheckCommand(CLI::App& app, int& code) {
  struct Options {
    std::vector<std::string> scripts, roots, plugins;
    SharedTypes types = standardNodes();
    std::string models;
  };
  auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("check", "Look for mistakes in scripts and assets; draws nothing");
  CommandOptions options(*command);
  options.add("SHOW", o->scripts);
  options.add("--assets", o->models);
  options.add("--asset-root", o->roots);
  addPluginOption(*command, o->plugins, o->types);
  command->footer("Sub-scenes and assets that a script names are checked with it. A script that a show loads "
                  "is checked in "
                  "that show.");
  command->callback([o, &code] {
    if (o->scripts.empty() && o->models.empty()) {
      std::fprintf(stderr, "check: name a script, or a folder with --assets DIR\n");
      code = kBadInput;
      return;
    }
    if (!o->scripts.empty()) code = checkEach(o->scripts, o->roots, o->types);
    if (!o->models.empty() && code == kOk) code = checkModels(o->models);
  });
}

}  // namespace stadion
