#pragma once
/// Keeps Xlib from ending the process when its connection breaks: the X server has ended or was restarted, or
/// somebody has killed a window (xkill).
///
/// Xlib calls exit() then, beneath whatever the program's other threads do. With this it notes what happened
/// and goes on; the windows are dead, but stages can stop and files can be written.
///
/// Threads  watchXConnection() and Xlib's calls on the main thread; xConnectionLost() any.
/// Errors   libX11 before 1.7 cannot be kept from it, and ends the process as ever.

#include <optional>
#include <string>

namespace stadion {

/// From now on, for this connection. `display` is Xlib's Display; null (another window system) does nothing.
void watchXConnection(void* display);

/// Why windows can no longer be shown; nothing while they can. Of the whole process, as Xlib's handlers are:
/// a room whose one screen is gone is not shown any more.
std::optional<std::string> xConnectionLost();

}  // namespace stadion
