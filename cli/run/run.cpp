/// `stadion run SHOW`: plays a show.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/run_options.h"
#include "cli/run/run_journal.h"
#include "cli/run/run_report.h"
#include "cli/run/supervise.h"
#include "engine/base/installed_files.h"
#include "engine/base/run_stopped.h"
#include "pipeline/platform/topology.h"
#include "pipeline/record/progress.h"
#include "pipeline/target/rasteriser_settings.h"
#include "profiling/regression/spans/work_counts.h"
#include "show/base/script_watch.h"
#include "show/base/stop_signal.h"
#include "show/cluster/cluster_part.h"
#include "show/console/live_desk.h"
#include "show/display/display_run.h"
#include "show/output/output_folder.h"
#include "show/output/run_output.h"
#include "show/session/last_frames.h"
#include "show/session/live_load.h"
#include "show/session/run_watch.h"
#include "show/session/show_recording.h"
#include "show/session/span_recording.h"
#include "show/settings/run_options.h"
#include "show/supervision/supervised_part.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace stadion {
namespace {

/// How long after the stop signal frames may still be drawn.
constexpr std::chrono::seconds kDrawAfterStop{5};

/// What a run needs. Anything that is not there is the user's affair; the findings say why.
struct RunSetup {
  std::unique_ptr<RunJournal> journal;         ///< null without --journal
  std::unique_ptr<SupervisedPart> supervised;  ///< null if nobody watches over this process
  std::unique_ptr<OutputFolder> folder;        ///< null without --out
  std::unique_ptr<GlProvider> provider;
  std::optional<DrawingPlan> drawing;  ///< nothing with --gl none
  std::unique_ptr<LiveDesk> desk;
  std::unique_ptr<Player> player;
  std::unique_ptr<ClusterPart> cluster;  ///< null without --cluster; it goes before the player
  std::unique_ptr<RunWatch> watch;
  std::unique_ptr<RunOutput> output;         ///< null without --out
  std::unique_ptr<SpanRecording> spans;      ///< null without --spans
  std::unique_ptr<DisplayRun> displays;      ///< null without --display
  std::unique_ptr<ShowRecording> recording;  ///< null if somebody else measures
  regression::WorkCounts work;               ///< with --count-work
  bool recordsNothing = false;               ///< of the input, though it was asked to
};

/// Findings, on stderr and in the journal.
std::function<void(const Diagnostics&)> reportOf(const RunSetup& s) {
  return [journal = s.journal.get()](const Diagnostics& findings) {
    tell(findings);
    if (journal) journal->note(findings);
  };
}

/// Findings that are told only if what is tried succeeds; then those that follow are, too. Any thread.
class HeldReport {
public:
  using Report = std::function<void(const Diagnostics&)>;

  explicit HeldReport(Report report) : held_(std::make_shared<Held>()) { held_->report = std::move(report); }
  Report function() const {
    return [held = held_](const Diagnostics& findings) {
      const std::lock_guard lock(held->mutex);
      held->released ? held->report(findings) : held->findings.append(findings);
    };
  }
  void release() {
    const std::lock_guard lock(held_->mutex);
    held_->released = true;
    held_->report(held_->findings);
  }

private:
  struct Held {
    std::mutex mutex;
    Report report;
    Diagnostics findings;
    bool released = false;
  };
  std::shared_ptr<Held> held_;
};

/// Late frames, in words, one in ten seconds.
std::function<void(const std::string&)> tellSometimes(RunJournal* journal) {
  return [journal, next = std::chrono::steady_clock::time_point{}](const std::string& text) mutable {
    if (journal) journal->late(text);
    constexpr std::chrono::seconds kApart{10};
    const auto now = std::chrono::steady_clock::now();
    if (now < next) return;
    next = now + kApart;
    std::fprintf(stderr, "late: %s\n", text.c_str());
  };
}

template <class T>
bool keep(Result<std::unique_ptr<T>> made, std::unique_ptr<T>& place, Diagnostics& findings) {
  if (made)
    place = std::move(made.value());
  else
    findings.add(made.error());
  return place != nullptr;
}

/// Better known now than when the first picture is to be drawn.
bool canDraw(GlProvider& provider, const ShowParts& parts, Diagnostics& findings) {
  std::optional<Diagnostic> why;
  const WallView* before = nullptr;
  for (const WallView& wall : parts.walls) {
    if (!why && !(before && before->width == wall.width && before->height == wall.height))
      why = checkPictureSize(provider, wall.width, wall.height);
    before = &wall;
  }
  if (why) findings.error(why->where, "--size: " + why->message);
  return !why;
}

/// Before the first context: the rasteriser asks once how many threads it has.
void planDrawing(const RunOptions& o, RunSetup& s, Diagnostics& findings) {
  Diagnostics toldLater;
  const auto walls = loadWalls(o.show.walls, shareFolder() + "/walls", toldLater);
  if (!s.provider || !walls) return;
  s.drawing.emplace(o.drawingNeeds(walls->walls.size()), knownMachine(findings));
  setRasteriserThreads(s.drawing->rasteriserThreadsHere());
}

/// Whether processors make the provider's pictures.
bool software(GlProvider& provider) {
  const auto target = provider.create(1, 1);
  if (!target || target.value()->makeCurrent()) return true;
  const std::string who = describeGl(target.value()->gl());
  target.value()->release();
  return drawnBySoftware(who);
}

/// What is only known once the show is there.
void reconsiderDrawing(const RunOptions& o, RunSetup& s) {
  if (!s.drawing || !s.drawing->setting().processes || o.wallWorkers != "auto") return;
  if (o.provider == "egl" && !software(*s.provider)) s.drawing->drawHere("a graphics card draws");
  if (!o.everyFrameCounts(*s.player) && hasDrawnBudgets(s.player->scene()))
    s.drawing->drawHere("budgets of what is drawn are measured where it is drawn");
}

/// Who looks where frames go: always, so that late frames have a cause, and a program that dies leaves what
/// its last frames were spent on; but nobody beside who measures for a comparison.
bool beginRecording(const RunOptions& o, RunSetup& s, Diagnostics& findings) {
  s.recording.reset();
  const bool live = !o.everyFrameCounts(*s.player);
  RecordingOptions options;
  options.trace = o.events.settle(findings);
  if (findings.hasErrors()) return false;
  if (s.spans || o.countWork || o.unrecorded) return true;
  if (options.trace) options.trace->show = o.show.script, options.trace->walls = s.player->walls().names();
  options.profile = o.profile, options.log.whole = o.profile, options.log.shares = true;
  const bool governed = live || o.profile || options.trace;
  options.log.samples = o.profile || (governed && hasDrawnBudgets(s.player->scene()));
  if (governed) {
    options.govern = governorOf(o, *s.player, s.player->walls().names());
    options.govern->drawnElsewhere = s.drawing && s.drawing->setting().processes;
  }
  options.keep = lastFramesOf(o, *s.player, s.player->walls().names());
  options.keep->tell = tellSometimes(s.journal.get());
  s.recording = ShowRecording::create(std::move(options), findings);
  return s.recording != nullptr;
}

/// The show is there; who looks on while it is played comes with it.
bool beginGroup(const RunOptions& o, RunSetup& s, Diagnostics& findings) {
  RunOptions recorded = o;
  recorded.recordInput = s.desk->recordName();
  if (!recorded.recordInput.empty() && s.cluster && s.cluster->goesOn()) {
    o.say(
        "--record-input: nothing is recorded: a record that begins in the middle of a show cannot be played");
    recorded.recordInput.clear();
    s.recordsNothing = true;
  }
  s.watch = RunWatch::create(recorded, *s.player, findings);
  if (!s.watch) return false;
  // All machines of a cluster have a file in the same frame, for which they wait.
  if (!o.repeats(*s.player) && !s.cluster) s.player->playLive();
  if (!beginRecording(o, s, findings)) return false;
  s.desk->beginGroup(*s.player, *s.watch);
  return true;
}

ImportedMeshes* modelsOf(LiveDesk& desk) {
  return desk.kept() ? &desk.kept()->models : nullptr;
}

/// In a cluster as whoever leads has it. Null: something is wrong, or the run is to end.
std::unique_ptr<Player> openShow(const RunOptions& o, const std::atomic<bool>& stop, RunSetup& s,
                                 Diagnostics& findings) {
  ShowOptions show = o.show;
  if (s.cluster && !s.cluster->join(show, findings)) return nullptr;
  if (s.supervised && s.supervised->state()) show.state = s.supervised->state();
  if (!show.state) return Player::create(show, findings, reportOf(s), &stop, modelsOf(*s.desk));

  HeldReport report(reportOf(s));
  Diagnostics found;
  auto player = Player::prepare(show, findings, report.function(), &stop, modelsOf(*s.desk));
  if (!player) return nullptr;
  if (player->openScene(found) && (!s.cluster || s.cluster->hasFiles(player->scene())))
    return report.release(), std::move(player);
  if (s.cluster && !s.cluster->leads()) {
    report.release();
    findings.append(found);
    return s.cluster->refuseFiles(findings), nullptr;
  }
  show.state.reset(), player.reset();
  player = Player::create(show, findings, reportOf(s), &stop, modelsOf(*s.desk));
  if (!player) return nullptr;
  if (!s.cluster)
    s.supervised->beginAgain(found);
  else if (!s.cluster->beginAnew(found, findings))
    return nullptr;
  return player;
}

/// In a cluster, once all have opened the show.
bool beginWithOthers(RunSetup& s, Diagnostics& findings) {
  const auto takeKeys = [&s] { return !s.displays || s.displays->takeKeys(*s.desk); };
  return !s.cluster || s.cluster->begin(*s.player, s.desk->queue(), takeKeys, findings);
}

/// Opens everything before anything is played, so that whatever is wrong is found first.
bool setUp(RunOptions& o, const std::atomic<bool>& stop, RunSetup& s, Diagnostics& findings) {
  s.journal = RunJournal::open(o, findings);
  if (findings.hasErrors()) return false;
  if (s.journal)
    o.say = [terminal = o.say, journal = s.journal.get()](const std::string& line) {
      terminal(line);
      journal->note(line);
    };
  s.supervised = SupervisedPart::create(o, findings);
  if (findings.hasErrors()) return false;
  s.cluster = ClusterPart::create(o, findings);
  if (findings.hasErrors()) return false;
  if (!o.out.empty() && !keep(OutputFolder::open(o.out), s.folder, findings)) return false;
  const GlProviderKind kind = o.provider == "egl" ? GlProviderKind::Egl : GlProviderKind::OsMesa;
  if (o.provider != "none" && !keep(openGlProvider(kind), s.provider, findings)) return false;
  planDrawing(o, s, findings);
  s.desk = LiveDesk::open(o, findings, o.say);
  if (!s.desk) return false;
  s.player = openShow(o, stop, s, findings);
  if (!s.player) return false;
  if (s.provider && !canDraw(*s.provider, s.player->parts(o.layout), findings)) return false;
  reconsiderDrawing(o, s);
  s.spans = SpanRecording::create(o.spans, *s.player, findings);
  if (findings.hasErrors()) return false;
  if (!s.desk->begin(*s.player, findings)) return false;
  if (!beginGroup(o, s, findings)) return false;
  if (o.display && !(s.displays = DisplayRun::open(o, s.player->walls(), findings))) return false;
  if (!beginWithOthers(s, findings)) return false;
  if (!s.folder) return true;
  const bool goesOn = s.cluster && s.cluster->goesOn();  // what was written before belongs to the same show
  if (const std::size_t removed = goesOn ? 0 : s.folder->clear(); removed > 0)
    std::fprintf(stderr, "removed %zu files of an earlier run from %s\n", removed, o.out.c_str());
  RunOutputOptions out{*s.folder, o.pictureChoice,  o.sheets, o.video, o.hashes,
                       goesOn,    s.player->rate(), o.layout, {},      {}};
  for (const WallEntry& w : s.player->walls().walls) {
    out.wallNames.push_back(w.wall.name);
    const WallBasis shape = basis(w.wall);
    out.wallAspects.push_back(shape.width / shape.height);
  }
  s.output = std::make_unique<RunOutput>(std::move(out));
  return true;
}

/// Of a show that was played well, or is over: whether all that was asked for is there.
int codeOfWhatIsMissing(const RunOptions& o, const RunSetup& s) {
  if (!s.cluster) return kOk;
  if (s.recordsNothing || s.cluster->hasDouble()) return kBadInput;
  if (!o.keepsPictures() || !s.cluster->missedTheEnd()) return kOk;
  o.say("--out: the show ended before this machine had caught up with it: its last pictures are missing");
  return kBadInput;
}

/// What follows once a show has been played.
enum class Then { Ends, NextGroup, JoinAgain };
struct Played {
  Then then = Then::Ends;
  int code = kOk;  ///< if it ends
};

/// Plays the show to its end and, if nothing follows, reports on it.
Played play(const RunOptions& o, const std::atomic<bool>& stop, RunSetup& s) {
  ShowRecording* const recording = s.recording.get();
  ProgressBar progress(s.player->frames());
  const ShowStages* running = nullptr;
  const FrameLoop* looping = nullptr;
  FrameLoopOptions options = o.loopOptions(*s.player);
  ShowParts parts = s.player->parts(o.layout, s.cluster ? s.cluster->inputOf(*s.player) : nullptr);
  parts.provider = s.provider.get();
  parts.sink = s.output.get();
  if (s.displays) parts.sink = &s.displays->sink(), s.displays->fitPictures(parts.walls);
  parts.drawUnseen = !s.output;
  if (s.drawing) parts.workers = o.workers(*s.player, s.drawing->setting());
  if (s.drawing && s.drawing->setting().pinned)
    parts.processors = Topology::ofThisMachine().parts(parts.walls.size());
  parts.head = o.headFor(parts.walls);
  if (s.desk->kept()) parts.contexts = &s.desk->kept()->contexts;
  FrameProbe* const probe = s.spans       ? s.spans->probe()
                            : o.countWork ? &s.work
                            : recording   ? &recording->probe()
                                          : nullptr;
  parts.probe = probe;
  parts.giveUp = [] { return sinceStopSignal() > kDrawAfterStop; };
  parts.observer = [&](const TimeSignature& now, const InputSample& input, const Scene& scene) {
    s.watch->see(now, input, scene);
    if (s.cluster) s.cluster->simulated(now);
    if (s.journal) s.journal->see(now, input, scene);
    if (s.supervised) s.supervised->simulated(now, s.player->scene(), *s.watch, looping->catchesUp());
    if (recording) recording->see(scene);
    s.player->collect(running->shownFrame());
    progress.update(now.frame + 1);
  };
  parts.shown = [&] {
    if (!s.displays) s.desk->pictureSeen();
    if (s.supervised) s.supervised->shown();
    if (s.journal && s.journal->shown()) s.journal->firstPicture(running->glDescription());
  };
  s.desk->addTo(parts, options);
  ShowStages stages(std::move(parts));
  running = &stages;
  if (recording && !s.player->obeysLog()) options.decider = recording->governor();
  if (s.cluster) s.cluster->addTo(options, *s.desk);
  if (s.supervised) {
    s.supervised->goOn(options, *s.desk, *s.watch);
    s.player->tellWaiting([&supervised = *s.supervised](bool waits) {  // that is no hanging
      supervised.enter(waits ? SharedProgress::Phase::Opening : SharedProgress::Phase::Playing);
    });
  }
  if (options.after) s.watch->goOnAfter(*options.after, s.player->scene());
  FrameLoop loop(stages, options, stop, probe);
  looping = &loop;

  if (s.supervised) s.supervised->enter(SharedProgress::Phase::Playing);
  const auto start = std::chrono::steady_clock::now();
  const FrameLoopOutcome outcome = s.displays ? s.displays->play(loop, *s.desk) : loop.run();
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  progress.finish();
  if (s.supervised) s.supervised->enter(SharedProgress::Phase::Ending);
  const bool ends = stop || !outcome.nextGroup;
  if (s.cluster) s.cluster->finish(ends && !outcome.failure);
  // Asked after that: meanwhile the show may have ended for all.
  const bool joins = s.cluster && s.cluster->isToJoinAgain() && !stop;
  if (!outcome.failure && joins) return {Then::JoinAgain};
  if (!outcome.failure && !ends) return {Then::NextGroup};
  if (recording && outcome.failure) recording->keepLastFrames();

  int code =
      report({o, *s.player, stages, loop, outcome, *s.watch, elapsed, s.desk->groups(), s.desk->uptime(),
              recording, s.work.totals(s.player->walls().names()), s.drawing ? &*s.drawing : nullptr,
              s.cluster.get(), s.supervised ? s.supervised->remark() : ""},
             s.output.get(), s.folder.get());
  if (code == kOk && s.cluster && s.cluster->summary().stopped) code = kInternalFault;
  if (code == kOk) code = codeOfWhatIsMissing(o, s);
  if (const auto wrong = s.spans ? s.spans->finish() : std::nullopt) {
    std::fprintf(stderr, "stadion: --spans: %s\n", wrong->message.c_str());
    return {Then::Ends, kBadInput};
  }
  if (recording && !tellRecording(o, *recording, *s.player, stages.glDescription()))
    return {Then::Ends, code == kOk ? kBadInput : code};
  return {Then::Ends, code};
}

/// Waits until the script is saved again or the next group is asked for once more; false if the run is to
/// end.
bool waitForScript(const RunOptions& o, const std::atomic<bool>& stop, RunSetup& s) {
  constexpr std::chrono::milliseconds kLookEvery{250};
  o.say("the script has errors; the next group's show begins once it is saved without them");
  ScriptWatch files(o.show.script, o.show.assetRoots);
  for (;;) {
    if (stop || (s.displays && !s.displays->takeKeys(*s.desk))) return false;
    for (const OperatorCommand& c : s.desk->queue().take()) {
      if (c.action == OperatorAction::End) return false;
      if (c.action == OperatorAction::NextGroup) return true;
    }
    if (files.changed()) return true;
    if (s.supervised) s.supervised->shown();  // this is no hanging
    std::this_thread::sleep_for(kLookEvery);
  }
}

/// Everything of the show is made anew, but for what was read from files. False if there is no next group.
bool nextGroup(const RunOptions& o, const std::atomic<bool>& stop, RunSetup& s) {
  s.desk->endGroup(*s.watch);
  if (s.supervised) s.supervised->enter(SharedProgress::Phase::Opening), s.supervised->beginGroup();
  if (s.journal) s.journal->beginGroup();
  Diagnostics findings;
  if (const auto wrong = s.watch->finish()) findings.add(*wrong);
  s.watch.reset();
  s.player.reset();
  s.desk->kept()->models.store().collect(~std::uint64_t{0});  // no frame shows it any more
  for (;;) {
    s.player = Player::create(o.show, findings, reportOf(s), &stop, modelsOf(*s.desk));
    reportOf(s)(std::exchange(findings, {}));
    if (s.player) break;
    if (!waitForScript(o, stop, s)) return false;
  }
  // Of a cluster's next group the others learn by a new session.
  const bool well = beginGroup(o, s, findings) && beginWithOthers(s, findings);
  tell(findings);
  return well;
}

/// The show as the machine that leads has it now. False if it is not to be.
bool joinAgain(const RunOptions& o, const std::atomic<bool>& stop, RunSetup& s) {
  Diagnostics findings;
  if (const auto wrong = s.watch->finish()) findings.add(*wrong);
  s.watch.reset();
  s.player.reset();
  s.player = openShow(o, stop, s, findings);
  const bool well = s.player && beginGroup(o, s, findings) && beginWithOthers(s, findings);
  tell(findings);
  return well;
}

/// There is no show, or no next one.
int codeWithoutShow(const RunOptions& o, bool stopped, const RunSetup& s) {
  if (s.output) s.output->finish({});  // what was shown before is kept
  if (s.output && s.output->failure()) {
    std::fprintf(stderr, "stadion: %s\n", s.output->failure()->message.c_str());
    return exitCodeOf(*s.output->failure());
  }
  const auto lost = s.displays ? s.displays->lost() : std::nullopt;
  if (!lost && stopped) return kStopped + stopSignal();
  if (!lost && s.cluster && s.cluster->isOver()) return codeOfWhatIsMissing(o, s);
  if (!lost) return s.cluster && s.cluster->hasOtherFiles() ? kOtherFiles : kBadInput;
  std::fprintf(stderr, "stadion: %s\n", lost->c_str());
  return kInternalFault;
}

int playShow(RunOptions& o, RunSetup& setup, Diagnostics findings) {
  const std::atomic<bool>& stop = catchStopSignals();
  outliveReaders();
  if (o.endsWith > 0) stopWithParent(o.endsWith);
  const bool ready = setUp(o, stop, setup, findings);
  reportOf(setup)(findings);
  if (!ready) return codeWithoutShow(o, setup.cluster && stop, setup);
  if (setup.cluster && !setup.cluster->leads())
    ;  // how long it is, who leads knows
  else if (setup.player->frames() == 0 && setup.player->end() == 0)
    std::fprintf(stderr, "no input log beside the show and no --frames: playing until Ctrl-C\n");
  else if (o.out.empty() && !o.display) {
    const Player& p = *setup.player;
    const double seconds = p.end() > 0 ? toSeconds(p.end()) : static_cast<double>(p.frames() - 1) / p.rate();
    std::fprintf(
        stderr,
        "playing %.1f s of %s unseen; --display and stadion view show it, --out DIR writes pictures\n",
        seconds, o.show.script.c_str());
  }
  if (setup.journal) setup.journal->began(o, *setup.player);
  for (;;) {
    const Played played = play(o, stop, setup);
    if (played.then == Then::Ends) return played.code;
    const bool well = played.then == Then::NextGroup ? nextGroup(o, stop, setup) : joinAgain(o, stop, setup);
    if (well) continue;
    if (setup.cluster && setup.cluster->leads()) setup.cluster->finish(true);
    return codeWithoutShow(o, stop, setup);
  }
}

int runShow(RunOptions o) try {
  Diagnostics findings;
  if (!o.settle(findings)) return tell(findings), kBadInput;
  if (o.supervise) return tell(findings), superviseRun(o);
  RunSetup setup;
  const int code = playShow(o, setup, std::move(findings));
  return setup.journal ? setup.journal->ended(code) : code;
} catch (const RunStopped&) {
  std::fprintf(stderr, "stadion: stopped by %s before the show was loaded\n", stopSignalName());
  return kStopped + stopSignal();
}

}  // namespace

void addRunCommand(CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads) {
  auto o = std::make_shared<RunOptions>();
  o->rasteriserThreads = rasteriserThreads;
  CLI::App* command = app.add_subcommand("run", "Play a show: simulate, cull and draw it on all walls");
  addRunOptions(*command, *o);
  command->callback([o, &code] { code = runShow(*o); });
}

}  // namespace stadion
