#include "engine/nodes/cue_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/core/state_fields.h"
#include "engine/input/input_sample.h"
#include "engine/input/operator_device.h"
#include "engine/input/tracker_names.h"
#include "engine/scene/scene.h"

namespace stadion {

void CueNode::press(bool down, Nanoseconds time) {
  if (down && !down_ && switch_.on()) raise("called", time);
  down_ = down;
}

void CueNode::receive(const Message& m, FrameContext&) {
  switch_.apply(m);
}

void CueNode::simulate(FrameContext& frame) {
  const TrackerSample* t = frame.input.find(kOperatorTracker);
  const std::uint32_t bit = 1U << (number_ - 1);
  if (t)
    for (const ControlKnot& knot : t->controls)
      if (knot.time > frame.start() && knot.time < frame.now.time)
        press((knot.buttons & bit) != 0, knot.time);
  press(t && t->hasControls() && (t->buttons & bit) != 0, frame.now.time);
}

template <class Self, class Fields>
void CueNode::fields(Self& self, Fields& f) {
  f("switch", self.switch_), f("down", self.down_);
}

void CueNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void CueNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

std::unique_ptr<Node> makeCue(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  return std::make_unique<CueNode>(r.self, r.name, static_cast<std::uint32_t>(d.number("number")),
                                   std::string(d.text("label")), d.flag("initstate"));
}

constexpr AttributeSpec kCueRows[] = {
    {.name = "number",
     .kind = ValueKind::Whole,
     .help = "how the operator calls it; cues with the same number are called together",
     .range = {1, OperatorDevice::kMostCues},
     .required = true},
    {.name = "label", .kind = ValueKind::Words, .help = "what the operator reads beside the number"},
    kInitStateRow,
};

constexpr EventSpec kCueEvents[] = {{"called", "the operator has called the cue's number"}};

}  // namespace

constinit const NodeType kCueType{
    .name = "cue",
    .help = "posts an event when the operator calls its number",
    .attributes = kCueRows,
    .events = kCueEvents,
    .traits = {Trait::Switched},
    .make = makeCue,
    .lint = lintSender,
};

namespace node_types {

void addCueNode(NodeRegistrar& types) {
  types.add(kCueType);
}

}  // namespace node_types

}  // namespace stadion
