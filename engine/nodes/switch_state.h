#pragma once
/// Something that is on or off, and may switch itself off after a while.
///
/// Commands  enable, disable, toggle, reset.

#include "engine/core/message.h"

namespace stadion {

class SwitchState {
public:
  explicit SwitchState(bool initially) : initially_(initially), on_(initially) {}

  bool on() const { return on_; }
  bool initially() const { return initially_; }
  void set(bool on) { on_ = on; }

  /// Applies m if it is a command for a switch. Returns true if the state may have changed.
  bool apply(const Message& m) {
    switch (m.command) {
    case CommandId::Enable: on_ = true; return true;
    case CommandId::Disable: on_ = false; return true;
    case CommandId::Toggle: on_ = !on_; return true;
    case CommandId::Reset: on_ = initially_; return true;
    default: return false;
    }
  }

  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("on", self.on_);
  }

private:
  bool initially_, on_;
};

}  // namespace stadion
