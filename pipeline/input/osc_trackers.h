#pragma once
/// Trackers that send Open Sound Control messages over UDP.
///
///     /tracker/NAME/pose    x y z  qx qy qz qw    [the rig file's unit], unit quaternion
///     /tracker/NAME/button  i down                i from 1 to 32, down 1 or 0
///     /tracker/NAME/axis    i value               i from 0 to 7, value from -1 to 1
///
/// Numbers may be of any OSC type. A bundle's time tag, if it has one, says when something was measured, by
/// the sender's clock: it orders and spaces measurements better than their arrival does.
///
/// Threads  the server's own.
/// Errors   whatever comes that is none of these is counted and told of once.

#include "pipeline/input/live_trackers.h"
#include "pipeline/input/osc_server.h"

namespace stadion {

/// A sender's clock in terms of ours: the least delay seen is taken for none. Forgets by 1 ms a second, so
/// that clocks that drift apart are followed.
class SenderClock {
public:
  Nanoseconds ours(Nanoseconds sent, Nanoseconds arrived);

private:
  bool known_ = false;
  Nanoseconds offset_ = 0, at_ = 0;
};

class OscTrackers {
public:
  /// Hears of nothing but what take() is given. The trackers must outlive it.
  explicit OscTrackers(LiveTrackers& trackers) : trackers_(trackers) {}
  /// One that listens. Fails if the port is taken.
  static Result<std::unique_ptr<OscTrackers>> open(std::uint16_t port, LiveTrackers& trackers);

  /// Of one that listens.
  std::uint16_t port() const { return server_->port(); }
  void take(const OscMessage& m);
  /// Messages that were no measurements, packets that were no messages.
  std::uint64_t misunderstood() const { return misunderstood_ + (server_ ? server_->malformed() : 0); }

private:
  bool understood(std::string_view tracker, std::string_view what, const OscMessage& m, Nanoseconds clock);

  LiveTrackers& trackers_;
  SenderClock clock_;
  std::atomic<std::uint64_t> misunderstood_ = 0;
  std::unique_ptr<OscServer> server_;  ///< the last one: its thread uses the others
};

}  // namespace stadion
