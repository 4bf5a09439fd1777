#include "show/measure/model_run.h"

#include "dynamics/collision/shape_choice.h"
#include "dynamics/nodes/collision_node.h"
#include "dynamics/nodes/dyn_object_node.h"
#include "dynamics/nodes/field_node.h"
#include "show/recording/show_recording.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr std::uint64_t kFramesWithoutInput = 600;

/// Looks on while a show plays.
class BodyWatch {
public:
  BodyWatch(Scene& scene, NodeRef only) : scene_(scene), only_(only) {}

  void look(const TimeSignature& now) {
    if (loadsSeen_ != scene_.tree().version()) findBodies();
    for (const NodeRef ref : present_)
      if (const auto* node = dynamic_cast<const DynObjectNode*>(scene_.find(ref))) note(*node, now.frame);
  }
  std::map<NodeRef, PlayedBody> take() { return std::move(bodies_); }

private:
  void findBodies() {
    loadsSeen_ = scene_.tree().version();
    present_.clear();
    scene_.tree().forEachNode([&](const Node& node) {
      if (node.kind() == "dynobject" && (!only_.valid() || node.self() == only_))
        present_.push_back(node.self());
    });
  }

  void note(const DynObjectNode& node, std::uint64_t frame) {
    if (!node.movedBy().valid()) return;
    const auto [at, isNew] = bodies_.try_emplace(node.self());
    PlayedBody& body = at->second;
    if (isNew) describe(node, body);
    const BodyState& s = node.state();
    ++body.modes[static_cast<std::size_t>(s.mode)];
    if (s.mode == BodyMode::Flight) ++body.flights[static_cast<std::size_t>(s.flight)];
    body.arcs = s.arcs;
    if (!only_.valid()) return;
    body.places.resize(frame + 1);
    body.places[frame] = s.pose;
  }

  void describe(const DynObjectNode& node, PlayedBody& body) {
    const LoadedScene& load = *scene_.tree().load(node.self().load);
    const FittedShape& fit = *node.fit();
    body.name = node.name();
    body.file = load.file;
    body.line = load.lines[node.self().position];
    body.shape = fit.choice.kind;
    body.deviation = fit.choice.deviation;
    body.chosen = node.appearance().shape == "auto" || node.appearance().shape.empty();
    if (const Mesh* mesh = scene_.instances().mesh(node.appearance().mesh)) {
      body.triangles = mesh->indices.size() / 3;
      if (!only_.valid()) body.exact = exactShapeOf(node.appearance().mesh, *mesh);
    }
    body.dragArea = node.body().dragArea.value_or(fit.dragArea);
    body.dynamics = node.movedBy();
    if (const auto* moves = dynamic_cast<const CollisionNode*>(scene_.find(body.dynamics)))
      body.impacts = moves->impacts().kind;
    for (const std::string& name : node.body().hooks)
      if (const Node* field = scene_.find(scene_.tree().resolve(name, node.self())))
        body.fields.push_back({name, field->type().name});
  }

  /// Of a model with flat faces: the simple shape that it is without tolerance.
  const std::string& exactShapeOf(MeshId id, const Mesh& mesh) {
    const auto [at, isNew] = exact_.try_emplace(id);
    if (!isNew) return at->second;
    const auto choice = chooseShape(mesh, ShapeKind::Auto, 0);
    if (choice && (choice.value().kind == ShapeKind::Box || choice.value().kind == ShapeKind::Convex))
      at->second = nameOf(choice.value().kind);
    return at->second;
  }

  Scene& scene_;
  std::map<MeshId, std::string> exact_;
  NodeRef only_;
  std::uint64_t loadsSeen_ = ~std::uint64_t{0};
  std::vector<NodeRef> present_;
  std::map<NodeRef, PlayedBody> bodies_;
};

DynamicsVariation variationOf(const BodyModel& model) {
  DynamicsVariation v;
  v.fineness = model.fineness;
  v.impacts = model.impacts;
  v.body = [model](NodeRef ref, Appearance& appearance, BodyAttributes& body) {
    if (ref != model.body) return;
    body.simulated = !model.absent;
    if (!model.shape.empty()) appearance.shape = model.shape;
    if (model.dragArea) body.dragArea = model.dragArea;
    for (const std::string& name : model.without) std::erase(body.hooks, name);
  };
  return v;
}

}  // namespace

std::optional<PlayedShow> playWith(const ShowOptions& show, const BodyModel& model, Diagnostics& findings,
                                   std::function<void(const Diagnostics&)> report) {
  ShowOptions options = show;
  options.variation = variationOf(model);
  const auto player = Player::create(options, findings, std::move(report));
  if (!player) return {};
  const auto recording = ShowRecording::create({.log = {.samples = false}}, findings);
  if (!recording) return {};
  BodyWatch watch(player->scene(), model.body);
  ShowParts parts = player->parts(StereoLayout::Off);
  parts.probe = &recording->probe();
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene&) { watch.look(now); };
  ShowStages stages(std::move(parts));
  FrameLoopOptions o = player->loopOptions();
  if (o.frames == 0 && o.end == 0) o.frames = kFramesWithoutInput;
  o.mode = Mode::Sequential;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  const FrameLoopOutcome outcome = loop.run();
  if (outcome.failure) {
    findings.error({}, outcome.failure->message);
    return {};
  }
  PlayedShow played{outcome.framesSimulated, player->rate(), watch.take()};
  for (const auto& [ref, cost] : recording->profile().nodes())
    if (const Node* node = player->scene().find(ref); node && node->kind() == "dynamics")
      played.milliseconds[ref] = cost.phases[0] + cost.phases[1] + cost.phases[2];
  return played;
}

}  // namespace stadion
