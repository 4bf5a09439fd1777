#pragma once
/// Tells the service manager how a show is: that it plays, that frames are still finished, that it ends.
///
/// The protocol is that of sd_notify(3): lines NAME=VALUE in a datagram to a socket that the manager names in
/// the environment. A manager with a watchdog restarts a service that is silent for too long. So pictureShown()
/// is the only function that pings while a show plays: if no frame is finished, the pings stop.
///
///     const auto address = ServiceAddress::ofEnvironment();         // main(), before any thread
///     auto service = ServiceNotifier::open(address);                // null: no manager asks
///     service->pictureShown("plays kick.evs");                      // READY=1 with the first picture
///
/// Units    nanoseconds of machineClock().
/// Threads  pictureShown() and alive() from any thread; all others one at a time. No function waits: a manager
///          that does not read loses lines. READY=1 is sent again until it has arrived.
/// Errors   open() returns null if the address is none. A line that cannot be sent is left out.
/// Sources  sd_notify(3), sd_watchdog_enabled(3), systemd 252.

#include "engine/base/file_descriptor.h"
#include "pipeline/supervision/shared_progress.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>

namespace stadion {

/// Where the service manager listens, and how often it wants to hear from this process.
struct ServiceAddress {
  std::string socket;        ///< a path, or "@name" of an abstract socket; empty: no manager asks
  Nanoseconds watchdog = 0;  ///< longest silence before it restarts this process [ns]; 0: it has no watchdog

  /// NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID. A watchdog of another process does not count. Removes them,
  /// so that programs that are started later do not speak for this one. Expects that there are no other threads.
  static ServiceAddress ofEnvironment();
};

class ServiceNotifier {
public:
  /// The watchdog's limit is so many times as long while a show opens, or waits for files.
  static constexpr int kLonger = 12;
  /// Pings in the time of one limit. Two may be lost.
  static constexpr int kPings = 4;

  using Clock = Nanoseconds (*)();
  /// Null if the address has no socket, or one that is none.
  static std::unique_ptr<ServiceNotifier> open(const ServiceAddress& address, Clock clock = machineClock);

  /// A frame is finished. The first one makes the service ready, later ones ping, as far as pings are due.
  /// `status` stands beside READY=1.
  void pictureShown(const std::string& status);
  /// Pings, if that is due, though no frame was finished: another limit is watched meanwhile.
  void alive();
  /// What the show does, for `systemctl status`. The same text is not sent twice.
  void status(const std::string& text);
  /// True: pictures may fail to come for longer, because a show opens or waits for files. False: the next
  /// picture ends that.
  void mayPause(bool may);
  /// The process is about to end.
  void stopping();

  /// Returns true once the manager has been told that the service is ready.
  bool isReady() const { return ready_; }

private:
  ServiceNotifier(FileDescriptor socket, std::string address, Nanoseconds watchdog, Clock clock)
      : socket_(std::move(socket)), address_(std::move(address)), watchdog_(watchdog), clock_(clock) {}
  bool send(const std::string& lines) const;
  std::string limitLine(int times) const;

  FileDescriptor socket_;
  std::string address_;  ///< as the system takes it: an abstract name begins with a zero byte
  Nanoseconds watchdog_;
  Clock clock_;
  std::atomic<bool> ready_ = false, pauses_ = false, longer_ = false;
  std::atomic<Nanoseconds> pinged_ = 0;  ///< when the last ping was sent
  std::string status_;
  bool stopping_ = false;  ///< the manager has been told
};

}  // namespace stadion
