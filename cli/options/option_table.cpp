#include "cli/options/option_table.h"

#include <algorithm>
#include <vector>

namespace stadion {
// With a name: what it brings in is not for the files that are compiled with this one.
namespace option_rows {

using enum OptionGroup;
using enum OptionValueKind;

constexpr double kMostCount = 1e12;

constexpr ValueGrammar flag() {
  return {};
}
constexpr ValueGrammar text(std::string_view shape, ValueTimes times = ValueTimes::Once) {
  return {.kind = Text, .shape = shape, .times = times};
}
constexpr ValueGrammar file(std::string_view shape = "FILE", ValueTimes times = ValueTimes::Once) {
  return {.kind = File, .shape = shape, .times = times};
}
constexpr ValueGrammar folder(ValueTimes times = ValueTimes::Once) {
  return {.kind = Folder, .shape = "DIR", .times = times};
}
constexpr ValueGrammar word(std::string_view words, ValueTimes times = ValueTimes::Once) {
  return {.kind = Word, .words = words, .times = times};
}
constexpr ValueGrammar whole(std::string_view shape, double least, double most, std::string_view words = {}) {
  return {.kind = Whole, .shape = shape, .least = least, .most = most, .words = words};
}
constexpr ValueGrammar number(std::string_view shape, double least, double most,
                              std::string_view words = {}) {
  return {.kind = Number, .shape = shape, .least = least, .most = most, .words = words};
}
constexpr ValueGrammar numbers(std::string_view shape, unsigned count, double least, double most) {
  return {.kind = Number, .shape = shape, .least = least, .most = most, .count = count};
}
constexpr ValueGrammar values(std::string_view shape, unsigned count) {
  return {.kind = Text, .shape = shape, .count = count};
}
constexpr ValueGrammar size() {
  return {.kind = Size, .shape = "WIDTHxHEIGHT", .least = 1, .most = 16384};
}

constexpr OptionRow kRows[] = {
    {"SHOW", file("SHOW", ValueTimes::Several), "script to play (.evs)", Inputs},
    {"WALLS", file("WALLS"), "cave4, cave6, powerwall, desktop, a hall such as dome-5, or a wall file",
     Inputs},
    {"ORDER", word("status|on|off|open|shut"), "what the projectors are to do", Inputs},
    {"PROJECTOR", text("NAME", ValueTimes::Several), "only projectors with these names", Inputs},
    {"CLUSTER", file("CLUSTER"), "cluster file: the hosts and their walls", Inputs},
    {"SUITE", file("SUITE"), "suite file: the shows to play and what to compare", Inputs},
    {"OBJECT", text("OBJECT"), "a model file, or SCRIPT.evs:NAME for a dynobject", Inputs},
    {"TYPE", text("TYPE"), "prints only this node type", Inputs},
    {"CASE", text("CASE", ValueTimes::Several),
     "plays only cases whose names contain this, such as C05 or bounce", Inputs},
    {"LOG", file("LOG", ValueTimes::Several), "input log with the path of a head", Inputs},
    {"TRACE", file("TRACE", ValueTimes::Several), "trace of a host (trace-HOST.json)", Inputs},

    {"--walls", file("WALLS"), "cave4, cave6, powerwall, desktop, a hall such as dome-5, or a wall file",
     Show},
    {"--mode", word("pipelined|sequential|all"),
     "pipelined: App, Cull and Draw overlap; sequential: one after the other, with the same pictures; all: "
     "both",
     Show},
    {"--rate", number("HZ", 1, 1000), "frames per second of show time", Show},
    {"--input", file(),
     "input log that replaces the visitor, or none (default: the log beside the script; view: none)", Show},
    {"--asset-root", folder(ValueTimes::Repeated), "further folder to look for assets in", Show},
    {"--plugin", file("FILE", ValueTimes::Repeated), "shared library with further node types", Show},
    {"--app-threads", whole("N", 1, 64),
     "threads that simulate dynamics nodes side by side; results do not depend on it (default: one for each "
     "processor, at most 8)",
     Show},
    {"--no-sound", flag(), "plays no sounds", Show},

    {"--frames", whole("N", 1, kMostCount), "plays this many frames; a measurement plays as many in each run",
     Length},
    {"--seconds", number("S", 1e-3, 1e9), "ends after this many seconds, of show time if a show is played",
     Length},
    {"--pace", word("free|lock|float"),
     "free: as fast as possible; lock: on the ticks of --rate; float: a late frame begins at once (default: "
     "lock with --display, else free with --frames, --seconds or --out, else lock)",
     Length},
    {"--wait", flag(), "stays at the first frame until the operator says start", Length},

    {"--size", size(), "pixels of one eye's picture (default: what the wall file says, else 800x600)",
     Drawing},
    {"--stereo", word("pair|side-by-side|top-bottom|anaglyph|interlaced|off"),
     "pair: a picture or a buffer for each eye; side-by-side, top-bottom, interlaced (rows): one picture for "
     "a 3D "
     "display; anaglyph: for red-cyan glasses; off: one eye",
     Drawing},
    {"--look", word("full|plain"),
     "full; or plain: light at the corners of triangles, one sample a pixel, no shadows, several times as "
     "fast in "
     "software",
     Drawing},
    {"--samples", word("1|2|4|8"),
     "of a pixel, in the full look: more make edges calmer and cost more; OpenGL may have fewer (default: 4)",
     Drawing},
    {"--renderer", word("auto|cpu|gl"),
     "what draws: cpu: the processors without OpenGL; gl: OpenGL; auto: gl with a graphics card or with --gl "
     "osmesa|egl, else cpu",
     Drawing},
    {"--gl", word("auto|osmesa|egl|none"),
     "implementation of OpenGL; osmesa: in software; egl: the same pixels; none: nothing is drawn; auto: egl "
     "with a "
     "graphics card, else osmesa",
     Drawing},
    {"--gl-submission", word("auto|direct|mapped|indirect|both"),
     "how OpenGL gets its work; pictures do not depend on it. mapped: data through memory that stays mapped; "
     "indirect: many draws in one call; direct: neither; auto: both with a graphics card, else direct",
     Drawing},
    {"--draw-threads", whole("N", 1, 1024),
     "threads of --renderer cpu; pictures do not depend on it (default: one for each processor)", Drawing},
    {"--display", flag(),
     "plays live on the outputs that the wall file names, in a window for each wall without one; Escape ends "
     "it. "
     "Without --stereo both eyes see the same",
     Drawing},
    {"--windows", word("one|walls"),
     "one: a window with the room unfolded, front wall in the middle; walls: a window for each wall",
     Drawing},
    {"--window", size(), "size of the window at the start", Drawing},
    {"--hud", flag(), "shows the frame budget from the start (F2)", Drawing},
    {"--swap-sync", word("auto|off|barrier"),
     "auto: windows of --display swap together if the display driver has swap groups; off: one after the "
     "other; "
     "barrier: hosts swap together as well, or the run does not begin",
     Drawing},
    {"--pattern", flag(),
     "shows a test pattern on the outputs that the wall file names, until Escape or Ctrl-C; with --out it "
     "writes the "
     "pattern to WALL-EYE.png instead",
     Drawing},
    {"--simulate", flag(),
     "simulates what a visitor sees in the hall, and compares it with the ideal picture; with --out it "
     "writes "
     "pictures",
     Drawing},
    {"--heads", whole("N", 1, 1000), "with --simulate: positions of the head within the visitor's reach",
     Drawing},
    {"--every", whole("N", 1, 64), "with --simulate: looks at every Nth pixel, across and down", Drawing},
    {"--moved", values("NAME X Y Z", 4),
     "with --simulate: the projector is so far from where the file says, in the unit of the file", Drawing},
    {"--wrong-gamma", values("NAME G", 2),
     "with --simulate: the display gamma of the projector is not the file's", Drawing},
    {"--adjust", flag(),
     "shows a test pattern on the outputs, and keys move corner pins and edges of ramps; S writes them back "
     "into the "
     "wall file",
     Drawing},
    {"--commands", flag(), "with --adjust: opens no windows; the commands are lines of the standard input",
     Drawing},
    {"--pattern-kind", word("room|pixels|blend|gamma|bars"),
     "room: metres, names and a cube, or on curved screens azimuths and elevations; pixels: numbered lines "
     "of "
     "each output; blend: white, with the ramps between projectors; gamma: greys beside rows of black and "
     "white; bars: full colours and greys",
     Drawing},
    {"--wall-workers", word("thread|process|auto"),
     "what draws the walls: a thread each in this program; a process each (uses more processors for software "
     "drawing, "
     "and a driver that crashes takes one wall only); auto: with OpenGL what stadion calibrate found to be "
     "faster, "
     "else threads",
     Drawing},
    {"--pin", word("on|off|auto"),
     "on: each wall is drawn on processors of its own; off: the system chooses; auto: with OpenGL what "
     "stadion "
     "calibrate found to be faster, else off",
     Drawing},
    {"--cull-draw", word("overlap|apart"),
     "overlap: Draw begins with the first part of a frame's list while Cull fills the rest; apart: Draw "
     "waits for the "
     "whole list. The pictures are the same",
     Drawing},
    {"--latency", whole("N", 1, 4),
     "frames in flight at most: fewer show younger poses, more let the stages overlap (default: as many as "
     "the stages "
     "hold)",
     Drawing},

    {"--out", folder(), "folder for everything that the command writes", Output},
    {"--write", file(),
     "writes the hall as a wall file (.walls, with its files beside it) or as MPCDI (.mpcdi)", Output},
    {"--json", flag(),
     "prints JSON on standard output, all else on standard error: one object; a bench, hash and tracker "
     "print one a line",
     Output},
    {"--csv", flag(), "prints the table as CSV, not with --json: a row for each node, stage, wall and eye",
     Output},
    {"--pictures", whole("N", 1, 1e9, "last|all|none"),
     "frames whose pictures are written to --out; N: every Nth", Output},
    {"--sheets", flag(), "adds a contact sheet of all walls to each frame's pictures", Output},
    {"--hashes", flag(),
     "writes each picture's hash and display time to --out: picture-hashes.txt, swap-times.txt. Without "
     "--out, "
     "also live: a line FRAME WALL EYE HASH on standard output, with --json on standard error",
     Output},
    {"--save-state", file(), "writes the state after the last frame to this file", Output},
    {"--compare-state", file(),
     "names the first node and field that differ from a state that --save-state wrote after the same frame; "
     "exit code 1 if one differs",
     Output},
    {"--video", flag(), "writes a video of all walls (needs ffmpeg)", Output},
    {"--track", text("NODE", ValueTimes::Repeated),
     "writes the path of a body or other node to track-NODE.csv in --out", Output},
    {"--record-input", file(), "writes the input of head, wand and joypad to this log, for --input", Output},
    {"--black-box", file(),
     "file with the last 600 frames of a run: run and view write it, profile reads it (default: the newest "
     "in "
     "~/.local/state/stadion/last-frames or $XDG_STATE_HOME). It stays if a frame was late, the run failed "
     "or the "
     "program died",
     Output},
    {"--journal", file(),
     "appends a line to this file for each event of the run: start, faults, late frames, end", Output},
    {"--record", file(), "file that keeps the results: a further run with the same file goes on from them",
     Output},

    {"--trace", file(), "event trace: every span of every thread, for a trace viewer (ui.perfetto.dev)",
     Measurement},
    {"--trace-frames",
     {.kind = Frames, .shape = "A..B"},
     "records only these frames in --trace",
     Measurement},
    {"--trace-limit", number("MB", 0.1, 1e5), "records no further frame once --trace is this large",
     Measurement},
    {"--profile", flag(), "prints the most expensive nodes; stadion profile prints more", Measurement},
    {"--spans", file(), "writes the processor time of each stage and node in each frame to this file",
     Measurement},
    {"--guard", flag(),
     "ends the run with exit code 5 if a stage writes what it may only read; names stage, node and field",
     Measurement},
    {"--count-work", flag(), "adds counts of pixels, tests, contacts and so on to the summary", Measurement},
    {"--nodes", whole("N", 0, 1e6), "number of nodes in the table, the most expensive first", Measurement},
    {"--rounds", whole("N", 1, 1e5), "rounds of the measurement; the result is their median, or their rank",
     Measurement},
    {"--within", number("PERCENT", 1e-6, 1000), "largest deviation that passes", Measurement},
    {"--limit", whole("S", 1, 1e5), "seconds that one case may take", Measurement},
    {"--minutes", number("MIN", 0.1, 1e5), "begins no round that would end later", Measurement},

    {"--assets", file("PATH"), "imports this model, or every one below this folder, and counts the results",
     Measurement},
    {"--full", flag(),
     "adds the acceptance counts: 10 000 damaged files of each kind, 1000 reloads, 300 frames of every "
     "comparison, the tests that measure time, and those that run Blender and three.js",
     Measurement},
    {"--only", text("REGEX"), "runs only tests whose names match", Measurement},
    {"--summarize", file(), "runs nothing; prints the results in this file of ctest --output-junit",
     Measurement},
    {"--visit", whole("N", 100, 1e9), "restarts a show after this many frames", Measurement},
    {"--no-memory", flag(), "does not judge memory, handles and threads, which a short soak cannot",
     Measurement},
    {"--forget", flag(), "measures nothing; removes the stored calibration", Measurement},
    {"--patience", number("S", 0.1, 600), "waits so long for each answer of a projector (default: 5 s)",
     Measurement},
    {"--for", text("WHAT", ValueTimes::Repeated),
     "a show, wall file, cluster file or topic that must work on this machine", Measurement},
    {"--from", file(), "plans with the costs in this file, which --json wrote, instead of measuring",
     Measurement},
    {"--wall-count", whole("N", 1, 256), "number of walls: those of cave6, repeated beyond six", Measurement},
    {"--cores", number("N", 1, 1024), "cores of the planned machine (default: of this one)", Measurement},
    {"--machines", whole("N", 1, 24), "equal machines that share the walls", Measurement},
    {"--processes", flag(), "a process with its own rasteriser for each wall", Measurement},
    {"--stadion", file("PROGRAM"), "program to test (default: this one)", Measurement},
    {"--against", file("PROGRAM"), "compares with this program of another build", Measurement},
    {"--baseline", file(),
     "baseline to compare with, or to write (default: SUITE.baseline.json beside the suite)", Measurement},
    {"--update", flag(), "writes the baseline; what --case and --compare leave out stays as it was",
     Measurement},
    {"--case", text("NAME", ValueTimes::Several), "plays only these cases", Measurement},
    {"--compare", word("state|images|counts|instructions|times", ValueTimes::List),
     "compares only this, of what the suite compares", Measurement},
    {"--instructions", flag(),
     "counts instructions under callgrind if the processor's counter cannot be read; half a minute a case",
     Measurement},
    {"--resume", flag(), "continues an interrupted run into the same --out", Measurement},

    {"--load-control", word("on|off"),
     "on: a live run that is too slow degrades as its script says (onoverrun) and reduces detail; off: it "
     "only reports",
     Load},
    {"--stress-frac", number("PART", 0.01, 10), "part of a frame that Cull and Draw of a wall may take",
     Load},
    {"--stress-low", number("LOAD", 0, 10), "load below which stress falls", Load},
    {"--stress-high", number("LOAD", 0, 10), "load above which stress rises", Load},
    {"--stress-scale", number("SPEED", 0, 10), "speed of that change", Load},
    {"--stress-max", number("FACTOR", 1, 16), "largest factor on distances for the choice of detail; 1: none",
     Load},

    {"--osc", whole("PORT", 0, 65535), "UDP port for the operator's commands", Operator},
    {"--web", text("[HOST:]PORT"),
     "web page for the operator, with thumbnails, commands and figures; without HOST on this machine alone",
     Operator},
    {"--web-token", file(),
     "file whose first line every request to the page must know (default: one is made and printed)",
     Operator},
    {"--web-name", text("NAME", ValueTimes::Repeated), "further host name of the page, as a proxy has it",
     Operator},

    {"--tracker", text("DEVICE"),
     "live trackers: osc:PORT (Open Sound Control over UDP), dtrack:PORT, freed:PORT or vrpn:DEVICE@HOST",
     Trackers},
    {"--rig", file(), "rig file: names of the trackers and the room in their coordinates", Trackers},
    {"--late-latch", flag(),
     "draws each frame from the head's newest pose instead of that at the frame's start", Trackers},
    {"--latch-reach", numbers("M RAD", 2, 0, 3),
     "movement and turn of the head for which Cull prepares; a head that goes farther is drawn from this "
     "edge and "
     "counted",
     Trackers},
    {"--predict", number("MS", 0, 100, "auto|off"),
     "predicts the head's pose for so many milliseconds; auto: until the measured swap. Records contain the "
     "predicted "
     "pose",
     Trackers},
    {"--calibrate", flag(), "measures a few poses and writes --rig", Trackers},
    {"--floor-tracker", text("NAME"), "tracker that lies on the floor", Trackers},
    {"--head-tracker", text("NAME"), "tracker on the glasses", Trackers},
    {"--eye-height", number("M", 0.5, 2.5),
     "height of the wearer's eyes; also measures the eyes from the sensor", Trackers},

    {"--cluster", file(), "plays the show on several hosts: the file names them and their walls", Cluster},
    {"--node", text("NAME"), "name of this host in --cluster", Cluster},
    {"--once", flag(), "does not restart a host that crashed", Cluster},

    {"--supervise", flag(), "plays in another process and replaces it if it crashes or hangs", Supervision},
    {"--hang-after", number("S", 0.5, 3600), "seconds without a frame after which a process hangs",
     Supervision},

    {"--fidelity", flag(), "compares the models of each body: error against the finest, and cost", Bodies},
    {"--tolerance", number("MM", 1e-6, 1e6), "largest error of a body's place", Bodies},
    {"--body", text("NAME", ValueTimes::Repeated), "plays only this body with other models", Bodies},
    {"--finest", word("mesh|convex|cylinder|box|capsule|sphere"), "the true shape of bodies (default: mesh)",
     Bodies},
    {"--most", whole("N", 0, 1e6), "number of bodies to compare, the most expensive first", Bodies},
    {"--reference", file("CSV", ValueTimes::Several), "recorded flights (docs/flight.md)", Bodies},
    {"--attitude", number("DEGREES", 1e-6, 180), "largest mean error of the axis (default: any)", Bodies},
    {"--mass", number("KG", 1e-9, 1e9), "mass (default: the script's, else that of 1000 kg/m3)", Bodies},
    {"--inertia", numbers("ALONG ACROSS", 2, 1e-15, 1e15),
     "moments of inertia along the axis and across it [kg m2] (default: the model's)", Bodies},
    {"--centre", numbers("X Y Z", 3, -1e6, 1e6), "centre of mass in the model [m] (default: the model's)",
     Bodies},
    {"--wind", numbers("X Y Z", 3, -1e3, 1e3), "wind of the flights [m/s]", Bodies},
    {"--gravity", number("M/S2", 0, 1e3), "gravity of the flights", Bodies},
    {"--density", number("KG/M3", 0, 1e4), "density of the air", Bodies},

    {"--all", flag(), "plays other engines at 1, 2, 4, 8 and 16 steps a frame, not only 1 and 4", Benches},
    {"--flights", whole("N", 1, 10000), "random flights of each object", Benches},
    {"--trials", whole("N", 0, 1000), "planted slowdowns of each kind", Benches},
    {"--same", whole("N", 0, 10000), "comparisons of the program with itself", Benches},
    {"--share", number("PERCENT", 0.01, 1000), "how much a planted slowdown lengthens its stage", Benches},
    {"--by", word("instructions|times"),
     "what decides: instructions (callgrind), or times of rounds in turns", Benches},
    {"--counts",
     {.kind = Whole, .shape = "N", .least = 1, .most = 64, .times = ValueTimes::List},
     "numbers of walls of the room to play on (default: 1, 2, 4 and 6 of cave6, all of another room)",
     Benches},
    {"--stall", whole("MS", 1, 1000), "delay of the node in each frame", Benches},
    {"--stall-time", number("S", 0.1, 600), "how long the node stalls", Benches},
    {"--recovery", number("S", 1, 600), "time in which the show must recover", Benches},
    {"--quiet", number("S", 1, 600), "time in which it must stay quiet after that", Benches},
    {"--tracker-rate", number("HZ", 20, 1000), "measurements a second", Benches},
    {"--noise", number("MM", 0, 100), "noise of a measurement in each axis; in degrees a tenth of it",
     Benches},
    {"--no-instructions", flag(), "measures times alone, without callgrind", Benches},
    {"--still", whole("N", 1, 1e7), "nodes that do not move", Benches},
    {"--moving", whole("N", 0, 4e6), "nodes that move", Benches},
    {"--cold", flag(), "empties the processor's caches before each frame, as drawing does", Benches},
    {"--scenes",
     word("a|b|c|kick|olympia-1|olympia-2|olympia-3|olympia-4|olympia-5|olympia-6|filled|crowd",
          ValueTimes::List),
     "scenes of the table; bench walls has a, b and c", Benches},
    {"--rungs", word("8|4|2|1|4-coarse|4-nearest|plain|opengl", ValueTimes::List),
     "rungs of the ladder of pictures (default: all)", Benches},
    {"--no-perception", flag(), "leaves out the distances butteraugli and ssimulacra", Benches},
    {"--scaling", flag(), "measures curves instead: 1000 to 1 000 000 nodes, 1 to 6 walls", Benches},
    {"--one", flag(), "measures one setting in this process and prints it as JSON", Benches},
    {"--scene", word("a|b|c"), "with --one: scene", Benches},
    {"--class", word("STRICT|OPEN|SUBMIT"), "with --one: freedom of the renderer", Benches},
    {"--without", word("unseen|small"),
     "with --one: no trick that leaves out unseen parts, or draws small objects without OpenGL", Benches},
    {"--layout", word("flat|grid"), "with --one: one group for all nodes, or a grid of groups", Benches},
    {"--width", whole("PIXELS", 8, 16384), "with --one: width of a picture", Benches},
    {"--height", whole("PIXELS", 8, 16384), "with --one: height of a picture", Benches},
    {"--warm", whole("N", 1, 100), "with --one: frames before the measured ones", Benches},
    {"--scene-nodes", whole("N", 1, 4e6), "with --one: number of nodes (default: the scene's own)", Benches},
    {"--far", number("M", 1, 1000), "with --one: distance of the far plane (default: the scene's own)",
     Benches},
    {"--control", flag(), "with --one: only waits for ticks, to see how even this machine is", Benches},

    {"--plant", text("DELAY"), "delays a node on purpose (regress)", Internal},
    {"--turns", flag(), "plays frames in turns with another run (regress)", Internal},
    {"--count-instructions", flag(), "marks frames for callgrind (regress)", Internal},
    {"--count-by-hardware", flag(), "counts instructions by the processor's counter (regress)", Internal},
    {"--plant-difference", whole("FRAME", 0, kMostCount), "changes a bit of the scene after this frame",
     Internal},
    {"--supervised", whole("DESCRIPTOR", 0, 1e9), "where a supervised player reports its progress", Internal},
    {"--ends-with", whole("PROCESS", 0, 1e9), "ends together with this process", Internal},
    {"--unrecorded", flag(), "records no costs of frames (bench recording)", Internal},
    {"--measured-setting", text("SETTING"), "measures this one setting (calibrate)", Internal},
    {"--measured-folder", folder(), "folder of the measured show (calibrate)", Internal},
    {"--measured-time", number("S", 1e-3, 3600), "length of the measurement (calibrate)", Internal},
};

std::vector<std::string_view> partsOf(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + separator.size()))
    parts.push_back(text.substr(0, end));
  parts.push_back(text);
  return parts;
}

/// The explanation of the accepted words alone: of "pair, off: so" with "off" it is "off: so". Empty if all
/// its words are refused. A part of the text that explains no words stays.
std::string explanationOf(std::string_view part, std::string_view words, std::string_view accepted) {
  const std::size_t colon = part.find(": ");
  if (colon == part.npos) return std::string(part);
  std::string kept;
  for (const std::string_view named : partsOf(part.substr(0, colon), ", ")) {
    const std::string_view word = named.substr(0, named.find(' '));
    if (!hasWord(words, word)) return std::string(part);
    if (hasWord(accepted, word)) kept += (kept.empty() ? "" : ", ") + std::string(named);
  }
  return kept.empty() ? kept : kept + std::string(part.substr(colon));
}

}  // namespace option_rows

std::string OptionRow::fullText() const {
  const bool repeats =
      value.times == ValueTimes::Repeated || (value.times == ValueTimes::Several && !isPositional());
  return std::string(text) + (repeats ? "; may be repeated" : "");
}

std::string OptionRow::textFor(std::string_view accepted) const {
  const std::string all = fullText();
  if (accepted.empty() || accepted == value.words) return all;
  std::string shown;
  for (const std::string_view part : option_rows::partsOf(all, "; ")) {
    const std::string kept = option_rows::explanationOf(part, value.words, accepted);
    if (!kept.empty()) shown += (shown.empty() ? "" : "; ") + kept;
  }
  return shown;
}

std::span<const OptionRow> optionTable() {
  return option_rows::kRows;
}

const OptionRow* findOption(std::string_view name) {
  const std::span<const OptionRow> rows = optionTable();
  const auto row = std::ranges::find(rows, name, &OptionRow::name);
  return row == rows.end() ? nullptr : &*row;
}

std::optional<std::string> flagWithValueIn(std::span<const std::string> words) {
  for (const std::string& word : words) {
    if (word == "--") break;
    const std::string name = word.substr(0, word.find('='));
    const OptionRow* row = name.size() < word.size() ? findOption(name) : nullptr;
    if (row && !row->isPositional() && row->value.kind == OptionValueKind::Flag)
      return name + " takes no value; \"" + word.substr(name.size() + 1) + "\" was given";
  }
  return std::nullopt;
}

std::string_view headingOf(OptionGroup group) {
  using enum OptionGroup;
  switch (group) {
  case Inputs: return "Arguments";
  case Show: return "What is played";
  case Length: return "Length and pace";
  case Drawing: return "Drawing";
  case Output: return "Output";
  case Measurement: return "Measurements";
  case Load: return "Load";
  case Operator: return "Operator";
  case Trackers: return "Trackers";
  case Cluster: return "Cluster";
  case Supervision: return "Supervision";
  case Bodies: return "Bodies";
  case Benches: return "Benches";
  case Internal: return "";
  }
  return "";
}

}  // namespace stadion
