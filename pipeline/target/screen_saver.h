#pragma once
/// Keeps the displays of a show from going dark while keyboard and mouse are idle.
///
/// X11      The server is asked to suspend its screen saver and DPMS (XScreenSaverSuspend, libXss). The
///          server itself ends that with the connection, also if the program was killed. The user's time-outs
///          are never changed. The idle time is also reset every few seconds, for screen savers that are
///          programs; without libXss this is the only measure, once a second. A display that is dark already
///          is lit.
/// Desktop  The session bus is asked too (org.freedesktop.ScreenSaver), for desktops that use it, such as
///          GNOME and KDE on Wayland. This inhibition ends with the connection as well.
///
/// Threads  the main thread alone.

#include "pipeline/target/session_bus.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace stadion {

class ScreenSaverPause {
public:
  /// Works from now on until it is destroyed. `display` is Xlib's Display; null: another window system.
  explicit ScreenSaverPause(void* display);
  ~ScreenSaverPause();
  ScreenSaverPause(const ScreenSaverPause&) = delete;
  ScreenSaverPause& operator=(const ScreenSaverPause&) = delete;

  /// Call it while windows are shown, at least once a second.
  void poll(std::chrono::steady_clock::time_point now);
  /// Restores the user's time-outs. GLFW sets them to never when a window fills a monitor, and this would
  /// outlive a program that is killed. Call it after each such moment.
  void restoreTimeouts();
  /// Returns a measure that failed, and what to do; nothing if all is well.
  const std::optional<std::string>& shortcoming() const { return shortcoming_; }

private:
  struct X;
  std::unique_ptr<X> x_;
  SessionInhibition desktop_;
  std::optional<std::string> shortcoming_;
  std::chrono::steady_clock::time_point due_{};
};

}  // namespace stadion
