#pragma once
/// Windows: they show pictures, and provide the input of keys, mouse and gamepad.
///
/// Units    pixels; (0, 0) is the upper left corner of a window's content.
/// Threads  the main thread makes the system and its windows, asks them for events and destroys them, as
///          window systems require, and uses their pixels. A window's context may be current on any one
///          thread.
/// Errors   Without a display, open() says so, and what to do. If the display is lost while windows are
///          shown, lost() says so; all other calls then do nothing.

#include "pipeline/target/monitor_rows.h"
#include "pipeline/target/swap_group.h"
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
  /// KeyRepeat: a key is still held down, and the window system repeats it.
  enum class Kind { Key, KeyRepeat, Button, Move, Wheel, PointerEntered, FocusLost, Close };
  Kind kind = Kind::Key;
  Key key = Key::Unknown;    ///< the key; for Key and KeyRepeat
  std::uint32_t button = 0;  ///< the button; for Button: 0 left, 1 right, 2 middle
  bool down = false;         ///< pressed, else released; for Key and Button
  bool shift = false;        ///< the shift key was held; for Key, KeyRepeat, Button and Wheel
  bool control = false;      ///< the control key was held; for Key and KeyRepeat
  double x = 0, y = 0;       ///< for Move: the pointer's place; for Wheel: the rotation, y away from the user
};

/// How pictures get into a window.
enum class WindowSurface {
  OpenGl,  ///< through an OpenGL context
  Pixels,  ///< from memory: no OpenGL library is loaded. Only X servers have such windows
};

struct WindowPlan {
  std::string title;
  /// The way of pictures into the window. Without an X server, and with `quadBuffer`, it is always OpenGl.
  WindowSurface surface = WindowSurface::OpenGl;
  std::uint32_t width = 800, height = 600;  ///< size of the content; a full screen has the monitor's size
  bool frame = true;                        ///< a title bar, and edges for resizing
  bool placed = false;                      ///< at x, y of the screen, or of the named monitor
  std::int32_t x = 0, y = 0;
  std::string monitor;        ///< name of the monitor, or its number from 1; empty = any
  bool fullscreen = false;    ///< alone on its monitor
  std::uint32_t refresh = 0;  ///< refresh rate of a full screen [1/s]; 0 = unchanged
  bool pointer = true;        ///< shows the mouse pointer over it
  bool quadBuffer = false;    ///< a left and a right back buffer
};

/// The OpenGL context of a window. Draw the content to its framebuffer 0, then show it with swap().
class WindowContext : public Target {
public:
  /// Shows the drawn picture. Expects that it is current here.
  virtual void swap() = 0;
  /// Sets whether swap() waits for the display's next picture. Expects that it is current here.
  virtual void waitForDisplay(bool wait) = 0;

protected:
  using Target::Target;
};

/// Rows of pixels from the top, without padding; each is 0xAARRGGBB with an alpha of 255.
struct PixelRows {
  std::uint32_t* first = nullptr;
  std::uint32_t width = 0, height = 0;

  std::uint32_t* row(std::uint32_t y) const { return first + std::size_t{y} * width; }
};

/// The content of a window without OpenGL.
class WindowPixels {
public:
  virtual ~WindowPixels() = default;
  WindowPixels() = default;
  WindowPixels(const WindowPixels&) = delete;
  WindowPixels& operator=(const WindowPixels&) = delete;

  /// Returns memory for the next content, of that size. What stands in it is void. It waits until the window
  /// system has read the last content.
  virtual PixelRows begin(std::uint32_t width, std::uint32_t height) = 0;
  /// Shows what was written into that memory.
  virtual void show() = 0;
};

class Window {
public:
  virtual ~Window() = default;
  Window() = default;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Null for a window without OpenGL.
  virtual WindowContext* context() = 0;
  /// Null for a window with OpenGL.
  virtual WindowPixels* pixels() = 0;
  /// Returns the current size of its content.
  virtual std::array<std::uint32_t, 2> size() const = 0;
  /// Returns the events since the last call.
  virtual std::vector<WindowEvent> takeEvents() = 0;
  virtual void setTitle(const std::string& title) = 0;
  /// Returns the current parts of its content on monitors. If the window system gives no position, the
  /// content begins in a monitor's top row.
  virtual std::vector<MonitorPart> monitorParts() const = 0;
};

/// The state of a gamepad, laid out like that of an Xbox.
struct GamepadState {
  std::array<float, 6> axes{};  ///< left x, y, right x, y (down is positive), triggers; from -1 to 1
  std::uint32_t buttons = 0;    ///< bits: A, B, X, Y, left and right bumper
};

/// A connection to a window system. While it lasts, the screen saver and DPMS wait (screen_saver.h).
class WindowSystem {
public:
  virtual ~WindowSystem() = default;

  /// Connects to the display that the environment names, or to `screen` (":0.1") of it. Several connections
  /// may be open.
  static Result<std::unique_ptr<WindowSystem>> open(const std::string& screen = {});

  virtual Result<std::unique_ptr<Window>> create(const WindowPlan& plan) = 0;
  /// Lets the driver swap these windows together (swap_group.h). Expects windows with OpenGL of this connection,
  /// which outlive the group.
  virtual Result<std::unique_ptr<SwapGroup>> joinSwapGroup(const std::vector<Window*>& windows,
                                                           bool barrier) = 0;
  /// Processes new events.
  virtual void poll() = 0;
  /// Returns why its windows can no longer be shown; nothing while they can.
  virtual std::optional<std::string> lost() const = 0;
  /// Returns the first gamepad; nothing if there is none.
  virtual std::optional<GamepadState> gamepad() = 0;
  /// Returns why its displays may go dark during a show, and what to do; nothing if they are kept lit.
  virtual std::optional<std::string> mayGoDark() const = 0;
  /// Returns names such as "HDMI-1 (1920 x 1080)", in the order of their numbers.
  virtual std::vector<std::string> monitors() = 0;
  /// Describes how windows without OpenGL get their pictures, such as "shared memory", or says why there are
  /// none.
  virtual Result<std::string> pixelsWay() = 0;
};

}  // namespace stadion
