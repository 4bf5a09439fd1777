#include "show/recording/span_recording.h"

#include "engine/base/atomic_file.h"

#include <algorithm>

namespace stadion {
namespace {

std::vector<std::string> wallNames(const Player& player) {
  std::vector<std::string> names;
  for (const WallEntry& w : player.walls().walls) names.push_back(w.wall.name);
  return names;
}

}  // namespace

std::unique_ptr<SpanRecording> SpanRecording::create(const SpanOptions& options, Player& player,
                                                     Diagnostics& findings) {
  if (options.file.empty()) {
    if (!options.planted.empty()) findings.error({}, "--plant needs --spans FILE");
    return nullptr;
  }
  std::unique_ptr<SpanRecording> made(new SpanRecording(options, player));
  regression::SpanTimesOptions times;
  if (options.turns) times.turns = &made->turns_;
  times.countInstructions = options.instructions || options.hardware;
  if (options.hardware && !made->count(times, findings)) return nullptr;
  if (!options.planted.empty() && !made->plant(times, findings)) return nullptr;
  made->times_.emplace(std::move(times));
  return made;
}

/// In sequential mode one thread does everything, and that is this one.
bool SpanRecording::count(regression::SpanTimesOptions& times, Diagnostics& findings) {
  std::string why;
  counter_ = regression::InstructionCounter::open(why);
  if (!counter_) {
    findings.error({}, "--count-by-hardware: " + why);
    return false;
  }
  times.instructions = [this] { return counter_->now(); };
  return true;
}

bool SpanRecording::plant(regression::SpanTimesOptions& times, Diagnostics& findings) {
  auto planted = regression::PlantedDelay::parse(options_.planted);
  if (!planted) {
    findings.error(
        {}, "--plant is simulate:NODE=AMOUNT, cull:WALL=AMOUNT, draw:WALL=AMOUNT or frame:=AMOUNT, not " +
                options_.planted);
    return false;
  }
  if (planted->where == regression::PlantedDelay::Where::Simulate) {
    planted->node = player_.scene().tree().resolve(planted->name, {1, 0});
    if (!player_.scene().find(planted->node))
      findings.error({}, "--plant: the show has no node \"" + planted->name + "\"");
  } else if (planted->where != regression::PlantedDelay::Where::Frame) {
    const std::vector<std::string> walls = wallNames(player_);
    const auto at = std::ranges::find(walls, planted->name);
    planted->wall = static_cast<std::uint32_t>(at - walls.begin());
    if (at == walls.end()) findings.error({}, "--plant: there is no wall \"" + planted->name + "\"");
  }
  times.planted = *planted;
  return !findings.hasErrors();
}

std::optional<Diagnostic> SpanRecording::finish() {
  const auto rows = times_->rows(wallNames(player_), [this](NodeRef node, regression::SpanRow& row) {
    nameNode(player_.scene(), node, row);
  });
  return writeFile(options_.file, regression::toJson(rows) + "\n");
}

void nameNode(const Scene& scene, NodeRef node, regression::SpanRow& row) {
  const LoadedScene* load = scene.tree().load(node.load);
  if (!load || node.position >= load->nodes.size()) {
    row.path = "(unloaded)";
    return;
  }
  row.file = load->file;
  row.line = load->lines[node.position];
  if (const Node* n = load->nodes[node.position].get()) row.path = n->name();
}

}  // namespace stadion
