#include "cli/options/run_options.h"

#include "cli/options/value_grammar.h"
#include "show/output/output_folder.h"
#include "show/player/output_conflicts.h"

namespace stadion {
namespace {

std::optional<bool> wish(const std::string& word, const char* yes) {
  return word == "auto" ? std::nullopt : std::optional(word == yes);
}

}  // namespace

bool RunOptions::hasEnd() const {
  const SessionSettings& s = settings;
  return s.show.frames != 0 || s.show.seconds > 0 || !s.record.out.empty();
}

bool RunOptions::asksForEveryFrame() const {
  if (settings.play.windows || settings.play.display) return false;
  const std::string& input = settings.show.input;
  return hasEnd() || (!input.empty() && input != "none");
}

/// Machines that play together cannot decide these each for itself.
void RunOptions::refuseInCluster(Diagnostics& findings) const {
  if (settings.cluster.file.empty()) return;
  const auto refuse = [&](bool asked, const char* options, const char* why) {
    if (asked) findings.error({}, std::string(options) + " not for clusters: " + why);
  };
  refuse(lateLatch, "--late-latch is", "all walls of a frame are drawn from the same head");
  refuse(!settings.record.spans.file.empty() || settings.record.countWork, "--spans and --count-work are",
         "they measure on one machine");
}

/// These belong to one process, and end with it.
void RunOptions::refuseInSupervision(Diagnostics& findings) const {
  const RecordSettings& r = settings.record;
  const SupervisionSettings standard;
  if (!supervise && settings.supervision.progress < 0 && settings.supervision.hangAfter != standard.hangAfter)
    findings.error({}, "--hang-after says when a supervised player hangs: it needs --supervise");
  if (!supervise) return;
  const auto refuse = [&](bool asked, const char* option, const char* why) {
    if (asked) findings.error({}, std::string(option) + " and --supervise: " + why);
  };
  refuse(!r.out.empty(), "--out",
         "a run with pictures can be repeated and needs no supervision; leave one out");
  refuse(!r.input.empty(), "--record-input",
         "a record that begins in the middle of a show cannot be played; leave one out");
  refuse(!r.spans.file.empty() || r.countWork || r.profile || !trace.file.empty(),
         "--spans, --count-work, --profile and --trace", "what is measured is one process's; leave one out");
  refuse(!settings.cluster.file.empty(), "--cluster",
         "supervision is for a single player; `stadion cluster` restarts a host that died, and the host "
         "joins again");
}

/// Without a rasteriser, tables and records are written, but no pictures.
void RunOptions::completeUndrawn(Diagnostics& findings) const {
  if (!renderer.drawsNothing()) return;
  const RecordSettings& r = settings.record;
  if (settings.play.display) findings.error({}, "--gl none draws nothing that --display could show");
  if (!r.out.empty() && r.pictures.kind != PictureChoice::Kind::None)
    findings.error({}, "--gl none draws nothing that --pictures could keep: leave one of them out");
  const auto refuse = [&](bool asked, const char* option) {
    if (asked)
      findings.error({}, std::string(option) + " needs pictures, and --gl none draws none: leave one out");
  };
  refuse(r.video, "--video");
  refuse(r.sheets, "--sheets");
  refuse(r.hashes, "--hashes");
}

/// Options of drawing that exclude each other.
void RunOptions::completeDrawing(Diagnostics& findings) {
  SessionSettings& s = settings;
  const RecordSettings& r = s.record;
  const bool display = s.play.display, measures = r.profile || !trace.file.empty();
  const bool inTurn = s.show.mode == Mode::Sequential;
  if (wallWorkers == "process" && (measures || !r.spans.file.empty() || r.countWork))
    findings.error({}, "--profile, --trace, --spans and --count-work look into the drawing, which "
                       "--wall-workers process gives to others: say --wall-workers thread");
  if (wallWorkers == "process" && display)
    findings.error({}, "--display draws into windows of this program: say --wall-workers thread");
  if (wallWorkers == "process" && s.play.guard)
    findings.error({},
                   "--guard watches the stages of this program. A wall process cannot write to the scene, "
                   "and its writes to its own copies are not watched: say --wall-workers thread");
  if (wallWorkers == "process" && renderer.drawsNothing())
    findings.error({}, "--gl none draws nothing that --wall-workers process could: leave one of them out");
  if (inTurn && (s.play.mostInFlight != 0 || cullDrawGiven))
    findings.error({}, std::string(s.play.mostInFlight != 0 ? "--latency" : "--cull-draw") +
                           " says how stages overlap, which those of --mode sequential do not: leave one of "
                           "them out");
  if (pin == "on" && (display || (inTurn && wallWorkers != "process")))
    findings.error({},
                   "--pin on is for walls that are drawn beside each other: leave out --display, and --mode "
                   "sequential without --wall-workers process");
  s.draw.layout = display && !stereoGiven ? StereoLayout::Off : *stereoLayout(stereo);
  s.draw.renderer = renderer.settings(findings);
  s.draw.processes = wish(wallWorkers, "process");
  s.draw.pinned = wish(pin, "on");
  s.play.drawBeginsEarly = cullDraw == "overlap";
}

/// Options that measure, and exclude each other.
void RunOptions::completeMeasuring(Diagnostics& findings) const {
  const RecordSettings& r = settings.record;
  const bool measures = r.profile || !trace.file.empty(), spans = !r.spans.file.empty();
  if (spans && !asksForEveryFrame())
    findings.error(
        {}, "--spans is for runs in which every frame counts: say --frames N, --seconds S or --input FILE");
  if (r.countWork && !asksForEveryFrame())
    findings.error({}, "--count-work is for runs in which every frame counts: say --frames N, --seconds S or "
                       "--input FILE");
  if (r.countWork && (measures || spans))
    findings.error({}, "--profile, --trace and --spans time what --count-work counts; leave the one or the "
                       "other out");
  if (measures && spans)
    findings.error({},
                   "--profile and --trace time the nodes, as --spans does; leave the one or the other out");
}

bool RunOptions::complete(Diagnostics& findings) {
  SessionSettings& s = settings;
  RecordSettings& r = s.record;
  const bool none = renderer.drawsNothing() && !picturesGiven;  // the default yields
  r.pictures = *PictureChoice::parse(none ? "none" : pictures);
  if (s.play.display && !r.out.empty())
    findings.error(
        {}, "--display plays live, and --out writes every frame that is asked for; leave one of them out");
  if (s.play.hud && !s.play.display)
    findings.error({}, "--hud shows the frame budget on a display: add --display, or use stadion view");
  completeUndrawn(findings);
  completeMeasuring(findings);
  completeDrawing(findings);
  r.trace = trace.options(findings);
  if (!r.nodes.empty() && r.out.empty())
    findings.error({}, "--track needs --out DIR to know where the table goes");
  if (r.video && r.out.empty()) findings.error({}, "--video needs --out DIR to know where the video goes");
  if (s.play.stress.low > s.play.stress.high)
    findings.error({}, "--stress-low must not be greater than --stress-high: between them stress stays");
  completeLive(findings);
  refuseInCluster(findings);
  completeFiles(findings);
  completeHead(findings);
  refuseInSupervision(findings);
  s.cluster.isChecked = endsWith >= 0;  // `stadion cluster` has warned for all its nodes
  return s.show.complete(findings) && !findings.hasErrors();
}

std::vector<NamedFile> RunOptions::namedFiles() const {
  const RecordSettings& r = settings.record;
  return {{"--rig", settings.console.trackers.rig, false},
          {"--web-token", settings.web.tokenFile, false},
          {"--record-input", r.input},
          {"--trace", trace.file},
          {"--spans", r.spans.file},
          {"--black-box", r.blackBox},
          {"--journal", settings.supervision.journal}};
}

void RunOptions::completeFiles(Diagnostics& findings) const {
  std::vector<NamedFile> files = namedFiles();
  const std::string& out = settings.record.out;
  if (!out.empty())
    for (const std::string& name : OutputFolder::namesOfRuns(out))
      files.push_back({"--out's " + name, out + "/" + name});
  refuseOverwriting({&settings.show, 1}, files, findings);
}

/// Options that need the clock, an operator or a tracker.
void RunOptions::completeLive(Diagnostics& findings) {
  SessionSettings& s = settings;
  const auto refuse = [&](const char* option) {
    findings.error({}, std::string(option) +
                           " is for live runs: leave out --frames, --seconds, --out and --input FILE");
  };
  const TrackerOptions& trackers = s.console.trackers;
  const bool everyFrame = asksForEveryFrame();
  if (everyFrame && s.console.oscPort >= 0) refuse("--osc");
  if (everyFrame && !s.web.address.empty()) refuse("--web");
  if (everyFrame && s.console.wait) refuse("--wait");
  if (everyFrame && !trackers.device.empty()) refuse("--tracker");
  if (everyFrame && degradationAsked) refuse("--load-control (and --stress-...)");
  if (!trackers.rig.empty() && trackers.device.empty())
    findings.error({}, "--rig says where trackers are, and there are none: --tracker osc:PORT");
  s.play.everyFrame = everyFrame;
  s.play.swapSync = swapSync == "off"       ? SwapSync::Off
                    : swapSync == "barrier" ? SwapSync::Barrier
                                            : SwapSync::Auto;
  if (swapSync != "auto" && !s.play.display)
    findings.error({}, "--swap-sync is for windows: it needs --display");
  const bool free = pace == "free" || (pace.empty() && hasEnd());
  s.play.pace = free && !s.play.display ? Pace::Free : pace == "float" ? Pace::Float : Pace::Lock;
  if (!trackers.device.empty()) s.show.input = "none";  // not the log beside the show
}

/// Pictures that depend on the moment at which they are drawn need a head that moves meanwhile.
void RunOptions::completeHead(Diagnostics& findings) {
  std::optional<Nanoseconds>& ahead = settings.draw.ahead;
  if (predict == "auto")
    ahead = HeadTiming::kToSwap;
  else if (predict != "off")
    ahead = fromSeconds(1e-3 * *readDecimal(predict));
  if (lateLatch) settings.draw.latch = HeadReach{reach[0], reach[1]};
  const auto needsTracker = [&](bool asked, const char* option) {
    if (asked && asksForEveryFrame())
      findings.error({}, std::string(option) + " is for live runs, whose pictures are never the same twice: "
                                               "leave out --frames, --seconds, --out and --input FILE");
    else if (asked && settings.console.trackers.device.empty())
      findings.error({}, std::string(option) + " needs the head of a live tracker: --tracker osc:PORT");
  };
  needsTracker(lateLatch, "--late-latch");
  needsTracker(predict != "off", "--predict");
}

}  // namespace stadion
