#include "engine/node.h"

#include "engine/scene/scene.h"

namespace stadion {
namespace {

/// Tells the probe, if there is one, when a phase of a node begins and ends.
class PhaseSpan {
public:
  PhaseSpan(FrameProbe* probe, NodeRef node, NodePhase phase) : probe_(probe), node_(node), phase_(phase) {
    if (probe_) probe_->nodePhaseBegan(node_, phase_);
  }
  ~PhaseSpan() {
    if (probe_) probe_->nodePhaseEnded(node_, phase_);
  }
  PhaseSpan(const PhaseSpan&) = delete;
  PhaseSpan& operator=(const PhaseSpan&) = delete;

private:
  FrameProbe* probe_;
  NodeRef node_;
  NodePhase phase_;
};

}  // namespace

void Node::begin(std::span<const Message> inbox, FrameContext& frame, FrameProbe* probe) {
  {
    const PhaseSpan span(probe, self_, NodePhase::Receive);
    for (const Message& m : inbox) receive(m, frame);
  }
  const PhaseSpan span(probe, self_, NodePhase::Simulate);
  simulate(frame);
}

void Node::compute(FrameProbe* probe) {
  const PhaseSpan span(probe, self_, NodePhase::Simulate);
  simulateApart();
}

void Node::conclude(FrameContext& frame, FrameProbe* probe) {
  const PhaseSpan span(probe, self_, NodePhase::Dispatch);
  afterSimulation(frame);
  dispatch(frame);
}

bool Node::awaits(const Node&, const Scene&) const {
  return true;
}

void Node::dispatch(FrameContext& frame) {
  for (const Raised& r : raised_) {
    frame.scene.note(self_, r.event, r.when, r.figure);
    for (const Notification& n : notifications_)
      if (n.event == r.event) frame.scene.post(*this, n, r.when);
  }
  raised_.clear();
}

}  // namespace stadion
