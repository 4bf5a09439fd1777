#include "cli/bench/bench_looks.h"

#include "bench/looks/looks_measurement.h"
#include "bench/looks/looks_plot.h"
#include "bench/looks/perceptual_programs.h"
#include "cli/bench/looks_scenes.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "engine/base/atomic_file.h"
#include "show/base/stop_signal.h"
#include "show/base/temporary_folder.h"
#include "show/output/output_folder.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace stadion {
namespace {

struct BenchLooksOptions {
  std::vector<std::string> scenes, rungs;  ///< empty: all
  std::string size, gl = "osmesa";
  std::size_t rounds = 5;
  std::uint64_t frames = 60;
  bool noPrograms = false, json = false;
  std::string out;
};

template <class Names>
bool isChosen(const Names& chosen, std::string_view name) {
  return chosen.empty() || std::ranges::find(chosen, name) != chosen.end();
}

std::vector<bench::NamedRung> chosenRungs(const BenchLooksOptions& o) {
  std::vector<bench::NamedRung> rungs;
  for (const bench::NamedRung& rung : bench::allRungs())
    if (isChosen(o.rungs, rung.name)) rungs.push_back(rung);
  return rungs;
}

/// Scene by scene: plays the show to its moment, measures, and prints.
class LooksRun {
public:
  LooksRun(const BenchLooksOptions& o, OutputFolder* out)
      : o_(o), out_(out), rungs_(chosenRungs(o)), stop_(catchStopSignals()) {}

  /// False, with the findings, if a scene cannot be measured.
  bool run(Diagnostics& findings) {
    if (!o_.json) std::fputs(bench::headOfTable().c_str(), stdout);
    for (const LooksScene& scene : allLooksScenes()) {
      if (!isChosen(o_.scenes, scene.name)) continue;
      if (!openShowOf(scene, findings)) return false;
      show_->playTo(scene.seconds);
      for (const std::string& wall : scene.walls)
        if (stop_ || !measure(scene, wall, findings)) return false;
    }
    return true;
  }
  const std::vector<bench::LooksRow>& rows() const { return rows_; }

private:
  bool openShowOf(const LooksScene& scene, Diagnostics& findings) {
    if (show_ && script_ == scene.script && !script_.empty()) return true;
    pictures_.reset();  // it draws meshes of the show before
    show_ = LooksShow::open(scene, o_.size, findings);
    if (!show_) return false;
    script_ = scene.script;
    std::optional<GlProviderKind> openGl;
    if (std::ranges::any_of(rungs_, [](const bench::NamedRung& r) { return !r.rung; }))
      openGl = o_.gl == "egl" ? GlProviderKind::Egl : GlProviderKind::OsMesa;
    auto pictures = bench::RungPictures::create(show_->meshes(), show_->size(), openGl);
    if (!pictures) {
      findings.add(pictures.error());
      return false;
    }
    pictures_ = std::move(pictures.value());
    return true;
  }

  bool measure(const LooksScene& scene, const std::string& wall, Diagnostics& findings) {
    bench::LooksMeasurement measurement(*pictures_, rungs_);
    const auto refused = [&](const Diagnostic& why) { return findings.add(why), false; };
    auto rows =
        measurement.measure(std::string(scene.name), wall, show_->listOf(wall), o_.rounds, filesOf(findings));
    if (!rows) return refused(rows.error());
    if (wall == scene.walls.back() && o_.frames > 1) {
      if (const auto wrong = measurement.measureFlicker(nextLists(wall), rows.value()))
        return refused(*wrong);
    }
    for (const bench::LooksRow& row : rows.value()) {
      const std::string line = o_.json ? bench::jsonOf(row).dump() + "\n" : bench::lineOf(row);
      std::fputs(line.c_str(), stdout);
      rows_.push_back(row);
    }
    std::fflush(stdout);
    return !findings.hasErrors();
  }

  /// The wall in this frame and in those that follow it.
  std::vector<DrawList> nextLists(const std::string& wall) {
    std::vector<DrawList> lists{show_->listOf(wall)};
    while (lists.size() < o_.frames) {
      show_->playFrame();
      lists.push_back(show_->listOf(wall));
    }
    return lists;
  }

  bench::LooksFiles filesOf(Diagnostics& findings) const {
    const auto pathOf = [this, &findings](const std::string& name) -> std::string {
      if (!out_) return o_.noPrograms ? std::string() : folder_.path(name);
      if (const auto wrong = out_->note(name)) findings.add(*wrong);
      return out_->pathOf(name);
    };
    return {pathOf, !o_.noPrograms};
  }

  const BenchLooksOptions& o_;
  OutputFolder* out_;  ///< null: no files
  std::vector<bench::NamedRung> rungs_;
  const std::atomic<bool>& stop_;
  TemporaryFolder folder_;
  std::string_view script_;
  std::unique_ptr<LooksShow> show_;
  std::unique_ptr<bench::RungPictures> pictures_;  ///< of the show
  std::vector<bench::LooksRow> rows_;
};

void tellMissingPrograms(const std::vector<bench::LooksRow>& rows) {
  const bool missing =
      std::ranges::any_of(rows, [](const bench::LooksRow& r) { return !r.butteraugli || !r.ssimulacra; });
  if (missing)
    std::fprintf(
        stderr,
        "stadion: butteraugli_main or ssimulacra_main is missing or failed; both are in the package %s\n",
        bench::kPerceptualPackage);
}

std::optional<Diagnostic> writePlot(OutputFolder& folder, const std::vector<bench::LooksRow>& rows) {
  const std::string name = "looks.svg";
  if (auto wrong = folder.note(name)) return wrong;
  return writeFile(folder.pathOf(name), bench::looksPlot(rows));
}

int benchLooks(const BenchLooksOptions& o) {
  std::unique_ptr<OutputFolder> out;
  if (!o.out.empty()) {
    auto opened = OutputFolder::open(o.out);
    if (!opened) return printError(opened.error(), kBadInput);
    out = std::move(opened.value());
    out->clear();
  }
  Diagnostics findings;
  LooksRun run(o, out.get());
  if (!run.run(findings)) return exitWith(findings, stopSignal() ? kStopped + stopSignal() : kBadInput);
  printFindings(findings);
  if (!o.noPrograms) tellMissingPrograms(run.rows());
  if (out)
    if (const auto wrong = writePlot(*out, run.rows())) return printError(*wrong, kBadInput);
  bool met = true;
  for (const bench::LooksLimit& limit : bench::limitsOf(run.rows())) {
    const std::string line = o.json ? bench::jsonOf(limit).dump() + "\n" : bench::lineOf(limit);
    std::fputs(line.c_str(), stdout);
    met = met && limit.met();
  }
  if (!o.json) std::printf("%s\n", met ? "ok" : "MISSED");
  return met ? kOk : kCheckFailed;
}

}  // namespace

void addBenchLooks(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchLooksOptions>();
  CLI::App* command = bench.add_subcommand(
      "looks",
      "What does each rung of the ladder of pictures cost, and how far is it from 64 samples a pixel?");
  CommandOptions options(*command);
  options.add("--scenes", o->scenes, {.words = kLooksSceneNames});
  options.add("--rungs", o->rungs, {.words = bench::kRungNames});
  options.add("--size", o->size);
  options.add("--gl", o->gl, {.words = "osmesa|egl"});
  options.add("--rounds", o->rounds, {.most = 999});
  options.add("--frames", o->frames, {.most = 600});
  options.add("--no-perception", o->noPrograms);
  options.add("--out", o->out);
  options.add("--json", o->json);
  command->footer(
      "--frames is the number of frames over which flicker is measured; 1: it is not.\n"
      "--out DIR receives looks.svg and the left eye's pictures: whole, and their worst part side by side.");
  command->callback([o, &code] { code = benchLooks(*o); });
}

}  // namespace stadion
