#include "cli/options/run_options.h"

#include "cli/options/command_options.h"
#include "cli/options/show_options.h"

#include <CLI/CLI.hpp>

namespace stadion {

void addTraceOptions(CLI::App& command, TraceRequest& o) {
  CommandOptions options(command);
  options.add("--trace", o.file);
  options.add("--trace-frames", o.frames);
  options.add("--trace-limit", o.megabytes);
}

void addSpanOptions(CLI::App& command, SpanOptions& o) {
  CommandOptions options(command);
  options.add("--spans", o.file);
  options.add("--plant", o.planted);
  options.add("--turns", o.turns);
  options.add("--count-instructions", o.instructions);
  options.add("--count-by-hardware", o.hardware);
}

void addTrackerOptions(CLI::App& command, TrackerOptions& o) {
  CommandOptions options(command);
  options.add("--tracker", o.device);
  options.add("--rig", o.rig);
}

void addLoadOptions(CLI::App& command, RunOptions& run) {
  CommandOptions options(command);
  PlaySettings& o = run.settings.play;
  options.add("--load-control", o.degradationControl).notes(run.degradationAsked);
  options.add("--stress-frac", o.stress.frac).notes(run.degradationAsked);
  options.add("--stress-low", o.stress.low).notes(run.degradationAsked);
  options.add("--stress-high", o.stress.high).notes(run.degradationAsked);
  options.add("--stress-scale", o.stress.scale).notes(run.degradationAsked);
  options.add("--stress-max", o.stress.max).notes(run.degradationAsked);
}

void addClusterOptions(CLI::App& command, ClusterSettings& o) {
  CommandOptions options(command);
  BoundOption file = options.add("--cluster", o.file);
  options.add("--node", o.node).needs("--cluster");
  file.needs("--node").excludes("--walls");
  options.add("--plant-difference", o.plantDifference).needs("--cluster");
}

void addHeadOptions(CLI::App& command, RunOptions& o) {
  CommandOptions options(command);
  options.add("--late-latch", o.lateLatch);
  options.add("--latch-reach", o.reach).needs("--late-latch");
  options.add("--predict", o.predict);
}

void addGuardOption(CLI::App& command, bool& guard) {
  CommandOptions(command).add("--guard", guard);
}

void addBlackBoxOption(CLI::App& command, RecordSettings& o) {
  CommandOptions(command).add("--black-box", o.blackBox);
}

void addSupervisionOptions(CLI::App& command, RunOptions& o) {
  CommandOptions options(command);
  SupervisionSettings& supervision = o.settings.supervision;
  options.add("--supervise", o.supervise);
  options.add("--hang-after", supervision.hangAfter);
  options.add("--supervised", supervision.progress);
  options.add("--ends-with", o.endsWith);
  options.add("--journal", supervision.journal);
}

void addOperatorOptions(CLI::App& command, RunOptions& o) {
  CommandOptions options(command);
  options.add("--latency", o.settings.play.mostInFlight);
  options.add("--cull-draw", o.cullDraw).notes(o.cullDrawGiven);
  options.add("--osc", o.settings.console.oscPort);
  options.add("--web", o.settings.web.address);
  options.add("--web-token", o.settings.web.tokenFile).needs("--web");
  options.add("--web-name", o.settings.web.names).needs("--web");
  options.add("--wait", o.settings.console.wait);
  options.add("--no-sound", o.settings.console.noSound);
}

namespace {

void addOutputOptions(CommandOptions& options, RunOptions& o) {
  RecordSettings& record = o.settings.record;
  options.add("--out", record.out);
  options.add("--pictures", o.pictures).notes(o.picturesGiven);
  options.add("--sheets", record.sheets);
  options.add("--hashes", record.hashes);
  options.add("--video", record.video);
  options.add("--track", record.nodes);
  options.add("--record-input", record.input);
  options.add("--profile", record.profile);
  options.add("--count-work", record.countWork);
  options.add("--unrecorded", record.unrecorded);
  options.add("--json", o.json);
}

void addDrawingOptions(CommandOptions& options, RunOptions& o) {
  options.add("--stereo", o.stereo).notes(o.stereoGiven);
  options.add("--display", o.settings.play.display);
  options.add("--hud", o.settings.play.hud);
  options.add("--swap-sync", o.swapSync);
  options.add("--pace", o.pace);
  options.add("--wall-workers", o.wallWorkers);
  options.add("--pin", o.pin);
}

}  // namespace

void addRunOptions(CLI::App& command, RunOptions& o) {
  CommandOptions options(command);
  SessionSettings& settings = o.settings;
  addShowOptions(command, settings.show);
  addDrawingOptions(options, o);
  o.renderer.addTo(command, true);
  addOutputOptions(options, o);
  addBlackBoxOption(command, settings.record);
  addGuardOption(command, settings.play.guard);
  addTraceOptions(command, o.trace);
  addClusterOptions(command, settings.cluster);
  addLoadOptions(command, o);
  addTrackerOptions(command, settings.console.trackers);
  addHeadOptions(command, o);
  addSpanOptions(command, settings.record.spans);
  addOperatorOptions(command, o);
  addSupervisionOptions(command, o);
  command.footer("--out DIR receives pictures, contact-sheet.png, summary.json and everything else but the "
                 "files that are named "
                 "one\nby one. Only the frames of --pictures are drawn. A further run into the same DIR "
                 "removes the files of the "
                 "run before,\nand no others.\n\nSIGINT (Ctrl-C) and SIGTERM end the run after the frames in "
                 "flight. It writes "
                 "all requested files and ends with exit\ncode 130 or 143. A second signal ends it at once.");
}

}  // namespace stadion
