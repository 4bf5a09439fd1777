#pragma once
/// Trackers of ART's DTrack, which sends text over UDP (dtrack_packet.h).
///
/// A body is called body0, body1, ..., a Flystick flystick0, flystick1, ... The rig file says which tracker each is
/// (`sent-as body2`). Where it says nothing, body0 is the head and flystick0 the wand. Lengths are millimetres whatever
/// the rig file's unit. The first button of a Flystick is button 1, its first controller is axis 0.
///
/// Threads  one of its own.
/// Errors   packets that are none of DTrack's, or damaged, are counted, and the first one is logged.

#include "pipeline/device/dtrack_packet.h"
#include "pipeline/device/sender_streams.h"
#include "pipeline/device/udp_port.h"

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace stadion {

class DTrackTrackers {
public:
  /// Makes an instance without a network, which receives only what take() is given. The trackers must outlive it.
  explicit DTrackTrackers(LiveTrackers& trackers) : trackers_(trackers), streams_(trackers) {}
  /// Makes an instance that listens. Fails if the port is taken.
  static Result<std::unique_ptr<DTrackTrackers>> open(std::uint16_t port, LiveTrackers& trackers);

  /// Expects an instance that listens.
  std::uint16_t port() const { return port_->port(); }
  void take(std::string_view packet, std::string_view from);
  std::uint64_t misunderstood() const { return misunderstood_; }

private:
  void takeDevice(const DTrackDevice& device, std::string_view from, std::optional<Nanoseconds> sent);
  void takeControls(const std::string& name, const DTrackDevice& device, std::string_view from,
                    std::optional<Nanoseconds> sent);
  std::optional<Nanoseconds> sentAt(const DTrackPacket& packet, std::string_view from);

  /// A sender's time of day, which restarts at midnight.
  struct Day {
    double last = 0;        ///< [s]
    std::int64_t days = 0;  ///< midnights so far
  };

  LiveTrackers& trackers_;
  SenderStreams streams_;
  std::map<std::string, Day, std::less<>> days_;            ///< by host
  std::map<std::string, std::uint32_t, std::less<>> down_;  ///< buttons of each device in its last packet
  std::atomic<std::uint64_t> misunderstood_ = 0;
  std::unique_ptr<UdpPort> port_;  ///< declared last: its thread uses the others
};

}  // namespace stadion
