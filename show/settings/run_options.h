#pragma once
/// What `stadion run` can be asked for.

#include "profiling/budget/stress_filter.h"
#include "show/output/output_names.h"
#include "show/output/run_output.h"
#include "show/player/drawing_plan.h"
#include "show/player/player.h"
#include "show/settings/span_options.h"
#include "show/settings/trace_options.h"
#include "show/settings/tracker_device.h"

#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct RunOptions {
  ShowOptions show;
  std::string stereo = "pair", pace, recordInput, out, pictures = "last", provider = "osmesa";
  std::vector<std::string> trace;
  TraceRequest events;
  TrackerOptions trackers;
  int oscPort = -1;      ///< where commands of the operator are listened for; -1: nowhere
  std::string blackBox;  ///< where a live run keeps its last frames; empty: a temporary file
  SpanOptions spans;
  bool countWork = false;
  bool unrecorded = false;            ///< for `stadion bench recording` alone
  std::string cluster, node;          ///< a cluster file, and which of its nodes this is
  bool follows = false;               ///< another node of it leads
  std::uint64_t plantDifference = 0;  ///< for tests: a bit of the scene is changed after that frame
  StressOptions stress;               ///< of the whole show
  bool loadAsked = false;             ///< any option of --load-control and stress was given
  bool loadControl = true;            ///< a live run gives up what its script says, when it takes too long
  std::string cullDraw = "overlap";   ///< or "apart": Draw waits until its list is complete
  bool cullDrawGiven = false;         ///< else `cullDraw` is the standard
  std::size_t latency = 0;            ///< frames under way at most; 0: as many as there is room for
  bool lateLatch = false;             ///< Draw takes the newest head
  HeadReach latchReach{0.05, 0.25};   ///< as far as it lies within
  std::string predict = "off";        ///< how far ahead the head is told: off, auto, or milliseconds
  std::string wallWorkers = "auto";   ///< who draws the walls: thread, process or auto
  std::string pin = "auto";           ///< each wall on processors of its own: on, off or auto
  /// How many threads the environment gives the rasteriser, if it says so; no option.
  std::optional<unsigned> rasteriserThreads{};
  bool supervise = false;  ///< another process plays, and is replaced when it dies
  double hangAfter = 10;   ///< or shows nothing for so long [s]
  int supervised = -1;     ///< this is that process: a descriptor (SharedProgress); no option for users
  int endsWith = -1;       ///< the process that started this one, and takes it along; no option for users
  std::string journal;     ///< to which what happens is written; empty: nowhere
  /// Is given what there is to tell while the show plays, a line at a time, from any thread. No option.
  std::function<void(const std::string&)> say = [](const std::string& line) {
    std::fprintf(stderr, "%s\n", line.c_str());
  };
  bool wait = false;
  bool noSound = false;
  bool display = false;      ///< on the walls' outputs
  bool stereoGiven = false;  ///< else `stereo` is the standard
  bool live = false;         ///< by the clock, whatever else is asked for; no option
  bool sheets = false, video = false, hashes = false, profile = false, json = false;

  StereoLayout layout = StereoLayout::Pair;  ///< from `stereo`
  PictureChoice pictureChoice;               ///< from `pictures`
  std::optional<Nanoseconds> ahead;          ///< from `predict`, as HeadTiming has it

  /// Completes what depends on other options. Says what is wrong.
  bool settle(Diagnostics& findings);
  /// The files that options name one by one, asked for or not.
  std::vector<NamedFile> namedFiles() const;

  void settleFiles(Diagnostics& findings) const;
  void settleCluster(Diagnostics& findings);
  void settleLive(Diagnostics& findings);
  void settleHead(Diagnostics& findings);
  void settleSupervision(Diagnostics& findings) const;
  /// Whether pictures are asked for, as files, as a video or as hashes. After settle().
  bool keepsPictures() const;
  /// Whether the options ask for a run that does not go by the clock.
  bool asksForEveryFrame() const;
  /// Every frame counts where somebody looks at the result later, and where a log says when each one was;
  /// else the newest one does.
  bool everyFrameCounts(const Player& player) const;
  /// Whether the show is the same at every run: every frame counts, or nobody but a log decides what happens.
  bool repeats(const Player& player) const;
  FrameLoopOptions loopOptions(const Player& player) const;
  /// What decides who draws so many walls. After settle().
  DrawingNeeds drawingNeeds(std::size_t walls) const;
  /// What is done for the head's pose to be young. The walls are culled for it.
  HeadTiming headFor(std::vector<WallView>& walls) const;
  /// The processes that draw the walls; nothing if this one does.
  std::optional<WallWorkers> workers(const Player& player, const DrawSetting& setting) const;
};

}  // namespace stadion
