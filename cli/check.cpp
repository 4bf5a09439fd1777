/// `stadion check FILE...`: everything that can be found wrong in shows and halls without playing; `--assets PATH`:
/// a model or every one below a folder.

#include "engine/asset/check.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/findings_json.h"
#include "cli/options/command_options.h"
#include "cli/options/plugin_option.h"
#include "engine/base/installed_files.h"
#include "engine/hall_formats/hall_import.h"
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

/// True if the file describes a hall, not a show.
bool isHall(const std::string& file) {
  return file.ends_with(".walls") || isForeignHall(file);
}

Diagnostics findingsOfHall(const std::string& file) {
  Diagnostics findings;
  loadHall(file, shareFolder() + "/walls", findings);
  return findings;
}

/// Returns the findings of one script. A script that a show loads (`around`) is checked as a part of that
/// show, because it may use the show's names and assets.
Diagnostics findingsOf(const std::string& file, const std::optional<std::string>& around,
                       const std::vector<std::string>& roots, const SharedTypes& types) {
  if (!around) return checkShow(file, roots, types);
  return inFiles(filesOf(file, *around, roots, *types), checkShow(*around, roots, types));
}

/// Prints what is found, as text or as one object at the end.
class CheckReport {
public:
  explicit CheckReport(bool json) : json_(json) {}

  void add(const std::string& file, const std::optional<std::string>& around, const Diagnostics& findings) {
    wrong_ |= findings.hasErrors();
    if (json_)
      shows_.push_back({{"file", file},
                        {"ok", !findings.hasErrors()},
                        {"part_of", around ? Json(*around) : Json()},
                        {"findings", jsonOf(findings)}});
    else
      print(file, around, findings);
  }

  void add(const AssetFinding& f) {
    if (json_)
      models_.push_back({{"file", f.file},
                         {"verdict", nameOf(f.verdict)},
                         {"triangles", f.mesh ? Json(f.mesh->indices.size() / 3) : Json()},
                         {"message", f.message},
                         {"used", f.inventory.texts(ContentUse::Used)},
                         {"approximated", f.inventory.texts(ContentUse::Approximated)},
                         {"left_out", f.inventory.texts(ContentUse::LeftOut)},
                         {"findings", jsonOf(f.losses)}});
    else
      print(f);
  }

  void add(const AssetCounts& c) {
    if (json_)
      counts_ = {{"loaded", c.loaded}, {"refused", c.refused}, {"failed", c.failed}, {"faults", c.faults}};
    else
      std::printf(
          "%zu loaded, %zu refused by name, %zu failed (%zu of them took the importer down or timed out)\n",
          c.loaded, c.refused, c.failed, c.faults);
  }

  /// Returns the exit code.
  int finish(int code) const {
    if (json_)
      printJson({{"ok", code == kOk}, {"shows", shows_}, {"models", models_}, {"model_counts", counts_}});
    return code;
  }
  bool wrong() const { return wrong_; }

private:
  using Json = nlohmann::ordered_json;

  static const char* nameOf(AssetVerdict verdict) {
    return verdict == AssetVerdict::Loaded    ? "loaded"
           : verdict == AssetVerdict::Refused ? "refused"
                                              : "failed";
  }

  static void print(const std::string& file, const std::optional<std::string>& around,
                    const Diagnostics& findings) {
    for (const Diagnostic& d : findings.all()) std::printf("%s\n", format(d).c_str());
    if (!findings.hasErrors())
      std::printf("%s: ok%s\n", file.c_str(), around ? (", as a part of " + *around).c_str() : "");
    else if (around)
      std::printf("%s: checked as a part of %s\n", file.c_str(), around->c_str());
  }

  static void print(const AssetFinding& f) {
    if (f.verdict == AssetVerdict::Loaded)
      std::printf("loaded   %s: %zu triangles\n", f.file.c_str(), f.mesh->indices.size() / 3);
    else
      std::printf("%-7s  %s: %s\n", nameOf(f.verdict), f.file.c_str(), f.message.c_str());
    for (const ContentUse use : {ContentUse::Used, ContentUse::Approximated, ContentUse::LeftOut})
      for (const std::string& text : f.inventory.texts(use))
        std::printf("         %s: %s\n", std::string(stadion::nameOf(use)).c_str(), text.c_str());
  }

  bool json_, wrong_ = false;
  Json shows_ = Json::array(), models_ = Json::array(), counts_;
};

int checkEach(const std::vector<std::string>& files, const std::vector<std::string>& roots,
              const SharedTypes& types, CheckReport& report) {
  for (const std::string& file : files) {
    const bool watched = isatty(2) == 1;
    if (watched) std::fprintf(stderr, "checking %s ...", file.c_str());
    const bool hall = isHall(file);
    const auto around = hall ? std::nullopt : showAround(file, roots, *types);
    const Diagnostics findings = hall ? findingsOfHall(file) : findingsOf(file, around, roots, types);
    if (watched) std::fprintf(stderr, "\r\x1b[K");
    report.add(file, around, findings);
  }
  return report.wrong() ? kBadInput : kOk;
}

int checkModels(const std::string& place, CheckReport& report) {
  const auto counts =
      checkAssets(Importer::installedProgram(), place, [&](const AssetFinding& f) { report.add(f); });
  if (!counts) {
    std::fprintf(stderr, "%s\n", format(counts.error()).c_str());
    return kBadInput;
  }
  report.add(counts.value());
  return kOk;
}

}  // namespace

void addCheckCommand(CLI::App& app, int& code) {
  struct Options {
    std::vector<std::string> scripts, roots, plugins;
    SharedTypes types = standardNodes();
    std::string models;
    bool json = false;
  };
  auto o = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("check", "Look for mistakes in scripts, assets and halls; draws nothing");
  CommandOptions options(*command);
  options.add("SHOW", o->scripts);
  options.add("--assets", o->models);
  options.add("--asset-root", o->roots);
  addPluginOption(*command, o->plugins, o->types);
  options.add("--json", o->json);
  command->footer(
      "Sub-scenes and assets that a script names are checked with it. A script that a show loads "
      "is checked in that show.\nA file whose name ends in .walls, or as halls of other programs do "
      "(.mpcdi, .json, .cfg), is checked as a hall.");
  command->callback([o, &code] {
    if (o->scripts.empty() && o->models.empty()) {
      const char* wrong = "name a script, or a model or folder with --assets PATH";
      std::fprintf(stderr, "check: %s\n", wrong);
      if (o->json) printJson({{"error", wrong}});
      code = kBadInput;
      return;
    }
    CheckReport report(o->json);
    if (!o->scripts.empty()) code = checkEach(o->scripts, o->roots, o->types, report);
    if (!o->models.empty() && code == kOk) code = checkModels(o->models, report);
    code = report.finish(code);
  });
}

}  // namespace stadion
