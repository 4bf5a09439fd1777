/// `stadion run SHOW`: plays a show.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/node_trace.h"
#include "cli/player.h"
#include "cli/run_output.h"
#include "engine/input/input_recorder.h"
#include "pipeline/output/progress.h"
#include "pipeline/output/run_summary.h"
#include "profiling/node_times.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace stadion {
namespace {

struct RunOptions {
  ShowOptions show;
  std::string stereo = "pair", pace, recordInput, out, pictures = "last", provider = "osmesa";
  std::vector<std::string> trace;
  bool sheets = false, video = false, profile = false, json = false;
};

std::atomic<bool> stopRequested = false;  // set by the signal handler, which can reach nothing else
/// The first signal ends the show after the present frame, the second one at once.
extern "C" void requestStop(int) {
  if (stopRequested.exchange(true)) std::_Exit(130);
}

/// Every frame counts where somebody looks at the result later; else the newest one does.
bool everyFrameCounts(const RunOptions& o) {
  return o.show.frames != 0 || !o.out.empty() || (!o.show.input.empty() && o.show.input != "none");
}

FrameLoopOptions loopOptions(const RunOptions& o, const Player& player) {
  FrameLoopOptions l;
  l.mode = o.show.mode == "sequential" ? Mode::Sequential : Mode::Pipelined;
  l.rate = o.show.rate;
  l.walls = player.walls().walls.size();
  l.frames = player.frames();
  l.delivery = everyFrameCounts(o) ? Delivery::Every : Delivery::Latest;
  // A live show that drops frames ends with its log's last moment, not with its last frame's number.
  if (l.delivery == Delivery::Latest && player.end() > 0) l.frames = 0, l.end = player.end();
  const bool free = o.pace.empty() ? (o.show.frames != 0 || !o.out.empty()) : o.pace == "free";
  l.pace = free ? Pace::Free : o.pace == "float" ? Pace::Float : Pace::Lock;
  return l;
}

/// What a run has seen and how it ended.
struct Watched {
  std::uint64_t lastFrame = 0, stateHash = 0, visited = 0, published = 0, delivered = 0, lost = 0;
  Nanoseconds lastTime = 0;
  std::vector<std::string> events;  ///< in words
};

std::string describe(const EventRecord& e, const Scene& scene) {
  std::string name = "?";
  if (const Load* load = scene.load(e.node.load))
    if (e.node.position < load->nodes.size() && load->nodes[e.node.position]) {
      name = load->nodes[e.node.position]->name();
      if (name.empty()) name = load->file + ":" + std::to_string(load->lines[e.node.position]);
    }
  char text[160];
  std::snprintf(text, sizeof text, "%9.4f s  %-10s %s", toSeconds(e.when),
                std::string(nameOf(e.event)).c_str(), name.c_str());
  return text;
}

RunSummary summarise(const RunOptions& o, const Player& player, const ShowStages& stages,
                     const FrameLoop& loop, const FrameLoopOutcome& outcome, const Watched& seen,
                     double elapsed) {
  RunSummary s;
  s.show = o.show.script, s.walls = o.show.walls, s.mode = o.show.mode, s.stereo = o.stereo;
  s.width = o.show.width, s.height = o.show.height, s.rate = o.show.rate;
  s.frames = outcome.framesShown, s.lateFrames = outcome.missedTicks;
  s.seconds = toSeconds(seen.lastTime), s.elapsedSeconds = elapsed;
  const FrameTimes& t = loop.times();
  s.frameMs = distributionOf(t.period.values());
  const std::string clock = "steady clock around the stage",
                    finish = "steady clock around draw + finish + read back";
  s.stages.push_back({"app", "", distributionOf(t.app.values()), clock});
  for (std::size_t w = 0; w < t.draw.size(); ++w) {
    const std::string& name = player.walls().walls[w].wall.name;
    s.stages.push_back({"cull", name, distributionOf(t.cull[w].values()), clock});
    s.stages.push_back({"draw", name, distributionOf(t.draw[w].values()), finish});
    s.latency.push_back({name, distributionOf(t.latency[w].values())});
    for (std::size_t e = 0; e < stages.lastPictures()[w].eyes.size(); ++e)
      s.imageHashes.push_back({name, eyeName(kEyes[e]), imageHash(stages.lastPictures()[w].eyes[e])});
  }
  s.lastFrame = seen.lastFrame;
  s.stateHash = seen.stateHash;
  const double frames = static_cast<double>(std::max<std::uint64_t>(1, outcome.framesSimulated));
  s.counters = {{"nodes visited per frame", static_cast<double>(seen.visited) / frames},
                {"changes published per frame", static_cast<double>(seen.published) / frames},
                {"messages delivered", static_cast<double>(seen.delivered)},
                {"messages lost", static_cast<double>(seen.lost)}};
  s.remarks.push_back("drawn by " + stages.glDescription());
  return s;
}

void tellDearest(const NodeTimes& times, const Scene& scene, std::uint64_t frames) {
  std::fprintf(stderr, "\ndearest nodes in App (steady clock)\n   us/frame  visits  node\n");
  for (const NodeCost& c : times.dearest(10)) {
    const Load* load = scene.load(c.node.load);
    const std::string where =
        load ? load->file + ":" + std::to_string(load->lines[c.node.position]) : "(unloaded)";
    const Node* node = load ? load->nodes[c.node.position].get() : nullptr;
    std::fprintf(stderr, "%11.2f %7llu  %s %s\n", 1000 * c.total() / static_cast<double>(frames),
                 static_cast<unsigned long long>(c.visits), node ? node->name().c_str() : "", where.c_str());
  }
}

int runShow(RunOptions o) {
  Diagnostics findings;
  const auto layout = stereoLayout(o.stereo);
  const auto pictures = PictureChoice::parse(o.pictures);
  if (!pictures)
    findings.error({}, "--pictures: \"" + o.pictures +
                           "\" is not last, all, none or a number N (every Nth frame)");
  if (!o.show.settle(findings)) return tell(findings), kBadInput;
  if (!o.trace.empty() && o.out.empty())
    findings.error({}, "--trace needs --out DIR to know where the table goes");
  if (o.video && o.out.empty()) findings.error({}, "--video needs --out DIR to know where the video goes");
  if (!o.out.empty()) {
    std::error_code error;
    std::filesystem::create_directories(o.out, error);
    if (error)
      findings.error({}, "--out: cannot make the folder " + o.out + ": " + error.message());
    else if (AtomicFile(o.out + "/summary.json").failed())  // better known now than after the show
      findings.error({}, "--out: cannot write into the folder " + o.out);
  }
  if (findings.hasErrors()) return tell(findings), kBadInput;

  auto provider = openGlProvider(o.provider == "egl" ? GlProviderKind::Egl : GlProviderKind::OsMesa);
  if (!provider) {
    findings.add(provider.error());
    return tell(findings), kBadInput;
  }
  auto player = Player::create(o.show, findings);
  tell(findings);
  if (!player) return kBadInput;

  std::unique_ptr<RunOutput> output;
  if (!o.out.empty()) {
    RunOutputOptions out{o.out, *pictures, o.sheets, o.video, o.show.rate, *layout, {}};
    for (const WallEntry& w : player->walls().walls) out.wallNames.push_back(w.wall.name);
    output = std::make_unique<RunOutput>(std::move(out));
  }
  std::unique_ptr<InputRecorder> recorder;
  if (!o.recordInput.empty()) recorder = std::make_unique<InputRecorder>(o.recordInput);
  NodeTimes nodeTimes;
  std::vector<NodeTrace> traces;
  for (const std::string& node : o.trace) {
    const NodeRef ref = player->scene().resolve(node, {1, 0});
    // What stands in a sub-scene may come later.
    if (node.find('/') == node.npos && !player->scene().find(ref)) {
      std::fprintf(stderr, "stadion: --trace: the show has no node \"%s\"\n", node.c_str());
      return kBadInput;
    }
    traces.emplace_back(node);
  }

  Watched seen;
  ProgressBar progress(player->frames());
  ShowParts parts = player->parts(*layout);
  parts.provider = provider.value().get();
  parts.sink = output.get();
  parts.drawUnseen = !output;
  parts.probe = o.profile ? &nodeTimes : nullptr;
  const ShowStages* running = nullptr;
  parts.observer = [&](const TimeSignature& now, const InputSample& input, const Scene& scene) {
    seen.lastFrame = now.frame, seen.lastTime = now.time;
    seen.stateHash = scene.stateHash();
    const FrameCounters& c = scene.counters();
    seen.visited += c.nodesVisited, seen.published += c.changesPublished;
    seen.delivered += c.messagesDelivered, seen.lost += c.messagesLost;
    for (const EventRecord& e : scene.events())
      if (seen.events.size() < 200) seen.events.push_back(describe(e, scene));
    if (recorder) recorder->record(input);
    for (NodeTrace& t : traces) t.record(now, scene);
    player->collect(running->shownFrame());
    progress.update(now.frame + 1);
  };
  ShowStages stages(std::move(parts));
  running = &stages;

  if (player->frames() == 0)
    std::fprintf(stderr, "no input log beside the show and no --frames: playing until Ctrl-C\n");
  if (!output && player->frames() != 0)
    std::fprintf(stderr, "playing %.1f s of %s; there is no window yet, --out DIR writes pictures\n",
                 static_cast<double>(player->frames() - 1) / o.show.rate, o.show.script.c_str());
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
  FrameLoop loop(stages, loopOptions(o, *player), stopRequested, o.profile ? &nodeTimes : nullptr);
  const auto start = std::chrono::steady_clock::now();
  const FrameLoopOutcome outcome = loop.run();
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  progress.finish();

  RunSummary summary = summarise(o, *player, stages, loop, outcome, seen, elapsed);
  int code = kOk;
  if (outcome.failure) {
    std::fprintf(stderr, "stadion: %s\n", outcome.failure->c_str());
    code = kInternalFault;
  }
  if (output) {
    output->finish(seen.lastFrame, stages.lastPictures());
    summary.files = output->files();
    summary.remarks.insert(summary.remarks.end(), output->remarks().begin(), output->remarks().end());
    if (output->failed()) code = kBadInput;
  }
  if (recorder)
    if (const auto wrong = recorder->commit()) {
      std::fprintf(stderr, "stadion: %s\n", wrong->message.c_str());
      code = kBadInput;
    }
  if (outcome.stopped) summary.remarks.push_back("stopped by request");
  if (output) {
    for (const NodeTrace& t : traces) {
      const std::string path = o.out + "/trace-" + t.fileName() + ".csv";
      if (const auto wrong = writeFile(path, t.table()))
        std::fprintf(stderr, "stadion: %s\n", wrong->message.c_str()), code = kBadInput;
      else
        summary.files.push_back(path);
    }
    AtomicFile file(o.out + "/summary.json");
    file.write(toJson(summary) + "\n");
    if (const auto wrong = file.commit())
      std::fprintf(stderr, "stadion: %s\n", wrong->message.c_str()), code = kBadInput;
    else
      summary.files.push_back(o.out + "/summary.json");
  }
  if (o.json) {
    std::printf("%s\n", toJson(summary).c_str());
  } else {
    std::printf("%s", toText(summary).c_str());
    if (!seen.events.empty()) std::printf("\nwhat happened\n");
    for (const std::string& e : seen.events) std::printf("%s\n", e.c_str());
    if (o.out.empty()) std::printf("\nTo see it:  ./stadion run %s --out pictures\n", o.show.script.c_str());
  }
  if (o.profile) tellDearest(nodeTimes, player->scene(), std::max<std::uint64_t>(1, outcome.framesSimulated));
  return code;
}

}  // namespace

void addRunCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Play a show: simulate, cull and draw it on all walls");
  o->show.addTo(*command);
  std::vector<std::string> layouts = stereoLayoutNames();
  command->add_option("--stereo", o->stereo, "how the two eyes' pictures are written")
      ->check(CLI::IsMember(layouts))
      ->capture_default_str();
  command
      ->add_option(
          "--pace", o->pace,
          "free: as fast as possible; lock: on the ticks of --rate; float: a late frame begins at once "
          "(default: free with --frames or --out, else lock)")
      ->check(CLI::IsMember({"free", "lock", "float"}));
  command->add_option("--record-input", o->recordInput, "write what the trackers said to this input log");
  command->add_option(
      "--out", o->out,
      "folder for pictures, contact-sheet.png and summary.json; only the frames of --pictures are drawn");
  command
      ->add_option("--pictures", o->pictures,
                   "of which frames pictures are written: last, all, none, or N for every Nth")
      ->capture_default_str();
  command->add_flag("--sheets", o->sheets, "a contact sheet of all walls beside each frame's pictures");
  command->add_flag("--video", o->video, "a video of all walls (needs ffmpeg)");
  command->add_flag("--profile", o->profile, "say which nodes cost App the most");
  command->add_option("--gl", o->provider, "who draws: osmesa or egl (the same pixels)")
      ->check(CLI::IsMember({"osmesa", "egl"}))
      ->capture_default_str();
  command->add_option("--trace", o->trace,
                      "write where this node is in every frame to trace-NODE.csv in --out DIR");
  command->add_flag("--json", o->json, "the summary as one JSON object on stdout");
  command->callback([o, &code] { code = runShow(*o); });
}

}  // namespace stadion
