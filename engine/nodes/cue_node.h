#pragma once
/// `cue`: a place of the show that the operator can call, by its number.
///
/// Events    called, when the operator calls the number; the time is the end of the frame that takes the command.
/// Commands  enable, disable, toggle, reset. A disabled cue posts nothing.
///
/// The call comes with the input, as a button of the tracker `operator` (engine/input/operator_device.h). So a recorded
/// show calls it again in the same frame.

#include "engine/nodes/switch_state.h"
#include "engine/scene/node.h"

#include <cstdint>
#include <string>

namespace stadion {

extern const NodeType kCueType;

class CueNode : public Node {
public:
  CueNode(NodeRef self, std::string name, std::uint32_t number, std::string label, bool on)
      : Node(kCueType, self, std::move(name)), number_(number), label_(std::move(label)), switch_(on) {}

  std::uint32_t number() const { return number_; }
  const std::string& label() const { return label_; }

  Rank rank() const override { return Rank::Sensing; }
  bool busy() const override { return true; }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);

protected:
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  void press(bool down, Nanoseconds time);

  std::uint32_t number_;  ///< from 1
  std::string label_;     ///< for the operator
  SwitchState switch_;
  bool down_ = false;  ///< the operator's button was down at the end of the frame before
};

}  // namespace stadion
