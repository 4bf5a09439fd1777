#include "cli/run_options.h"

#include "cli/number_option.h"
#include "cli/output_folder.h"
#include "cli/overwriting.h"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace stadion {
namespace {

/// Refuses the empty word of a shell variable that is not set.
std::string aName(const std::string& word) {
  return word.empty() ? "a name is expected, not an empty word" : "";
}

}  // namespace

void RunOptions::addTo(CLI::App& command) {
  show.addTo(command);
  std::vector<std::string> layouts = stereoLayoutNames();
  command.add_option("--stereo", stereo, "how the two eyes' pictures are written")
      ->check(CLI::IsMember(layouts))
      ->each([this](const std::string&) { stereoGiven = true; })
      ->capture_default_str();
  command.add_flag(
      "--display", display,
      "show the walls on the outputs that the wall file names (a window for each that has none), "
      "live; Escape ends it. --stereo pair is a buffer for each eye then (quad-buffered); without "
      "--stereo both eyes see the same");
  command
      .add_option(
          "--pace", pace,
          "free: as fast as possible; lock: on the ticks of --rate; float: a late frame begins at once "
          "(default: free with --frames or --out, else lock)")
      ->check(CLI::IsMember({"free", "lock", "float"}));
  command.add_option("--record-input", recordInput, "write what the trackers said to this input log")
      ->check(aName, "FILE");
  command
      .add_option(
          "--out", out,
          "folder for pictures, contact-sheet.png and summary.json; only the frames of --pictures are drawn")
      ->check(aName, "DIR");
  command
      .add_option("--pictures", pictures,
                  "of which frames pictures are written: last, all, none, or N for every Nth")
      ->capture_default_str();
  command.add_flag("--sheets", sheets, "a contact sheet of all walls beside each frame's pictures");
  command.add_flag("--hashes", hashes,
                   "each picture's hash, and when it was shown: picture-hashes.txt, swap-times.txt");
  command.add_flag("--video", video, "a video of all walls (needs ffmpeg)");
  command.add_flag("--profile", profile, "say which nodes cost the most; stadion profile says more");
  addBlackBoxTo(command);
  command
      .add_option("--gl", provider, "who draws: osmesa or egl (the same pixels), none: App and Cull alone")
      ->check(CLI::IsMember({"osmesa", "egl", "none"}))
      ->capture_default_str();
  command
      .add_option(
          "--wall-workers", wallWorkers,
          "who draws the walls: a thread each in this program, a process each (several processors are "
          "used better when software draws, and a driver that crashes takes one wall only), or auto: what "
          "stadion calibrate found to be faster on this machine, without it threads")
      ->check(CLI::IsMember({"thread", "process", "auto"}))
      ->capture_default_str();
  command
      .add_option("--pin", pin,
                  "on: each wall is drawn on processors of its own, near to each other; off: wherever the "
                  "system likes; auto: as stadion calibrate found to be faster, without it off")
      ->check(CLI::IsMember({"on", "off", "auto"}))
      ->capture_default_str();
  command
      .add_option("--trace", trace,
                  "write where this node is in every frame to trace-NODE.csv in --out DIR; may be repeated")
      ->allow_extra_args(false);
  events.addTo(command, "--trace-events");
  addClusterTo(command);
  addLoadTo(command);
  trackers.addTo(command);
  addHeadTo(command);
  spans.addTo(command);
  command.add_flag(
      "--count-work", countWork,
      "count pixels, spheres tested and seen, contacts and so on of all frames, for the summary");
  command.add_flag("--unrecorded", unrecorded)->group("");  // for `stadion bench recording` alone
  addOperatorTo(command);
  addSupervisionTo(command);
  command.add_flag("--json", json, "the summary as one JSON object on stdout");
  command.footer("SIGINT (Ctrl-C) and SIGTERM end the run after the frames under way; all that was asked for "
                 "is written, and "
                 "the\nexit code is 130 or 143. The second one ends it at once. A further run into the same "
                 "--out DIR removes "
                 "the files of\nthe run before, and no others.");
}

void RunOptions::addLoadTo(CLI::App& command) {
  const auto asked = [this](const std::string&) { loadAsked = true; };
  command
      .add_option_function<std::string>(
          "--load-control", [this](const std::string& word) { loadControl = word == "on"; },
          "on: a live run gives up what its script says (onoverrun), and detail, while it takes too long; "
          "off: it only tells (docs/budgets.md)")
      ->check(CLI::IsMember({"on", "off"}))
      ->each(asked)
      ->default_str("on");
  const auto add = [&](const char* option, double& figure, const char* help, double from, double to) {
    command.add_option(option, figure, help)->check(numberFrom(from, to))->each(asked)->capture_default_str();
  };
  add("--stress-frac", stress.frac, "part of a frame that a wall's Cull and Draw may take", 0.01, 10);
  add("--stress-low", stress.low, "load below which stress goes down", 0, 10);
  add("--stress-high", stress.high, "load above which stress goes up", 0, 10);
  add("--stress-scale", stress.scale, "how fast it does", 0, 10);
  add("--stress-max", stress.max, "how many times farther away things count at most; 1: never", 1, 16);
}

void RunOptions::addClusterTo(CLI::App& command) {
  CLI::Option* file = command.add_option(
      "--cluster", cluster,
      "play the show on several machines together: a file that names them and their walls (docs/cluster.md)");
  CLI::Option* name = command.add_option("--node", node, "which of the cluster's nodes this machine is");
  file->check(aName, "FILE")->needs(name)->excludes(command.get_option("--walls"));
  name->check(aName, "NAME")->needs(file);
  command.add_option("--plant-difference", plantDifference)->needs(file)->group("");  // for tests
}

/// What all machines do together each of them cannot decide alone.
void RunOptions::settleCluster(Diagnostics& findings) {
  if (cluster.empty()) return;
  const auto refuse = [&](bool asked, const char* options, const char* why) {
    if (asked) findings.error({}, std::string(options) + " not for clusters: " + why);
  };
  refuse(lateLatch, "--late-latch is", "all walls of a frame are drawn from the same head");
  refuse(!spans.file.empty() || countWork, "--spans and --count-work are", "they measure on one machine");
}

void RunOptions::addHeadTo(CLI::App& command) {
  CLI::Option* latch =
      command.add_flag("--late-latch", lateLatch,
                       "draw each frame from where the live tracker says the head is just then, not from "
                       "where it was when the frame began");
  command
      .add_option_function<std::vector<double>>(
          "--latch-reach",
          [this](const std::vector<double>& v) {
            latchReach = {v[0], v[1]};
          },
          "how far the head may go meanwhile [m] and turn [rad]: Cull looks for what is seen from there, and "
          "a head that goes farther is drawn from this edge, and counted")
      ->expected(2)
      ->type_name("M RAD")
      ->check(numberFrom(0, 3))
      ->needs(latch)
      ->default_str("0.05 0.25");
  command
      .add_option(
          "--predict", predict,
          "carry the live tracker's head on to when its picture is seen: so many milliseconds, at "
          "most 100, or auto: as frames take to their swap. Records have the head as it was carried on")
      ->type_name("MS|auto|off")
      ->capture_default_str();
}

void RunOptions::addBlackBoxTo(CLI::App& command) {
  command
      .add_option(
          "--black-box", blackBox,
          "where a run keeps its last 600 frames while it plays (default: a file in "
          "~/.local/state/stadion/last-frames, of which the newest 16 stay); it stays if one was late, the "
          "run "
          "failed or the program died, however it died: stadion profile --black-box tells of the newest")
      ->check(aName, "FILE");
}

void RunOptions::addSupervisionTo(CLI::App& command) {
  command.add_flag("--supervise", supervise,
                   "another process plays the show, and is replaced when it dies or "
                   "hangs: the next one goes on at the show "
                   "time that would be now (docs/all-day.md)");
  command.add_option("--hang-after", hangAfter, "it hangs when it shows no frame for so many seconds")
      ->check(numberFrom(0.5, 3600))
      ->capture_default_str();
  command.add_option("--supervised", supervised)->group("");  // by --supervise alone
  command.add_option("--ends-with", endsWith)->group("");     // by that and by `stadion cluster`
  command
      .add_option(
          "--journal", journal,
          "add a line to this file for all that happens to the run: how it began, files that came and "
          "went, late frames, trackers, walls and players that died, how it ended")
      ->check(aName, "FILE");
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

void RunOptions::addOperatorTo(CLI::App& command) {
  command
      .add_option(
          "--latency", latency,
          "frames under way at most between pose and picture, 1 to 4: fewer show what is younger, more let "
          "the stages overlap (default: as many as the stages hold); the operator may change it")
      ->check(wholeNumberFrom(1, 4));
  command
      .add_option("--cull-draw", cullDraw,
                  "overlap: a wall's Draw begins with the first part of a frame's list while Cull fills the "
                  "rest, so that fewer milliseconds lie between pose and picture; apart: it waits for all of "
                  "it. The pictures are the same")
      ->check(CLI::IsMember({"overlap", "apart"}))
      ->each([this](const std::string&) { cullDrawGiven = true; })
      ->capture_default_str();
  command
      .add_option("--osc", oscPort, "listen for the operator's commands on this UDP port (docs/operator.md)")
      ->check(wholeNumberFrom(0, 65535));
  command.add_flag("--wait", wait, "stand at the first frame until the operator says start");
  command.add_flag("--no-sound", noSound, "the show's sounds are not played");
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
