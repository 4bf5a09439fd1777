#pragma once
/// Keeps Xlib from ending the process when its connection breaks: the X server has ended or was restarted, or
/// a user has killed a window (xkill).
///
/// Xlib would call exit() then, while other threads of the program run. This class records the loss and goes
/// on. The windows are dead, but stages can stop and files can be written.
///
/// Threads  watchXConnection() and Xlib's calls on the main thread; xConnectionLost() any.
/// Errors   libX11 before 1.7 cannot be kept from it, and still ends the process.

#include <optional>
#include <string>

namespace stadion {

/// Starts watching this connection. `display` is Xlib's Display; null (another window system) does nothing.
void watchXConnection(void* display);

/// Returns why windows can no longer be shown; nothing while they can. It holds for the whole process, as
/// Xlib's handlers do: a room that has lost one screen is not shown any more.
std::optional<std::string> xConnectionLost();

/// While it lasts, errors that an X server reports are only noted: for requests that may be refused. Wait for
/// the answer to the last request (XSync) before it ends.
class IgnoredXErrors {
public:
  IgnoredXErrors();
  ~IgnoredXErrors();
  IgnoredXErrors(const IgnoredXErrors&) = delete;
  IgnoredXErrors& operator=(const IgnoredXErrors&) = delete;

  bool any() const;
};

}  // namespace stadion
