#pragma once
/// Where the operator's commands and the trackers come from, and whether sounds are played.

#include "show/console/tracker_device.h"

namespace stadion {

struct OperatorSettings {
  TrackerOptions trackers{};
  int oscPort = -1;   ///< the UDP port for the operator's commands; -1: none
  bool wait = false;  ///< the show stands at its first frame until the operator starts it
  bool noSound = false;
  bool hasPage = false;    ///< the operator has a web page, too
  bool elsewhere = false;  ///< operator and trackers are at the machine that leads the cluster
};

}  // namespace stadion
