#pragma once
/// `timer`: posts timesup when its period is over, once or again and again.
///
/// Events    timesup, at the exact time.
/// Commands  enable (starts it anew), disable, toggle, reset.
/// It is not visited while it waits.

#include "engine/nodes/switched.h"
#include "engine/scene/node.h"

namespace stadion {

class TimerNode : public Node {
public:
  TimerNode(NodeRef self, std::string name, Nanoseconds period, bool repeat, bool on)
      : Node(NodeKind::Timer, self, std::move(name)), period_(period), repeat_(repeat), switch_(on) {}

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
  Switched switch_;
  Nanoseconds due_ = 0;
};

}  // namespace stadion
