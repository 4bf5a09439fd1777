#pragma once
/// Trackers that send FreeD messages over UDP (freed_packet.h), as camera trackers do.
///
/// Camera N is called cameraN. The rig file says which tracker it is (`sent-as camera1`). Where it says nothing, the
/// first camera that is heard of is the head. Lengths are as the protocol has them, whatever the rig file's unit. The
/// messages have no time: that of arrival counts.
///
/// Threads  one of its own.
/// Errors   other packets are counted, and the first one is logged.

#include "pipeline/device/freed_packet.h"
#include "pipeline/device/sender_streams.h"
#include "pipeline/device/udp_port.h"

#include <atomic>
#include <memory>

namespace stadion {

class FreeDTrackers {
public:
  /// Makes an instance without a network, which receives only what take() is given. The trackers must outlive it.
  explicit FreeDTrackers(LiveTrackers& trackers) : trackers_(trackers), streams_(trackers) {}
  /// Makes an instance that listens. Fails if the port is taken.
  static Result<std::unique_ptr<FreeDTrackers>> open(std::uint16_t port, LiveTrackers& trackers);

  /// Expects an instance that listens.
  std::uint16_t port() const { return port_->port(); }
  void take(std::span<const std::uint8_t> packet, std::string_view from);
  std::uint64_t misunderstood() const { return misunderstood_; }

private:
  LiveTrackers& trackers_;
  SenderStreams streams_;
  std::optional<std::uint32_t> head_;  ///< the camera that is the head if the rig file says nothing
  std::atomic<std::uint64_t> misunderstood_ = 0;
  std::unique_ptr<UdpPort> port_;  ///< declared last: its thread uses the others
};

}  // namespace stadion
