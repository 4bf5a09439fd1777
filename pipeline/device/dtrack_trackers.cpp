#include "pipeline/device/dtrack_trackers.h"

#include "engine/input/tracker_names.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kDay = 86'400;           ///< [s]
constexpr std::size_t kMostSenders = 64;  ///< more are forgotten

}  // namespace

Result<std::unique_ptr<DTrackTrackers>> DTrackTrackers::open(std::uint16_t port, LiveTrackers& trackers) {
  auto made = std::make_unique<DTrackTrackers>(trackers);
  auto opened =
      UdpPort::open(port, [t = made.get()](std::span<const std::uint8_t> packet, std::string_view from) {
        t->take({reinterpret_cast<const char*>(packet.data()), packet.size()}, from);
      });
  if (!opened) return opened.error();
  made->port_ = std::move(opened.value());
  return made;
}

void DTrackTrackers::take(std::string_view text, std::string_view from) {
  const auto packet = readDTrack(text);
  if (!packet) {
    ++misunderstood_;
    trackers_.misunderstood(
        "a packet is none of DTrack's, or damaged; let DTrack send its ASCII output (6d, 6df2, "
        "ts) to this port");
    return;
  }
  const auto sent = sentAt(*packet, from);
  for (const DTrackDevice& device : packet->devices) takeDevice(device, from, sent);
}

/// Counts midnights. A packet of the day before that came late stays there.
std::optional<Nanoseconds> DTrackTrackers::sentAt(const DTrackPacket& packet, std::string_view from) {
  if (!packet.time) return std::nullopt;
  if (days_.size() >= kMostSenders && !days_.contains(from)) days_.clear();
  const auto [at, isNew] = days_.try_emplace(std::string(from), Day{*packet.time, 1});
  Day& day = at->second;
  if (!isNew) {
    const double step = *packet.time - day.last;
    if (std::fabs(step) > 0.9 * kDay && (step < 0 || day.days > 0)) day.days += step < 0 ? 1 : -1;
    day.last = *packet.time;
  }
  return static_cast<Nanoseconds>(std::llround((static_cast<double>(day.days) * kDay + *packet.time) * 1e9));
}

void DTrackTrackers::takeDevice(const DTrackDevice& device, std::string_view from,
                                std::optional<Nanoseconds> sent) {
  const std::string name = (device.flystick ? "flystick" : "body") + std::to_string(device.number);
  const std::string_view standard = device.number > 0 ? "" : device.flystick ? kWandTracker : kHeadTracker;
  const std::string tracker(trackers_.nameOf(name, standard));
  if (device.X_SD) {
    const Vec3 p = device.X_SD->p / trackers_.unit();
    const Quat& q = device.X_SD->q;
    streams_.take(tracker, {Measurement::Kind::Pose, {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}}, from,
                  sent);
  }
  if (device.flystick) takeControls(tracker, device, from, sent);
}

/// The controllers come with each packet, buttons when they change.
void DTrackTrackers::takeControls(const std::string& name, const DTrackDevice& device, std::string_view from,
                                  std::optional<Nanoseconds> sent) {
  if (down_.size() >= kMostSenders && !down_.contains(name)) down_.clear();
  const auto [at, isNew] = down_.try_emplace(name, 0);
  for (std::uint32_t i = 0; i < device.buttonCount; ++i) {
    const std::uint32_t bit = 1u << i;
    if ((device.buttons & bit) == (at->second & bit)) continue;
    const double down = (device.buttons & bit) != 0 ? 1 : 0;
    streams_.take(name, {Measurement::Kind::Button, {static_cast<double>(i + 1), down}}, from, sent);
  }
  at->second = device.buttons;
  for (std::size_t i = 0; i < device.controllers.size(); ++i)
    streams_.take(name, {Measurement::Kind::Axis, {static_cast<double>(i), device.controllers[i]}}, from,
                  sent);
}

}  // namespace stadion
