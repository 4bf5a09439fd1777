#include "dynamics/nodes/dyn_object_node.h"

#include "engine/scene/scene.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

/// About the longest, the middle and the shortest axis: that is how the moments of even matter rise.
void takeMoments(MassProperties& mass, const Vec3& moments) {
  const Vec3 even = mass.inertia;
  int order[3] = {0, 1, 2};
  std::stable_sort(order, order + 3, [&even](int i, int j) { return even[i] < even[j]; });
  for (int k = 0; k < 3; ++k) mass.inertia[order[k]] = moments[k];
}

}  // namespace

MassProperties BodyAttributes::massOf(const FittedShape& fit) const {
  const MassProperties& filled = fit.filled.value();
  MassProperties m = filled.withMass(mass.value_or(density * filled.mass));
  if (centre) m.centre = centre->cwiseProduct(fit.scale);
  if (inertia) takeMoments(m, *inertia);
  return m;
}

void DynObjectNode::onEnter(Scene& scene) {
  ObjectNode::onEnter(scene);
  hooked_.clear();
  for (const std::string& name : body_.hooks)
    if (const NodeRef field = scene.resolve(name, self()); field.valid()) hooked_.push_back(field);
}

std::vector<DynObjectNode::Request> DynObjectNode::takeRequests() {
  return std::exchange(requests_, {});
}

void DynObjectNode::ask(Request request) {
  if (!simulation_.asking) return;  // nobody would ever take it
  requests_.push_back(std::move(request));
  simulation_.asking->push_back(self());
}

void DynObjectNode::receive(const Message& m, FrameContext& frame) {
  const Nanoseconds when = frame.effective(m);
  const auto argument = [&](std::size_t i) { return m.arguments.size() > i ? m.arguments[i] : "wand"; };
  switch (m.verb) {
  case Verb::Hook:
  case Verb::Unhook: {
    if (!m.node.valid()) return;
    const bool hook = m.verb == Verb::Hook;
    std::erase(hooked_, m.node);
    if (hook) hooked_.push_back(m.node);
    ask({when, hook ? Request::Kind::Hook : Request::Kind::Unhook, m.node, {}});
    break;
  }
  case Verb::Grab: ask({when, Request::Kind::Grab, {}, argument(0)}); break;
  case Verb::Attach: ask({when, Request::Kind::Grab, {}, argument(1)}); break;  // to the hand, as a body
  case Verb::Release:
  case Verb::Detach: ask({when, Request::Kind::Release, {}, {}}); break;
  case Verb::Reset:
    restoreHooks(when, frame.scene);
    ask({when, Request::Kind::Reset, {}, {}});
    ObjectNode::receive(m, frame);
    break;
  default: ObjectNode::receive(m, frame); break;
  }
  if (simulation_.asking) frame.scene.wakeNow(simulation_.dynamics);
}

void DynObjectNode::restoreHooks(Nanoseconds when, Scene& scene) {
  // As at the start: the hooks of the script.
  for (const NodeRef field : hooked_) ask({when, Request::Kind::Unhook, field, {}});
  hooked_.clear();
  for (const std::string& name : body_.hooks)
    if (const NodeRef field = scene.resolve(name, self()); field.valid()) {
      hooked_.push_back(field);
      ask({when, Request::Kind::Hook, field, {}});
    }
}

template <class Self, class Fields>
void DynObjectNode::fields(Self& self, Fields& f) {
  ObjectNode::fields(self, f);
  f("hooked", self.hooked_);
  auto& s = self.state_;
  f("centre of mass", s.p), f("attitude", s.q), f("velocity", s.v), f("angular velocity", s.omega);
  f("angular momentum", s.L), f("mode", s.mode), f("clock", s.clock), f("clock rest", s.clockRest);
  f.kept("pose", s.pose), f.kept("flight", s.flight), f.kept("arcs", s.arcs);
  f.kept("requests", self.requests_);
}

void DynObjectNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void DynObjectNode::state(StateFields& f) {
  fields(*this, f);
}

}  // namespace stadion
