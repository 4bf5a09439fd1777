#include "engine/nodes/scene_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/scene/scene.h"
#include "engine/script/file_path.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {

constexpr SceneNode::Change lastOf(SceneNode::Change) {
  return SceneNode::Change::Unloaded;
}

void SceneNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  if (initially_) load(scene, scene.now());
}

void SceneNode::load(Scene& scene, Nanoseconds at) {
  if (number_ != 0) return;
  number_ = scene.requestLoad(file_, self(), at);
  expected_.push_back({at, Change::Loaded});
  scene.schedule().wakeAt(at, self());
}

void SceneNode::unload(Scene& scene, Nanoseconds at) {
  if (number_ == 0) return;
  scene.requestUnload(number_, at);
  number_ = 0;
  expected_.push_back({at, Change::Unloaded});
  scene.schedule().wakeAt(at, self());
}

void SceneNode::receive(const Message& m, FrameContext& frame) {
  if (m.command != CommandId::Reset) PlacedNode::receive(m, frame);
  const Nanoseconds at = frame.effective(m) + ready_;
  switch (m.command) {
  case CommandId::Load: load(frame.scene, at); break;
  case CommandId::Unload: unload(frame.scene, at); break;
  case CommandId::Reset:
    resetPlace(frame.scene);
    unload(frame.scene, at);
    if (initially_) load(frame.scene, at);
    break;
  default: break;
  }
}

void SceneNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  std::erase_if(expected_, [&](const auto& e) {
    if (e.first > frame.now.time) return false;
    if (e.second == Change::Loaded && number_ != 0 && frame.scene.requests().awaits(number_)) {  // it comes late
      frame.scene.schedule().wakeAt(frame.now.time + 1, self());
      return false;
    }
    // A file that could not be loaded is not there; the load may be asked for again.
    const bool failed = e.second == Change::Loaded && number_ != 0 && !frame.scene.tree().load(number_);
    if (failed)
      number_ = 0;
    else
      raise(e.second == Change::Loaded ? Event("loaded") : Event("unloaded"),
            std::max(e.first, frame.now.time - frame.now.step));
    return true;
  });
}

template <class Self, class Fields>
void SceneNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("load", self.number_), f("expected", self.expected_);
}

void SceneNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void SceneNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

std::unique_ptr<Node> makeScene(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  return std::make_unique<SceneNode>(r.self, r.name, r.place, std::string(d.text("file")),
                                     fromSeconds(d.number("ready")), d.flag("initstate"));
}

void lintScene(const Declaration& node, LintScope& scope) {
  if (endingOf(node.text("file")) != "evs")
    scope.warn(node, "file", fmt::format("\"{}\" does not look like a script (.evs)", node.text("file")));
  if (!node.flag("initstate") && node.name().empty())
    scope.warn(node, "initstate",
               "this scene is not loaded at the start, and without a name it never can be");
}

constexpr AttributeSpec kSceneRows[] = {
    {.name = "file", .kind = ValueKind::File, .help = "the script of the sub-scene (.evs)", .required = true},
    {.name = "initstate",
     .kind = ValueKind::Flag,
     .help = "whether it is loaded at the start",
     .standard = "on"},
    {.name = "ready",
     .kind = ValueKind::Number,
     .help = "show time from the request to the moment the scene appears or goes",
     .standard = "1",
     .unit = "s",
     .range = {0, 3600}},
};

constexpr EventSpec kSceneEvents[] = {{"loaded", "the sub-scene has appeared"},
                                      {"unloaded", "the sub-scene has been removed"}};

constexpr CommandSpec kSceneCommands[] = {
    {"load", ArgumentKind::None, "load", "the scene appears after its `ready` time"},
    {"unload", ArgumentKind::None, "unload", "the scene goes after its `ready` time"}};

}  // namespace

constinit const NodeType kSceneType{
    .name = "scene",
    .help = "another script, loaded into this one and unloaded by message",
    .attributes = kSceneRows,
    .events = kSceneEvents,
    .commands = kSceneCommands,
    .traits = {Trait::Placed, Trait::Parent, Trait::Level, Trait::Moves, Trait::Encloses},
    .make = makeScene,
    .lint = lintScene,
};

namespace node_types {

void addSceneNode(NodeRegistrar& types) {
  types.add(kSceneType);
}

}  // namespace node_types

}  // namespace stadion
