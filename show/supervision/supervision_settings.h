#pragma once
/// What outlives a process that plays a show: its progress, and the journal; and what watches it.

#include "pipeline/supervision/service_notifier.h"

#include <string>

namespace stadion {

struct SupervisionSettings {
  double hangAfter = 10;  ///< a player that shows no frame for so long hangs [s]
  int progress = -1;    ///< the descriptor of the SharedProgress of this player's supervisor; -1: it has none
  std::string journal;  ///< the file to which each event of the run is added; empty: none
  ServiceAddress service;  ///< the service manager that started this process
};

}  // namespace stadion
