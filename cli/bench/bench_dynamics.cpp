#include "cli/bench/bench_dynamics.h"

#include "bench/comparison/comparison_report.h"
#include "bench/comparison/work_precision_plot.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "engine/plain_text/suggestion.h"
#include "show/output/output_folder.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>

namespace stadion {
namespace {

struct BenchDynamicsOptions {
  bench::ComparisonOptions comparison;
  bool json = false;
  std::string out;
};

void printError(const std::string& what) {
  std::fprintf(stderr, "stadion: %s\n", what.c_str());
}

bool namesAreKnown(const bench::ComparisonOptions& options, const std::vector<bench::ListedCase>& known) {
  std::vector<std::string> names;
  for (const bench::ListedCase& c : known) names.push_back(c.name);
  const std::vector<std::string> unknown = bench::unknownCases(options, known);
  for (const std::string& name : unknown)
    printError("there is no case \"" + name + "\"" + didYouMean(name, names));
  return unknown.empty();
}

/// Reports that other engines are missing, and how to build them.
void reportMissingEngines(const std::vector<bench::EngineProgram>& programs) {
  if (programs.size() == 4) return;
  std::fprintf(stderr,
               "stadion: %s. To have Bullet, ODE and MuJoCo beside Stadion, install and build them with\n"
               "  ./stadion setup peers\n",
               programs.size() == 1 ? "no other engine is built" : "not all other engines are built");
}

bool write(OutputFolder& folder, const std::string& name, const std::string& content) {
  if (const auto wrong = folder.note(name)) {
    printError(wrong->message);
    return false;
  }
  std::ofstream file(folder.pathOf(name), std::ios::binary);
  file << content;
  file.close();
  if (!file) printError("cannot write " + folder.pathOf(name));
  return static_cast<bool>(file);
}

bool writeAll(OutputFolder& folder, const std::vector<bench::CaseComparison>& results) {
  bool ok = write(folder, "results.json", bench::resultsJson(results));
  for (const bench::CaseComparison& r : results)
    ok = write(folder, r.name + ".svg", bench::workPrecisionPlot(r.name, r.measurements)) && ok;
  return ok;
}

std::vector<bench::CaseComparison> compareAndPrint(const std::vector<bench::EngineProgram>& programs,
                                                   const BenchDynamicsOptions& o) {
  std::vector<bench::CaseComparison> results;
  const auto progress = [](const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); };
  bench::compareEngines(programs, o.comparison, progress, [&](const bench::CaseComparison& r) {
    if (o.json)
      for (const bench::Measurement& m : r.measurements) std::printf("%s\n", bench::toJson(m).c_str());
    else
      std::printf("%s\n", bench::tableOf(r).c_str());
    std::fflush(stdout);
    results.push_back(r);
  });
  return results;
}

int benchDynamics(const BenchDynamicsOptions& o) {
  const std::string folder = std::filesystem::canonical("/proc/self/exe").parent_path();
  const auto programs = bench::enginePrograms(folder);
  if (programs.empty() || !programs.front().ours) {
    printError("stadion-dyn-stadion is missing beside the program; build the target dynamics_programs");
    return kInternalFault;
  }
  if (!namesAreKnown(o.comparison, bench::casesOf(programs.front()))) return kBadInput;
  std::unique_ptr<OutputFolder> out;
  if (!o.out.empty()) {
    auto opened = OutputFolder::open(o.out);
    if (!opened) {
      printError(opened.error().message);
      return kBadInput;
    }
    out = std::move(opened.value());
    out->clear();
  }
  reportMissingEngines(programs);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<bench::CaseComparison> results = compareAndPrint(programs, o);
  const std::chrono::duration<double, std::ratio<60>> minutes = std::chrono::steady_clock::now() - start;
  std::fprintf(o.json ? stderr : stdout, "%s%.1f minutes\n", bench::summaryOf(results).c_str(),
               minutes.count());
  if (out && !writeAll(*out, results)) return kBadInput;
  return bench::allMet(results) ? kOk : kCheckFailed;
}

}  // namespace

void addBenchDynamics(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchDynamicsOptions>();
  CLI::App* command =
      bench.add_subcommand("dynamics", "How exact and how fast bodies move, beside Bullet, ODE and MuJoCo");
  CommandOptions options(*command);
  options.add("CASE", o->comparison.cases);
  options.add("--all", o->comparison.everyStep);
  options.add("--rounds", o->comparison.rounds, {.most = 99});
  options.add("--limit", o->comparison.limit, {.most = 3600});
  options.add("--out", o->out);
  options.add("--json", o->json);
  command->footer("--limit counts processor seconds. --out DIR receives results.json and a plot of error "
                  "against cost for "
                  "each case.");
  command->callback([o, &code] { code = benchDynamics(*o); });
}

}  // namespace stadion
