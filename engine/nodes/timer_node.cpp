/// `timer`: posts timesup when its period is over, once or again and again.
///
/// Events    timesup, at the exact time.
/// Commands  enable (restarts it), disable, toggle, reset.
/// It is not visited while it waits.

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/core/state_fields.h"
#include "engine/nodes/switch_state.h"
#include "engine/scene/node.h"
#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {

extern const NodeType kTimerType;

namespace {

class TimerNode : public Node {
public:
  TimerNode(NodeRef self, std::string name, Nanoseconds period, bool repeat, bool on)
      : Node(kTimerType, self, std::move(name)), period_(period), repeat_(repeat), switch_(on) {}

  Rank rank() const override { return Rank::Sensing; }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  bool resume(Scene& scene) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);

protected:
  void onEnter(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  void startAt(Nanoseconds when, Scene& scene);

  Nanoseconds period_;  ///< > 0
  bool repeat_;
  SwitchState switch_;
  Nanoseconds due_ = 0;
};

void TimerNode::startAt(Nanoseconds when, Scene& scene) {
  due_ = when + period_;
  scene.schedule().wakeAt(due_, self());
}

void TimerNode::onEnter(Scene& scene) {
  if (switch_.on()) startAt(scene.now(), scene);
}

void TimerNode::receive(const Message& m, FrameContext& frame) {
  if (switch_.apply(m) && switch_.on()) startAt(frame.effective(m), frame.scene);
}

void TimerNode::simulate(FrameContext& frame) {
  while (switch_.on() && due_ <= frame.now.time) {
    raise("timesup", due_);
    if (repeat_)
      due_ += period_;
    else
      switch_.set(false);
  }
  if (switch_.on()) frame.scene.schedule().wakeAt(due_, self());
}

template <class Self, class Fields>
void TimerNode::fields(Self& self, Fields& f) {
  f("switch", self.switch_), f("due", self.due_);
}

// A timer never misses a frame. An overdue one is damaged, and might post events without end.
bool TimerNode::resume(Scene& scene) {
  return !switch_.on() || due_ > scene.now();
}

void TimerNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void TimerNode::state(StateFields& f) {
  fields(*this, f);
}

std::unique_ptr<Node> makeTimer(const NodeRequest& r) {
  const Nanoseconds period = std::max<Nanoseconds>(1, fromSeconds(r.declaration.number("period")));
  return std::make_unique<TimerNode>(r.self, r.name, period, r.declaration.flag("repeat"),
                                     r.declaration.flag("initstate"));
}

constexpr AttributeSpec kTimerRows[] = {
    {.name = "period",
     .kind = ValueKind::Number,
     .help = "time from being enabled to the event",
     .unit = "s",
     .range = {1e-3, kLong},
     .required = true},
    {.name = "repeat",
     .kind = ValueKind::Flag,
     .help = "whether it starts again after the event",
     .standard = "off"},
    kInitStateRow,
};

constexpr EventSpec kTimerEvents[] = {{"timesup", "the timer's period is over"}};

}  // namespace

constinit const NodeType kTimerType{
    .name = "timer",
    .help = "posts an event after a time",
    .attributes = kTimerRows,
    .events = kTimerEvents,
    .traits = {Trait::Switched},
    .make = makeTimer,
    .lint = lintSender,
};

namespace node_types {

void addTimerNode(NodeRegistrar& types) {
  types.add(kTimerType);
}

}  // namespace node_types

}  // namespace stadion
