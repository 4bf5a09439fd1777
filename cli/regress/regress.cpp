/// `stadion regress SUITE`: plays a suite of shows and compares what comes out.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_programs.h"
#include "cli/regress/regress_folder.h"
#include "cli/terminal.h"
#include "engine/base/atomic_file.h"
#include "profiling/regression/reports.h"
#include "show/base/stop_signal.h"
#include "show/player/output_conflicts.h"
#include "show/player/player.h"
#include "show/regress/regress_case.h"
#include "show/regress/regress_child.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <unistd.h>
#include <utility>

namespace stadion {
namespace {

std::string nowUtc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// What to compare with, or to update, as the options say; false if it should be there and is not.
bool findReference(const RegressOptions& o, RegressReference& with, Diagnostics& findings) {
  with.program = o.against;
  with.baselineFile = o.baseline;
  std::error_code none;
  if (!o.against.empty()) return true;
  if (!std::filesystem::exists(o.baseline, none)) {
    if (o.baselineGiven && !o.update)
      findings.error({}, "--baseline: there is no file " + o.baseline + "; --update writes it");
    return !findings.hasErrors();
  }
  if (o.update && std::filesystem::is_empty(o.baseline, none)) return true;
  auto read = regression::readBaseline(o.baseline);
  if (!read) {
    findings.add(read.error());
    return false;
  }
  with.baseline = std::move(read.value());
  return true;
}

/// Cases of the baseline that the suite has no more, after a renaming for instance.
void tellGone(const std::vector<std::string>& gone, const RegressOptions& o) {
  Diagnostics findings;
  for (const std::string& name : gone)
    findings.note({o.baseline, 0, 0},
                  o.update ? name + " is removed: the suite has no such case"
                           : "has a case " + name + ", which the suite has not; --update removes it");
  printFindings(findings);
}

/// What the results follow from: the suite, what it names, and what it is compared with. (Files that shows
/// name are not looked into.)
std::string whatIsPlayed(const RegressOptions& o, const regression::Suite& suite) {
  std::string all = textOf(o.suite) + '\0' + (o.update ? std::string() : textOf(o.baseline));
  for (const regression::SuiteCase& c : suite.cases)
    for (const std::string& file : {c.show, c.walls, c.input}) all += '\0' + textOf(file);
  return all;
}

/// A file that is asked for; it is opened before anything is played.
class Output {
public:
  Output(bool wanted, const std::string& path, Diagnostics& findings) {
    if (wanted && file_.emplace(path).error()) findings.add(*file_->error());
  }
  bool write(const std::string& content) {
    file_->write(content);
    const auto wrong = file_->commit();
    if (wrong) std::fprintf(stderr, "stadion: %s\n", format(*wrong).c_str());
    return !wrong;
  }

private:
  std::optional<AtomicFile> file_;
};

/// The exit code of what was found; `written`: all files could be. Green is only what was compared with what
/// was before; that modes agree with each other is not enough.
int codeOf(const regression::SuiteResult& result, bool update, bool written) {
  if (result.faults() > 0) return result.refused() ? kBadInput : kInternalFault;
  if (!written) return kBadInput;
  if (result.count(regression::Outcome::Failed) > 0) return kCheckFailed;
  return update || result.compared() ? kOk : kBadInput;
}

/// Nothing that is played or compared with may be written over.
void refuseOverwriting(const RegressOptions& o, const std::vector<regression::SuiteCase>& cases,
                       Diagnostics& findings) {
  std::vector<NamedFile> files{
      {"the suite", o.suite, false}, {"--stadion", o.program, false}, {"--against", o.against, false}};
  std::vector<ShowOptions> shows;
  for (const regression::SuiteCase& c : cases) {
    ShowOptions& show = shows.emplace_back();
    show.script = c.show;
    show.walls = c.walls;
    show.input = c.input;
    show.assetRoots = c.assetRoots;
  }
  files.push_back({o.baselineGiven ? "--baseline" : "the suite's baseline", o.baseline, o.update});
  if (!o.out.empty())
    for (const char* name : {"report.html", "results.json", "junit.xml", "history.jsonl", "progress.jsonl"})
      files.push_back({std::string("--out's ") + name, o.out + "/" + name});
  refuseOverwriting(shows, files, findings);
}

regression::SuiteResult emptyResult(const RegressOptions& o, const RegressReference& with) {
  const std::string reference = !o.against.empty() ? o.against : with.baseline ? o.baseline : "";
  return {o.suite, o.program, reference, nowUtc(), {}};
}

/// Plays the cases that the folder does not have yet, until `stop` is true. Returns false if the folder
/// cannot keep a result.
bool playSuite(const RegressOptions& o, const regression::Suite& suite, const RegressReference& with,
               RegressFolder& folder, const std::atomic<bool>& stop, regression::Baseline* updated,
               regression::SuiteResult& result) {
  const bool watched = isatty(2) == 1;
  const auto progress = [watched](const std::string& what) {
    if (watched) std::fprintf(stderr, "\r\x1b[K%s", what.c_str());
  };
  for (const regression::SuiteCase& c : suite.cases) {
    const auto done = folder.done().find(c.name);
    const bool isDone = done != folder.done().end();
    const auto results = isDone ? done->second : playCase(c, o.settings(), with, updated, stop, progress);
    if (stop) break;
    if (!o.out.empty() && !isDone && !folder.note(c.name, results)) return false;
    for (const regression::CaseResult& r : results) result.add(r);
  }
  progress("");
  return true;
}

int stoppedBySignal(const RegressOptions& o) {
  std::fprintf(stderr, "stadion: stopped by %s%s\n", stopSignalName(),
               o.out.empty() ? "" : "; with --resume the suite goes on where it was");
  return kStopped + stopSignal();
}

/// Writes the new baseline if all cases could be played. Returns false if it cannot be written.
bool writeBaseline(const RegressOptions& o, const regression::SuiteResult& result,
                   const regression::Baseline& updated, const std::vector<std::string>& gone, Output& file) {
  if (result.faults() > 0) {
    std::fprintf(stderr, "%s stays as it was: not all cases could be played\n", o.baseline.c_str());
    return true;
  }
  if (!file.write(regression::toJson(updated))) return false;
  tellGone(gone, o);
  std::fprintf(stderr, "wrote %s\n", o.baseline.c_str());
  return true;
}

/// Says why a suite without faults was not compared.
void printLackOfReference(const RegressOptions& o, const regression::SuiteResult& result, bool hasReference) {
  if (result.faults() == 0 && !result.compared())
    std::fprintf(stderr, "stadion: error: nothing was compared%s\n",
                 hasReference ? "; the table says why" : "");
  if (!hasReference)
    std::fprintf(
        stderr, "stadion: error: there is no baseline %s: --update writes it, --against BUILD does without\n",
        o.baseline.c_str());
}

int regress(RegressOptions o) {
  Diagnostics findings;
  RegressReference with;
  std::optional<regression::Suite> suite;
  if (o.complete(findings)) {
    suite = regression::loadSuite(o.suite, findings);
    refuseOverwriting(o, suite ? suite->cases : std::vector<regression::SuiteCase>(), findings);
  }
  const bool ready = !findings.hasErrors() && suite && findReference(o, with, findings);
  std::vector<std::string> gone;
  if (ready && with.baseline) gone = regression::othersThan(*suite, *with.baseline);
  const bool chosen = ready && o.choose(*suite, findings);
  Output baseline(chosen && o.update, o.baseline, findings);
  printFindings(findings);
  if (!chosen || findings.hasErrors()) return kBadInput;
  if (!o.update) tellGone(gone, o);

  RegressFolder folder;
  if (!o.out.empty() && !folder.open(o, whatIsPlayed(o, *suite))) return kBadInput;
  const std::atomic<bool>& stop = catchStopSignals();
  regression::Baseline updated;
  if (o.update && with.baseline) updated = std::move(*std::exchange(with.baseline, std::nullopt));
  for (const std::string& name : gone) updated.erase(name);
  regression::SuiteResult result = emptyResult(o, with);
  if (!playSuite(o, *suite, with, folder, stop, o.update ? &updated : nullptr, result)) return kBadInput;
  if (stop) return stoppedBySignal(o);

  bool written = o.out.empty() || folder.finish(result);
  if (!o.out.empty() && written) std::fprintf(stderr, "wrote %s/report.html\n", o.out.c_str());
  if (o.update && !writeBaseline(o, result, updated, gone, baseline)) written = false;
  if (!o.out.empty() && written) folder.forgetProgress();
  const std::string text = o.json ? regression::benchmarkJsonOf(result) + "\n" : regression::tableOf(result);
  std::printf("%s", text.c_str());
  if (!o.update) printLackOfReference(o, result, with.baseline || !o.against.empty());
  return codeOf(result, o.update, written);
}

}  // namespace

void addRegressCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<RegressOptions>();
  CLI::App* command = addListedCommand(app, "regress");
  o->addTo(*command);
  command->callback([o, &code] {
    setenv("STADION_CALIBRATION", "none", 1);  // what is played depends on no machine's calibration
    code = regress(*o);
  });
}

}  // namespace stadion
