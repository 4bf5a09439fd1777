#include "show/view/view_controls.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kLookPerPixel = 0.004;   ///< [rad]
constexpr double kHandPerPixel = 0.0025;  ///< [m]
constexpr double kHandPerNotch = 0.06;    ///< [m]
constexpr double kPadLook = 1.6;          ///< at full deflection [rad/s]
constexpr double kPadSlack = 0.12;        ///< a stick let go is not quite at 0

constexpr Key letter(char c) {
  return static_cast<Key>(c);
}

double beyondSlack(float axis) {
  const double a = static_cast<double>(axis);
  return std::fabs(a) < kPadSlack ? 0 : a;
}

}  // namespace

void ViewControls::take(const WindowEvent& event) {
  moved_ = {};
  switch (event.kind) {
  case WindowEvent::Kind::Key: key(event.key, event.down); break;
  case WindowEvent::Kind::Button:
    shift_ = event.shift;
    if (event.down)
      held_.insert(event.button);
    else
      held_.erase(event.button);
    if (event.button < 4) visitor_.setButton(event.button, event.down);
    break;
  case WindowEvent::Kind::Move: moved(event.x, event.y); break;
  case WindowEvent::Kind::Wheel: visitor_.moveHand({0, kHandPerNotch * event.y, 0}); break;
  case WindowEvent::Kind::PointerEntered: pointer_.reset(); break;
  case WindowEvent::Kind::FocusLost:
    keys_.clear();
    held_.clear();
    visitor_.letGo();
    break;
  case WindowEvent::Kind::KeyRepeat:
  case WindowEvent::Kind::Close: break;
  }
}

void ViewControls::key(Key key, bool down) {
  if (down)
    keys_.insert(key);
  else
    keys_.erase(key);
  if (key >= letter('1') && key <= letter('4'))
    visitor_.setButton(static_cast<std::uint32_t>(key) - '1', down);
  if (key == Key::Home && down) visitor_.reset();
  walk();
}

void ViewControls::walk() {
  const auto both = [&](Key plus, Key minus) {
    return (keys_.contains(plus) ? 1.0 : 0.0) - (keys_.contains(minus) ? 1.0 : 0.0);
  };
  visitor_.setAxis(0, both(letter('D'), letter('A')));
  visitor_.setAxis(1, both(letter('W'), letter('S')));
  visitor_.setStep({both(Key::Right, Key::Left), both(Key::Up, Key::Down), both(Key::PageUp, Key::PageDown)});
}

void ViewControls::moved(double x, double y) {
  const std::array<double, 2> before = pointer_.value_or(std::array<double, 2>{x, y});
  pointer_ = {x, y};
  moved_ = {x - before[0], y - before[1]};
  const double right = moved_[0], up = -moved_[1];
  if (turnsCamera_) return;
  if (held_.empty())
    visitor_.turn(kLookPerPixel * right, kLookPerPixel * up);
  else
    visitor_.moveHand(kHandPerPixel * (shift_ ? Vec3(right, up, 0) : Vec3(right, 0, up)));
}

void ViewControls::take(const std::optional<GamepadState>& pad, double seconds) {
  if (!pad) return;
  std::array<double, kTrackerAxes> axes{};
  axes[0] = beyondSlack(pad->axes[0]);
  axes[1] = -beyondSlack(pad->axes[1]);
  visitor_.setGamepad(axes, pad->buttons & 15u);
  visitor_.turn(kPadLook * seconds * beyondSlack(pad->axes[2]),
                -kPadLook * seconds * beyondSlack(pad->axes[3]));
}

}  // namespace stadion
