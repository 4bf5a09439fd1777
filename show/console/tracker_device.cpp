#include "show/console/tracker_device.h"

#include <charconv>
#include <optional>

namespace stadion {
namespace {

std::optional<std::uint16_t> portOf(const std::string& word) {
  std::uint16_t port = 0;
  const auto [end, wrong] = std::from_chars(word.data(), word.data() + word.size(), port);
  return wrong == std::errc() && end == word.data() + word.size() ? std::optional(port) : std::nullopt;
}

}  // namespace

std::unique_ptr<TrackerDevice> TrackerDevice::open(const TrackerOptions& options, LiveTrackers::Tell tell,
                                                   Diagnostics& findings) {
  auto rig = options.rig.empty() ? std::optional(standardRig()) : loadRigFile(options.rig, findings);
  if (!rig) return nullptr;
  std::unique_ptr<TrackerDevice> made(new TrackerDevice(std::move(*rig), std::move(tell)));
  return made->listen(options.device, findings) ? std::move(made) : nullptr;
}

bool TrackerDevice::listen(const std::string& device, Diagnostics& findings) {
  const auto keep = [&](auto opened, auto& place) {
    if (opened)
      place = std::move(opened.value());
    else
      findings.error({}, "--tracker: " + opened.error().message);
    return place != nullptr;
  };
  const std::size_t colon = std::min(device.find(':'), device.size());
  const std::string kind = device.substr(0, colon), where = device.substr(std::min(colon + 1, device.size()));
  if (kind == "vrpn" && !where.empty()) return keep(VrpnTrackers::open(where, trackers_), vrpn_);
  if (const auto port = portOf(where); kind == "osc" && port)
    return keep(OscTrackers::open(*port, trackers_), osc_);
  findings.error({}, "--tracker: \"" + device + "\" is not osc:PORT (such as osc:7000) or vrpn:DEVICE@HOST");
  return false;
}

std::string TrackerDevice::description() const {
  return osc_ ? "OSC on UDP port " + std::to_string(osc_->port()) : "VRPN";
}

}  // namespace stadion
