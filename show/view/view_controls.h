#pragma once
/// From keys, mouse and gamepad to what a visitor at a desk does.
///
/// Threads  main.

#include "pipeline/device/desk_visitor.h"
#include "pipeline/target/window.h"

#include <array>
#include <optional>
#include <set>

namespace stadion {

class ViewControls {
public:
  explicit ViewControls(DeskVisitor& visitor) : visitor_(visitor) {}

  void take(const WindowEvent& event);
  void take(const std::optional<GamepadState>& pad, double seconds);
  /// How far the pointer went with the last event: right, down [pixels].
  std::array<double, 2> lastMove() const { return moved_; }
  /// While it does, moving the pointer is nothing to the visitor.
  void turnCamera(bool turns) { turnsCamera_ = turns; }
  bool turnsCamera() const { return turnsCamera_; }

private:
  void key(Key key, bool down);
  void moved(double x, double y);
  void walk();

  DeskVisitor& visitor_;
  std::set<Key> keys_;
  std::set<std::uint32_t> held_;  ///< mouse buttons
  std::optional<std::array<double, 2>> pointer_;
  std::array<double, 2> moved_{};
  bool shift_ = false, turnsCamera_ = false;
};

}  // namespace stadion
