#pragma once
/// The trackers that were asked for on the command line: `--tracker
/// osc:PORT|dtrack:PORT|freed:PORT|vrpn:DEVICE@HOST`, `--rig FILE`.
///
/// Ownership  owns the device and its threads.

#include "pipeline/device/dtrack_trackers.h"
#include "pipeline/device/freed_trackers.h"
#include "pipeline/device/osc_trackers.h"
#include "pipeline/device/vrpn_trackers.h"

#include <memory>
#include <string>

namespace stadion {

struct TrackerOptions {
  std::string device, rig;
};

class TrackerDevice {
public:
  /// Null, with the reason in the findings, if it cannot be opened. `tell` learns of what is left out.
  static std::unique_ptr<TrackerDevice> open(const TrackerOptions& options, LiveTrackers::Tell tell,
                                             Diagnostics& findings);

  LiveTrackers& trackers() { return trackers_; }
  const RigFile& rig() const { return rig_; }
  /// Where it listens, for people.
  std::string description() const;
  std::uint64_t misunderstood() const;

private:
  TrackerDevice(RigFile rig, LiveTrackers::Tell tell)
      : rig_(std::move(rig)), trackers_(rig_, std::move(tell)) {}
  bool listen(const std::string& device, Diagnostics& findings);

  RigFile rig_;
  LiveTrackers trackers_;
  std::unique_ptr<OscTrackers> osc_;
  std::unique_ptr<DTrackTrackers> dtrack_;
  std::unique_ptr<FreeDTrackers> freed_;
  std::unique_ptr<VrpnTrackers> vrpn_;
};

}  // namespace stadion
