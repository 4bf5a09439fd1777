#include "pipeline/device/osc_server.h"

#include "pipeline/device/osc_trackers.h"
#include "pipeline/operator/operator_state.h"
#include "pipeline/operator/osc_operator.h"
#include "tests/fuzz/targets.h"

#include <cmath>

namespace stadion::fuzz {
namespace {

/// What messages come to, from a fresh start.
struct OscRoom {
  Nanoseconds time = 1'000'000'000;
  LiveTrackers trackers{standardRig(), [](const std::string&) {}, [this] { return time += 1'000'000; }};
  OscTrackers osc{trackers};
  OperatorState show;

  void take(const OscMessage& m) {
    osc.take(m);
    if (const auto command = operatorCommandOf(m))
      show.apply(*command);
    else
      complaintAbout(m);
  }
};

/// One socket for all packets: opening another one takes longer than reading a packet.
struct Ear {
  OscRoom* room = nullptr;
  std::unique_ptr<OscServer> server;
  Ear() {
    auto opened = OscServer::open(0, [this](const OscMessage& m) { room->take(m); });
    require(static_cast<bool>(opened), "a port is free");
    server = std::move(opened.value());
  }
};

}  // namespace

/// One packet.
void osc(Bytes bytes) {
  static Ear ear;
  OscRoom room;
  ear.room = &room;
  ear.server->decode(bytes);
  InputSample sample;
  room.trackers.sampleFrame(0, 16'666'667, sample);
  for (const TrackerSample& t : sample.trackers) {
    require(t.X_RT.finite(), "a tracker is somewhere");
    for (const float a : t.axes) require(a >= -1 && a <= 1, "an axis is in its range");
  }
  require(room.show.volume >= 0 && room.show.volume <= 1 && std::isfinite(room.show.eyeSeparation()),
          "figures are in their ranges");
}

}  // namespace stadion::fuzz
