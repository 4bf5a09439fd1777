#pragma once
/// Keeps the displays of a show from going dark while nobody touches keyboard and mouse.
///
/// X11      the server is asked to suspend its screen saver and DPMS (XScreenSaverSuspend, libXss). The
/// server
///          itself ends that when the connection ends, also if the program was killed. The user's time-outs
///          are never changed. Once in some seconds the idle time is reset as well, for screen savers that
///          are programs; without libXss that is all, and once a second. What is dark already is lit.
/// Desktop  the session bus is asked too (org.freedesktop.ScreenSaver), for those that go by it, such as
/// GNOME
///          and KDE on Wayland. Their inhibition ends with the connection as well.
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
  /// From now on until it is destroyed. `display` is Xlib's Display; null: another window system.
  explicit ScreenSaverPause(void* display);
  ~ScreenSaverPause();
  ScreenSaverPause(const ScreenSaverPause&) = delete;
  ScreenSaverPause& operator=(const ScreenSaverPause&) = delete;

  /// From time to time while windows are shown, at least once a second.
  void poll(std::chrono::steady_clock::time_point now);
  /// GLFW sets the time-outs to never when a window fills a monitor, which would outlive a program that is
  /// killed. After each such moment: the user's own are set again.
  void restoreTimeouts();
  /// What could not be had, and what to do; nothing if all is well.
  const std::optional<std::string>& shortcoming() const { return shortcoming_; }

private:
  struct X;
  std::unique_ptr<X> x_;
  SessionInhibition desktop_;
  std::optional<std::string> shortcoming_;
  std::chrono::steady_clock::time_point due_{};
};

}  // namespace stadion
