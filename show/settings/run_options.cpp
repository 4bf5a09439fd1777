#include "show/settings/run_options.h"

#include "engine/base/number_text.h"
#include "show/output/output_folder.h"
#include "show/player/overwriting.h"

#include <cstdio>

namespace stadion {
/// What all machines do together each of them cannot decide alone.
void RunOptions::settleCluster(Diagnostics& findings) {
  if (cluster.empty()) return;
  const auto refuse = [&](bool asked, const char* options, const char* why) {
    if (asked) findings.error({}, std::string(options) + " not for clusters: " + why);
  };
  refuse(lateLatch, "--late-latch is", "all walls of a frame are drawn from the same head");
  refuse(!spans.file.empty() || countWork, "--spans and --count-work are", "they measure on one machine");
}

/// What belongs to one process, and goes with it.
void RunOptions::settleSupervision(Diagnostics& findings) const {
  const RunOptions standard;
  if (!supervise && supervised < 0 && hangAfter != standard.hangAfter)
    findings.error({}, "--hang-after says when a supervised player hangs: it needs --supervise");
  if (!supervise) return;
  const auto refuse = [&](bool asked, const char* option, const char* why) {
    if (asked) findings.error({}, std::string(option) + " and --supervise: " + why);
  };
  refuse(!out.empty(), "--out",
         "pictures of a run that can be repeated need nobody who goes on; leave one out");
  refuse(!recordInput.empty(), "--record-input",
         "a record that begins in the middle of a show cannot be played; leave one out");
  refuse(!spans.file.empty() || countWork || profile || !events.file.empty(),
         "--spans, --count-work, --profile and --trace-events",
         "what is measured is one process's; leave one out");
  refuse(!cluster.empty(), "--cluster",
         "a node that dies joins the others again by itself; `stadion cluster` begins it anew");
}

bool RunOptions::settle(Diagnostics& findings) {
  layout = *stereoLayout(stereo);
  if (const auto choice = PictureChoice::parse(pictures))
    pictureChoice = *choice;
  else
    findings.error({}, "--pictures: \"" + pictures +
                           "\" is not last, all, none or a whole number N from 1 (every Nth frame)");
  if (display && !out.empty())
    findings.error(
        {}, "--display plays live, and --out writes every frame that is asked for; leave one of them out");
  if (provider == "none" && (display || !out.empty()))
    findings.error({}, "--gl none draws nothing that --display or --out could show");
  if (!spans.file.empty() && !asksForEveryFrame())
    findings.error(
        {}, "--spans is for runs in which every frame counts: say --frames N, --seconds S or --input FILE");
  if (countWork && !asksForEveryFrame())
    findings.error({}, "--count-work is for runs in which every frame counts: say --frames N, --seconds S or "
                       "--input FILE");
  if (countWork && (profile || !events.file.empty() || !spans.file.empty()))
    findings.error(
        {}, "--profile, --trace-events and --spans time what --count-work counts; leave the one or the "
            "other out");
  if ((profile || !events.file.empty()) && !spans.file.empty())
    findings.error(
        {}, "--profile and --trace-events time the nodes, as --spans does; leave the one or the other out");
  if (wallWorkers == "process" && (profile || !events.file.empty() || !spans.file.empty() || countWork))
    findings.error({}, "--profile, --trace-events, --spans and --count-work look into the drawing, which "
                       "--wall-workers process gives to others: say --wall-workers thread");
  if (wallWorkers == "process" && display)
    findings.error({}, "--display draws into windows of this program: say --wall-workers thread");
  if (wallWorkers == "process" && provider == "none")
    findings.error({}, "--gl none draws nothing that --wall-workers process could: leave one of them out");
  if (show.mode == "sequential" && (latency != 0 || cullDrawGiven))
    findings.error({}, std::string(latency != 0 ? "--latency" : "--cull-draw") +
                           " says how stages overlap, which those of --mode sequential do not: leave one of "
                           "them out");
  if (pin == "on" && (display || (show.mode == "sequential" && wallWorkers != "process")))
    findings.error({},
                   "--pin on is for walls that are drawn beside each other: leave out --display, and --mode "
                   "sequential without --wall-workers process");
  events.settle(findings);
  if (display && !stereoGiven) layout = StereoLayout::Off;
  if (!trace.empty() && out.empty())
    findings.error({}, "--trace needs --out DIR to know where the table goes");
  if (hashes && out.empty()) findings.error({}, "--hashes needs --out DIR to know where they go");
  if (video && out.empty()) findings.error({}, "--video needs --out DIR to know where the video goes");
  if (stress.low > stress.high)
    findings.error({}, "--stress-low must not be greater than --stress-high: between them stress stays");
  settleLive(findings);
  settleCluster(findings);
  settleFiles(findings);
  settleHead(findings);
  settleSupervision(findings);
  return show.settle(findings) && !findings.hasErrors();
}

bool RunOptions::keepsPictures() const {
  return !out.empty() && provider != "none" &&
         (pictureChoice.kind != PictureChoice::Kind::None || video || hashes);
}

std::vector<NamedFile> RunOptions::namedFiles() const {
  return {{"--rig", trackers.rig, false}, {"--record-input", recordInput}, {"--trace-events", events.file},
          {"--spans", spans.file},        {"--black-box", blackBox},       {"--journal", journal}};
}

/// No output is another one, or what the show is played from.
void RunOptions::settleFiles(Diagnostics& findings) const {
  std::vector<NamedFile> files = namedFiles();
  if (!out.empty())
    for (const std::string& name : OutputFolder::namesOfRuns(out))
      files.push_back({"--out's " + name, out + "/" + name});
  refuseOverwriting({&show, 1}, files, findings);
}

/// What needs somebody who is there.
void RunOptions::settleLive(Diagnostics& findings) {
  const auto refuse = [&](const char* option) {
    findings.error({}, std::string(option) +
                           " is for live runs: leave out --frames, --seconds, --out and --input FILE");
  };
  if (asksForEveryFrame() && oscPort >= 0) refuse("--osc");
  if (asksForEveryFrame() && wait) refuse("--wait");
  if (asksForEveryFrame() && !trackers.device.empty()) refuse("--tracker");
  if (asksForEveryFrame() && loadAsked) refuse("--load-control (and --stress-...)");
  if (!trackers.rig.empty() && trackers.device.empty())
    findings.error({}, "--rig says where trackers are, and there are none: --tracker osc:PORT");
  if (!trackers.device.empty()) show.input = "none";  // not the log beside the show
}

/// What lets pictures depend on the moment at which they are drawn needs a head that goes on meanwhile.
void RunOptions::settleHead(Diagnostics& findings) {
  const auto milliseconds = parseNumber(predict);
  if (predict == "auto")
    ahead = HeadTiming::kToSwap;
  else if (milliseconds && *milliseconds >= 0 && *milliseconds <= 100)
    ahead = fromSeconds(1e-3 * *milliseconds);
  else if (predict != "off")
    findings.error({}, "--predict: \"" + predict + "\" is not off, auto or milliseconds from 0 to 100");
  const auto needsTracker = [&](bool asked, const char* option) {
    if (asked && asksForEveryFrame())
      findings.error({}, std::string(option) + " is for live runs, whose pictures are never the same twice: "
                                               "leave out --frames, --seconds, --out and --input FILE");
    else if (asked && trackers.device.empty())
      findings.error({},
                     std::string(option) + " needs a head that a live tracker tells of: --tracker osc:PORT");
  };
  needsTracker(lateLatch, "--late-latch");
  needsTracker(predict != "off", "--predict");
}

HeadTiming RunOptions::headFor(std::vector<WallView>& walls) const {
  HeadTiming head;
  head.predict = ahead;
  if (!lateLatch) return head;
  head.latch = latchReach;
  for (WallView& view : walls) view.reach = latchReach;
  return head;
}

bool RunOptions::asksForEveryFrame() const {
  if (live || display) return false;
  const bool byInput = !show.input.empty() && show.input != "none";
  return show.frames != 0 || show.seconds > 0 || !out.empty() || byInput;
}

bool RunOptions::everyFrameCounts(const Player& player) const {
  return asksForEveryFrame() || player.obeysLog();
}

bool RunOptions::repeats(const Player& player) const {
  return everyFrameCounts(player) || (player.inputFound() && !player.inputIsLive());
}

DrawingNeeds RunOptions::drawingNeeds(std::size_t walls) const {
  DrawingNeeds needs;
  needs.walls = walls, needs.look = show.look;
  needs.wishes.rasteriserThreads = rasteriserThreads;
  if (wallWorkers != "auto") needs.wishes.processes = wallWorkers == "process";
  const bool inTurn = display || (show.mode == "sequential" && wallWorkers != "process");
  if (pin != "auto" || inTurn) needs.wishes.pinned = pin == "on";
  if (wallWorkers != "auto") return needs;
  if (display) needs.here = "--display draws into windows of this program";
  if (show.mode == "sequential") needs.here = "--mode sequential does everything in one thread";
  if (profile || !events.file.empty() || !spans.file.empty() || countWork || unrecorded)
    needs.here = "what is measured looks into the drawing";
  return needs;
}

std::optional<WallWorkers> RunOptions::workers(const Player& player, const DrawSetting& setting) const {
  if (!setting.processes) return {};
  WallWorkers w;
  w.rasteriserThreads = setting.rasteriserThreads;
  w.egl = provider == "egl";
  w.everyFrame = everyFrameCounts(player) || !cluster.empty();
  w.rate = player.rate();
  w.tell = [tell = say](const std::string& what) { tell("stadion: " + what); };
  return w;
}

FrameLoopOptions RunOptions::loopOptions(const Player& player) const {
  FrameLoopOptions l = player.loopOptions();
  l.latency = latency;
  l.drawBeginsEarly = cullDraw == "overlap";
  l.delivery = everyFrameCounts(player) ? Delivery::Every : Delivery::Latest;
  const bool newest = l.delivery == Delivery::Latest;
  l.everyTick = newest && repeats(player);
  // A live show that drops frames ends with its log's last moment, not with its last frame's number.
  if (newest && !l.everyTick && player.end() > 0) l.frames = 0, l.end = player.end();
  if (display || live) l.pace = pace == "float" ? Pace::Float : Pace::Lock;
  if (display || live) return l;
  const bool free = pace.empty() ? (show.frames != 0 || show.seconds > 0 || !out.empty()) : pace == "free";
  l.pace = free ? Pace::Free : pace == "float" ? Pace::Float : Pace::Lock;
  return l;
}

}  // namespace stadion
