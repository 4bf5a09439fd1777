#pragma once
/// Windows: where pictures are shown, and where keys, mouse and gamepad come from.
///
/// Units    pixels; (0, 0) is the upper left corner of a window's content.
/// Threads  the system and its windows are made, asked for events and destroyed on the main thread, as window
///          systems want it. A window's context may be current on any one thread.
/// Errors   where there is no display open() says so, and what to do. A display that goes while windows are
///          shown is told by lost(); all that is asked of them then does nothing.

#include "pipeline/target/monitor_rows.h"
#include "pipeline/target/target.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stadion {

/// Letters, digits and punctuation are their ASCII code, letters as capitals: static_cast<Key>('W').
enum class Key : std::uint32_t {
  Unknown = 0,
  Space = 32,
  Escape = 256,
  Enter,
  Tab,
  Backspace,
  Left,
  Right,
  Up,
  Down,
  PageUp,
  PageDown,
  Home,
  F1,
  F2,
  F3,
  F4,
  F5,
  F6,
  F7,
  F8,
  F9,
  F10,
  F11,
  F12,
};

struct WindowEvent {
  enum class Kind { Key, Button, Move, Wheel, PointerEntered, FocusLost, Close };
  Kind kind = Kind::Key;
  Key key = Key::Unknown;    ///< of Key
  std::uint32_t button = 0;  ///< of Button: 0 left, 1 right, 2 middle
  bool down = false;         ///< of Key and Button: pressed, else let go
  bool shift = false;        ///< of Key, Button and Wheel: held meanwhile
  double x = 0, y = 0;  ///< of Move: where the pointer is; of Wheel: how far it was turned, y away from one
};

struct WindowPlan {
  std::string title;
  std::uint32_t width = 800, height = 600;  ///< of the content; of a full screen as the monitor has it
  bool frame = true;                        ///< a title bar, and edges to pull
  bool placed = false;                      ///< at x, y of the screen, or of the monitor if one is named
  std::int32_t x = 0, y = 0;
  std::string monitor;        ///< its name, or its number from 1; empty = any
  bool fullscreen = false;    ///< alone on its monitor
  std::uint32_t refresh = 0;  ///< of a full screen [1/s]; 0 = as it is
  bool pointer = true;        ///< the mouse's pointer is seen over it
  bool quadBuffer = false;    ///< a left and a right back buffer
};

/// Its content is what is drawn to framebuffer 0 of its context, then shown by swap().
class Window : public Target {
public:
  /// Shows what was drawn. Expects its context to be current here.
  virtual void swap() = 0;
  /// Whether swap() waits for the display's next picture. Expects its context to be current here.
  virtual void waitForDisplay(bool wait) = 0;
  /// How large its content is now.
  virtual std::array<std::uint32_t, 2> size() const = 0;
  /// What happened since it was asked last.
  virtual std::vector<WindowEvent> takeEvents() = 0;
  virtual void setTitle(const std::string& title) = 0;
  virtual bool quadBuffered() const = 0;
  /// Where its content lies now. Where the window system does not say, it begins in a monitor's top row.
  virtual std::vector<MonitorPart> monitorParts() const = 0;

protected:
  using Target::Target;
};

/// What a gamepad says now, laid out as that of an Xbox.
struct GamepadState {
  std::array<float, 6> axes{};  ///< left x, y, right x, y (down is positive), triggers; from -1 to 1
  std::uint32_t buttons = 0;    ///< bits: A, B, X, Y, left and right bumper
};

/// One connection to a window system. While it lasts, the screen saver and DPMS wait (screen_saver.h).
class WindowSystem {
public:
  virtual ~WindowSystem() = default;

  /// Connects to the display that the environment names, or to `screen` (":0.1") of it. Several connections
  /// may be open.
  static Result<std::unique_ptr<WindowSystem>> open(const std::string& screen = {});

  virtual Result<std::unique_ptr<Window>> create(const WindowPlan& plan) = 0;
  /// Takes in what happened.
  virtual void poll() = 0;
  /// Why its windows can no longer be shown; nothing while they can.
  virtual std::optional<std::string> lost() const = 0;
  /// The first gamepad; nothing if there is none.
  virtual std::optional<GamepadState> gamepad() = 0;
  /// Why its displays may go dark during a show, and what to do; nothing if they are kept from it.
  virtual std::optional<std::string> mayGoDark() const = 0;
  /// "HDMI-1 (1920 x 1080)", in the order in which they are numbered.
  virtual std::vector<std::string> monitors() = 0;
};

}  // namespace stadion
