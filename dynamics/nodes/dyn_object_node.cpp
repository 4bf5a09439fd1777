#include "dynamics/nodes/dyn_object_node.h"

#include "engine/scene/scene.h"

#include <algorithm>
#include <utility>

namespace stadion {

void DynObjectNode::onEnter(Scene& scene) {
  ObjectNode::onEnter(scene);
  hooked_.clear();
  for (const std::string& name : body_.hooks)
    if (const NodeRef field = scene.resolve(name, self()); field.valid()) hooked_.push_back(field);
}

DynObjectNode::Requests DynObjectNode::takeRequests() {
  return std::exchange(requests_, {});
}

void DynObjectNode::receive(const Message& m, FrameContext& frame) {
  switch (m.verb) {
  case Verb::Hook:
  case Verb::Unhook: {
    if (!m.node.valid()) return;
    const bool hook = m.verb == Verb::Hook;
    std::erase(hooked_, m.node);
    if (hook) hooked_.push_back(m.node);
    requests_.hooks.push_back({frame.effective(m), m.node, hook});
    break;
  }
  case Verb::Grab: requests_.grab = m.arguments.empty() ? "wand" : m.arguments[0]; break;
  case Verb::Release: requests_.release = true; break;
  case Verb::Attach:  // to the hand, as a body
    requests_.grab = m.arguments.size() > 1 ? m.arguments[1] : "wand";
    break;
  case Verb::Detach: requests_.release = true; break;
  case Verb::Reset:
    restoreHooks(frame.scene);
    requests_.reset = true;
    ObjectNode::receive(m, frame);
    break;
  default: ObjectNode::receive(m, frame); break;
  }
  if (simulation_.valid()) frame.scene.wakeNow(simulation_);
}

void DynObjectNode::restoreHooks(Scene& scene) {
  // As at the start: the hooks of the script.
  for (const NodeRef field : hooked_) requests_.hooks.push_back({0, field, false});
  hooked_.clear();
  for (const std::string& name : body_.hooks)
    if (const NodeRef field = scene.resolve(name, self()); field.valid()) {
      hooked_.push_back(field);
      requests_.hooks.push_back({0, field, true});
    }
}

void DynObjectNode::hash(StateHash& h) const {
  ObjectNode::hash(h);
  for (const NodeRef field : hooked_) h.add(field);
  h.add(state_.p), h.add(state_.q), h.add(state_.v), h.add(state_.omega), h.add(state_.L);
  h.add(static_cast<std::uint32_t>(state_.mode));
  h.add(state_.clock), h.add(state_.clockRest);
}

}  // namespace stadion
