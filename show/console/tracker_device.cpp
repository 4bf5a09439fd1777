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
  if (const auto port = portOf(where)) {
    if (kind == "osc") return keep(OscTrackers::open(*port, trackers_), osc_);
    if (kind == "dtrack") return keep(DTrackTrackers::open(*port, trackers_), dtrack_);
    if (kind == "freed") return keep(FreeDTrackers::open(*port, trackers_), freed_);
  }
  findings.error({},
                 "--tracker: \"" + device +
                     "\" is not osc:PORT (such as osc:7000), dtrack:PORT, freed:PORT or vrpn:DEVICE@HOST");
  return false;
}

std::string TrackerDevice::description() const {
  if (osc_) return "OSC on UDP port " + std::to_string(osc_->port());
  if (dtrack_) return "DTrack on UDP port " + std::to_string(dtrack_->port());
  return freed_ ? "FreeD on UDP port " + std::to_string(freed_->port()) : "VRPN";
}

std::uint64_t TrackerDevice::misunderstood() const {
  if (osc_) return osc_->misunderstood();
  if (dtrack_) return dtrack_->misunderstood();
  return freed_ ? freed_->misunderstood() : 0;
}

}  // namespace stadion
