/// `stadion view SHOW`: plays a show in windows.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/view/view_session.h"
#include "engine/base/run_stopped.h"
#include "show/base/stop_signal.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

namespace stadion {
namespace {

int viewShow(ViewOptions options) try {
  Diagnostics findings;
  const std::atomic<bool>& stop = catchStopSignals();
  std::unique_ptr<ViewSession> session;
  if (options.settle(findings)) session = ViewSession::open(std::move(options), findings);
  tell(findings);
  return session ? session->run(stop) : kBadInput;
} catch (const RunStopped&) {
  std::fprintf(stderr, "stadion: stopped by %s before the show was loaded\n", stopSignalName());
  return kStopped + stopSignal();
}

}  // namespace

void addViewCommand(CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads) {
  auto o = std::make_shared<ViewOptions>();
  o->run.rasteriserThreads = rasteriserThreads;
  CLI::App* command =
      app.add_subcommand("view", "Play a show in windows, with keyboard and mouse for a visitor");
  o->addTo(*command);
  command->callback([o, &code] { code = viewShow(*o); });
}

}  // namespace stadion
