#pragma once
/// Trackers that send Open Sound Control messages over UDP.
///
///     /tracker/NAME/pose    x y z  qx qy qz qw    [the rig file's unit], unit quaternion
///     /tracker/NAME/button  i down                i from 1 to 32, down 1 or 0
///     /tracker/NAME/axis    i value               i from 0 to 7, value from -1 to 1
///
/// Numbers may be of any OSC type. A bundle's time tag, if it has one, is the time of measurement by the
/// sender's clock. It orders and spaces measurements better than their arrival does. Each sender has a clock
/// of its own, and may set it (sender_clock.h).
///
/// Threads  the server's own.
/// Errors   other messages are counted, and the first one is logged.

#include "pipeline/device/live_trackers.h"
#include "pipeline/device/osc_server.h"
#include "pipeline/device/sender_streams.h"

namespace stadion {

class OscTrackers {
public:
  /// Makes an instance without a network, which receives only what take() is given. The trackers must outlive
  /// it.
  explicit OscTrackers(LiveTrackers& trackers) : trackers_(trackers), streams_(trackers) {}
  /// Makes an instance that listens. Fails if the port is taken.
  static Result<std::unique_ptr<OscTrackers>> open(std::uint16_t port, LiveTrackers& trackers);

  /// Expects an instance that listens.
  std::uint16_t port() const { return server_->port(); }
  void take(const OscMessage& m);
  /// Returns the number of messages that were no measurements and of packets that were no messages.
  std::uint64_t misunderstood() const { return misunderstood_ + (server_ ? server_->malformed() : 0); }

private:
  static std::optional<Measurement> measurementOf(std::string_view what, std::span<const double> numbers);

  LiveTrackers& trackers_;
  SenderStreams streams_;
  std::atomic<std::uint64_t> misunderstood_ = 0;
  std::unique_ptr<OscServer> server_;  ///< declared last: its thread uses the others
};

}  // namespace stadion
