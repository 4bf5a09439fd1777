#include "pipeline/device/vrpn_trackers.h"

#ifdef STADION_VRPN
#include <vrpn_Analog.h>
#include <vrpn_Button.h>
#include <vrpn_Tracker.h>

#include <atomic>
#include <chrono>
#include <thread>
#endif

namespace stadion {

#ifdef STADION_VRPN

struct VrpnTrackers::Connection {
  Connection(const std::string& address, LiveTrackers& to)
      : trackers(to), names(to.names()), poses(address.c_str()), buttons(address.c_str()),
        channels(address.c_str()) {
    poses.register_change_handler(this, &Connection::moved);
    buttons.register_change_handler(this, &Connection::pressed);
    channels.register_change_handler(this, &Connection::turned);
    thread = std::thread([this] {
      while (!ending) {
        poses.mainloop();
        buttons.mainloop();
        channels.mainloop();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  ~Connection() {
    ending = true;
    thread.join();
  }

  static void VRPN_CALLBACK moved(void* self, const vrpn_TRACKERCB m) {
    auto& c = *static_cast<Connection*>(self);
    if (m.sensor < 0 || static_cast<std::size_t>(m.sensor) >= c.names.size()) return;
    c.trackers.pose(c.names[static_cast<std::size_t>(m.sensor)], c.trackers.now(),
                    {Vec3(m.pos[0], m.pos[1], m.pos[2]), Quat(m.quat[3], m.quat[0], m.quat[1], m.quat[2])});
  }
  static void VRPN_CALLBACK pressed(void* self, const vrpn_BUTTONCB m) {
    auto& c = *static_cast<Connection*>(self);
    c.trackers.button(c.names.back(), c.trackers.now(), m.button + 1, m.state != 0);
  }
  static void VRPN_CALLBACK turned(void* self, const vrpn_ANALOGCB m) {
    auto& c = *static_cast<Connection*>(self);
    for (vrpn_int32 i = 0; i < m.num_channel && i < static_cast<vrpn_int32>(kTrackerAxes); ++i)
      c.trackers.axis(c.names.back(), c.trackers.now(), i, m.channel[i]);
  }

  LiveTrackers& trackers;
  std::vector<std::string> names;
  vrpn_Tracker_Remote poses;
  vrpn_Button_Remote buttons;
  vrpn_Analog_Remote channels;
  std::atomic<bool> ending = false;
  std::thread thread;
};

Result<std::unique_ptr<VrpnTrackers>> VrpnTrackers::open(const std::string& address, LiveTrackers& trackers) {
  return std::unique_ptr<VrpnTrackers>(new VrpnTrackers(std::make_unique<Connection>(address, trackers)));
}

#else

struct VrpnTrackers::Connection {};

Result<std::unique_ptr<VrpnTrackers>> VrpnTrackers::open(const std::string& address, LiveTrackers&) {
  return Result<std::unique_ptr<VrpnTrackers>>::failure(
      "vrpn:" + address +
      ": this program was built without VRPN; install its library (github.com/vrpn/vrpn) and build again, or "
      "let the tracking system send OSC");
}

#endif

VrpnTrackers::VrpnTrackers(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}
VrpnTrackers::~VrpnTrackers() = default;

}  // namespace stadion
