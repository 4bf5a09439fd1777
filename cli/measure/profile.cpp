/// `stadion profile SHOW`: what the frames of a show are spent on, node by node; with --fidelity, how near
/// each body comes to its finest model, and what would be cheaper.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/command_programs.h"
#include "cli/options/renderer_options.h"
#include "cli/options/run_options.h"
#include "cli/options/show_options.h"
#include "cli/terminal.h"
#include "profiling/record/black_box.h"
#include "profiling/record/black_box_folder.h"
#include "profiling/report/last_frames_report.h"
#include "show/base/stop_signal.h"
#include "show/measure/fidelity.h"
#include "show/measure/profile_run.h"
#include "show/player/output_conflicts.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <unistd.h>

namespace stadion {
namespace {

struct ProfileOptions {
  FidelityOptions fidelity;
  ProfileRunOptions run;
  RendererOptions renderer;
  TraceRequest trace;
  std::size_t nodes = 25;
  double millimetres = 1;
  CLI::Option* blackBox = nullptr;
  std::string blackBoxFile;
  std::string out;
  bool fidelityAsked = false, json = false, csv = false;
};

/// The file of the run that began last; empty if there is none. Says which it is.
std::string newestBlackBox() {
  const BlackBoxFolder folder = BlackBoxFolder::ofThisUser();
  const auto files = folder.files();
  if (files.empty()) {
    std::fprintf(stderr,
                 "stadion: no run has left its last frames in %s; they stay if a frame was late, the run "
                 "failed or the program died\n",
                 folder.path().c_str());
    return {};
  }
  const std::string newest = files.front();
  const bool written = BlackBox::isWritten(newest);
  std::fprintf(stderr, "%s: the newest of %zu there%s%s\n", newest.c_str(), files.size(),
               written ? ", of a run that is under way" : "",
               written && files.size() > 1 ? ("; the one before: " + files[1].string()).c_str() : "");
  return newest;
}

/// What a run left behind; an empty name: the newest one. --out receives a page and JSON.
int showBlackBox(std::string file, const ProfileOptions& o) {
  if (file.empty() && (file = newestBlackBox()).empty()) return kBadInput;
  Diagnostics findings;
  OutputFiles files(o.out, {"last-frames.html", "last-frames.json"});
  std::vector<NamedFile> named = files.named();
  named.insert(named.begin(), {"--black-box", file, false});
  refuseOverwriting({}, named, findings);
  const auto content = BlackBox::read(file);
  if (!content) findings.add(content.error());
  const std::string json = content ? lastFramesJson(content.value(), file) : "";
  if (!findings.hasErrors() && files.open(findings) && files.areWanted()) {
    files.write("last-frames.html", lastFramesPage(content.value(), file));
    files.write("last-frames.json", json);
    files.commit(findings);
  }
  printFindings(findings);
  if (findings.hasErrors()) return kBadInput;
  std::fputs((o.json ? json : lastFramesText(content.value())).c_str(), stdout);
  return kOk;
}

/// Says which options are beside --black-box that it could not apply.
bool isAlone(const CLI::Option& blackBox, CLI::App& command) {
  Diagnostics findings;
  for (const CLI::Option* other : command.get_options()) {
    const std::string name = other->get_name();
    if (other != &blackBox && other->count() > 0 && name != "--out" && name != "--json")
      findings.error({}, name +
                             " is for a show that is played now; --black-box explains a past run: it takes "
                             "--out DIR and --json");
  }
  printFindings(findings);
  return !findings.hasErrors();
}

int profileFrames(ProfileOptions o) {
  ProfileRunOptions& options = o.run;
  options.show = o.fidelity.show;
  options.layout = *stereoLayout(options.stereo);
  options.fidelity = o.fidelity;
  options.fidelity.report = printFindings;
  options.fidelityAsked = o.fidelityAsked;
  options.fidelity.tolerance = 1e-3 * o.millimetres;
  Diagnostics findings;
  OutputFiles files = profileFiles(o.out, o.fidelityAsked);
  std::vector<NamedFile> named = files.named();
  named.push_back({"--trace", o.trace.file});
  refuseOverwriting({&options.show, 1}, named, findings);
  options.trace = o.trace.options(findings);
  options.renderer = o.renderer.settings(findings);
  const bool settled = options.show.complete(findings) && !findings.hasErrors();
  TerminalReporter terminal;
  Failure failure;
  const auto figures = settled ? profileShow(options, files, terminal, findings, failure) : std::nullopt;
  printFindings(findings);
  if (!figures) return failure ? exitCodeOf(*failure) : kBadInput;
  std::printf("%s", o.json  ? (toJson(*figures) + "\n").c_str()
                    : o.csv ? toCsv(*figures).c_str()
                            : toText(*figures, o.nodes).c_str());
  return stopSignal() ? kStopped + stopSignal() : kOk;  // the figures are those of what was played
}

/// A comparison of models records nothing, unless a page shows both.
bool asksForRecord(const CLI::App& command) {
  Diagnostics findings;
  for (const char* option : {"--csv", "--trace", "--trace-frames", "--trace-limit", "--nodes"})
    if (command.count(option) > 0)
      findings.error({}, std::string(option) +
                             " tells of frames, which --fidelity does not record: leave one "
                             "of them out, or add --out DIR, whose page has both");
  printFindings(findings);
  return findings.hasErrors();
}

int profileModels(ProfileOptions o) {
  FidelityOptions& options = o.fidelity;
  options.tolerance = 1e-3 * o.millimetres;
  options.report = printFindings;
  options.show.walls = "desktop";
  Diagnostics findings;
  if (!options.show.complete(findings)) return exitWith(findings, kBadInput);
  const bool watched = isatty(2) == 1;
  const auto progress = [watched](const std::string& what) {
    if (watched) std::fprintf(stderr, "\r\x1b[Kplaying %s", what.c_str());
  };
  const auto measured = measureFidelity(options, findings, progress);
  if (watched) std::fprintf(stderr, "\r\x1b[K");
  printFindings(findings);
  if (!measured) return kBadInput;
  std::printf("%s", o.json ? (fidelityJson(*measured) + "\n").c_str() : fidelityTable(*measured).c_str());
  return kOk;
}

constexpr const char* kProfileFooter =
    R"(The show is played as in run, and the report names each node's share of the frame: App is timed by node, when it visits it (where it visits hundreds, in some frames only);
Cull by wall, shared among the nodes that it looked at; Draw by drawing a few batches alone in some frames, in their
place in the frame, until every node has had its turn. `visitor` stands for the trackers and for the eyes in front of the walls.
`explained` says how much of what the stages took is found with nodes, or with parts of the stages themselves.
The figures leave out the first four frames; the trace has them. `-` (JSON: null, CSV: empty) is what was not measured, for want of frames.

--out DIR receives the figures as profile.json and profile.csv, with --fidelity also fidelity.json; and profile.html, a
page for a browser: each thread in the frames around the longest, costs along the scene tree, histograms, walls and
eyes, late frames with their causes, bodies' costs beside their errors. With --trace FILE every span is written, for
ui.perfetto.dev; App, Cull and Draw of a frame are joined by arrows. docs/profiling.md teaches to read both.

  ./stadion profile scripts/kick.evs --out kick --trace kick.json --trace-frames 100..160

With --fidelity, every dynobject is listed with what stands for it: the shape that collides, the fields it is hooked to, how its
flight is computed (in closed form; by a series of order 16, in one medium; by steps of order 5, under other fields),
its contact states, and its share of the dynamics node's time, by the arcs it begins.

Then the show is played again with one body's model changed at a time, never drawn, and the body's places are
compared, frame by frame, with those of the finest model: its own mesh (or the box or convex body that the mesh is to
rounding, which is more exact in contact), and the steps of lasting contact divided by eight. `error` is how far off
it ever is, `at the end` how far in the last frame, `degrees` how differently it is turned. A bounce magnifies what was
off before it: see from when on a model is beyond the tolerance. The mesh is the model as it was drawn; if a ball of
flat facets is meant to be round, say --finest sphere. In lasting contact a mesh is no exact reference; a caution says
so. `us/frame` is what the dynamics node takes more with the model than without the body; what is less than can be
measured in the rounds is given as `< x`.

`as it is, steps / 8` tells how much of the error is due to steps in time, not to the shape. `shape=...` goes into the
script as it stands; `without FIELD` means to leave that hook out. What a body is not hooked to, such as air, is no
part of any of its models.

  ./stadion profile --fidelity scripts/kick.evs --finest sphere --tolerance 5)";

}  // namespace

void addProfileCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<ProfileOptions>();
  CLI::App* command = addListedCommand(app, "profile");
  ShowOptions& show = o->fidelity.show;
  addShowOptions(*command, show);
  CommandOptions options(*command);
  options.add("--stereo", o->run.stereo, {.words = "pair|off"});
  o->renderer.addTo(*command, true);
  o->blackBox = options.add("--black-box", o->blackBoxFile).valueMayBeMissing().option();
  addGuardOption(*command, o->run.guard);
  options.add("--nodes", o->nodes);
  options.add("--out", o->out);
  addTraceOptions(*command, o->trace);
  options.add("--csv", o->csv);
  options.add("--json", o->json).excludes("--csv");
  options.add("--fidelity", o->fidelityAsked);
  options.add("--tolerance", o->millimetres);
  options.add("--body", o->fidelity.bodies);
  options.add("--finest", o->fidelity.finest);
  options.add("--most", o->fidelity.most);
  options.add("--rounds", o->fidelity.rounds, {.most = 99});
  command->footer(kProfileFooter);
  command->get_option("SHOW")->required(false);
  command->callback([o, command, &code] {
    if (o->blackBox->count() > 0)
      code = !isAlone(*o->blackBox, *command) ? kBadInput : showBlackBox(o->blackBoxFile, *o);
    else if (o->fidelity.show.script.empty())
      throw CLI::RequiredError("SHOW");
    else if (!o->fidelityAsked || !o->out.empty())
      code = profileFrames(*o);
    else
      code = asksForRecord(*command) ? kBadInput : profileModels(*o);
  });
}

}  // namespace stadion
