#include "cli/regress/regress_options.h"

#include "cli/options/command_options.h"
#include "engine/base/installed_files.h"
#include "engine/plain_text/suggestion.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace stadion {
namespace {

constexpr const char* kRegressFooter =
    R"(A suite file names shows, walls, modes, input logs, sizes, frames, what to compare and how exactly
(docs/formats.md, scripts/suites/basic.suite). Each case is played by the program in processes of its own.

  ./stadion regress scripts/suites/basic.suite                    # with the baseline that lies beside it
  ./stadion regress my.suite --update                             # writes that baseline: look at its changes
  ./stadion regress my.suite --against ../before/build/release/bin/stadion --out report
  ./stadion regress my.suite --compare state,counts --out report                                   # in CI

--out DIR receives report.html with plots of all runs so far, results.json, junit.xml and history.jsonl. --json prints the
results in Google Benchmark's layout.

Times are processor times of the typical frame, stage by stage. With --against the two builds play the same case in turns,
frame by frame, in several rounds; a stage is slower if the ranks of the rounds say so (Wilcoxon, p <= 5 % over all
stages of the case) and the difference exceeds the tolerance. With a baseline, times are divided by those of a
calibration kernel run in the same minute, and compared by rank sums. A slower stage is reported with the node in it
that moved. Beside the typical frame, hitches are compared by processor time and by the clock on the wall: frames that are
long in more rounds than before, and mean, p95, p99, longest and late frames of a round. A failure of times must show
again in as many fresh rounds. --instructions counts instead: less than the tolerance apart on any machine, however busy.

State hashes, image hashes and counts (nodes visited, messages, draw calls, triangles and so on, by wall and eye) have to
be equal. Images are compared only where the same renderer drew them: the CPU renderer draws alike everywhere, OpenGL on the same
processor. With --renderer all programs of the comparison must know it. All modes of a case have to
give the same state and images, whether there is a baseline or not.

Exit codes: 0 all is equal, 1 a comparison failed, 2 bad usage, a suite or show with mistakes, no baseline (and no
--against), or nothing that could be compared, 3 a program that was played crashed or hung.)";

/// The program `stadion` of this copy, which plays the shows.
std::string ownPath() {
  std::error_code none;
  return std::filesystem::canonical(helperProgram("stadion"), none).string();
}

/// It is this file, wherever programs are looked for.
void checkProgram(std::string& path, const char* option, Diagnostics& findings) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none))
    findings.error({}, std::string(option) + ": " + path + " is a folder; name the program in it, such as " +
                           path + "/build/release/bin/stadion");
  else if (!std::filesystem::exists(path, none))
    findings.error({}, std::string(option) + ": there is no program " + path);
  else
    path = std::filesystem::absolute(path, none).string();
}

}  // namespace

void RegressOptions::addTo(CLI::App& command) {
  CommandOptions options(command);
  options.add("SUITE", suite).required();
  options.add("--stadion", program);
  options.add("--against", against);
  options.add("--baseline", baseline);
  options.add("--update", update);
  options.add("--case", cases);
  options.add("--compare", compare);
  options.add("--instructions", instructions);
  options.add("--rounds", rounds, {.least = 12, .most = 80});
  options.add("--limit", limit);
  renderer.addTo(command);
  options.add("--out", out);
  options.add("--resume", resume);
  options.add("--json", json);
  command.footer(kRegressFooter);
}

bool RegressOptions::complete(Diagnostics& findings) {
  if (program.empty()) program = ownPath();
  checkProgram(program, "--stadion", findings);
  if (!against.empty()) checkProgram(against, "--against", findings);
  if (!against.empty() && (!baseline.empty() || update))
    findings.error({},
                   "--against compares with another build, --baseline and --update are about a file; leave "
                   "one of them out");
  if (resume && (out.empty() || update))
    findings.error({}, "--resume needs the --out DIR of the run that was interrupted, and no --update");
  renderer.settings(findings);
  baselineGiven = !baseline.empty();
  if (baseline.empty()) baseline = regression::baselineBeside(suite);
  return !findings.hasErrors();
}

regression::Metrics RegressOptions::asked() const {
  const auto wanted = [&](const char* metric) {
    return compare.empty() || std::ranges::find(compare, metric) != compare.end();
  };
  return {wanted("state"), wanted("images"), wanted("counts"), wanted("instructions"), wanted("times")};
}

bool RegressOptions::choose(regression::Suite& suiteRead, Diagnostics& findings) const {
  std::vector<std::string> known;
  for (const regression::SuiteCase& c : suiteRead.cases) known.push_back(c.name);
  for (const std::string& name : cases)
    if (std::ranges::find(known, name) == known.end())
      findings.error({suite, 0, 0}, "there is no case \"" + name + "\"" + didYouMean(name, known));
  if (!cases.empty())
    std::erase_if(suiteRead.cases, [&](const regression::SuiteCase& c) {
      return std::ranges::find(cases, c.name) == cases.end();
    });
  const regression::Metrics wanted = asked();
  for (regression::SuiteCase& c : suiteRead.cases) {
    regression::Metrics& m = c.metrics;
    m.state &= wanted.state;
    m.images &= wanted.images;
    m.counts &= wanted.counts;
    m.instructions &= wanted.instructions;
    m.times &= wanted.times;
    if (rounds > 0) c.rounds = rounds;
    c.renderer = renderer.words();
  }
  // A case that compares nothing of what was asked for is not played.
  std::erase_if(suiteRead.cases, [](const regression::SuiteCase& c) { return c.metrics.none(); });
  if (suiteRead.cases.empty() && !findings.hasErrors())
    findings.error({suite, 0, 0}, "no case compares " + fmt::format("{}", fmt::join(compare, " or ")) +
                                      "; say so in its \"compare\" statement, or leave --compare out");
  return !findings.hasErrors();
}

}  // namespace stadion
