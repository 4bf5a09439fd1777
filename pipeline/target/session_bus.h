#pragma once
/// Asks the desktop, over the D-Bus session bus, not to go idle (org.freedesktop.ScreenSaver.Inhibit).
///
/// It starts no service. Without a bus, without libdbus, or without a desktop that offers this, it does
/// nothing. The desktop ends the inhibition with the connection, also if the program was killed.
///
/// Threads  one at a time.

#include <memory>

namespace stadion {

class SessionInhibition {
public:
  /// Waits for the answer, half a second at most.
  SessionInhibition();
  ~SessionInhibition();
  SessionInhibition(const SessionInhibition&) = delete;
  SessionInhibition& operator=(const SessionInhibition&) = delete;

  /// Returns true if a desktop has agreed.
  bool granted() const { return bus_ != nullptr; }

private:
  struct Bus;
  std::unique_ptr<Bus> bus_;
};

}  // namespace stadion
