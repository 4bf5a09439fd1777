#pragma once
/// Trackers of VRPN servers, if the library was installed when the program was built.
///
/// `DEVICE@HOST` is a VRPN address. Its sensors 0, 1, ... are the rig file's trackers, in their order. Its
/// buttons and channels, if it has any, belong to the last of these trackers.
///
/// Threads  one of its own.
/// Errors   it waits for a server that does not run.

#include "pipeline/device/live_trackers.h"

#include <memory>

namespace stadion {

class VrpnTrackers {
public:
  /// Fails if the program was built without VRPN. The trackers must outlive it.
  static Result<std::unique_ptr<VrpnTrackers>> open(const std::string& address, LiveTrackers& trackers);
  ~VrpnTrackers();

private:
  struct Connection;
  explicit VrpnTrackers(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

}  // namespace stadion
