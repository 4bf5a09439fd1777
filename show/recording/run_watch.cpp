#include "show/recording/run_watch.h"

#include "engine/base/atomic_file.h"
#include "engine/core/cost_budget.h"
#include "engine/core/state_hash.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

namespace stadion {
namespace {

std::string nameIn(const Scene& scene, NodeRef node) {
  const LoadedScene* load = scene.tree().load(node.load);
  if (!load || node.position >= load->nodes.size() || !load->nodes[node.position]) return "?";
  const std::string name = load->nodes[node.position]->name();
  return name.empty() ? load->file + ":" + std::to_string(load->lines[node.position]) : name;
}

bool givesUp(const Scene& scene, NodeRef node) {
  const LoadedScene* load = scene.tree().load(node.load);
  const auto at = load ? load->terms.find(node.position) : decltype(load->terms.end())();
  return load && at != load->terms.end() && levelsOf(at->second.gives) > 0;
}

/// Whether something is there that must not be lost for a new input log.
bool isAnotherFile(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none) || std::filesystem::file_size(path, none) == 0)
    return false;
  constexpr std::string_view kBegin = "stadion-input ";
  std::string begin(kBegin.size(), 0);
  return !std::ifstream(path, std::ios::binary).read(begin.data(), std::ssize(begin)) || begin != kBegin;
}

}  // namespace

std::unique_ptr<RunWatch> RunWatch::create(const RecordSettings& record, const PlaySettings& play,
                                           Player& player, Diagnostics& findings) {
  std::unique_ptr<RunWatch> watch(new RunWatch(player));
  for (const std::string& node : record.nodes) {
    const NodeRef ref = player.scene().tree().resolve(node, {1, 0});
    // What stands in a sub-scene may come later.
    if (node.find('/') == node.npos && !player.scene().find(ref))
      findings.error({player.script(), 0, 0}, "--track: the show has no node \"" + node + "\"");
    watch->traces_.emplace_back(node);
  }
  if (findings.hasErrors()) return nullptr;
  watch->recordInput(record.input, play.everyFrameCounts(player), findings);
  return findings.hasErrors() ? nullptr : std::move(watch);
}

void RunWatch::recordInput(const std::string& file, bool everyFrame, Diagnostics& findings) {
  if (file.empty()) return;
  std::error_code none;
  if (std::filesystem::equivalent(file, player_.inputName(), none)) {
    findings.error({}, "--record-input: " + file + " is the input log being played; name another file");
    return;
  }
  if (isAnotherFile(file)) {
    findings.error({}, "--record-input: " + file +
                           " is there and is no input log; name another file, or remove this one");
    return;
  }
  for (const std::string& part : partsOfKilledWriters(file))
    findings.warning({part, 0, 0},
                     "is what a run that was killed has left of its record of the input: without its "
                     "last line, which may be half of one, it can be played; else remove it");
  // Where every frame follows the last one at 1/rate there is nothing to record but the input.
  const bool clockDecides = !everyFrame || player_.replaysLog();
  recorder_ = std::make_unique<InputRecorder>(file, clockDecides ? player_.rate() : 0);
  if (const auto& why = recorder_->refusal())
    findings.error({}, "--record-input: " + file + " " + why->message);
  player_.tellLateLoads(
      [recorder = recorder_.get()](std::uint32_t load, Nanoseconds time) { recorder->lateLoad(load, time); });
}

void RunWatch::see(const TimeSignature& now, const InputSample& input, const Scene& scene) {
  last_ = now;
  stateHash_ = scene.stateHash();
  StateHash history(historyHash_);
  history.add(stateHash_);
  historyHash_ = history.value();
  const FrameCounters& c = scene.counters();
  visited_ += c.nodesVisited;
  published_ += c.changesPublished;
  delivered_ += c.messagesDelivered;
  lost_ += c.messagesLost;
  for (const EventRecord& e : scene.events()) note(e, scene);
  for (const DegradationDecision& d : now.decisions) note(d, scene);
  if (recorder_) {
    recorder_->frame(now);
    recorder_->record(input);
  }
  for (NodeTrace& t : traces_) t.record(now, scene);
}

void RunWatch::goOnAfter(const TimeSignature& frame, const Scene& scene) {
  last_ = frame;
  stateHash_ = scene.stateHash();
}

std::optional<Diagnostic> RunWatch::finish() {
  if (!recorder_ || std::exchange(finished_, true)) return {};
  // What had not come by the end must not come in a replay either.
  for (const std::uint32_t load : player_.overdueLoads()) recorder_->lateLoad(load, last_.time + 1);
  return recorder_->commit();
}

void RunWatch::note(const EventRecord& event, const Scene& scene) {
  ++eventCount_;
  if (events_.size() < RunSummary::kMostEvents)
    events_.push_back(
        {toSeconds(event.when), std::string(event.event.name()), nameIn(scene, event.node), event.value});
  if (event.value && measured_.size() < RunSummary::kMostEvents)
    measured_.push_back({toSeconds(event.when), nameIn(scene, event.node), *event.value});
}

void RunWatch::note(const DegradationDecision& d, const Scene& scene) {
  const NodeRef node{d.load, d.position};
  ReplayedDegradation& o = givenUp_[node];
  if (o.node.empty() && givesUp(scene, node)) o.node = nameIn(scene, node);
  ++o.changes;
  o.highest = std::max(o.highest, d.level);
  o.now = d.level;
}

/// What a live run decides, its governor tells, with what it cost.
void RunWatch::addObeyed(RunSummary& s) const {
  if (!player_.replaysLog()) return;
  s.stress.emplace();
  std::uint64_t aboutNothing = 0;
  for (const auto& [node, o] : givenUp_)
    if (node.load == 0)
      s.stress = StressSummary{stressOf(o.highest), stressOf(o.now), o.changes};
    else if (o.node.empty())
      aboutNothing += o.changes;
    else
      s.replayedDegradations.push_back(o);
  if (aboutNothing > 0)
    s.remarks.push_back("decisions of the log about nodes that are not there or give nothing up: " +
                        std::to_string(aboutNothing));
}

void RunWatch::addTo(RunSummary& s, std::uint64_t frames) const {
  s.seconds = toSeconds(last_.time);
  s.lastFrame = last_.frame;
  s.stateHash = stateHash_;
  s.historyHash = historyHash_;
  const double each = static_cast<double>(std::max<std::uint64_t>(1, frames));
  s.counters = {{"nodes visited per frame", static_cast<double>(visited_) / each},
                {"changes published per frame", static_cast<double>(published_) / each},
                {"messages delivered", static_cast<double>(delivered_)},
                {"messages lost", static_cast<double>(lost_)}};
  s.events = events_;
  s.measured = measured_;
  s.eventCount = eventCount_;
  addObeyed(s);
}

}  // namespace stadion
