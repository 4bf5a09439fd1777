#include "engine/nodes/timer_node.h"

#include "engine/core/state_fields.h"
#include "engine/scene/scene.h"

namespace stadion {

void TimerNode::startAt(Nanoseconds when, Scene& scene) {
  due_ = when + period_;
  scene.wakeAt(due_, self());
}

void TimerNode::onEnter(Scene& scene) {
  if (switch_.on()) startAt(scene.now(), scene);
}

void TimerNode::receive(const Message& m, FrameContext& frame) {
  if (switch_.obey(m) && switch_.on()) startAt(frame.effective(m), frame.scene);
}

void TimerNode::simulate(FrameContext& frame) {
  while (switch_.on() && due_ <= frame.now.time) {
    raise(Event::TimesUp, due_);
    if (repeat_)
      due_ += period_;
    else
      switch_.set(false);
  }
  if (switch_.on()) frame.scene.wakeAt(due_, self());
}

template <class Self, class Fields>
void TimerNode::fields(Self& self, Fields& f) {
  f("switch", self.switch_), f("due", self.due_);
}

// It never misses a frame: one that is overdue would make up for ever so many.
bool TimerNode::resume(Scene& scene) {
  return !switch_.on() || due_ > scene.now();
}

void TimerNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void TimerNode::state(StateFields& f) {
  fields(*this, f);
}

}  // namespace stadion
