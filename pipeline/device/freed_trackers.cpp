#include "pipeline/device/freed_trackers.h"

#include "engine/input/tracker_names.h"

#include <string>

namespace stadion {

Result<std::unique_ptr<FreeDTrackers>> FreeDTrackers::open(std::uint16_t port, LiveTrackers& trackers) {
  auto made = std::make_unique<FreeDTrackers>(trackers);
  auto opened = UdpPort::open(port, [t = made.get()](std::span<const std::uint8_t> packet,
                                                     std::string_view from) { t->take(packet, from); });
  if (!opened) return opened.error();
  made->port_ = std::move(opened.value());
  return made;
}

void FreeDTrackers::take(std::span<const std::uint8_t> packet, std::string_view from) {
  const auto read = readFreeD(packet);
  if (!read) {
    ++misunderstood_;
    trackers_.misunderstood("a packet of " + std::to_string(packet.size()) +
                            " bytes is no FreeD message D1 of 29 bytes, or damaged");
    return;
  }
  if (!head_) head_ = read->camera;
  const std::string name = "camera" + std::to_string(read->camera);
  const std::string_view tracker = trackers_.nameOf(name, read->camera == *head_ ? kHeadTracker : "");
  const Vec3 p = read->X_SD.p / trackers_.unit();
  const Quat& q = read->X_SD.q;
  streams_.take(tracker, {Measurement::Kind::Pose, {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}}, from,
                {});
}

}  // namespace stadion
