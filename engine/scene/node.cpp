#include "engine/scene/node.h"

#include "engine/scene/scene.h"

namespace stadion {
void Node::begin(std::span<const Message> inbox, FrameContext& frame, FrameProbe* probe) {
  {
    const SpanScope span(probe, Span::Receive, self_);
    for (const Message& m : inbox) receive(m, frame);
  }
  const SpanScope span(probe, Span::Simulate, self_);
  simulate(frame);
}

void Node::compute(FrameProbe* probe) {
  const SpanScope span(probe, Span::Simulate, self_);
  simulateApart();
}

void Node::conclude(FrameContext& frame, FrameProbe* probe) {
  const SpanScope span(probe, Span::Dispatch, self_);
  afterSimulation(frame);
  dispatch(frame);
}

bool Node::awaits(const Node&, const Scene&) const {
  return true;
}

void Node::dispatch(FrameContext& frame) {
  for (const Raised& r : raised_) {
    frame.scene.note(self_, r.event, r.when, r.value);
    for (const Notification& n : notifications_)
      if (n.event == r.event) frame.scene.post(*this, n, r.when);
  }
  raised_.clear();
}

}  // namespace stadion
