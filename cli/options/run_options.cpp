#include "cli/options/run_options.h"

#include "cli/options/number_option.h"
#include "cli/options/show_options.h"

#include <CLI/CLI.hpp>

namespace stadion {
namespace {

/// Refuses the empty word of a shell variable that is not set.
std::string aName(const std::string& word) {
  return word.empty() ? "a name is expected, not an empty word" : "";
}

}  // namespace

void addTraceOptions(CLI::App& command, TraceRequest& o, const std::string& option) {
  command.add_option(option, o.file,
                     "write every span of every thread to FILE, for a trace viewer (ui.perfetto.dev)");
  command.add_option("--trace-frames", o.frames, "only these frames of it: A..B");
  command
      .add_option("--trace-limit", o.megabytes, "begin no further frame once the trace is that large [MB]")
      ->check(numberFrom(0.1, 100000))
      ->capture_default_str();
}

void addSpanOptions(CLI::App& command, SpanOptions& o) {
  command.add_option("--spans", o.file,
                     "write what each stage and node cost in each frame to this file (processor time of the "
                     "thread, docs/formats.md)");
  // For `stadion regress` alone.
  command.add_option("--plant", o.planted)->group("");
  command.add_flag("--turns", o.turns)->group("");
  command.add_flag("--count-instructions", o.instructions)->group("");
  command.add_flag("--count-by-hardware", o.hardware)->group("");
}

void addTrackerOptions(CLI::App& command, TrackerOptions& o) {
  command.add_option("--tracker", o.device,
                     "live trackers: osc:PORT (Open Sound Control over UDP) or vrpn:DEVICE@HOST");
  command.add_option("--rig", o.rig, "rig file: where the room is in the trackers' coordinates, their names");
}

void addLoadOptions(CLI::App& command, RunOptions& run) {
  PlaySettings& o = run.settings.play;
  const auto asked = [&run](const std::string&) { run.loadAsked = true; };
  command
      .add_option_function<std::string>(
          "--load-control", [&o](const std::string& word) { o.loadControl = word == "on"; },
          "on: a live run gives up what its script says (onoverrun), and detail, while it takes too long; "
          "off: it only tells (docs/budgets.md)")
      ->check(CLI::IsMember({"on", "off"}))
      ->each(asked)
      ->default_str("on");
  const auto add = [&](const char* option, double& figure, const char* help, double from, double to) {
    command.add_option(option, figure, help)->check(numberFrom(from, to))->each(asked)->capture_default_str();
  };
  add("--stress-frac", o.stress.frac, "part of a frame that a wall's Cull and Draw may take", 0.01, 10);
  add("--stress-low", o.stress.low, "load below which stress goes down", 0, 10);
  add("--stress-high", o.stress.high, "load above which stress goes up", 0, 10);
  add("--stress-scale", o.stress.scale, "how fast it does", 0, 10);
  add("--stress-max", o.stress.max, "how many times farther away things count at most; 1: never", 1, 16);
}

void addClusterOptions(CLI::App& command, ClusterSettings& o) {
  CLI::Option* file = command.add_option(
      "--cluster", o.file,
      "play the show on several machines together: a file that names them and their walls (docs/cluster.md)");
  CLI::Option* name = command.add_option("--node", o.node, "which of the cluster's nodes this machine is");
  file->check(aName, "FILE")->needs(name)->excludes(command.get_option("--walls"));
  name->check(aName, "NAME")->needs(file);
  command.add_option("--plant-difference", o.plantDifference)->needs(file)->group("");  // for tests
}

void addHeadOptions(CLI::App& command, RunOptions& o) {
  CLI::Option* latch =
      command.add_flag("--late-latch", o.lateLatch,
                       "draw each frame from where the live tracker says the head is just then, not from "
                       "where it was when the frame began");
  command
      .add_option_function<std::vector<double>>(
          "--latch-reach",
          [&o](const std::vector<double>& v) {
            o.reach = {v[0], v[1]};
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
          "--predict", o.predict,
          "carry the live tracker's head on to when its picture is seen: so many milliseconds, at "
          "most 100, or auto: as frames take to their swap. Records have the head as it was carried on")
      ->type_name("MS|auto|off")
      ->capture_default_str();
}

void addBlackBoxOption(CLI::App& command, RecordSettings& o) {
  command
      .add_option(
          "--black-box", o.blackBox,
          "where a run keeps its last 600 frames while it plays (default: a file in "
          "~/.local/state/stadion/last-frames, of which the newest 16 stay); it stays if one was late, the "
          "run "
          "failed or the program died, however it died: stadion profile --black-box tells of the newest")
      ->check(aName, "FILE");
}

void addSupervisionOptions(CLI::App& command, RunOptions& o) {
  SupervisionSettings& supervision = o.settings.supervision;
  command.add_flag("--supervise", o.supervise,
                   "another process plays the show, and is replaced when it dies or "
                   "hangs: the next one goes on at the show "
                   "time that would be now (docs/all-day.md)");
  command
      .add_option("--hang-after", supervision.hangAfter,
                  "it hangs when it shows no frame for so many seconds")
      ->check(numberFrom(0.5, 3600))
      ->capture_default_str();
  command.add_option("--supervised", supervision.progress)->group("");  // by --supervise alone
  command.add_option("--ends-with", o.endsWith)->group("");             // by that and by `stadion cluster`
  command
      .add_option(
          "--journal", supervision.journal,
          "add a line to this file for all that happens to the run: how it began, files that came and "
          "went, late frames, trackers, walls and players that died, how it ended")
      ->check(aName, "FILE");
}

void addOperatorOptions(CLI::App& command, RunOptions& o) {
  command
      .add_option(
          "--latency", o.settings.play.latency,
          "frames under way at most between pose and picture, 1 to 4: fewer show what is younger, more let "
          "the stages overlap (default: as many as the stages hold); the operator may change it")
      ->check(wholeNumberFrom(1, 4));
  command
      .add_option("--cull-draw", o.cullDraw,
                  "overlap: a wall's Draw begins with the first part of a frame's list while Cull fills the "
                  "rest, so that fewer milliseconds lie between pose and picture; apart: it waits for all of "
                  "it. The pictures are the same")
      ->check(CLI::IsMember({"overlap", "apart"}))
      ->each([&o](const std::string&) { o.cullDrawGiven = true; })
      ->capture_default_str();
  command
      .add_option("--osc", o.settings.console.oscPort,
                  "listen for the operator's commands on this UDP port (docs/operator.md)")
      ->check(wholeNumberFrom(0, 65535));
  command.add_flag("--wait", o.settings.console.wait,
                   "stand at the first frame until the operator says start");
  command.add_flag("--no-sound", o.settings.console.noSound, "the show's sounds are not played");
}

void addRunOptions(CLI::App& command, RunOptions& o) {
  SessionSettings& settings = o.settings;
  RecordSettings& record = settings.record;
  addShowOptions(command, settings.show);
  std::vector<std::string> layouts = stereoLayoutNames();
  command.add_option("--stereo", o.stereo, "how the two eyes' pictures are written")
      ->check(CLI::IsMember(layouts))
      ->each([&o](const std::string&) { o.stereoGiven = true; })
      ->capture_default_str();
  command.add_flag(
      "--display", settings.play.display,
      "show the walls on the outputs that the wall file names (a window for each that has none), "
      "live; Escape ends it. --stereo pair is a buffer for each eye then (quad-buffered); without "
      "--stereo both eyes see the same");
  command
      .add_option(
          "--pace", o.pace,
          "free: as fast as possible; lock: on the ticks of --rate; float: a late frame begins at once "
          "(default: free with --frames or --out, else lock)")
      ->check(CLI::IsMember({"free", "lock", "float"}));
  command.add_option("--record-input", record.input, "write what the trackers said to this input log")
      ->check(aName, "FILE");
  command
      .add_option(
          "--out", record.out,
          "folder for pictures, contact-sheet.png and summary.json; only the frames of --pictures are drawn")
      ->check(aName, "DIR");
  command
      .add_option("--pictures", o.pictures,
                  "of which frames pictures are written: last, all, none, or N for every Nth")
      ->capture_default_str();
  command.add_flag("--sheets", record.sheets, "a contact sheet of all walls beside each frame's pictures");
  command.add_flag("--hashes", record.hashes,
                   "each picture's hash, and when it was shown: picture-hashes.txt, swap-times.txt");
  command.add_flag("--video", record.video, "a video of all walls (needs ffmpeg)");
  command.add_flag("--profile", record.profile, "say which nodes cost the most; stadion profile says more");
  addBlackBoxOption(command, record);
  command
      .add_option("--gl", o.provider, "who draws: osmesa or egl (the same pixels), none: App and Cull alone")
      ->check(CLI::IsMember({"osmesa", "egl", "none"}))
      ->capture_default_str();
  command
      .add_option(
          "--wall-workers", o.wallWorkers,
          "who draws the walls: a thread each in this program, a process each (several processors are "
          "used better when software draws, and a driver that crashes takes one wall only), or auto: what "
          "stadion calibrate found to be faster on this machine, without it threads")
      ->check(CLI::IsMember({"thread", "process", "auto"}))
      ->capture_default_str();
  command
      .add_option("--pin", o.pin,
                  "on: each wall is drawn on processors of its own, near to each other; off: wherever the "
                  "system likes; auto: as stadion calibrate found to be faster, without it off")
      ->check(CLI::IsMember({"on", "off", "auto"}))
      ->capture_default_str();
  command
      .add_option("--trace", record.nodes,
                  "write where this node is in every frame to trace-NODE.csv in --out DIR; may be repeated")
      ->allow_extra_args(false);
  addTraceOptions(command, o.trace, "--trace-events");
  addClusterOptions(command, settings.cluster);
  addLoadOptions(command, o);
  addTrackerOptions(command, settings.console.trackers);
  addHeadOptions(command, o);
  addSpanOptions(command, record.spans);
  command.add_flag(
      "--count-work", record.countWork,
      "count pixels, spheres tested and seen, contacts and so on of all frames, for the summary");
  command.add_flag("--unrecorded", record.unrecorded)->group("");  // for `stadion bench recording` alone
  addOperatorOptions(command, o);
  addSupervisionOptions(command, o);
  command.add_flag("--json", o.json, "the summary as one JSON object on stdout");
  command.footer("SIGINT (Ctrl-C) and SIGTERM end the run after the frames under way; all that was asked for "
                 "is written, and "
                 "the\nexit code is 130 or 143. The second one ends it at once. A further run into the same "
                 "--out DIR removes "
                 "the files of\nthe run before, and no others.");
}

}  // namespace stadion
