/// `stadion view SHOW`: plays a show in windows, or shows a model alone.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/terminal.h"
#include "cli/view/view_options.h"
#include "engine/asset/import.h"
#include "engine/base/run_stopped.h"
#include "show/base/stop_signal.h"
#include "show/view/model_show.h"
#include "show/view/view_session.h"

#include <CLI/CLI.hpp>
#include <cinttypes>
#include <cstdio>
#include <memory>

namespace stadion {
namespace {

void print(const ViewReport& report) {
  const RunSummary& s = report.summary;
  std::printf("the rig stands at %.3f %.3f %.3f\n", report.rig.x(), report.rig.y(), report.rig.z());
  std::printf("played %.3f s in %" PRIu64 " frames, %" PRIu64 " ticks dropped; state hash %016" PRIx64 "\n%s",
              s.seconds, report.frames, report.dropped, s.stateHash.value_or(0), eventsText(s).c_str());
  std::fputs(report.lateFrames.c_str(), stderr);
}

/// If a model is to be viewed, lets the options name a show of it. The show goes with the result. False if the model
/// cannot be read.
bool showModel(ViewOptions& options, std::unique_ptr<ModelShow>& model, Diagnostics& findings) {
  ShowOptions& show = options.run.settings.show;
  if (!ModelShow::isModel(show.script)) return true;
  model = ModelShow::make(show.script, Importer::installedProgram(), findings);
  if (!model) return false;
  options.settings.model = show.script;
  show.script = model->script();
  show.assetRoots.push_back(model->assetRoot());
  return true;
}

int viewShow(ViewOptions options) try {
  Diagnostics findings;
  const std::atomic<bool>& stop = catchStopSignals();
  TerminalReporter terminal;
  std::unique_ptr<ModelShow> model;
  std::unique_ptr<ViewSession> session;
  if (showModel(options, model, findings) && options.complete(findings))
    session = ViewSession::open(std::move(options.settings), terminal, findings);
  printFindings(findings);
  if (!session) return kBadInput;
  const SessionEnd end = session->run(stop);
  print(session->report());
  return statusOf(end);
} catch (const RunStopped&) {
  std::fprintf(stderr, "stadion: stopped by %s before the show was loaded\n", stopSignalName());
  return kStopped + stopSignal();
}

}  // namespace

void addViewCommand(CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads) {
  auto o = std::make_shared<ViewOptions>();
  o->run.settings.draw.rasteriserThreads = rasteriserThreads;
  CLI::App* command = app.add_subcommand(
      "view", "Play a show in windows, with keyboard and mouse for a visitor; or show a model");
  o->addTo(*command);
  command->callback([o, &code] { code = viewShow(*o); });
}

}  // namespace stadion
